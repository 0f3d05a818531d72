"""The blocks of plane_blocks.py solved by SNES, the Newton method of PETSc (petsc4py), with contact from Osculate.

    python3 snes.py [FOLDER] [-options of PETSc]     writes FOLDER/increments.csv and FOLDER/nodes.csv
    osculate run plane_blocks.yaml                   the same model by Osculate

DMPlex has the mesh, and a section of it the unknowns: coordinates of vertices, of which those that are held are constrained.
Local vectors have all coordinates in the order that contact wants, global ones those that are free.

SNES has a function and a Jacobian, contact has an active set beside them. It changes between two iterations only, where
SNES asks for the Jacobian; the function is that of the branch that the Jacobian belongs to (`branch_force`), and a test
of convergence of the program's own looks at the forces that are true.
"""
import functools
import sys

import newton
import numpy as np
import osculate
import petsc4py
from scipy.sparse import csr_matrix

petsc4py.init(sys.argv)
from petsc4py import PETSc  # noqa: E402  (after its options)

from plane_blocks import Problem  # noqa: E402


def meshed(problem):
    """The cells of both blocks as a DMPlex; its vertices are the nodes, in their order."""
    cells = np.vstack([block.cells for block in problem.blocks]).astype(PETSc.IntType)
    return PETSc.DMPlex().createFromCellList(2, cells, problem.reference)


def with_section(mesh, held):
    """A copy of the mesh with two unknowns a vertex, those of the `held` nodes constrained."""
    dm, (first, last) = mesh.clone(), mesh.getDepthStratum(0)
    nodes = np.flatnonzero(held.reshape(-1, 2).all(axis=1)).astype(PETSc.IntType)
    assert last - first == len(held) // 2 and 2 * len(nodes) == held.sum()
    dm.setNumFields(1)
    section = dm.createSection([2], [2, 0, 0], [0], bcPoints=[PETSc.IS().createGeneral(first + nodes)])
    dm.setSection(section)
    assert section.getOffset(first) == 0  # local number 2 n + i is coordinate i of node n
    return dm


class Increment:
    """One increment as SNES sees it: the unknowns are the motions of the free coordinates since its beginning."""

    def __init__(self, dm, bodies, contact, history, x, held, motion):
        self.dm, self.local = dm, dm.createLocalVec()
        self.bodies, self.contact, self.history, self.start = bodies, contact, history, x.copy()
        self.free, self.motion = np.flatnonzero(~held), motion
        self.active, self.began = contact.predicted(history, x), False

    def coordinates(self, unknowns):
        """The held coordinates move with the first correction, which starts from where the increment begins."""
        self.local.array = self.motion if self.began else np.zeros_like(self.motion)
        self.dm.globalToLocal(unknowns, self.local)  # which leaves those that are constrained
        return self.start + self.local.array_r.reshape(self.start.shape)

    def evaluate(self, unknowns, tangent):
        x = self.coordinates(unknowns)
        return self.contact.evaluate(x, self.history, self.active, tangent=tangent), self.bodies(x, tangent=tangent)

    def gathered(self, values, out):
        """Of all coordinates those that are free."""
        self.local.array = values
        self.dm.localToGlobal(self.local, out)
        return out

    def function(self, snes, unknowns, out):
        self.now, (self.internal, self.tangent) = self.evaluate(unknowns, True)
        self.tangent = self.tangent + csr_matrix(osculate.csr(self.now.tangent, self.start.size), self.tangent.shape)
        forces = self.internal + self.now.branch_force.ravel()
        if not self.began:
            forces += self.tangent @ self.motion
        self.gathered(forces, out)

    def jacobian(self, snes, unknowns, matrix, preconditioner):
        """Of what the function has evaluated last, by local numbers; from here on the next active set counts."""
        preconditioner.zeroEntries()
        k = self.tangent.tocsr()
        preconditioner.setValuesLocalCSR(k.indptr.astype(PETSc.IntType), k.indices.astype(PETSc.IntType), k.data)
        preconditioner.assemble()
        self.search = self.began and not self.now.branched
        self.residual = self.gathered(self.internal + self.now.force.ravel(), unknowns.duplicate())
        self.active, self.began = self.now.next_active_set(), True

    def scale(self, unknowns, correction):
        """SNES takes unknowns - correction as a whole: it is shortened before, by the rule of `osculate run`."""
        tried = unknowns.duplicate()

        def residual_at(step):
            now, internal = self.evaluate(unknowns - step * correction, False)
            return self.gathered(internal + now.force.ravel(), tried).array_r, now.branched
        if self.search:
            correction.scale(osculate.line_search(residual_at, self.residual.array_r, -correction.array_r))

    def converged(self, snes, iteration, norms):
        done = iteration > 0 and newton.converged(self.internal, self.now.force, self.free)
        return PETSc.SNES.ConvergedReason.CONVERGED_FNORM_RELATIVE if done else PETSc.SNES.ConvergedReason.ITERATING


def increment(mesh, bodies, contact, history, x, held, motion):
    """As newton.increment."""
    dm = with_section(mesh, held)
    problem = Increment(dm, bodies, contact, history, x, held, motion)
    matrix = dm.createMatrix()
    matrix.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)  # contact slides
    snes = PETSc.SNES().create()
    snes.setFunction(problem.function, dm.createGlobalVec())
    snes.setJacobian(problem.jacobian, matrix)
    snes.setConvergenceTest(problem.converged)
    snes.setLineSearchPreCheck(problem.scale)
    options = PETSc.Options()
    options["snes_linesearch_type"] = "basic"
    options["ksp_type"], options["pc_type"] = "preonly", "lu"
    snes.setFromOptions()
    unknowns = dm.createGlobalVec()
    snes.solve(None, unknowns)
    if snes.reason <= 0:
        raise RuntimeError(f"SNES did not converge: {snes.reason}")
    x[:] = problem.coordinates(unknowns)
    return snes.its, problem.now, problem.internal


if __name__ == "__main__":
    problem = Problem()
    problem.drag(functools.partial(increment, meshed(problem), problem.bodies), *(a for a in sys.argv[1:2] if not a.startswith("-")))
