"""One contact point by name: every d_... and the tangent are derivatives, and the parts are those of the papers."""
import unittest

import numpy as np
from osculate import ContactPoint, Evaluator, Feature, Refused, Status, Surface

PENALTY, SHEAR, MU = 1e3, 4e2, 0.3
FRICTION = {"coulomb": {"mu": MU, "penalty": SHEAR}}
FACETS = [("quad4", [[1, 2, 3, 4], [2, 5, 6, 3]])]


def curve(kind="line3", **options):
    """A slave node beside a parabola that is run from the right to the left."""
    x = np.array([[0.3, 0.19], [1, 0], [-1, 0.1], [0, 0.2]])
    nodes = {"line3": [[1, 2, 3]], "line2": [[1, 2]]}[kind]
    return ContactPoint(x, master=Surface([(kind, nodes)]), normal={"penalty": PENALTY}, friction=FRICTION,
                        **options), x


def surface(kind="quad4", **options):
    x = np.array([[0.45, 0.3, -0.02], [0, 0, 0], [1, 0, 0.1], [1, 1, -0.05], [0, 1, 0.2], [2, 0.1, 0], [2.1, 1, 0]])
    facets = {"quad4": FACETS, "tri3": [("tri3", [[1, 2, 3]])]}[kind]
    return ContactPoint(x, master=Surface(facets), normal={"penalty": PENALTY}, friction=FRICTION, **options), x


def moved(x, way):
    """The slave node goes along, and every node a little."""
    out = x + 1e-3 * np.random.default_rng(1).uniform(-1, 1, x.shape)
    out[0, 0] += way
    return out


class Points(unittest.TestCase):
    def test_it_prints_where_it_is_and_what_acts(self):
        point, x = curve()
        here = point.at(moved(x, 0.002))
        lines = str(here).splitlines()
        self.assertEqual(lines[0].split(", place")[0], f"stick at the face of facet 0, xi {here.xi}")
        self.assertIn(f"gap {here.gap:.6g}, ", lines[1])
        self.assertEqual(lines[4], f"tangent: largest entry {abs(here.tangent).max():.6g}")
        self.assertEqual(len(lines), 8)

    def order(self, point, x, name, exact):
        errors = [np.abs(point.derivative(name, x, step=h) - exact).max() for h in (2e-4, 1e-4)]
        self.assertGreater(errors[0], 0)
        return np.log2(errors[0] / errors[1])

    def test_derivatives_are_of_second_order(self):
        for case in (curve, surface):
            for way, status in ((0.002, Status.stick), (0.08, Status.slip)):
                for residual in ("surface", "full"):
                    with self.subTest(case=case.__name__, status=status.name, residual=residual):
                        point, x = case(residual=residual)
                        x = moved(x, way)
                        now = point.at(x)
                        self.assertEqual((now.status, now.feature), (status, Feature.face))
                        self.assertLess(now.gap, 0)
                        for name, exact in (("gap", now.d_gap), ("xi", now.d_xi), ("normal", now.d_normal),
                                            ("base", now.d_base), ("force", now.tangent)):
                            self.assertAlmostEqual(self.order(point, x, name, exact), 2, delta=0.1, msg=name)

    def test_edges_and_corners(self):
        for place, feature, moving in (([1.05, 0.4, 0.3], Feature.edge, 1), ([-0.2, -0.2, 0.1], Feature.corner, 0)):
            point, x = surface()
            x[0] = place
            if feature is Feature.edge:  # of the fold between both facets, from outside
                x[1:5, 2] -= 0.4 * (1 - x[1:5, 0])
                x[5:, 2] -= 0.4
            now = point.at(x)
            self.assertEqual((now.feature, len(now.d_xi), now.base.shape), (feature, moving, (moving, 3)))
            self.assertAlmostEqual(self.order(point, x, "gap", now.d_gap), 2, delta=0.1)
            self.assertAlmostEqual(self.order(point, x, "normal", now.d_normal), 2, delta=0.1)

    def test_parts_sum_to_the_papers_tangent(self):
        for case in (curve, surface):
            for way in (0.002, 0.08):
                point, x = case()
                now = point.at(moved(x, way))
                facets = [("line3", [[1, 2, 3]])] if case is curve else FACETS
                whole = Evaluator(x, master=Surface(facets), slave=Surface(points=(0,)), normal={"penalty": PENALTY},
                                  friction=FRICTION, weight="node", tangent=["main", "rotational", "curvature"])
                entries = whole.evaluate(moved(x, way), whole.initial_history(x)).tangent
                covariant = now.main + now.rotational + now.bending
                expected = np.zeros(covariant.shape)
                np.add.at(expected, (entries["row"], entries["column"]), entries["value"])
                np.testing.assert_allclose(covariant, expected, atol=1e-12 * np.abs(expected).max())
                symmetric = np.abs(covariant - covariant.T).max() / np.abs(covariant).max()
                self.assertEqual(symmetric < 1e-12, now.status is Status.stick)

    def test_main_part_is_written_with_the_weights(self):
        # [eq:KS2D:54] without friction: eps n n on the weights, of rank 1; the force is N n on them
        x = np.array([[0.3, 0.19], [1, 0], [-1, 0.1], [0, 0.2]])
        point = ContactPoint(x, master=Surface([("line3", [[1, 2, 3]])]), normal={"penalty": PENALTY})
        now = point.at(x)
        weights = now.d_gap.reshape(4, 2) @ now.normal  # w_k n . n
        np.testing.assert_allclose(now.main, PENALTY * np.outer(now.d_gap, now.d_gap), atol=1e-10)
        np.testing.assert_allclose(now.force, PENALTY * now.gap * now.d_gap, atol=1e-12)
        self.assertEqual(np.linalg.matrix_rank(now.main), 1)
        self.assertAlmostEqual(weights.sum(), 0, delta=1e-14)
        self.assertAlmostEqual(now.pressure, PENALTY * now.gap, delta=1e-12)
        # [eq:KS2D:27] a_ij - g h_ij , and h by the second derivative
        np.testing.assert_allclose(now.offset_metric, now.metric - now.gap * now.curvature, atol=1e-15)
        np.testing.assert_allclose(now.curvature, now.second @ now.normal, atol=1e-15)
        np.testing.assert_allclose(now.metric, now.base @ now.base.T, atol=1e-15)

    def test_bending_is_zero_on_flat_facets(self):
        for case, kind in ((curve, "line2"), (surface, "tri3")):
            point, x = case(kind)
            if kind == "tri3":
                x[0] = [0.6, 0.3, 0.0]
            now = point.at(moved(x, 0.002))
            self.assertLess(now.gap, 0)
            self.assertEqual(np.abs(now.bending).max(), 0)
            self.assertGreater(np.abs(now.rotational).max(), 0)

    def test_forces_balance_and_friction_is_limited(self):
        for case in (curve, surface):
            point, x = case()
            now = point.at(moved(x, 0.08))
            np.testing.assert_allclose(now.force.reshape(x.shape).sum(axis=0), 0, atol=1e-11)
            self.assertAlmostEqual(np.linalg.norm(now.shear), -MU * now.pressure, delta=1e-10)

    def test_history_goes_on(self):
        point, x = curve()
        first = point.at(moved(x, 0.002))
        back = point.at(moved(x, 0.002), first.after)
        np.testing.assert_allclose(back.shear, first.shear, atol=1e-12)
        np.testing.assert_allclose(back.slip, 0, atol=1e-15)
        self.assertEqual(first.before.bytes(), point.start.bytes())

    def test_is_the_evaluators_point(self):
        point, x = surface()
        contact = Evaluator(x, master=Surface(FACETS), slave=Surface(points=(0,)),
                            normal={"penalty": PENALTY}, friction=FRICTION, weight="node")
        y = moved(x, 0.002)
        now, same = point.at(y), contact.evaluate(y, contact.initial_history(x))
        np.testing.assert_array_equal(now.force, same.force.reshape(-1))
        self.assertEqual(now.gap, same.points[0]["gap"])

    def test_refusals(self):
        with self.assertRaisesRegex(Refused, "does not exist"):
            ContactPoint(np.zeros((3, 2)), master=Surface([("line2", [[1, 7]])]), normal={"penalty": 1.0})

    def test_the_normal_tangent_is_the_spring_less_what_the_foot_follows(self):
        # [eq:KSVD:55] [eq:KSVD:56] [eq:KSVD:57] [eq:KSVD:58] docs/theory_contact.md, section 6:
        # eps (A^T A - b_i g^ij b_j^T), and what the parts of the papers lack of it: -N gap Q_i g^ij Q_j^T with
        # Q_i = D_i - h_i^k W_k
        x = surface()[1][:5]
        point = ContactPoint(x, master=Surface([("quad4", [[1, 2, 3, 4]])]), normal={"penalty": PENALTY})
        now = point.at(x)
        (a, b), (sa, sb) = now.xi, np.array([[-1, 1, 1, -1], [-1, -1, 1, 1]])
        weights = np.array([np.concatenate(([first], -0.25 * n)) for first, n in (
            (1, (1 + sa * a) * (1 + sb * b)), (0, sa * (1 + sb * b)), (0, (1 + sa * a) * sb), (0, sa * sb))])
        of = [np.kron(w, np.eye(3)) for w in weights]  # A, A_1, A_2, A_12
        twist = -(weights[3] @ x) @ now.normal  # h_12
        metric, bend = now.base @ now.base.T, np.array([[0, twist], [twist, 0]])
        offset = metric - now.gap * bend
        along = np.array([of[0].T @ r for r in now.base])  # W_i
        turning = np.array([m.T @ now.normal for m in of[1:3]])  # D_i
        followed, lacking = along - now.gap * turning, turning - bend @ np.linalg.solve(metric, along)
        self.assertGreater(abs(now.gap * twist), 1e-4)
        np.testing.assert_allclose(
            now.tangent, PENALTY * (of[0].T @ of[0] - followed.T @ np.linalg.solve(offset, followed)), atol=1e-10)
        np.testing.assert_allclose(
            now.tangent - (now.main + now.rotational + now.bending),
            -PENALTY * now.gap**2 * lacking.T @ np.linalg.solve(offset, lacking), atol=1e-10)


if __name__ == "__main__":
    unittest.main()
