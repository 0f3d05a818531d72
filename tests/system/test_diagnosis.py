"""Models built to fail, each in one way: the cause that is named and what is proposed. Usage: test_diagnosis.py PROGRAM"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
HEAD = """osculate: 1
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [8, 4]}}}}
materials: {s: {MATERIAL: {E: 1.0e3, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}
contact: [{name: c, master: floor, slave: block.bottom, normal: {penalty: PENALTY}FRICTION}]
steps:
  - STEP
solver: {SOLVER}
"""
COULOMB = ", friction: {coulomb: {mu: 0.3, penalty: 1.0e4}}"
PUSH = "{name: push, increments: 2, body_force: [{on: block, bx: 0.5, by: -1}]}"


def model(step, material="linear_elastic", penalty="1.0e4", friction=COULOMB, solver="cutbacks: 2"):
    return (HEAD.replace("MATERIAL", material).replace("PENALTY", penalty).replace("FRICTION", friction)
            .replace("STEP", step).replace("SOLVER", solver))


# A shallow arch under a force on its crown, held at both ends: beyond the limit load it snaps through.
ARCH = """osculate: 1
mesh: {generate: {arch: {box: {x: [-10, 10], y: [0, 0.4], elements: [40, 2], crown: {side: top, radius: 60}}}}}
materials: {s: {st_venant_kirchhoff: {E: 1.0e4, nu: 0}}}
sections: [{on: arch, material: s, element: plane_strain}]
steps:
  - {name: load, increments: 10, prescribe: [{on: arch.left, ux: 0, uy: 0}, {on: arch.right, ux: 0, uy: 0}],
     body_force: [{on: arch, by: LOAD}]}
solver: {cutbacks: 3}
"""


class Diagnosis(unittest.TestCase):
    def failure(self, text):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "m.yaml"), "w") as file:
                file.write(text)
            done = subprocess.run([PROGRAM, "run", "m.yaml", "--json"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            summary = json.loads(done.stdout)
            with open(os.path.join(folder, "m.results", "log.txt")) as file:
                self.assertIn(summary["message"], file.read())
            with open(os.path.join(folder, "m.results", "last_iterate.vtu"), "rb") as file:
                self.fields = file.read()
        found = summary["diagnosis"]
        self.assertIn(f"Cause: {found['cause']}. Proposal: {found['proposal']}.", summary["message"])
        self.message = summary["message"]
        return found

    def test_missing_friction(self):
        found = self.failure(model(PUSH, friction=""))
        self.assertEqual(found["cause"], "sliding motion", self.message)
        self.assertIn("give contact 'c' a `friction`, or hold body 'block'", found["proposal"])
        self.assertEqual(found["free_motions"][0]["direction"], [1, 0])
        self.assertIn(b'"free_motion_1"', self.fields)

    def test_friction_that_does_not_suffice(self):
        found = self.failure(model(PUSH))
        self.assertEqual(found["cause"], "sliding motion", self.message)
        self.assertIn("raise the friction coefficient of contact 'c'", found["proposal"])

    def test_a_body_that_nothing_holds(self):
        found = self.failure(model("{name: lift, increments: 2, body_force: [{on: block, by: 1}]}"))
        self.assertEqual(found["cause"], "free motion", self.message)
        self.assertIn("begin with a step that prescribes the motion of body 'block'", found["proposal"])
        self.assertEqual(len(found["free_motions"]), 3)
        self.assertIn(b'"free_motion_3"', self.fields)

    def test_an_inverted_element(self):
        found = self.failure(model("{name: crush, increments: 1, prescribe: [{on: block.top, ux: 0, uy: -2.5}]}",
                                   material="neo_hooke", solver="cutbacks: 0"))
        self.assertEqual(found["cause"], "inverted element", self.message)
        self.assertIn("turned inside out", found["reason"])
        self.assertIn("more increments (`increments: 4`)", found["proposal"])

    def test_contact_too_stiff(self):
        found = self.failure(model(PUSH.replace("0.5", "0.1"), penalty="1.0e18", friction=COULOMB.replace("1.0e4", "1.0e18")))
        self.assertEqual(found["cause"], "stiffness ratio", self.message)
        self.assertIn("lower the penalty of the contact by a factor of", found["proposal"])
        self.assertGreater(found["stiffness_ratio"], 1e12)

    def test_snap_through(self):
        found = self.failure(ARCH.replace("LOAD", "-200"))
        self.assertEqual(found["cause"], "instability", self.message)
        self.assertIn("prescribe a displacement instead of the load in step 'load'", found["proposal"])

    def test_too_large_an_increment(self):
        found = self.failure(model("{name: press, increments: 1, prescribe: [{on: block.top, ux: 0.5, uy: -0.4}]}",
                                   material="st_venant_kirchhoff", friction="",
                                   solver="cutbacks: 0, max_iterations: 2"))
        self.assertEqual(found["cause"], "too large increment", self.message)
        self.assertEqual(found["proposal"], "give step 'press' more increments (`increments: 4`)")

    def test_flipping_contact(self):
        found = self.failure(model("{name: push, increments: 1, prescribe: [{on: block.top, ux: 0.4, uy: -0.1}]}",
                                   penalty="1.0e6", friction=", friction: {coulomb: {mu: 0.8, penalty: 1.0e7}}",
                                   solver="cutbacks: 0, line_search: off, predictor: tangent, max_iterations: 12"))
        self.assertEqual(found["cause"], "flipping contact", self.message)
        self.assertIn("contact 'c'", found["proposal"])
        self.assertEqual(found["flips"][0]["pair"], "c")
        self.assertIn("node", found["flips"][0]["node"])
        self.assertGreater(len(set(found["flips"][0]["states"].split(", "))), 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
