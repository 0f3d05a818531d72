"""Closest points of many points at once."""
import unittest

import numpy as np
import osculate
from osculate import ClosestStatus, Feature


class Closest(unittest.TestCase):
    def test_distances_from_a_torus(self):
        points = np.random.default_rng(1).uniform(-3, 3, (500, 3))
        found = osculate.closest_points(osculate.Torus(radius=2, tube_radius=0.5), points)
        rings = np.hypot(np.hypot(points[:, 0], points[:, 1]) - 2, points[:, 2])
        np.testing.assert_allclose(found.distance, rings - 0.5, atol=1e-12)
        self.assertTrue(np.all(found.status == ClosestStatus.projected))
        self.assertTrue(found.unique.all())
        np.testing.assert_allclose(np.linalg.norm(points - found.point, axis=1), np.abs(found.distance), atol=1e-12)

    def test_features_of_a_mesh(self):
        surface = osculate.ClosestPoints([("tri3", [[0, 1, 2], [0, 2, 3]])],
                                         [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
        found = surface.find([[0.7, 0.2, 1], [0.5, -1, 0], [2, 2, 0], [np.nan, 0, 0]])
        self.assertEqual(found.feature.tolist(), [Feature.face, Feature.edge, Feature.corner, Feature.none])
        np.testing.assert_allclose(found.distance[:3], [1, 1, np.sqrt(2)])
        self.assertEqual(found.facet.tolist(), [0, 0, found.facet[2], -1])
        self.assertEqual(found.status[3], ClosestStatus.invalid)
        self.assertEqual(surface.dimension, 3)

    def test_the_middle_of_a_circle_has_no_closest_point(self):
        found = osculate.closest_points(osculate.Circle(), [[0.0, 0.0], [2.0, 0.0]])
        self.assertEqual(found.unique.tolist(), [False, True])
        np.testing.assert_allclose(found.distance, [-1, 1])

    def test_threads_and_modes(self):
        points = np.random.default_rng(2).uniform(-1, 1, (200, 2))
        curve = osculate.ClosestPoints([("line2", [[0, 1], [1, 2]])], [[-1, 0], [0, 0.2], [1, 0]])
        one, two = curve.find(points), curve.find(points, threads=2)
        for name in ("status", "facet", "xi", "point", "distance", "margin"):
            np.testing.assert_array_equal(getattr(one, name), getattr(two, name))
        np.testing.assert_allclose(curve.find(points, "nearest").distance, one.distance)
        self.assertTrue(np.isnan(curve.find(points, "nearest").margin).all())
        with self.assertRaisesRegex(osculate.Refused, "none of nearest"):
            curve.find(points, "exact")
        with self.assertRaises(osculate.Refused):
            curve.find(np.zeros((3, 3)))


if __name__ == "__main__":
    unittest.main()
