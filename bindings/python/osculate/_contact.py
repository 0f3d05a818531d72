"""Contact for codes of one's own: surfaces and coordinates in, forces, tangent and next state out."""
import enum
import math
from dataclasses import dataclass, field

import numpy as np

from . import _core, _laws
from ._comments import comment_of
from ._core import ActiveSet, Evaluation, History, Multipliers  # noqa: F401


@comment_of("osculate::Status")
class Status(enum.IntEnum):
    open, stick, slip = range(3)


@comment_of("osculate::Feature")
class Feature(enum.IntEnum):
    none, face, edge, corner = range(4)


@comment_of("osculate::ClosestStatus")
class ClosestStatus(enum.IntEnum):
    projected, ambiguous, outside_domain, invalid = range(4)


@dataclass
class Surface:
    """One side of a contact.

    facets   [(type, nodes (m, k)), ...]: line2 ... line8 in the plane (the body is on the right of the way), tri3,
             tri6, quad4, quad8, quad9 in space (counterclockwise from outside), in Gmsh's order
    shapes   Circle, Plane, ... on a rigid body; in the plane also several curves one behind the other
    closed   several curves: the first one begins where the last one ends
    frame    with shapes: the nodes at the origin and the tips of the unit vectors of the frame they stand in
    points   nodes of a slave without facets; they weigh 1 each
    """

    facets: list = field(default_factory=list)
    shapes: list = field(default_factory=list)
    closed: bool = False
    frame: tuple = ()
    points: tuple = ()


@dataclass(frozen=True)
@comment_of("osculate::DerivativeCheck")
class DerivativeCheck:
    """passed: same_states and (exact or 1.75 < order < 2.25)."""

    error: float
    order: float
    exact: bool
    same_states: bool
    passed: bool


@dataclass(frozen=True)
@comment_of("osculate::Pattern")
class Pattern:
    """couplings: (n, 2), slave point and facet of the master."""

    dim: int
    couplings: np.ndarray
    row_start: np.ndarray
    columns: np.ndarray
    point_start: np.ndarray
    point_nodes: np.ndarray

    def csr(self):
        """indices, indptr of coordinates, as of `scipy.sparse.csr_matrix((data, indices, indptr))`."""
        length = np.diff(self.row_start).astype(np.int64)
        block = (self.dim * self.columns[:, None].astype(np.int64) + np.arange(self.dim)).ravel()
        starts = self.dim * np.repeat(self.row_start[:-1].astype(np.int64), self.dim)
        lengths = np.repeat(self.dim * length, self.dim)
        indptr = np.concatenate([[0], np.cumsum(lengths)])
        inside = np.arange(indptr[-1]) - np.repeat(indptr[:-1], lengths)
        return block[np.repeat(starts, lengths) + inside], indptr


@comment_of("osculate::Evaluator")
class Evaluator(_core.Evaluator):
    """Contact of a slave with a master, for a code that has its own mesh and solver.

    reference      coordinates of all nodes, (n, 2) or (n, 3)
    master, slave  Surface; without a slave the master touches itself
    normal         {"penalty": eps_N} or another law of docs/laws.md with its numbers: {"exponential": {...}}
    friction       {"coulomb": {"mu": 0.3, "penalty": eps_T}}, ...; damping: {"restitution": 0.5}, ...
    sampling       nodes, gauss, lobatto or mortar, with sampling_points a direction and subdomains of a facet
    enforcement    penalty, augmented_lagrange or lagrange_multiplier
    weight         what tractions are multiplied by: node (1), reference_area or current_area
    separation     allowed, no_separation, tied_normal or tied
    tangent        None: the exact derivative; else the parts of the papers' one: ["main", "rotational", "curvature"]
    The others are those of include/osculate/options.hpp. Errors: Refused.
    """

    def __init__(self, reference, *, master, slave=None, normal, friction=None, damping=None, factors=None,
                 sampling="nodes", sampling_points=2, subdomains=1, enforcement="penalty", weight="reference_area",
                 separation="allowed", tolerance=0.0, keep_gap=True, offset=0.0, overlap="acts", history="continuous",
                 residual="surface", tangent=None, thickness=1.0, axisymmetric=False, smoothing="none",
                 sharp_angle=math.pi / 6, edge_angle=None, reentrant_vertices=False, search_distance=None,
                 depth=math.inf, part=1.0):
        arguments = dict(locals())
        for name in ("self", "reference", "__class__"):
            arguments.pop(name, None)
        super().__init__(reference, arguments)

    @comment_of("osculate::Evaluator::evaluate")
    def evaluate(self, coordinates, committed, active_set=None, multipliers=None, *, tangent=True, duration=0.0,
                 relief=0.0, far=False):
        """Forces, tangent and next states at these coordinates, (n, dim) or one number behind the other.

        active_set    None: every point is taken as its traction says
        duration      of the increment, for laws that ask for a speed
        relief        overlap="ramped": share of the initial overlaps that does not count yet
        far           with a search distance: report gaps of points far away, too
        Arrays of doubles are read where they stand; those of the Evaluation show its memory.
        """
        answer = super().evaluate(coordinates, committed, active_set, multipliers, tangent, duration, relief, far)
        _laws.reraise()
        return answer

    @comment_of("osculate::Evaluator::predicted", "osculate::FrictionGuess")
    def predicted(self, committed, coordinates, guess="as_before"):
        """States (ActiveSet) for the first iteration of an increment; guess: as_before, sticking or sliding."""
        answer = super().predicted(committed, coordinates, guess)
        _laws.reraise()
        return answer

    @comment_of("osculate::Evaluator::pattern", "osculate::Reach")
    def pattern(self, coordinates, committed, motion, distance=math.inf):
        """A Pattern; motion, distance: those of `reach`. With friction, open points that have a place are as those in contact."""
        return Pattern(**super().pattern(coordinates, committed, motion, distance))

    @comment_of("osculate::check_derivative")
    def derivative_check(self, coordinates, committed, step, active_set=None, multipliers=None, *, duration=0.0):
        """A DerivativeCheck."""
        answer = super().derivative_check(coordinates, committed, step, active_set, multipliers, duration)
        _laws.reraise()
        return DerivativeCheck(**answer)


def csr(entries, size):
    """A matrix of `size` rows from entries (row, column, value) of which those of one place are summed, in the order
    in which they stand: data, indices, indptr as of `scipy.sparse.csr_matrix((data, indices, indptr))`."""
    rows = entries["row"].astype(np.int64)
    place = rows * size + entries["column"]
    places, inverse = np.unique(place, return_inverse=True)
    data = np.bincount(inverse, weights=entries["value"], minlength=len(places))
    indptr = np.searchsorted(places, np.arange(size + 1, dtype=np.int64) * size)
    return data, places % size, indptr


@dataclass(frozen=True)
@comment_of("osculate::ClosestPointArrays")
class Closest:
    """status: ClosestStatus; feature: Feature; xi (n, 2), point (n, dim); unique: whether there is one place only.
    margin and unique are looked for by "certified"."""

    status: np.ndarray
    feature: np.ndarray
    facet: np.ndarray
    xi: np.ndarray
    point: np.ndarray
    distance: np.ndarray
    margin: np.ndarray
    unique: np.ndarray


@comment_of("osculate::ClosestPoints")
class ClosestPoints:
    """The closest points of a surface.

    surface       a shape (Circle, Torus, ...), or facets [(type, nodes), ...] as of Surface
    coordinates   with facets: of all nodes, (n, dim)
    """

    def __init__(self, surface, coordinates=None):
        if coordinates is None:
            self._prepared = _core.ClosestPoints.of_shape(surface)
        else:
            self._prepared = _core.ClosestPoints.of_facets(list(surface), coordinates)

    @property
    def dimension(self):
        """2 or 3."""
        return self._prepared.dimension

    @comment_of("osculate::ClosestPoints::find", "osculate::ClosestMode", "osculate::ClosestPointOptions")
    def find(self, points, mode="certified", threads=1):
        """The nearest places to `points` (n, dim): Closest."""
        return Closest(**self._prepared.find(points, mode, threads))


def closest_points(surface, points, *, coordinates=None, mode="certified", threads=1):
    """ClosestPoints(surface, coordinates).find(points, mode, threads)."""
    return ClosestPoints(surface, coordinates).find(points, mode, threads)


@comment_of("osculate::automatic_penalties", "osculate::Layer")
def automatic_penalties(slave, master=()):
    """Penalties per area (normal, shear). Rows (E, nu, height of the cells, area) of the pieces of both sides; none: rigid."""
    return _core.automatic_penalties([tuple(map(float, row)) for row in slave],
                                     [tuple(map(float, row)) for row in master])
