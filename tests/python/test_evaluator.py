"""Contact for codes in Python. HOST: a program that does the same in C++ and prints all bits."""
import os
import subprocess
import threading
import unittest

import numpy as np
import osculate
from osculate import Circle, Evaluator, Feature, Status, Surface

COULOMB = {"coulomb": {"mu": 0.3, "penalty": 1e4}}


def plane(**changes):
    x = np.array([[0, 0], [1, 0], [0, 1], [0.4, 0.0], [0.1, 0.01], [-0.3, 0.0]])
    arguments = dict(master=Surface(shapes=[Circle(center=(0, -5), radius=5)], frame=(0, 1, 2)),
                     slave=Surface(facets=[("line2", [[3, 4], [4, 5]])]), normal={"penalty": 1e4}, friction=COULOMB)
    return Evaluator(x, **{**arguments, **changes}), x, 3


def space(**changes):
    x = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0.1], [0, 1, 0], [2, 0, 0], [2, 1, 0], [0.3, 0.2, 0.0],
                  [1.4, 0.3, 0.005], [0.4, 0.8, 0.0], [1.5, 0.7, 0.01]])
    arguments = dict(master=Surface(facets=[("quad4", [[0, 1, 2, 3], [1, 4, 5, 2]])]),
                     slave=Surface(facets=[("tri3", [[6, 8, 7], [7, 8, 9]])]), normal={"penalty": 1e3},
                     friction={"coulomb": {"mu": 0.2, "penalty": 5e2}}, sampling="gauss", sampling_points=3)
    return Evaluator(x, **{**arguments, **changes}), x, 6


def pressed(x, frame):
    """The motion of an increment of the host."""
    x, dim = x.copy(), x.shape[1]
    flat = x.reshape(-1)
    for i in range(frame * dim, flat.size):
        flat[i] += -0.01 if i % dim == dim - 1 else 0.02 + 0.001 * i
    return x


def bits(value):
    return f"{np.float64(value).view(np.uint64):016x}"


def lines(evaluator, x, frame):
    out, history = [], evaluator.initial_history(x)
    for _ in range(3):
        active = evaluator.predicted(history, x)
        x = pressed(x, frame)
        result = evaluator.evaluate(x, history, active)
        result = evaluator.evaluate(x, history, result.next_active_set())
        history = result.committed()
        out += [f"force {bits(f)}" for f in result.force.ravel()]
        for row, column, value in result.tangent:
            out += [f"entry {row} {column}", f"tangent {bits(value)}"]
        for p in result.points:
            out += [f"point {p['status']} {p['feature']} {p['facet']}", f"gap {bits(p['gap'])}",
                    f"normal {bits(p['normal_traction'])}"]
            out += [f"shear {bits(t)}" for t in p["shear_traction"]] + [f"work {bits(p['friction_work'])}"]
        out.append(history.bytes().hex())
    return out


class Evaluators(unittest.TestCase):
    def test_python_and_cpp_give_the_same_bits(self):
        expected = subprocess.run([os.environ["HOST"]], capture_output=True, text=True, check=True).stdout.split("\n")
        found = lines(*plane()) + lines(*space())
        self.assertEqual(found, expected[:-1])
        self.assertTrue(any(line.startswith("point 2") for line in found), "something slides")
        self.assertTrue(any(line.startswith("work 3f") for line in found), "friction does work")

    def test_arrays_show_the_memory_of_the_evaluation(self):
        evaluator, x, frame = space()
        result = evaluator.evaluate(pressed(x, frame), evaluator.initial_history(x))
        for name in ("force", "branch_force", "tangent", "points"):
            first, second = getattr(result, name), getattr(result, name)
            self.assertEqual(first.__array_interface__["data"], second.__array_interface__["data"], name)
            self.assertFalse(first.flags.writeable)
        force = result.force
        kept = force.copy()
        del result
        np.testing.assert_array_equal(force, kept)
        self.assertEqual(force.shape, x.shape)

    def test_the_sum_of_all_forces_is_zero(self):
        evaluator, x, frame = space()
        force = evaluator.evaluate(pressed(x, frame), evaluator.initial_history(x)).force
        self.assertGreater(np.abs(force).max(), 0.1)
        np.testing.assert_allclose(force.sum(axis=0), 0, atol=1e-12)

    def test_csr_is_the_matrix_of_the_entries(self):
        evaluator, x, frame = space()
        entries = evaluator.evaluate(pressed(x, frame), evaluator.initial_history(x)).tangent
        dense = np.zeros((x.size, x.size))
        np.add.at(dense, (entries["row"], entries["column"]), entries["value"])
        data, indices, indptr = osculate.csr(entries, x.size)
        self.assertEqual(len(indptr), x.size + 1)
        found = np.zeros_like(dense)
        for row in range(x.size):
            part = slice(indptr[row], indptr[row + 1])
            self.assertTrue(np.all(np.diff(indices[part]) > 0))
            found[row, indices[part]] = data[part]
        np.testing.assert_array_equal(found, dense)
        self.assertGreater(np.count_nonzero(found), 100)

    def test_the_tangent_is_the_derivative_of_the_forces(self):
        evaluator, x, frame = space(friction={"coulomb": {"mu": 50, "penalty": 5e2}})
        history = evaluator.initial_history(x)
        x = pressed(x, frame)
        active = evaluator.evaluate(x, history).next_active_set()
        check = evaluator.derivative_check(x, history, 1e-4, active)
        self.assertTrue(check.passed, check)
        parts, x0, _ = space(friction={"coulomb": {"mu": 50, "penalty": 5e2}}, tangent=["main"])
        self.assertFalse(parts.derivative_check(x, parts.initial_history(x0), 1e-4).passed)

    def test_values_are_saved_and_read(self):
        evaluator, x, frame = plane()
        result = evaluator.evaluate(pressed(x, frame), evaluator.initial_history(x))
        history, active = result.committed(), result.next_active_set()
        self.assertEqual(evaluator.history(history.bytes()).bytes(), history.bytes())
        self.assertEqual(evaluator.active_set(active.bytes()).bytes(), active.bytes())
        self.assertEqual(len(history), 3)
        with self.assertRaises(osculate.Refused):
            evaluator.history(history.bytes()[:-1])
        with self.assertRaisesRegex(osculate.Refused, "plane"):
            space()[0].evaluate(space()[1], history)

    def test_points_say_what_they_do(self):
        evaluator, x, frame = plane()
        points = evaluator.evaluate(pressed(x, frame), evaluator.initial_history(x)).points
        touching = points["gap"] < 0
        self.assertTrue(touching.any())
        self.assertTrue(np.all(points["status"][touching] != Status.open))
        self.assertTrue(np.all(points["feature"][touching] == Feature.face))
        np.testing.assert_allclose(points["normal_traction"][touching], 1e4 * points["gap"][touching])
        shapes = evaluator.slave_points()
        self.assertEqual([nodes.tolist() for nodes, _, _ in shapes], [[3], [4], [5]])

    def test_multipliers(self):
        evaluator, x, frame = plane(enforcement="augmented_lagrange", friction=None)
        history, values = evaluator.initial_history(x), evaluator.initial_multipliers()
        x = pressed(x, frame)
        first = evaluator.evaluate(x, history, None, values)
        corrected = first.corrected_multipliers()
        touching = first.points["gap"] < 0
        np.testing.assert_allclose(corrected.values[touching, 0], 1e4 * first.points["gap"][touching])
        self.assertLess(np.abs(first.force).sum(), np.abs(evaluator.evaluate(x, history, None, corrected).force).sum())
        again = evaluator.multipliers(evaluator.bytes(corrected))
        np.testing.assert_array_equal(again.values, corrected.values)
        unknown, _, _ = plane(enforcement="lagrange_multiplier")
        self.assertEqual(unknown.unknowns_per_point, 3)
        numbers = np.arange(9.0)
        np.testing.assert_allclose(unknown.unknowns_of(unknown.multipliers_of(numbers)), numbers)

    def test_what_cannot_be_used_is_refused(self):
        for change, part in (({"normal": {"penality": 1}}, "penality"), ({"normal": {"penalty": "auto"}}, "number"),
                             ({"weight": "areas"}, "none of node"), ({"sampling": "nodal"}, "none of nodes"),
                             ({"slave": Surface(facets=[("line2", [[3, 9]])])}, ""),
                             ({"slave": Surface(facets=[("line9", [[3, 4]])])}, "no type of facets"),
                             ({"slave": Surface(facets=[("line3", [[3, 4]])])}, "has 3 nodes"),
                             ({"master": Surface(shapes=[osculate.Sphere()], frame=(0, 1, 2))}, "of the plane"),
                             ({"master": Surface(shapes=[Circle()], frame=(0, 1))}, "frame of 3")):
            with self.subTest(part=part), self.assertRaisesRegex(osculate.Refused, part):
                plane(**change)
        evaluator, x, _ = plane()
        with self.assertRaises(osculate.Refused):
            evaluator.evaluate(x[:4], evaluator.initial_history(x))
        with self.assertRaisesRegex(osculate.Refused, "2 coordinates"):
            evaluator.evaluate(np.zeros((4, 3)), evaluator.initial_history(x))

    def test_wrong_kinds_are_refused_with_the_name_of_the_argument(self):
        for change, part in (({"offset": "far"}, "offset: expected a number, got 'far'"),
                             ({"keep_gap": "yes"}, "keep_gap: expected True or False, got 'yes'"),
                             ({"sampling_points": 2.5}, "sampling_points: expected a whole number, got 2.5"),
                             ({"weight": 1}, "weight: expected a word, got 1"), ({"normal": 1e4}, "normal: expected a"),
                             ({"normal": {"penalty": None}}, "penalty: expected a number, got None"),
                             ({"normal": {"table": [1, 2]}}, "table: expected pairs of numbers"),
                             ({"friction": {"coulomb": {"mu": []}}}, "no law|coulomb|mu"),
                             ({"tangent": [1]}, "tangent: expected a list of words"),
                             ({"slave": 3}, "expected an osculate.Surface, got 3"),
                             ({"slave": Surface(facets=[3])}, "facets: expected pairs")):
            with self.subTest(part=part), self.assertRaisesRegex(osculate.Refused, part):
                plane(**change)

    def test_nodes_are_whole_numbers(self):
        for nodes, part in (([[3.7, 4.2]], "whole numbers"), ([[True, False]], "whole numbers"),
                            ([[3, 2**32 + 4]], "no number of a node"), ([[3, -1]], "no number of a node")):
            with self.subTest(nodes=nodes), self.assertRaisesRegex(osculate.Refused, part):
                plane(slave=Surface(facets=[("line2", nodes)]))
        for kind in (np.int32, np.uint64, np.int8):
            narrow = plane(slave=Surface(facets=[("line2", np.array([[3, 4], [4, 5]], dtype=kind))]))[0]
            self.assertEqual([nodes.tolist() for nodes, _, _ in narrow.slave_points()], [[3], [4], [5]])

    def test_threads_share_an_evaluator(self):
        evaluator, x, frame = space()
        history, x = evaluator.initial_history(x), pressed(x, frame)
        expected = evaluator.evaluate(x, history).force.copy()
        found = [None] * 4

        def work(i):
            for _ in range(20):
                found[i] = evaluator.evaluate(x, history).force

        threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for force in found:
            np.testing.assert_array_equal(force, expected)

    def test_line_search(self):
        def residual(step):  # its work along the correction has a kink at 0.25 and a zero at 0.5
            return np.array([-2 + 4 * step if step > 0.25 else -1.0, 0.1])
        seen = []

        def look(step):
            seen.append(step)
            return residual(step)
        step = osculate.line_search(look, residual(0), [1.0, 0.0])
        self.assertLess(abs(residual(step)[0]), 0.05)
        self.assertGreater(len(seen), 2)
        self.assertEqual(osculate.line_search(lambda s: (residual(s), True), residual(0), [1, 0]), 1.0)
        self.assertEqual(osculate.line_search(lambda s: np.array([-0.4, 0]), [-1, 0], [1, 0]), 1.0)
        half = osculate.line_search(lambda s: None if s > 0.5 else np.array([-0.1, 0]), [-1, 0], [1, 0])
        self.assertEqual(half, 0.5)
        with self.assertRaisesRegex(ValueError, "residuals have 3 numbers, and the correction has 2"):
            osculate.line_search(lambda s: np.zeros(3), [-1, 0], [1, 0])
        with self.assertRaises(ZeroDivisionError):
            osculate.line_search(lambda s: 1 / 0, [-1, 0], [1, 0])

    def test_a_pattern_has_all_entries_within_the_reach(self):
        random, seen = np.random.default_rng(7), 0
        for make in (plane, space):
            evaluator, x, frame = make()
            history = evaluator.initial_history(x)
            found = evaluator.pattern(x, history, 0.05)
            self.assertEqual(found.dim, x.shape[1])
            self.assertEqual(found.couplings.shape[1], 2)
            indices, indptr = found.csr()
            rows = np.repeat(np.arange(x.size), np.diff(indptr))
            places = set(zip(rows.tolist(), indices.tolist()))
            for row in range(x.size):  # ascending, and blocks of nodes
                own = indices[indptr[row]:indptr[row + 1]]
                self.assertTrue((np.diff(own) > 0).all())
                node = row // found.dim
                nodes = found.columns[found.row_start[node]:found.row_start[node + 1]]
                np.testing.assert_array_equal(own.reshape(-1, found.dim)[:, 0], found.dim * nodes)
            for _ in range(20):
                y = x.copy()
                way = random.normal(size=x.shape)
                y[frame:] += (0.049 * way / np.linalg.norm(way, axis=1, keepdims=True))[frame:]
                tangent = evaluator.evaluate(y, history).tangent
                seen += len(tangent)
                self.assertLessEqual(set(zip(tangent["row"].tolist(), tangent["column"].tolist())), places)
        self.assertGreater(seen, 1000)
        with self.assertRaisesRegex(osculate.Refused, "motion must be >= 0"):
            evaluator.pattern(x, history, -1)

    def test_automatic_penalties(self):
        normal, shear = osculate.automatic_penalties([(100, 0.25, 2, 1)])
        self.assertAlmostEqual(normal, 10 / (2 / 100))
        self.assertAlmostEqual(shear, 10 / (2 / 40))
        with self.assertRaises(osculate.Refused):
            osculate.automatic_penalties([])


if __name__ == "__main__":
    unittest.main()
