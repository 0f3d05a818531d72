"""The program as a user calls it: exit codes, messages, files. Usage: test_program.py PROGRAM SOURCE_DIR"""
import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], sys.argv[2]
BLOCK = """osculate: 1
title: Block on a slope
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [8, 4]}}}}
materials: {s: {linear_elastic: {E: 1.0e4, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}
contact: [{name: c, master: floor, slave: block.bottom, normal: {penalty: 1.0e6},
  friction: {coulomb: {mu: 0.3, penalty: 1.0e6}}}]
steps:
  - {name: weight, increments: 2, body_force: [{on: block, bx: SIDE, by: -1}]}
  - {name: more, increments: 1, body_force: [{on: block, by: -2}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: shear_force}]}
"""

SPACE = """osculate: 1
title: Block in space on a plane
mesh: {generate: {b: {box: {x: [0, 2], y: [0, 1], z: [0, 1], elements: [4, 2, 2]}}}}
materials: {m: {linear_elastic: {E: 100, nu: 0.25}}}
sections: [{on: b, material: m, element: solid}]
rigid: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}
contact: [{name: c, master: floor, slave: b.bottom, normal: {penalty: 1000},
  friction: {coulomb: {mu: 0.3, penalty: 500}}}]
steps:
  - {name: press, increments: 2, prescribe: [{on: b.top, ux: 0, uy: 0, uz: -0.02}]}
  - {name: drag, increments: 3, prescribe: [{on: b.top, ux: 0.03, uy: 0.04}]}
output: {history: [{on: c, of: normal_force}, {on: c, of: force_x}, {on: c, of: force_y},
  {on: c, of: slip}, {on: b.top, of: rfz}]}
"""


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def model(self, text, name="model.yaml"):
        with open(self.path(name), "w") as file:
            file.write(text)
        return name

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder.name, capture_output=True, text=True)

    def test_run_writes_what_it_promises(self):
        name = self.model(BLOCK.replace("SIDE", "0.1"))
        done = self.run_program("run", name, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(done.stdout)
        self.assertEqual(summary["status"], "done")
        self.assertEqual([len(s["increments"]) for s in summary["steps"]], [2, 1])
        with open(self.path("model.results/summary.json")) as file:
            self.assertEqual(json.load(file)["steps"], summary["steps"])
        with open(self.path("model.results/history.csv")) as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(list(rows[0]), ["step", "increment", "time", "c.normal_force", "c.shear_force"])
        self.assertAlmostEqual(float(rows[2]["c.normal_force"]), 8.0, places=7)
        self.assertAlmostEqual(float(rows[-1]["c.normal_force"]), 16.0, places=7)
        for file in ("results.pvd", "report.html", "report.json", "log.txt"):
            self.assertTrue(os.path.exists(self.path("model.results/" + file)), file)

    def test_sliding_away_ends_with_3_and_names_the_motion(self):
        done = self.run_program("run", self.model(BLOCK.replace("SIDE", "0.31")), "--json")
        self.assertEqual(done.returncode, 3)
        message = json.loads(done.stdout)["message"]
        self.assertIn("body 'block' is free to move along (1.0000, 0.0000)", message)
        self.assertTrue(os.path.exists(self.path("model.results/last_iterate.vtu")))

    def test_bad_input_ends_with_2_and_writes_nothing(self):
        for wrong, message in (
            ("materials: {s", "model.yaml:4: materials: "),
            ("friction:", "model.yaml:8: "),
        ):
            text = BLOCK.replace("SIDE", "0").replace(wrong, wrong.replace("s", "z").replace("i", "y"), 1)
            done = self.run_program("run", self.model(text))
            self.assertEqual(done.returncode, 2, text)
            self.assertTrue(done.stderr.startswith("error: model.yaml:"), done.stderr)
            self.assertFalse(os.path.exists(self.path("model.results")))
        done = self.run_program("run", "nowhere.yaml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("nowhere.yaml", done.stderr)

    def test_a_folder_with_something_else_is_refused(self):
        name = self.model(BLOCK.replace("SIDE", "0"))
        os.mkdir(self.path("mine"))
        with open(self.path("mine/thesis.txt"), "w") as file:
            file.write("do not touch")
        done = self.run_program("run", name, "-o", "mine")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(os.listdir(self.path("mine")), ["thesis.txt"])
        self.assertEqual(self.run_program("run", name, "--quiet").returncode, 0)
        again = self.run_program("run", name, "--quiet")
        self.assertEqual((again.returncode, again.stdout, again.stderr), (0, "", ""))

    def expect_the_same_bits(self, name):
        texts = []
        for threads in ("1", "2"):
            self.run_program("run", name, "-o", "t" + threads, "--threads", threads, "--quiet")
            with open(self.path("t" + threads + "/history.csv")) as file:
                texts.append(file.read())
        self.assertEqual(texts[0], texts[1])

    def test_the_same_bits_with_one_and_two_threads(self):
        self.expect_the_same_bits(self.model(BLOCK.replace("SIDE", "0.1")))

    def test_until_and_what_is_not_there_yet(self):
        name = self.model(BLOCK.replace("SIDE", "0.1"))
        done = self.run_program("run", name, "--until", "weight", "--json", "--quiet")
        self.assertEqual(len(json.loads(done.stdout)["steps"]), 1)
        wrong = self.run_program("run", name, "--until", "wait")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("did you mean 'weight'", wrong.stderr)
        for arguments in (("run", name, "--restart"), ("tangent", name, "--state", "3")):
            later = self.run_program(*arguments)
            self.assertEqual(later.returncode, 2)
            self.assertIn("not available yet", later.stderr)

    def test_the_other_commands(self):
        name = self.model(BLOCK.replace("SIDE", "0.1"))
        self.assertEqual(json.loads(self.run_program("schema").stdout)["type"], "object")
        self.assertIn("friction", self.run_program("doc", "contact.friction").stdout)
        self.assertEqual(self.run_program("doc", "contact.fricton").returncode, 2)
        check = self.run_program("check", name, "--json")
        self.assertEqual(json.loads(check.stdout)["contact"][0]["touching"], 9)
        tangent = self.run_program("tangent", name, "--json")
        self.assertEqual(tangent.returncode, 0, tangent.stderr)
        self.assertTrue(all(row["pass"] for row in json.loads(tangent.stdout)["rows"]))
        self.assertEqual(self.run_program("verify", "nonsense").returncode, 2)
        self.run_program("run", name, "--quiet")
        os.remove(self.path("model.results/report.html"))
        self.assertEqual(self.run_program("report", "model.results").returncode, 0)
        with open(self.path("model.results/report.html")) as file:
            self.assertIn("Block on a slope", file.read())
        self.assertEqual(self.run_program("nonsense").returncode, 2)

    def test_a_block_in_space_is_pressed_and_dragged(self):
        name = self.model(SPACE)
        done = self.run_program("run", name, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = json.loads(done.stdout)
        for phase in ("contact", "bulk", "assembly", "solver", "output", "total"):
            self.assertGreater(summary["seconds"][phase], 0, phase)
        with open(self.path("model.results/history.csv")) as file:
            last = {k: float(v) for k, v in list(csv.DictReader(file))[-1].items()}
        normal, x, y = (last["c." + q] for q in ("normal_force", "force_x", "force_y"))
        self.assertEqual(last["c.slip"], 15)
        self.assertAlmostEqual((x * x + y * y) ** 0.5 / normal, 0.3, places=2)
        self.assertAlmostEqual(last["b.top.rfz"] / normal, -1, places=8)
        with open(self.path("model.results/report.html")) as file:
            self.assertIn('"dimension":3', file.read())
        self.assertTrue(os.path.exists(self.path("model.results/contact0_00005.vtu")))
        tangent = self.run_program("tangent", name)
        self.assertEqual(tangent.returncode, 0, tangent.stdout + tangent.stderr)
        check = self.run_program("check", name)
        self.assertIn("15 of 15 slave nodes face the master, 15 touch", check.stdout)

    def test_the_same_bits_with_one_and_two_threads_in_space(self):
        self.expect_the_same_bits(self.model(SPACE))

    def test_the_examples_are_valid(self):
        examples = os.path.join(SOURCE, "examples")
        found = [os.path.join(folder, name) for folder, _, names in os.walk(examples)
                 for name in names if name.endswith(".yaml")]
        self.assertTrue(found)
        for example in found:
            done = self.run_program("check", example)
            self.assertEqual(done.returncode, 0, example + done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
