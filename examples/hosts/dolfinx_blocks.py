"""The blocks of total_lagrangian.py with bodies of dolfinx (FEniCSx), whose forces and matrix are derivatives of an
energy in UFL, and with contact from Osculate.

    python3 dolfinx_blocks.py [FOLDER]       writes FOLDER/increments.csv and FOLDER/nodes.csv
    osculate run total_lagrangian.yaml       the same model with the bodies of Osculate

Nodes of contact are those of the function space: number 3 n + i of its vectors is direction i of node n.
"""
import functools
import sys

import newton
import numpy as np
import osculate
import ufl
from dolfinx import fem, mesh
from mpi4py import MPI
from scipy.sparse import csr_matrix
from total_lagrangian import Problem


def function_space(problem):
    """Hexahedra of both blocks, whose corners stand in the order of tensor products in dolfinx."""
    cells = np.vstack([problem.lower.cells, problem.upper.cells])[:, [0, 1, 3, 2, 4, 5, 7, 6]]
    of_points = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.hexahedron, 1))
    return fem.VectorFunctionSpace(mesh.create_mesh(MPI.COMM_SELF, cells, problem.reference, of_points), ("Lagrange", 1))


class Bodies:
    """W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2, with 2 x 2 x 2 Gauss points."""

    def __init__(self, V):
        self.reference, self.u = V.tabulate_dof_coordinates(), fem.Function(V)
        young = fem.Function(fem.FunctionSpace(V.mesh, ("DG", 0)))
        young.interpolate(lambda x: np.where(x[2] < 1, 1000.0, 2000.0))
        mu, lam = young / 2.6, young * 0.3 / (1.3 * 0.4)
        F = ufl.Identity(3) + ufl.grad(self.u)
        J = ufl.det(F)
        W = mu / 2 * (ufl.tr(F.T * F) - 3) - mu * ufl.ln(J) + lam / 2 * ufl.ln(J) ** 2
        energy = W * ufl.dx(metadata={"quadrature_degree": 3})
        self.force = fem.form(ufl.derivative(energy, self.u))
        self.stiffness = fem.form(ufl.derivative(ufl.derivative(energy, self.u), self.u))

    def __call__(self, x, tangent):
        self.u.x.array[:] = (x - self.reference).ravel()
        force = fem.petsc.assemble_vector(self.force).array.copy()
        if not tangent:
            return force
        matrix = fem.petsc.assemble_matrix(self.stiffness)
        matrix.assemble()
        rows, columns, values = matrix.getValuesCSR()
        return force, csr_matrix((values, columns, rows), (x.size, x.size))


def surface(V, height):
    """Boundary facets at this height, by their nodes: seen from outside the corners run counterclockwise."""
    topology, points, quads = V.mesh.topology, V.tabulate_dof_coordinates(), []
    topology.create_connectivity(2, 3)
    of_facet, of_cell = topology.connectivity(2, 3), topology.connectivity(3, 2)
    for facet in mesh.locate_entities_boundary(V.mesh, 2, lambda x: np.isclose(x[2], height)):
        cell = of_facet.links(facet)[0]
        nodes = V.dofmap.cell_dofs(cell)
        a, b, d, c = nodes[V.dofmap.dof_layout.entity_closure_dofs(2, list(of_cell.links(cell)).index(facet))]
        normal = np.cross(points[b] - points[a], points[d] - points[a])
        outwards = normal @ (points[a] - points[nodes].mean(axis=0)) > 0
        quads.append([a, b, c, d] if outwards else [d, c, b, a])
    return osculate.Surface(facets=[("quad4", quads)])


def main(folder=None):
    problem = Problem()
    V = function_space(problem)
    points = V.tabulate_dof_coordinates()
    contact = osculate.Evaluator(points, master=surface(V, 1.0), slave=surface(V, 1.01), **problem.laws)

    def nodes(marker):
        return fem.locate_dofs_geometrical(V, marker)
    newton.drag(functools.partial(newton.increment, Bodies(V)), contact, points, nodes(lambda x: np.isclose(x[2], 0)),
                nodes(lambda x: np.isclose(x[2], 1.61)), nodes(lambda x: x[2] > 1.005), problem.motions, folder)


if __name__ == "__main__":
    main(*sys.argv[1:])
