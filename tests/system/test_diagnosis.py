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


# A shallow arch, held at both ends, under its weight: beyond the limit load it snaps through.
ARCH = """osculate: 1
mesh: arch.msh
materials: {s: {st_venant_kirchhoff: {E: 1.0e4, nu: 0}}}
sections: [{on: arch, material: s, element: plane_strain}]
steps:
  - {name: load, increments: 10, prescribe: [{on: ends, ux: 0, uy: 0}], body_force: [{on: arch, by: -0.4}]}
solver: {cutbacks: 6, max_iterations: 8, arc_length: off}
"""


def arch_mesh(nx=40, ny=2, half=10, rise=0.8, thickness=0.2):
    """Gmsh 2.2, y = rise (1 - (x / half)^2)."""
    nodes = [(half * (2 * i / nx - 1), rise * (1 - (2 * i / nx - 1) ** 2) + thickness * (j / ny - 0.5))
             for j in range(ny + 1) for i in range(nx + 1)]
    number = lambda i, j: j * (nx + 1) + i + 1
    quads = [(number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1))
             for j in range(ny) for i in range(nx)]
    lines = [(number(i, j), number(i, j + 1)) for i in (0, nx) for j in range(ny)]
    cells = [f"3 2 1 1 {q}" for q in (" ".join(map(str, q)) for q in quads)]
    cells += [f"1 2 2 2 {a} {b}" for a, b in lines]
    return "\n".join(
        ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "2", '2 1 "arch"', '1 2 "ends"',
         "$EndPhysicalNames", "$Nodes", str(len(nodes))]
        + [f"{k + 1} {x!r} {y!r} 0" for k, (x, y) in enumerate(nodes)]
        + ["$EndNodes", "$Elements", str(len(cells))]
        + [f"{k + 1} {c}" for k, c in enumerate(cells)] + ["$EndElements", ""])


# Nodes on nodes, a stiff penalty, and none of the remedies.
FLIPPING = """osculate: 1
mesh:
  generate:
    low: {box: {x: [0, 4], y: [0, 1], elements: [12, 3]}}
    up: {box: {x: [1, 3], y: [1, 2], elements: [5, 3]}}
materials: {s: {linear_elastic: {E: 100, nu: 0.3}}}
sections:
  - {on: low, material: s, element: plane_strain, formulation: full}
  - {on: up, material: s, element: plane_strain, formulation: full}
contact: [{name: c, master: low.top, slave: up.bottom, normal: {penalty: 1.0e7},
  friction: {coulomb: {mu: 0.6, penalty: 1.0e7}}}]
steps:
  - {name: press, increments: 2, prescribe: [{on: low.bottom, uy: 0, ux: 0}, {on: up.top, uy: -0.1, ux: 0}]}
  - {name: shear, increments: 4, prescribe: [{on: up.top, ux: 0.3}]}
solver: {cutbacks: 0, line_search: off, max_iterations: 5, arc_length: off}
"""

# Its sides bulge onto the plates, which know its lower and upper face alone.
PRESSED = """osculate: 1
mesh: {generate: {b: {box: {x: [0, 10], y: [0, 10], elements: [12, 12]}}}}
materials: {m: {neo_hooke: {E: 3, nu: 0.45}}}
sections: [{on: b, material: m, element: plane_strain, formulation: bbar}]
rigid: {low: {line: {point: [0, 0], normal: [0, 1]}}, up: {line: {point: [0, 10], normal: [0, -1]}}}
contact:
  - {name: l, master: low, slave: b.bottom, friction: {coulomb: {mu: 0.5}}}
  - {name: u, master: up, slave: b.top, friction: {coulomb: {mu: 0.5}}}
steps: [{name: s, increments: 14, prescribe: [{on: low, ux: 0, uy: 0, rz: 0}, {on: up, ux: 0, uy: -7, rz: 0}]}]
"""

# Blocks on each other, pressed from above; nothing but what a test adds carries the lowest.
STACK = """osculate: 1
mesh: {generate: {BLOCKS}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.3}}}
sections: [SECTIONS]
rigid: {floor: {line: {point: [0, FLOOR], normal: [0, 1]}}}
contact: [CONTACTS]
steps: [{name: press, increments: 2, ALSOpressure: [{on: up.top, value: 1}]}]
"""


def stack(names, gap=0.0, more="", floor=-9.0, also=""):
    """Of blocks, the lowest first."""
    where = {n: f"{n}: {{box: {{x: [0, {2 - 0.2 * i}], y: [{i * (1 + gap)}, {i * (1 + gap) + 1}], elements: [{4 - i}, 2]}}}}"
             for i, n in enumerate(names)}
    pairs = [f"{{name: {a}_{b}, master: {a}.top, slave: {b}.bottom, friction: {{coulomb: {{mu: 0.3}}}}}}"
             for a, b in zip(names, names[1:])]
    return (STACK.replace("BLOCKS", ", ".join(where[n] for n in sorted(names, reverse=True)))
            .replace("SECTIONS", ", ".join(f"{{on: {n}, material: m, element: plane_strain}}" for n in names))
            .replace("CONTACTS", ", ".join(pairs) + more).replace("FLOOR", str(floor)).replace("ALSO", also))


OVER = """osculate: 1
mesh:
  generate: {a: {box: {x: [0, 4], y: [0, 1], elements: [8, 2]}}, b: {box: {x: [1, 3], y: [1, 2], elements: [5, 3]}}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.3}}}
sections: [{on: a, material: m, element: plane_strain}, {on: b, material: m, element: plane_strain}]
contact: [{name: c, master: a.top, slave: b.bottom, enforcement: lagrange_multiplier, sampling: SAMPLING}]
steps: [{name: s, increments: 1, prescribe: [{on: a.top, ux: 0, uy: 0}, {on: b.bottom, ux: 0, uy: -0.01}]}]
"""


class Diagnosis(unittest.TestCase):
    def failure(self, text):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "m.yaml"), "w") as file:
                file.write(text)
            with open(os.path.join(folder, "arch.msh"), "w") as file:
                file.write(arch_mesh())
            done = subprocess.run([PROGRAM, "run", "m.yaml", "--json"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
            summary = json.loads(done.stdout)
            with open(os.path.join(folder, "m.results", "log.txt")) as file:
                self.assertIn(summary["message"], file.read())
            with open(os.path.join(folder, "m.results", "last_iterate.vtu"), "rb") as file:
                self.fields = file.read()
            with open(os.path.join(folder, "m.results", "report.json")) as file:
                report = json.load(file)
            drawn = report.get("last_iterate", {"motions": []})
            self.assertEqual(len(drawn["motions"]), len(summary["diagnosis"]["free_motions"]))
            for motion in drawn["motions"]:
                self.assertEqual(motion["shape"], report["mesh"]["points"]["shape"])
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
        self.assertIn("look at the signs of the loads in step 'lift': they pull body 'block' off", found["proposal"])
        self.assertEqual(len(found["free_motions"]), 3)
        self.assertIn(b'"free_motion_3"', self.fields)

    def test_a_body_that_is_pulled_off_a_rigid_mesh(self):
        found = self.failure("""osculate: 1
mesh: {generate: {base: {box: {x: [0, 4], y: [-1, 0], elements: [4, 1]}}, block: {box: {x: [0, 4], y: [0, 2], elements: [4, 2]}}}}
materials: {m: {linear_elastic: {E: 1.0e3, nu: 0.3}}}
sections: [{on: block, material: m, element: plane_strain}]
rigid: {floor: {set: base}}
contact: [{name: c, master: base.top, slave: block.bottom, friction: {coulomb: {mu: 0.3}}}]
steps: [{name: lift, increments: 2, pressure: [{on: block.top, value: -1}]}]
""")
        self.assertIn("look at the signs of the loads in step 'lift': they pull body 'block' off", found["proposal"])

    def test_a_stack_on_nothing_is_the_fault_of_its_lowest_body(self):
        guided = "prescribe: [" + ", ".join(f"{{on: {n}.left, ux: 0}}" for n in ("up", "low")) + "], "
        for gap, prescribe, motions in ((0, "", 3), (0, guided, 1), (0.01, guided, 1)):
            with self.subTest(gap=gap, prescribe=prescribe):
                found = self.failure(stack(("low", "up"), gap, also=prescribe))
                self.assertEqual(found["cause"], "free motion", self.message)
                self.assertIn("hold body 'low' by a prescription, or let it rest on something: what lies on it ('up') is "
                              "pressed against it, and nothing is behind it", found["proposal"])
                mine = [m for m in found["free_motions"] if m["body"] == "low"]
                self.assertEqual(found["free_motions"][:motions], mine)
                self.assertEqual([m["along"] for m in mine], [["up"]] * motions)
        found = self.failure(stack(("base", "low", "up")))
        self.assertIn("hold body 'base' by a prescription", found["proposal"])
        self.assertEqual(found["free_motions"][0]["along"], ["up", "low"])
        self.assertIn("body 'base' is free to move and turn in every direction: nothing holds it, and 'up', 'low' come along",
                      self.message)

    def test_a_stack_that_slides_as_a_whole_slides_under_its_lowest_body(self):
        found = self.failure(stack(("low", "up"), floor=0, more=", {name: ice, master: floor, slave: low.bottom}",
                                   also="traction: [{on: up.left, tx: 0.1}], "))
        self.assertEqual(found["cause"], "sliding motion", self.message)
        self.assertEqual(found["free_motions"][0]["direction"], [1, 0])
        self.assertIn("give contact 'ice' a `friction`, or hold body 'low'", found["proposal"])

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
        found = self.failure(ARCH)
        self.assertEqual(found["cause"], "instability", self.message)
        self.assertIn("prescribe a displacement instead of the load in step 'load'", found["proposal"])

    def test_a_snap_is_passed_unless_it_is_not_wanted(self):
        for words in ("auto", "always"):
            with tempfile.TemporaryDirectory() as folder:
                with open(os.path.join(folder, "m.yaml"), "w") as file:
                    file.write(ARCH.replace("arc_length: off", f"arc_length: {words}"))
                with open(os.path.join(folder, "arch.msh"), "w") as file:
                    file.write(arch_mesh())
                done = subprocess.run([PROGRAM, "run", "m.yaml", "--json"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            increments = json.loads(done.stdout)["steps"][0]["increments"]
            times = [one["time"] for one in increments]
            self.assertEqual(times[-1], 1)
            self.assertEqual(times == sorted(times), words == "auto")
            self.assertTrue(any(one["resisted" if words == "auto" else "on_path"] for one in increments))

    def test_too_large_an_increment(self):
        found = self.failure(model("{name: press, increments: 1, prescribe: [{on: block.top, ux: 0.5, uy: -0.4}]}",
                                   material="st_venant_kirchhoff", friction="",
                                   solver="cutbacks: 0, max_iterations: 2, arc_length: off"))
        self.assertEqual(found["cause"], "too large increment", self.message)
        self.assertIn("give step 'press' more increments (`increments: 4`)", found["proposal"])

    def test_a_load_with_the_wrong_sign(self):
        found = self.failure(model("{name: pull, increments: 2, pressure: [{on: block.top, value: -1}]}", friction=""))
        self.assertEqual(found["cause"], "free motion", self.message)
        self.assertIn("signs of the loads in step 'pull'", found["proposal"])

    def test_a_slave_set_that_is_too_small(self):
        found = self.failure(PRESSED)
        self.assertEqual(found["cause"], "slave set too small", self.message)
        self.assertIn("('b.left', 'b.right') into the slave of contact", found["proposal"])

    def test_contact_that_is_prescribed_on_both_sides(self):
        for sampling in ("nodes", "mortar"):
            found = self.failure(OVER.replace("SAMPLING", sampling))
            self.assertEqual(found["cause"], "over-constrained contact", self.message)
            self.assertIn("the gap of 6 of its points", found["proposal"])

    def test_a_deep_initial_overlap(self):
        found = self.failure("""osculate: 1
mesh: {generate: {b: {box: {x: [0, 4], y: [0, 2], elements: [40, 20]}}}}
materials: {m: {neo_hooke: {E: 100, nu: 0.3}}}
sections: [{on: b, material: m, element: plane_strain}]
rigid: {r: {line: {point: [0, 0.8], normal: [0, 1]}}}
contact: [{name: c, master: r, slave: b.bottom}]
steps: [{name: s, increments: 4, prescribe: [{on: b.top, ux: 0, uy: 0}]}]
""")
        self.assertEqual(found["cause"], "initial overlap", self.message)
        self.assertIn("its slave begins 0.8 deep in the master, 8 times the height of the cells", found["proposal"])

    def test_flipping_contact(self):
        found = self.failure(FLIPPING)
        self.assertEqual(found["cause"], "flipping contact", self.message)
        self.assertIn("contact 'c'", found["proposal"])
        self.assertEqual(found["flips"][0]["pair"], "c")
        self.assertIn("node", found["flips"][0]["node"])
        self.assertGreater(len(set(found["flips"][0]["states"].split(", "))), 1)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
