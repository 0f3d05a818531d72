"""A finite-element program of NumPy and SciPy: two blocks of quadrilaterals in plane strain, neo-Hooke, at finite
strains, one of which is pressed onto the other and dragged over it. Contact with friction is Osculate's.

    python3 plane_blocks.py [FOLDER]         writes FOLDER/increments.csv and FOLDER/nodes.csv
    osculate run plane_blocks.yaml           the same model with the bodies of Osculate
"""
import functools
import sys

import newton
import numpy as np
import osculate
from scipy.sparse import coo_matrix, csr_matrix


class Block:
    """A rectangle of cells, whose nodes are rows of `points` from `first` on; numbers count all nodes."""

    def __init__(self, x, y, elements, first, young, poisson):
        self.node = first + np.arange((elements[0] + 1) * (elements[1] + 1)).reshape(elements[0] + 1, -1)
        grid = np.meshgrid(np.linspace(*x, elements[0] + 1), np.linspace(*y, elements[1] + 1), indexing="ij")
        self.points = np.stack(grid, axis=-1).reshape(-1, 2)
        n = self.node
        self.cells = np.stack([n[:-1, :-1], n[1:, :-1], n[1:, 1:], n[:-1, 1:]], axis=-1).reshape(-1, 4)
        self.mu, self.lam = young / (2 + 2 * poisson), young * poisson / ((1 + poisson) * (1 - 2 * poisson))


def stress(block, F):
    """Second Piola-Kirchhoff stress (cells, 2, 2) and its derivative by E11, E22, 2 E12 (cells, 3, 3) of
    W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2."""
    inverse = np.linalg.inv(F.transpose(0, 2, 1) @ F)
    log_j = np.log(np.linalg.det(F))[:, None, None]
    S = block.mu * (np.eye(2) - inverse) + block.lam * log_j * inverse
    a, b = [0, 1, 0], [0, 1, 1]
    i, j = inverse[:, a][:, :, a], inverse[:, b][:, :, b]
    of_pairs = i * j + inverse[:, a][:, :, b] * inverse[:, b][:, :, a]
    column = inverse[:, a, b]
    return S, block.lam * column[:, :, None] * column[:, None, :] + (block.mu - block.lam * log_j) * of_pairs


def cell_forces(block, reference, x):
    """Internal forces (cells, 8) and their derivative (cells, 8, 8), by 2 x 2 Gauss points."""
    cells = block.cells
    force, matrix = np.zeros((len(cells), 8)), np.zeros((len(cells), 8, 8))
    corner = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    for xi in corner / np.sqrt(3):
        slope = corner * (1 + corner * xi)[:, ::-1] / 4                      # dN_a / dxi
        jacobian = reference[cells].transpose(0, 2, 1) @ slope
        G = slope @ np.linalg.inv(jacobian)                                 # dN_a / dX
        weight = np.linalg.det(jacobian)
        F = x[cells].transpose(0, 2, 1) @ G
        S, D = stress(block, F)
        B = np.empty((len(cells), 3, 4, 2))                                 # d(E11, E22, 2 E12) / dx_ai
        B[:, 0] = G[:, :, :1] * F[:, None, :, 0]
        B[:, 1] = G[:, :, 1:] * F[:, None, :, 1]
        B[:, 2] = G[:, :, :1] * F[:, None, :, 1] + G[:, :, 1:] * F[:, None, :, 0]
        B = B.reshape(-1, 3, 8)
        force += weight[:, None] * np.einsum("cvm,cv->cm", B, S[:, [0, 1, 0], [0, 1, 1]])
        matrix += weight[:, None, None] * (B.transpose(0, 2, 1) @ D @ B)
        initial = weight[:, None, None] * (G @ S @ G.transpose(0, 2, 1))
        for axis in range(2):
            matrix[:, axis::2, axis::2] += initial
    return force, matrix


def assembled(blocks, reference, x, tangent):
    """Internal forces of all coordinates and their sparse derivative."""
    force, matrix = np.zeros(x.size), csr_matrix((x.size, x.size))
    for block in blocks:
        f, k = cell_forces(block, reference, x)
        at = (2 * block.cells[:, :, None] + np.arange(2)).reshape(-1, 8)
        np.add.at(force, at, f)
        if tangent:
            rows, columns = np.broadcast_arrays(at[:, :, None], at[:, None, :])
            matrix += coo_matrix((k.ravel(), (rows.ravel(), columns.ravel())), matrix.shape).tocsr()
    return (force, matrix) if tangent else force


class Problem:
    """Both blocks and their contact."""

    def __init__(self):
        lower = Block((-2, 2), (0, 1), (16, 4), 0, 1000, 0.3)
        upper = Block((-1.5, -0.5), (1.01, 1.61), (6, 4), len(lower.points), 2000, 0.3)
        self.reference, self.blocks = np.vstack([lower.points, upper.points]), [lower, upper]
        self.bodies = functools.partial(assembled, self.blocks, self.reference)
        # Facets have their body on the right of the way from the first to the second node.
        top = np.column_stack([lower.node[:-1, -1], lower.node[1:, -1]])
        bottom = np.column_stack([upper.node[1:, 0], upper.node[:-1, 0]])
        self.contact = osculate.Evaluator(
            self.reference, master=osculate.Surface(facets=[("line2", top)]),
            slave=osculate.Surface(facets=[("line2", bottom)]), sampling="gauss", sampling_points=2,
            normal={"penalty": 5e4}, friction={"coulomb": {"mu": 0.3, "penalty": 2.5e4}})
        self.lower_bottom, self.upper_top, self.upper = lower.node[:, 0], upper.node[:, -1], upper.node.ravel()
        self.motions = [(0, -0.13 / 4)] * 4 + [(1.6 / 20, 0)] * 20

    def drag(self, solve, folder=None):
        newton.drag(solve, self.contact, self.reference, self.lower_bottom, self.upper_top, self.upper, self.motions, folder)


if __name__ == "__main__":
    problem = Problem()
    problem.drag(functools.partial(newton.increment, problem.bodies), *sys.argv[1:])
