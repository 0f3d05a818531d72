"""osculate study: runs over values of parameters. Usage: test_study.py PROGRAM SOURCE_DIR"""
import csv
import glob
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM, SOURCE = sys.argv[1], sys.argv[2]
MODEL = """osculate: 1
parameters: {mu: 0.3, side: 0.2, steel: 1.0e4, kind: quad4}
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [4, 2], type: =kind}}}}
materials: {s: {linear_elastic: {E: =steel, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}
contact: [{name: c, master: floor, slave: block.bottom, normal: {penalty: 1.0e6}, friction: {coulomb: {mu: =mu, penalty: 1.0e6}}}]
steps:
  - {name: press, increments: 2, prescribe: [{on: block.top, ux: 0, uy: -0.01}]}
  - {name: push, increments: 2, prescribe: [{on: block.top, ux: =side}]}
output: {fields: none, report: false, history: [{on: c, of: normal_force}, {on: c, of: shear_force}]}
"""


class Study(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("m.yaml", MODEL)

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)

    def study(self, *arguments, code=0, model="m.yaml"):
        done = subprocess.run([PROGRAM, "study", model, *arguments], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def table(self, folder="m.study"):
        with open(self.path(folder, "table.csv"), newline="") as file:
            return list(csv.DictReader(file))

    def times(self):
        return {name: os.stat(name).st_mtime_ns for name in glob.glob(self.path("m.study", "*", "summary.json"))}

    def refused(self, *arguments, says):
        before = sorted(os.listdir(self.folder))
        done = self.study(*arguments, code=2)
        self.assertIn(says, done.stderr)
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    # ---- what it runs ----

    def test_all_combinations_with_the_outputs_of_single_runs(self):
        self.study("--set", "mu=0.1:0.3:3", "--set", "side=0.1,0.2", "-j", "2")
        rows = self.table()
        self.assertEqual([(row["mu"], row["side"]) for row in rows],
                         [(mu, side) for mu in ("0.1", "0.2", "0.3") for side in ("0.1", "0.2")])
        self.assertEqual({row["status"] for row in rows}, {"done"})
        for row in rows:
            self.assertAlmostEqual(-float(row["c.shear_force"]), float(row["mu"]) * float(row["c.normal_force"]), delta=1e-6)
        subprocess.run([PROGRAM, "run", "m.yaml", "--quiet", "--set", "mu=0.2", "--set", "side=0.1"], cwd=self.folder, check=True)
        with open(self.path("m.results", "history.csv"), newline="") as file:
            last = list(csv.DictReader(file))[-1]
        self.assertEqual([rows[2][name] for name in ("c.normal_force", "c.shear_force")],
                         [last["c.normal_force"], last["c.shear_force"]])
        with open(self.path("m.results", "summary.json")) as file:
            self.assertEqual(int(rows[2]["iterations"]), json.load(file)["total"]["iterations"])
        self.assertEqual(rows[2]["folder"], "mu=0.2,side=0.1")
        self.assertTrue(os.path.exists(self.path("m.study", "mu=0.2,side=0.1", "log.txt")))

    def test_together(self):
        self.study("--set", "mu=0.1,0.2", "--set", "kind=quad8", "--set", "side=0.1,0.3", "--together")
        self.assertEqual([row["folder"] for row in self.table()], ["mu=0.1,kind=quad8,side=0.1", "mu=0.2,kind=quad8,side=0.3"])
        self.refused("--set", "mu=0.1,0.2", "--set", "side=1,2,3", "--together", says="mu has 2 values, side has 3")

    def test_ranges(self):
        def listed(values):
            return re.findall(r"steel=(\S+)", self.study("--list", "--set", "steel=" + values).stdout)

        self.assertEqual(listed("1000:100000:3:log"), ["1000", "10000", "100000"])
        self.assertEqual(listed("0.1:0.5:5"), ["0.1", "0.2", "0.3", "0.4", "0.5"])
        self.assertEqual(listed("1e3,3:1:2"), ["1e3", "3", "1"])
        self.assertFalse(os.path.exists(self.path("m.study")))

    def test_texts_and_the_extremes_of_a_column(self):
        self.study("--set", "kind=quad4,quad8", "--column", "max:c.normal_force", "--column", "min:c.normal_force", "--column", "c.normal_force")
        for row in self.table():
            with open(self.path("m.study", row["folder"], "history.csv"), newline="") as file:
                values = [float(line["c.normal_force"]) for line in csv.DictReader(file)]
            self.assertEqual([float(row[name]) for name in ("max:c.normal_force", "min:c.normal_force", "c.normal_force")],
                             [max(values), min(values), values[-1]])
            self.assertLess(values[-1], max(values))
        self.assertEqual(glob.glob(self.path("m.study", "*.svg")), [])  # nothing to draw them over

    def test_plots_have_a_curve_for_each_combination(self):
        self.study("--set", "kind=quad4,quad8", "--set", "steel=1e3:1e5:3:log", "--set", "mu=0.1,0.2", "--column", "c.normal_force")
        with open(self.path("m.study", "c.normal_force.svg")) as file:
            plot = file.read()
        for label in ("kind=quad4, mu=0.1", "kind=quad8, mu=0.2", ">steel<", ">c.normal_force<", "m.yaml"):
            self.assertIn(label, plot)
        self.assertEqual(plot.count('stroke-width="1.6"/>\n'), 2 * 4)  # curve and key

    # ---- taken up again ----

    def test_what_is_done_is_not_run_again(self):
        self.study("--set", "mu=0.1,0.2")
        first, before = self.table(), self.times()
        self.assertIn("2 of 2 are done already", self.study("--set", "mu=0.1,0.2").stderr)
        self.assertEqual((self.times(), self.table()), (before, first))
        self.study("--set", "mu=0.1,0.2,0.4")
        self.assertEqual({name: at for name, at in self.times().items() if name in before}, before)
        self.assertEqual(self.table()[:2], first)
        self.assertEqual(self.study("--list", "--set", "mu=0.2,0.5").stdout, "mu=0.2  done\nmu=0.5\n")
        self.study("--set", "mu=0.1,0.2", "--again")
        for name, at in before.items():
            self.assertNotEqual(self.times()[name], at)

    def test_another_model_is_run_again(self):
        self.study("--set", "mu=0.1,0.2")
        self.write("m.yaml", MODEL.replace("steel: 1.0e4", "steel: 2.0e4"))
        self.assertEqual(self.study("--list", "--set", "mu=0.1,0.2").stdout, "mu=0.1\nmu=0.2\n")
        before = [float(row["c.normal_force"]) for row in self.table()]
        self.study("--set", "mu=0.1,0.2")
        for old, row in zip(before, self.table()):
            self.assertAlmostEqual(float(row["c.normal_force"]) / old, 2, delta=0.02)

    def test_another_program_runs_again(self):
        self.study("--set", "mu=0.1,0.2")
        path = self.path("m.study", "mu=0.2", "summary.json")
        with open(path) as file:
            text = file.read()
        summary = json.loads(text)
        with open(path, "w") as file:
            json.dump({**summary, "osculate": summary["osculate"] + ".1"}, file)
        self.assertEqual(self.study("--list", "--set", "mu=0.1,0.2").stdout, "mu=0.1  done\nmu=0.2\n")
        with open(path, "w") as file:
            file.write(text)
        self.assertEqual(self.study("--list", "--set", "mu=0.1,0.2").stdout, "mu=0.1  done\nmu=0.2  done\n")

    def test_another_content_of_a_mesh_is_another_model(self):
        with open(os.path.join(SOURCE, "tests", "unit", "io", "data", "blocks_41.msh")) as file:
            mesh = file.read()
        self.write("b.msh", mesh)
        subprocess.run([PROGRAM, "init", "b.msh", "-o", "b.yaml"], cwd=self.folder, check=True, capture_output=True)
        with open(self.path("b.yaml")) as file:
            text = file.read()
        self.write("b.yaml", re.sub(r"nu: 0\.3", "nu: =nu", text) + "\nparameters: {nu: 0.3}\n")
        self.study("--set", "nu=0.2,0.3", model="b.yaml")
        self.assertEqual(self.study("--list", "--set", "nu=0.2", model="b.yaml").stdout, "nu=0.2  done\n")
        later, earlier = time.time() + 5, time.time() - 1000
        os.utime(self.path("b.msh"), (later, later))  # as a copy of the same is
        self.assertEqual(self.study("--list", "--set", "nu=0.2", model="b.yaml").stdout, "nu=0.2  done\n")
        self.write("b.msh", mesh + "\n")
        os.utime(self.path("b.msh"), (earlier, earlier))
        self.assertEqual(self.study("--list", "--set", "nu=0.2", model="b.yaml").stdout, "nu=0.2\n")

    def test_interrupted_and_taken_up_again(self):
        self.write("m.yaml", MODEL.replace("increments: 2, prescribe: [{on: block.top, ux: =side}]",
                                           "increments: 20000, prescribe: [{on: block.top, ux: =side}]"))
        arguments = [PROGRAM, "study", "m.yaml", "--set", "mu=0.1:0.4:4", "-j", "2", "--column", "c.normal_force"]
        for folder, number in (("m.study", signal.SIGINT), ("other.study", signal.SIGTERM)):
            with self.subTest(signal=number):
                study = subprocess.Popen([*arguments, "-o", folder], cwd=self.folder, stderr=subprocess.PIPE, text=True)
                running = [self.path(folder, f"mu=0.{k}", "history.csv") for k in (1, 2)]
                while not all(os.path.exists(name) and os.path.getsize(name) > 1000 for name in running):
                    self.assertIsNone(study.poll())
                    time.sleep(0.01)
                study.send_signal(number)
                _, errors = study.communicate(timeout=60)
                self.assertEqual(study.returncode, 3)
                self.assertIn("the same command does the runs that are left", errors)
                rows = self.table(folder)
                self.assertEqual([(row["mu"], row["status"], row["c.normal_force"]) for row in rows],
                                 [("0.1", "stopped", "nan"), ("0.2", "stopped", "nan")])
                with open(self.path(folder, "summary.json")) as file:
                    summary = json.load(file)
                self.assertEqual([summary[key] for key in ("status", "runs", "done")], ["stopped", 4, 0])
        self.write("m.yaml", MODEL)
        self.study("--set", "mu=0.1:0.4:4")
        self.assertEqual([row["status"] for row in self.table()], ["done"] * 4)

    def test_a_study_that_is_killed_leaves_no_run_behind(self):
        self.write("m.yaml", MODEL.replace("increments: 2, prescribe: [{on: block.top, ux: =side}]",
                                           "increments: 20000, prescribe: [{on: block.top, ux: =side}]"))
        study = subprocess.Popen([PROGRAM, "study", "m.yaml", "--set", "mu=0.1", "--quiet"], cwd=self.folder)
        history = self.path("m.study", "mu=0.1", "history.csv")
        while not (os.path.exists(history) and os.path.getsize(history) > 1000):
            time.sleep(0.01)
        study.kill()
        study.wait()
        for _ in range(3000):
            with open(self.path("m.study", "mu=0.1", "summary.json")) as file:
                if json.load(file)["status"] == "stopped":
                    break
            time.sleep(0.01)
        else:
            self.fail("the run goes on")

    # ---- what goes wrong ----

    def test_one_that_fails_does_not_stop_the_others(self):
        done = self.study("--set", "mu=0.1,0.2,0.3", "--max-iterations", "6", "--column", "c.normal_force", code=3)
        self.assertIn("stopped", done.stderr)
        stopped = {row["status"] for row in self.table()}
        self.assertIn("stopped", stopped)
        self.write("m.yaml", MODEL.replace("kind: quad4", "kind: quad4, on: bottom").replace("slave: block.bottom", "slave: 'block.${on}'"))
        self.study("--set", "on=bottom,nowhere,top", "--column", "c.normal_force", "-o", "other", code=3)
        rows = self.table("other")
        self.assertEqual([row["status"].split(":")[0] for row in rows], ["done", "failed", "done"])
        self.assertIn("unknown set 'block.nowhere'", rows[1]["status"])
        self.assertEqual(rows[1]["c.normal_force"], "nan")

    def test_one_that_crashes_does_not_stop_the_others(self):
        self.write("m.yaml", MODEL.replace("increments: 2, prescribe: [{on: block.top, ux: =side}]",
                                           "increments: =count, prescribe: [{on: block.top, ux: =side}]").replace("mu: 0.3,", "mu: 0.3, count: 2,"))
        study = subprocess.Popen([PROGRAM, "study", "m.yaml", "--set", "count=20000,2,3", "-j", "1", "--quiet", "--column", "c.normal_force"],
                                 cwd=self.folder)
        lock, history = (self.path("m.study", "count=20000", name) for name in ("running.lock", "history.csv"))
        while not (os.path.exists(history) and os.path.getsize(history) > 1000):
            self.assertIsNone(study.poll())
            time.sleep(0.01)
        with open(lock) as file:
            os.kill(int(re.search(r"process (\d+)", file.read())[1]), signal.SIGSEGV)
        self.assertEqual(study.wait(timeout=60), 3)
        self.assertEqual([row["status"] for row in self.table()], ["failed: signal 11 (Segmentation fault)", "done", "done"])

    def test_bad_input_writes_nothing(self):
        self.refused("--set", "nu=1,2", says="unknown parameter 'nu'; did you mean 'mu'?")
        self.refused("--set", "mu=0.1", "--column", "c.normal_forc", says="did you mean 'c.normal_force'?")
        self.refused("--set", "mu=0.1,-0.2", says="mu=-0.2: ")
        self.refused("--set", "mu=0.1", "--set", "mu=0.2", says="'mu' is given twice")
        self.refused("--set", "mu=0.1,0.2,0.1", says="the value '0.1' is given twice")
        self.refused("--set", "mu=", says="expected NAME=VALUE")
        self.refused("--set", "mu=0.1,,0.2", says="a value is missing")
        for values in ("0.1:0.2", "0.1:0.2:1", "0.1:x:3", "0.1:0.2:3:lin", "0.1:0.2:3:log:4", "0.1:0.2:2.5"):
            self.refused("--set", "mu=" + values, says="expected from:to:count")
        self.refused("--set", "mu=0:1:3:log", says="positive ends")
        self.refused("--set", "mu=0:1:100000", says="more than 10000 values")
        self.refused("--set", "mu=0:1:1000", "--set", "side=1:2:1000", says="1000000 runs")
        self.refused("--set", "mu=0.1", "--column", "c.shear_force", "--column", "c.shear_force", says="given twice")
        self.refused(says="--set is required")
        self.write("m.yaml", MODEL.replace("block.bottom", "block.botom"))
        self.refused("--set", "mu=0.1,0.2", says="did you mean 'block.bottom'?")
        self.write("m.yaml", MODEL.replace("mu: 0.3,", "mu: 0.3, status: 1,"))
        self.refused("--set", "status=1,2", says="two columns 'status'")

    def test_folders_of_others_are_left_alone(self):
        os.mkdir(self.path("m.study"))
        self.write("m.study/notes.txt", "mine")
        self.refused("--set", "mu=0.1", says="holds no results of 'm.yaml'")
        self.assertEqual(os.listdir(self.path("m.study")), ["notes.txt"])
        subprocess.run([PROGRAM, "run", "m.yaml", "--quiet"], cwd=self.folder, check=True)
        self.refused("--set", "mu=0.1", "-o", "m.results", says="holds the results of a run")

    # ---- docs/study.md ----

    def test_the_example_of_the_page(self):
        with open(os.path.join(SOURCE, "docs", "study.md")) as file:
            page = file.read()
        model, command, table = (re.search(pattern, page, re.M | re.S)[1] for pattern in
                                 (r"^```yaml\n(.*?)^```", r"^```\nosculate study (\S.*?)\n```", r"^```\n(mu,.*?)^```"))
        self.write("block.yaml", model)
        self.study(*command.split()[1:], model=command.split()[0])
        found, shown = self.table("block.study"), list(csv.DictReader(table.split("\n")))
        self.assertEqual([list(row) for row in found], [list(row) for row in shown])
        for mine, theirs in zip(found, shown):
            for name in mine:
                if name == "floor.shear_force":
                    self.assertAlmostEqual(float(mine[name]) / float(theirs[name]), 1, delta=1e-5)
                else:
                    self.assertEqual(mine[name], theirs[name], name)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
