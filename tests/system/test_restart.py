"""Checkpoints and restart as a user meets them: kills, damage, full disks. Usage: test_restart.py PROGRAM"""
import csv
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest
import xml.etree.ElementTree

from restart_case import PROGRAM, RestartCase

# A strip is pressed into a wavy channel and dragged along it: sticking, sliding, new facets, cut-backs.
PLANE = """osculate: 1
title: Block dragged over a bump
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [24, 6]}}}}
materials: {s: {st_venant_kirchhoff: {E: 1.0e3, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
rigid: {floor: {polyline: {points: [[-5, 0], [4.2, 0], [4.6, 0.08], [5, 0], [9, 0]]}}}
contact: [{name: c, master: floor, slave: block.bottom, normal: {penalty: 1.0e5},
  friction: {coulomb: {mu: 0.3, penalty: 1.0e5}}}]
steps:
  - {name: press, increments: 3, prescribe: [{on: block.top, ux: 0, uy: -0.02}]}
  - {name: drag, increments: 15, prescribe: [{on: block.top, ux: 0.8}]}
solver: {max_iterations: 6}
output: {history: [{on: c, of: normal_force}, {on: c, of: shear_force}, {on: block.top, of: rfx}]}
"""
SPACE = """osculate: 1
title: Block dragged over a block
mesh:
  generate:
    low: {box: {x: [0, 3], y: [0, 2], z: [0, 1], elements: [7, 4, 2]}}
    up: {box: {x: [0.3, 1.4], y: [0.4, 1.5], z: [1, 1.8], elements: [5, 5, 2]}}
materials: {m: {linear_elastic: {E: 100, nu: 0.25}}}
sections: [{on: low, material: m, element: solid}, {on: up, material: m, element: solid}]
contact: [{name: c, master: low.top, slave: up.bottom, normal: {penalty: 2000},
  friction: {coulomb: {mu: 0.3, penalty: 1000}}}]
steps:
  - {name: press, increments: 2, prescribe: [{on: low.bottom, ux: 0, uy: 0, uz: 0},
      {on: up.top, ux: 0, uy: 0, uz: -0.03}]}
  - {name: drag, increments: 10, prescribe: [{on: up.top, ux: 0.9, uy: 0.2}]}
output: {fields: 2, history: [{on: c, of: normal_force}, {on: c, of: force_x}, {on: c, of: force_y}]}
"""


class Restart(RestartCase):
    def files(self, out):
        found = {}
        for name in os.listdir(self.path(out)):
            with open(self.path(out, name), "rb") as file:
                found[name] = file.read()
        return found

    def expect_a_whole_collection(self, out):
        if not os.path.exists(self.path(out, "results.pvd")):
            return
        for frame in xml.etree.ElementTree.parse(self.path(out, "results.pvd")).getroot().iter("DataSet"):
            self.assertTrue(os.path.exists(self.path(out, frame.get("file"))))

    def kill_at_random(self, model, seed, *more):
        self.write(model)
        begun = time.monotonic()
        self.run_to_end("whole", *more)
        whole = time.monotonic() - begun
        chance = random.Random(seed)
        kills = 0
        while True:
            restart = ["--restart"] if os.path.exists(self.path("killed", "checkpoint.bin")) else []
            with subprocess.Popen(self.command("killed", "--quiet", *more, *restart), cwd=self.folder.name,
                                  stderr=subprocess.PIPE, text=True) as program:
                try:
                    program.wait((chance.uniform(0.1, 0.3) + 0.1 * kills) * whole)
                    message = program.stderr.read()
                    break
                except subprocess.TimeoutExpired:
                    program.kill()
                    program.wait()
                    kills += 1
                    self.expect_a_whole_collection("killed")
        self.assertEqual(program.returncode, 0, message)
        self.assertGreater(kills, 0)
        self.expect_the_same("killed", "whole")

    def test_killed_at_any_moment_it_goes_on_with_the_same_bits(self):
        for seed in (1, 2, 3):
            with self.subTest(seed=seed):
                self.kill_at_random(PLANE, seed)
                shutil.rmtree(self.path("killed"))

    def test_in_space_too_and_with_two_threads(self):
        for threads in "12":
            with self.subTest(threads=threads):
                self.kill_at_random(SPACE, 10 + int(threads), "--threads", threads)
                shutil.rmtree(self.path("killed"))

    def test_after_a_step_and_after_every_third_increment(self):
        self.write(PLANE.replace("output: {", "output: {checkpoint: 3, "))
        self.run_to_end("whole")
        with open(self.path("whole/summary.json")) as file:
            self.assertGreater(json.load(file)["total"]["cutbacks"], 0)  # the step control is in the middle
        self.run_to_end("parts", "--until", "press")
        with subprocess.Popen(self.command("parts", "--restart"), cwd=self.folder.name,
                              stderr=subprocess.PIPE, text=True) as program:
            for line in program.stderr:
                if line.startswith("drag  ") and line.split()[1] == "5":
                    program.send_signal(signal.SIGINT)
                    break
            program.stderr.read()
        self.assertEqual(program.returncode, 3)
        self.assertNotEqual(self.results("parts")["history.csv"], self.results("whole")["history.csv"])
        done = self.run_to_end("parts", "--restart")
        self.assertIn("restart after increment", done.stderr)
        self.expect_the_same("parts", "whole")
        self.run_to_end("parts", "--restart")  # nothing is left to do
        self.expect_the_same("parts", "whole")

    def test_a_damaged_checkpoint_is_not_used(self):
        self.write(PLANE)
        self.run_to_end("whole")
        self.run_to_end("press", "--until", "press")
        shutil.copytree(self.path("press"), self.path("r"))
        good = self.files("r")
        chance = random.Random(7)

        def restart_with(code, *more, **changed):
            shutil.rmtree(self.path("r"))
            os.mkdir(self.path("r"))
            for name, content in {**good, **changed}.items():
                if content is not None:
                    with open(self.path("r", name), "wb") as file:
                        file.write(content)
            before = self.files("r")
            done = self.run_to_end("r", "--restart", *more, code=code)
            if code == 2:
                self.assertEqual(self.files("r"), before)
            return done

        def flipped(content):
            at = chance.randrange(len(content))
            return content[:at] + bytes([content[at] ^ (1 << chance.randrange(8))]) + content[at + 1:]

        last = good["checkpoint.bin"]
        for broken in [flipped(last) for _ in range(12)] + [last[:chance.randrange(len(last))] for _ in range(4)]:
            done = restart_with(0, "--until", "press", **{"checkpoint.bin": broken})
            self.assertIn("going on from the previous checkpoint instead", done.stderr)
            self.assertIn("checkpoint.bin: ", done.stderr)
            self.expect_the_same("r", "press")
        done = restart_with(0, **{"checkpoint.bin": None})
        self.assertIn("going on from the previous checkpoint instead", done.stderr)
        self.expect_the_same("r", "whole")
        done = restart_with(2, **{"checkpoint.bin": flipped(last),
                                  "checkpoint.previous.bin": flipped(good["checkpoint.previous.bin"])})
        self.assertIn("no checkpoint can be used: ", done.stderr)
        journal = good["journal.bin"]
        for broken in (flipped(journal[:2000]) + journal[2000:], journal[:3000], None):
            done = restart_with(2, **{"journal.bin": broken})
            self.assertIn("journal.bin", done.stderr)
        self.expect_the_same_after(restart_with, journal + b"half an entry of the increment that was killed")
        done = restart_with(2, **{"checkpoint.bin": re.sub(rb"\Aosculate checkpoint \d+\n", b"osculate checkpoint 7\n", last),
                                  "checkpoint.previous.bin": None})
        self.assertIn("is of another version: 'osculate checkpoint 7', expected 'osculate checkpoint ", done.stderr)
        done = restart_with(2, **{"checkpoint.bin": None, "checkpoint.previous.bin": None})
        self.assertIn("there is no checkpoint in 'r'", done.stderr)

    def expect_the_same_after(self, restart_with, journal):
        restart_with(0, **{"journal.bin": journal})
        self.expect_the_same("r", "whole")

    def test_only_solver_and_output_may_change(self):
        self.write(PLANE)
        self.run_to_end("r", "--until", "press")
        for old, new, message in (
            ("mu: 0.3", "mu: 0.35", "model.yaml:8: contact[0].friction.coulomb.mu: was 0.3, is now 0.35"),
            ("elements: [24, 6]", "elements: [24, 5]", "mesh.generate.block.box.elements[1]: was 6, is now 5"),
            ("E: 1.0e3, ", "E: 1.0e3, thickness: 2, ", None),
            ("{on: block.top, of: rfx}", "{on: block.top, of: rfy}", "output.history: the columns are others than before"),
        ):
            if message is None:
                continue
            self.write(PLANE.replace(old, new))
            before = self.files("r")
            done = self.run_to_end("r", "--restart", code=2)
            self.assertIn(message, done.stderr)
            self.assertEqual(self.files("r"), before)
        self.write(PLANE.replace("max_iterations: 6", "max_iterations: 20").replace("# ", "#").replace("title: Block", "title: A block"))
        self.run_to_end("r", "--restart")

    def test_a_full_disk_ends_with_3_and_keeps_the_results(self):
        self.write(PLANE)
        self.run_to_end("whole")
        sizes = {name: len(content) for name, content in self.files("whole").items()}
        for limit in (sizes["journal.bin"] // 2, sizes["bodies_00005.vtu"] - 10, 400):
            if os.path.exists(self.path("r")):
                shutil.rmtree(self.path("r"))
            done = self.run_to_end("r", code=3, preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_FSIZE, (limit, limit)))
            self.assertIn("cannot write: File too large; what was written before is kept", done.stderr)
            with open(self.path("r/history.csv")) as file:
                text = file.read()
            self.assertTrue(text.endswith("\n"))
            rows = list(csv.reader(text.splitlines()))
            self.assertTrue(all(len(row) == len(rows[0]) for row in rows))
            with open(self.path("whole/history.csv")) as file:
                self.assertTrue(file.read().startswith(text))
            if os.path.exists(self.path("r/checkpoint.bin")):
                self.run_to_end("r", "--restart")
                self.expect_the_same("r", "whole")

    def test_a_folder_that_cannot_be_written_to_ends_with_3(self):
        self.write(PLANE)
        done = self.run_to_end("/proc/results", code=3)
        self.assertIn("/proc/results", done.stderr)
        done = self.run_to_end("/proc/self/fd", code=2)  # occupied
        self.assertIn("/proc/self/fd", done.stderr)

    def test_the_tangent_at_a_converged_increment(self):
        for model in (PLANE, SPACE):
            self.write(model)
            self.run_to_end("whole", "--until", "press")
            for arguments in ((), ("-o", "whole")):
                done = subprocess.run([PROGRAM, "tangent", "model.yaml", "--state", "3", "--json", *arguments],
                                      cwd=self.folder.name, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                report = json.loads(done.stdout)
                self.assertEqual([row["part"] for row in report["rows"]], ["bulk", "contact", "all"])
                self.assertTrue(all(row["pass"] and not row["skipped"] for row in report["rows"]), done.stdout)
                self.assertGreater(report["stick"] + report["slipping"], 0)
            done = subprocess.run([PROGRAM, "tangent", "model.yaml", "--state", "99999"], cwd=self.folder.name,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("--state 99999: the analysis has only ", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
