"""The blocks of plane_blocks.py solved by SNES, the Newton method of PETSc (petsc4py), with contact from Osculate.

    python3 snes.py [FOLDER] [-options of PETSc]     writes FOLDER/increments.csv and FOLDER/nodes.csv
    osculate run plane_blocks.yaml                   the same model by Osculate

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


class Increment:
    """One increment as SNES sees it: the unknowns are the motions of the free coordinates since its beginning."""

    def __init__(self, bodies, contact, history, x, held, motion):
        self.bodies, self.contact, self.history, self.start = bodies, contact, history, x.copy()
        self.free, self.motion = np.flatnonzero(~held), motion
        self.active, self.began = contact.predicted(history, x), False
        self.seen = {}

    def coordinates(self, unknowns):
        """The held coordinates move with the first correction, which starts from where the increment begins."""
        moved = self.motion.copy() if self.began else np.zeros_like(self.motion)
        moved[self.free] = unknowns
        return self.start + moved.reshape(self.start.shape)

    def evaluate(self, unknowns, tangent):
        x = self.coordinates(unknowns)
        return self.contact.evaluate(x, self.history, self.active, tangent=tangent), self.bodies(x, tangent=tangent)

    def function(self, snes, unknowns, out):
        self.now, (self.internal, self.tangent) = self.evaluate(unknowns.array_r, True)
        self.tangent = self.tangent + csr_matrix(osculate.csr(self.now.tangent, self.start.size), self.tangent.shape)
        forces = self.internal + self.now.branch_force.ravel()
        if not self.began:
            forces += self.tangent @ self.motion
        out.array = forces[self.free]

    def jacobian(self, snes, unknowns, matrix, preconditioner):
        """Of what the function has evaluated last; from here on the next active set counts."""
        of_free = self.tangent[self.free][:, self.free].tocsr()
        preconditioner.zeroEntries()
        preconditioner.setValuesCSR(of_free.indptr, of_free.indices, of_free.data)
        preconditioner.assemble()
        self.search = self.began and not self.now.branched
        self.residual = (self.internal + self.now.force.ravel())[self.free]
        self.active, self.began = self.now.next_active_set(), True

    def scale(self, unknowns, correction):
        """SNES takes unknowns - correction as a whole: it is shortened before, by the rule of `osculate run`."""
        def residual_at(step):
            tried, internal = self.evaluate(unknowns.array_r - step * correction.array_r, False)
            return (internal + tried.force.ravel())[self.free], tried.branched
        if self.search:
            correction.scale(osculate.line_search(residual_at, self.residual, -correction.array_r))

    def converged(self, snes, iteration, norms):
        done = iteration > 0 and newton.converged(self.internal, self.now.force, self.free)
        return PETSc.SNES.ConvergedReason.CONVERGED_FNORM_RELATIVE if done else PETSc.SNES.ConvergedReason.ITERATING


def increment(bodies, contact, history, x, held, motion):
    """As newton.increment."""
    problem = Increment(bodies, contact, history, x, held, motion)
    size = len(problem.free)
    matrix = PETSc.Mat().createAIJ((size, size), nnz=size)
    matrix.setOption(PETSc.Mat.Option.NEW_NONZERO_ALLOCATION_ERR, False)
    snes = PETSc.SNES().create()
    snes.setFunction(problem.function, matrix.createVecLeft())
    snes.setJacobian(problem.jacobian, matrix)
    snes.setConvergenceTest(problem.converged)
    snes.setLineSearchPreCheck(problem.scale)
    options = PETSc.Options()
    options["snes_linesearch_type"] = "basic"
    options["ksp_type"], options["pc_type"] = "preonly", "lu"
    snes.setFromOptions()
    unknowns = matrix.createVecRight()
    snes.solve(None, unknowns)
    if snes.reason <= 0:
        raise RuntimeError(f"SNES did not converge: {snes.reason}")
    x[:] = problem.coordinates(unknowns.array_r)
    return snes.its, problem.now, problem.internal


if __name__ == "__main__":
    problem = Problem()
    problem.drag(functools.partial(increment, problem.bodies), *(a for a in sys.argv[1:2] if not a.startswith("-")))
