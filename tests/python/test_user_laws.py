"""Laws and materials that are functions of the user: in Python, and compiled (examples/user_law)."""
import ctypes
import math
import os
import shutil
import subprocess
import tempfile
import threading
import unittest

import numpy as np
import osculate
from models import block
from osculate import _laws
from test_evaluator import lines, plane, space

SOURCE = os.environ["SOURCE"]


def coulomb(mu):
    return lambda at: (mu * at.pressure, 0.0, mu)


def linear(stiffness):
    return osculate.normal_law(lambda gap: (-stiffness * gap, -stiffness), lambda gap: 0.5 * stiffness * gap * gap)


def saturating(mu, tau, slope=1.0):
    """slope: 1 or what the derivative is wrong by."""
    def limit(at):
        rest = math.exp(-mu * at.pressure / tau)
        return tau * (1 - rest), 0.0, slope * mu * rest
    return limit


class Points(unittest.TestCase):
    def test_coulomb_and_a_penalty_have_the_bits_of_the_programs_own(self):
        for place, mu, normal, penalty in ((plane, 0.3, 1e4, 1e4), (space, 0.2, 1e3, 5e2)):
            own = place(friction=osculate.friction_law(coulomb(mu), penalty=penalty), normal=linear(normal))
            self.assertEqual(lines(*own), lines(*place()))

    def test_the_checker_tells_a_right_derivative_from_a_wrong_one(self):
        for slope, right in ((1.0, True), (1.1, False)):
            law = osculate.friction_law(saturating(0.2, 3.0, slope), penalty=5e2)
            evaluator, x, frame = space(friction=law)
            history = evaluator.initial_history(x)
            history = evaluator.evaluate(x, history).committed()
            x[frame:, 2] -= 0.01
            x[frame:, 0] += 0.03
            points = evaluator.evaluate(x, history).points
            self.assertIn(osculate.Status.slip, points["status"])
            self.assertEqual(evaluator.derivative_check(x, history, 1e-4).passed, right)

    def test_energy_is_integrated_where_none_is_given(self):
        law = osculate.normal_law(lambda gap: (0.5 * (0.1 - gap) ** 2, gap - 0.1), onset=0.1)["user"]
        at = _laws._NormalPoint(gap=-0.2)
        ctypes.CFUNCTYPE(None, ctypes.POINTER(_laws._NormalPoint))(int(law["function"], 16))(ctypes.byref(at))
        self.assertAlmostEqual(at.pressure, 0.045, places=15)
        self.assertAlmostEqual(at.d_pressure, -0.3, places=15)
        self.assertAlmostEqual(at.energy, 0.0045, places=15)

    def test_what_a_function_raises_is_raised(self):
        evaluator, x, _ = space(friction=osculate.friction_law(lambda at: 1 / 0, penalty=5e2))
        with self.assertRaises(ZeroDivisionError):
            evaluator.evaluate(x, evaluator.initial_history(x))
        evaluator, x, _ = space(friction=osculate.friction_law(lambda at: (0.0, 0.0), penalty=5e2))
        with self.assertRaises(ValueError):
            evaluator.evaluate(x, evaluator.initial_history(x))

    def test_laws_have_names_numbers_and_functions(self):
        for law, said in (({"user": {"penalty": 1.0}}, "function is missing"),
                          ({"user": {"function": "f", "penalty": 1.0}}, "an address"),
                          ({"user": {"function": "f", "library": "none.so", "penalty": 1.0}}, "there is no file"),
                          ({"coulomb": {"mu": 0.3, "penalty": 1.0, "constants": [1.0]}}, "no constants"),
                          ({"user": {"function": "0x1", "name": 1.0, "penalty": 1.0}}, "unknown number .name.")):
            with self.assertRaisesRegex(osculate.Refused, said):
                space(friction=law)


class Runs(unittest.TestCase):
    def with_friction(self, law, **changes):
        model = block(**changes)
        model["contact"][0]["friction"] = law
        return model

    def test_a_run_has_the_bits_of_the_programs_own_law(self):
        law = osculate.friction_law(coulomb(0.05), penalty=1e6)
        steps = [{"name": "push", "increments": 4, "body_force": [{"on": "block", "fx": 0.1, "fy": -1}],
                  "prescribe": [{"on": "block.top", "ux": 0.01}]}]
        own, program = (osculate.run(self.with_friction(one, steps=steps)) for one in
                        (law, {"coulomb": {"mu": 0.05, "penalty": 1e6}}))
        self.assertGreater(abs(program.history["c.shear_force"][-1]), 0)
        for name in program.history:
            np.testing.assert_array_equal(own.history[name], program.history[name], name)

    def test_what_a_point_keeps_is_how_far_it_has_slid(self):
        def by_distance(at):
            return 0.3 * at.pressure * math.exp(-at.distance / 0.1), 0.0, 0.3 * math.exp(-at.distance / 0.1)

        def by_memory(at):
            return 0.3 * at.pressure * math.exp(-at.memory[0] / 0.1), 0.0, 0.3 * math.exp(-at.memory[0] / 0.1)

        steps = [{"name": "press", "increments": 2, "prescribe": [{"on": "block.top", "ux": 0, "uy": -0.01}]},
                 {"name": "drag", "increments": 6, "prescribe": [{"on": "block.top", "ux": 0.2}]}]
        forces = [osculate.run(self.with_friction(law, steps=steps)).history["c.shear_force"] for law in (
            osculate.friction_law(by_distance, penalty=1e5),
            osculate.friction_law(by_memory, lambda at: (at.memory[0] + at.slid, 0.0), penalty=1e5))]
        self.assertLess(abs(forces[0][-1]), 0.5 * abs(forces[0]).max())
        np.testing.assert_allclose(forces[1], forces[0], rtol=1e-9)

    def test_what_a_function_raises_ends_the_run(self):
        with self.assertRaises(ZeroDivisionError):
            osculate.run(self.with_friction(osculate.friction_law(lambda at: 1 / 0, penalty=1e6)))

    def test_a_law_without_an_answer_is_no_solution(self):
        law = osculate.friction_law(lambda at: (math.nan, 0.0, 0.0), penalty=1e6)
        with self.assertRaises(osculate.AnalysisFailed):
            osculate.run(self.with_friction(law))

    def test_a_material_is_a_function(self):
        lame, shear = 1e4 * 0.3 / (1.3 * 0.4), 1e4 / 2.6
        stiffness = np.diag([2 * shear] * 3 + [shear] * 3)
        stiffness[:3, :3] += lame
        hooke = osculate.material(lambda strain, change, state, duration: (
            stiffness @ (strain + change), stiffness, state))
        steps = [{**step, "duration": 1} for step in block()["steps"]]
        own, program = (osculate.run(block(materials={"s": law}, steps=steps)) for law in
                        (hooke, {"linear_elastic": {"E": 1e4, "nu": 0.3}}))
        for name in ("c.normal_force", "c.shear_force"):
            np.testing.assert_allclose(own.history[name], program.history[name], rtol=1e-9, atol=1e-9)


class Threads(unittest.TestCase):
    def test_each_is_told_of_its_own_errors(self):
        x = np.array([[0, 0], [4, 0], [1, -0.01], [3, -0.01]])

        def work(error, found):
            def pressure(gap):
                barrier.wait(10)  # both are inside of their laws
                if error is None:
                    return 0.0, 0.0
                raise error

            contact = osculate.Evaluator(x, master=osculate.Surface(facets=[("line2", [[0, 1]])]),
                                         slave=osculate.Surface(facets=[("line2", [[3, 2]])]),
                                         normal=osculate.normal_law(pressure, lambda gap: 0.0), weight="node")
            history = contact.initial_history(x)
            try:
                contact.evaluate(x, history)
                found.append(None)
            except Exception as raised:
                found.append(raised)

        for errors in ((KeyError("one"), KeyError("other")), (None, KeyError("one"))):
            barrier, found = threading.Barrier(2), ([], [])
            threads = [threading.Thread(target=work, args=pair) for pair in zip(errors, found)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            self.assertEqual([f[0] for f in found], list(errors))


class Compiled(unittest.TestCase):
    def setUp(self):
        self.compiler = shutil.which("cc") or shutil.which("g++")
        if not self.compiler:
            self.skipTest("no compiler")
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name in ("laws.c", "drawbead.yaml"):
            shutil.copy(os.path.join(SOURCE, "examples", "user_law", name), self.folder.name)
        subprocess.run([self.compiler, "-shared", "-fPIC", "-O2", "-ffp-contract=off", "-I",
                        os.path.join(SOURCE, "include"), "-o", "laws.so", "laws.c", "-lm"],
                       cwd=self.folder.name, check=True)
        self.model = os.path.join(self.folder.name, "drawbead.yaml")

    def test_the_example_and_its_law_in_python_agree(self):
        def asperities(gap):
            depth = 0.005 - gap
            return 1e6 * depth ** 1.5, -1.5e6 * depth ** 0.5

        def polished(at):
            factor = 1 - 0.5 * (1 - math.exp(-at.distance / 0.02))
            rest = math.exp(-0.3 * at.pressure / 60)
            return factor * 60 * (1 - rest), 0.0, factor * 0.3 * rest

        compiled = osculate.run(self.model, os.path.join(self.folder.name, "results"))
        model = {
            "osculate": 1, "mesh": {"generate": {"b": {"box": {"x": [0, 2], "y": [0, 1], "elements": [8, 4]}}}},
            "materials": {"steel": {"linear_elastic": {"E": 2.1e5, "nu": 0.3}}},
            "sections": [{"on": "b", "material": "steel", "element": "plane_strain"}],
            "rigid": {"tool": {"line": {"point": [0, 0], "normal": [0, 1]}}},
            "contact": [{"name": "c", "master": "tool", "slave": "b.bottom", "sampling": {"lobatto": 2},
                         "normal": osculate.normal_law(asperities, lambda gap: 4e5 * (0.005 - gap) ** 2.5, onset=0.005),
                         "friction": osculate.friction_law(polished, penalty=1e5)}],
            "steps": [{"name": "press", "increments": 2, "prescribe": [{"on": "b.top", "ux": 0, "uy": -0.001}]},
                      {"name": "drag", "increments": 20, "prescribe": [{"on": "b.top", "ux": 0.1}]}],
            "output": {"history": [{"on": "c", "of": "normal_force"}, {"on": "c", "of": "shear_force"}]}}
        shear = compiled.history["c.shear_force"]
        tried = osculate.run(model).history["c.shear_force"]
        np.testing.assert_allclose(tried, shear, rtol=1e-9)
        self.assertLess(abs(shear[-1]), 0.6 * abs(shear).max())

    def test_what_is_missing_is_said_with_its_place(self):
        with open(self.model) as file:
            text = file.read()
        for old, new, said in (("function: polished", "function: polish", r"drawbead.yaml:14: .*no function 'polish'"),
                               ("library: laws.so, function: asperities", "library: law.so, function: asperities",
                                r"drawbead.yaml:13: .*there is no file")):
            with open(self.model, "w") as file:
                file.write(text.replace(old, new))
            with self.assertRaisesRegex(osculate.InputError, said):
                osculate.check(self.model)


if __name__ == "__main__":
    unittest.main()
