"""A total-Lagrangian finite-element program that works as felupe does: gradients of all cells at all quadrature points
are one array, and forces and matrix are contracted by einsum. Two blocks of hexahedra, neo-Hooke, at finite strains:
one is pressed onto the other and dragged over it, aslant to its cells. Contact with friction is Osculate's.

    python3 total_lagrangian.py [FOLDER]     writes FOLDER/increments.csv and FOLDER/nodes.csv
    osculate run total_lagrangian.yaml       the same model with the bodies of Osculate

Indices: a, b nodes of a cell; i, k present and J, L reference axes; q quadrature points; c cells
"""
import functools
import itertools
import sys

import newton
import numpy as np
import osculate
from scipy.sparse import coo_matrix, csr_matrix

CORNERS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])


class Mesh:
    """A box of hexahedra; `node[i, j, k]` of a grid are rows of all nodes, counted from `first`."""

    def __init__(self, low, high, elements, first):
        lines = [np.linspace(a, b, n + 1) for a, b, n in zip(low, high, elements)]
        self.points = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1).reshape(-1, 3)
        self.node = node = first + np.arange(len(self.points)).reshape([n + 1 for n in elements])
        ends = {-1: slice(None, -1), 1: slice(1, None)}
        self.cells = np.stack([node[tuple(ends[s] for s in corner)].ravel() for corner in CORNERS], axis=-1)


class Region:
    """Gradients dN_a/dX_J (a, J, q, c) of the cells at 2 x 2 x 2 Gauss points, and the same times volumes dV."""

    def __init__(self, reference, cells):
        points = np.array(list(itertools.product([-1, 1], repeat=3))) / np.sqrt(3)
        slope = np.empty((8, 3, len(points)))                                          # dN_a / dxi
        for axis in range(3):
            others = [other for other in range(3) if other != axis]
            slope[:, axis] = CORNERS[:, axis, None] / 8 * np.prod(
                [1 + CORNERS[:, other, None] * points[None, :, other] for other in others], axis=0)
        jacobian = np.einsum("caI,aJq->qcIJ", reference[cells], slope)                  # dX_I / dxi_J
        self.cells = cells
        self.dNdX = np.einsum("aIq,qcIJ->aJqc", slope, np.linalg.inv(jacobian))
        self.dNdX_dV = self.dNdX * np.linalg.det(jacobian)

    def deformation(self, x):
        """F_iJ (i, J, q, c)."""
        return np.einsum("cai,aJqc->iJqc", x[self.cells], self.dNdX)


class NeoHooke:
    """W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2."""

    def __init__(self, young, poisson):
        self.mu, self.lam = young / (2 + 2 * poisson), young * poisson / ((1 + poisson) * (1 - 2 * poisson))

    def gradient(self, F):
        """First Piola-Kirchhoff stress P_iJ = dW/dF_iJ; and F^-1 and lambda ln det F."""
        at_points = np.moveaxis(F, (0, 1), (-2, -1))
        inverse = np.moveaxis(np.linalg.inv(at_points), (-2, -1), (0, 1))               # (J, i, q, c)
        pressure = self.lam * np.log(np.linalg.det(at_points))
        return self.mu * F + (pressure - self.mu) * inverse.swapaxes(0, 1), inverse, pressure

    def hessian(self, inverse, pressure):
        """A_iJkL = dP_iJ/dF_kL."""
        A = self.lam * np.einsum("Jiqc,Lkqc->iJkLqc", inverse, inverse)
        A += (self.mu - pressure) * np.einsum("Liqc,Jkqc->iJkLqc", inverse, inverse)
        A += self.mu * np.einsum("ik,JL->iJkL", np.eye(3), np.eye(3))[..., None, None]
        return A


def assembled(bodies, x, tangent):
    """Internal forces of all coordinates and their sparse derivative."""
    force, matrix = np.zeros(x.size), csr_matrix((x.size, x.size))
    for region, material in bodies:
        P, *state = material.gradient(region.deformation(x))
        at = 3 * region.cells.T[:, None, :] + np.arange(3)[:, None]
        np.add.at(force, at, np.einsum("aJqc,iJqc->aic", region.dNdX_dV, P))
        if tangent:
            slope = np.einsum("iJkLqc,bLqc->iJbkqc", material.hessian(*state), region.dNdX)      # dP_iJ / dx_bk
            k = np.einsum("aJqc,iJbkqc->aibkc", region.dNdX_dV, slope)
            rows, columns = np.broadcast_arrays(at[:, :, None, None], at[None, None])
            matrix += coo_matrix((k.ravel(), (rows.ravel(), columns.ravel())), matrix.shape).tocsr()
    return (force, matrix) if tangent else force


def facets(layer):
    """Quadrilaterals of a layer of nodes [i, j] of the grid; seen from above they run counterclockwise."""
    return np.stack([layer[:-1, :-1], layer[1:, :-1], layer[1:, 1:], layer[:-1, 1:]], axis=-1).reshape(-1, 4)


class Problem:
    """Both blocks and what happens to them."""

    laws = dict(sampling="gauss", sampling_points=3, smoothing="hermite", normal={"penalty": 1e5},
                friction={"coulomb": {"mu": 0.3, "penalty": 5e4}})
    motions = [(0, 0, -0.13 / 4)] * 4 + [(0.96 / 12, 0.24 / 12, 0)] * 12

    def __init__(self):
        self.lower = Mesh((-1.5, -1, 0), (1.5, 1, 1), (9, 6, 3), 0)
        self.upper = Mesh((-1.2, -0.5, 1.01), (-0.2, 0.4, 1.61), (5, 4, 3), len(self.lower.points))
        self.reference = np.vstack([self.lower.points, self.upper.points])

    def bodies(self):
        """Internal forces as a function of coordinates."""
        parts = [(Region(self.reference, self.lower.cells), NeoHooke(1000, 0.3)),
                 (Region(self.reference, self.upper.cells), NeoHooke(2000, 0.3))]
        return functools.partial(assembled, parts)

    def drag(self, folder=None):
        lower, upper = self.lower.node, self.upper.node
        top, bottom = facets(lower[:, :, -1]), facets(upper[:, :, 0])[:, ::-1]                # each seen from outside
        contact = osculate.Evaluator(self.reference, master=osculate.Surface(facets=[("quad4", top)]),
                                     slave=osculate.Surface(facets=[("quad4", bottom)]), **self.laws)
        newton.drag(functools.partial(newton.increment, self.bodies()), contact, self.reference, lower[:, :, 0],
                    upper[:, :, -1], upper.ravel(), self.motions, folder)


if __name__ == "__main__":
    Problem().drag(*sys.argv[1:])
