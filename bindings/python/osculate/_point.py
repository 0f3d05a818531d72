"""One contact point with all that the covariant description says of it, by name."""
from dataclasses import dataclass

import numpy as np

from . import _core
from ._comments import comment_of
from ._contact import Evaluator, Feature, Status, Surface, csr


@dataclass(frozen=True)
@comment_of("osculate::contact::Kinematics", "osculate::contact::consistent_terms", "osculate::contact::covariant_terms")
class PointParts:
    """What a contact point is at one configuration, n nodes in d dimensions, m directions that its place on the
    master moves in (a face of space has 2, an edge 1, a corner 0). `d_...` are derivatives by the coordinates of all
    nodes one behind the other, n d columns. Formulas: docs/equations.md.

    feature, facet, xi, foot    where it is on the master: Feature, number, convective coordinates, place in space
    gap, normal                 g = (r_s - rho) . n, negative inside; n points out of the master (d)
    base, second                rho_,i (m, d) and rho_,ij (m, m, d)
    metric, inverse_metric      a_ij and a^ij (m, m)
    curvature, offset_metric    h_ij = rho_,ij . n and a_ij - g h_ij
    d_gap, d_xi, d_normal       (n d), (m, n d), (d, n d)
    d_base                      of rho_,i at the place that moves along, (m, d, n d)
    status, pressure            Status; normal traction N, negative in compression
    shear, slip                 tangential traction and elastic predictor's slip of the increment, in space (d)
    force                       on all nodes, (n d)
    tangent                     its derivative, (n d, n d)
    main, rotational, bending   the parts of the papers' tangent: KS2D:54, 56, 58 and KSVD:55 to 58. Their sum is not
                                `tangent`: the papers take the rates at g = 0 (docs/theory_contact.md)
    before, after               History: what it remembers at the beginning of the increment, and at its end
    """

    feature: Feature
    facet: int
    xi: np.ndarray
    foot: np.ndarray
    gap: float
    normal: np.ndarray
    base: np.ndarray
    second: np.ndarray
    metric: np.ndarray
    inverse_metric: np.ndarray
    curvature: np.ndarray
    offset_metric: np.ndarray
    d_gap: np.ndarray
    d_xi: np.ndarray
    d_normal: np.ndarray
    d_base: np.ndarray
    status: Status
    pressure: float
    shear: np.ndarray
    slip: np.ndarray
    force: np.ndarray
    tangent: np.ndarray
    main: np.ndarray
    rotational: np.ndarray
    bending: np.ndarray
    before: _core.History
    after: _core.History

    def __str__(self):
        """Where it is and what acts there, in a few lines; `repr` has all."""
        lines = [f"{self.status.name} at the {self.feature.name} of facet {self.facet}, xi {self.xi}, place {self.foot}",
                 f"gap {self.gap:.6g}, normal {self.normal}, pressure {self.pressure:.6g}, shear {self.shear}"]
        for name in ("metric", "curvature"):
            lines.append(f"{name} {np.array2string(getattr(self, name)).replace(chr(10), '')}")
        for name in ("tangent", "main", "rotational", "bending"):
            lines.append(f"{name}: largest entry {np.abs(getattr(self, name)).max(initial=0.0):.6g}")
        return "\n".join(lines)


class ContactPoint:
    """A slave node and its master, of weight 1, to look at what contact is made of.

    coordinates   of all nodes where it begins, (n, d): the slave's and the master's
    master        Surface
    slave         number of the slave's node
    The others are those of Evaluator; of these `residual="full"` has the work-conjugate forces. Errors: Refused.
    """

    def __init__(self, coordinates, *, master, slave=0, normal, friction=None, **options):
        self._x = np.array(coordinates, dtype=float)
        self._master, self._slave = master, slave
        arguments = dict(master=master, slave=Surface(points=(slave,)), normal=normal, friction=friction, weight="node",
                         **options)
        self._exact = Evaluator(self._x, **arguments)
        self._parts = {name: Evaluator(self._x, tangent=[word], **arguments)
                       for name, word in (("main", "main"), ("rotational", "rotational"), ("bending", "curvature"))}
        self.start = self._exact.initial_history(self._x)

    def _matrix(self, evaluation):
        size = self._x.size
        data, indices, indptr = csr(evaluation.tangent, size)
        rows = np.repeat(np.arange(size), np.diff(indptr))
        out = np.zeros((size, size))
        out[rows, indices] = data
        return out

    def at(self, coordinates, before=None, *, duration=0.0):
        """PointParts at these coordinates; before: a History (`after` of an earlier one), None: that of the start."""
        x = np.array(coordinates, dtype=float).reshape(self._x.shape)
        before = self.start if before is None else before
        now = self._exact.evaluate(x, before, duration=duration)
        found = _core.contact_point(self._master, x, self._slave)
        point = now.points[0]
        parts = {name: self._matrix(evaluator.evaluate(x, before, duration=duration))
                 for name, evaluator in self._parts.items()}
        found["feature"] = Feature(found["feature"])
        return PointParts(**found, **parts, status=Status(int(point["status"])), before=before,
                          after=now.committed(), pressure=float(point["normal_traction"]),
                          shear=np.array(point["shear_traction"]), slip=np.array(point["slip"]),
                          force=np.array(now.force).reshape(-1), tangent=self._matrix(now))

    def derivative(self, name, coordinates, before=None, *, step=1e-6, duration=0.0):
        """Central differences of one of the PointParts by all coordinates, as its d_... has them: of `gap`, `xi`,
        `normal`, `base`, `force`, ... Both sides have to be in one state (Status, Feature)."""
        x = np.array(coordinates, dtype=float).reshape(-1)
        columns = []
        for i in range(x.size):
            sides = []
            for sign in (1, -1):
                moved = x.copy()
                moved[i] += sign * step
                sides.append(np.asarray(getattr(self.at(moved, before, duration=duration), name), dtype=float))
            columns.append((sides[0] - sides[1]) / (2 * step))
        return np.stack(columns, axis=-1)
