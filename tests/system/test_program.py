"""The program as a user calls it: exit codes, messages, files. Usage: test_program.py PROGRAM SOURCE_DIR"""
import csv
import fcntl
import json
import os
import shutil
import signal
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
  - {name: weight, increments: 2, body_force: [{on: block, fx: SIDE, fy: -1}]}
  - {name: more, increments: 1, body_force: [{on: block, fy: -2}]}
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
  {on: c, of: slip}, {on: c, of: slipping}, {on: c, of: closed}, {on: b.top, of: rfz}]}
"""

CASE = """requirement: A block on a line carries its weight
source: statics
runs:
  - each: [[{side: 0.1}, {side: 0.2}]]
    model: block.yaml
    set: {steps.0.body_force.0.fx: "{side}"}
    rows:
      - {quantity: "side {side}: weight", of: c.normal_force, step: more, is: 16, within: 1.0e-9}
  - {name: flat, model: block.yaml}
  - name: steep
    model: block.yaml
    set: {steps.0.body_force: [{on: block, fx: 0.2, fy: -1}]}
    rows: [{quantity: increments, of: increments, at: sum, is: 3}]
  - rows:
      - {quantity: "side that holds it, over the other", run: steep, of: c.shear_force, at: 1,
         over: {run: flat, of: c.shear_force, at: 1}, at_least: 1.99}
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

    def text(self, name):
        with open(self.path(name)) as file:
            return file.read()

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder.name, capture_output=True, text=True)

    def test_without_the_verification_cases_one_sentence_says_what_to_do(self):
        os.mkdir(self.path("bin"))
        alone = self.path("bin/osculate")
        shutil.copy(PROGRAM, alone)
        os.symlink(os.path.join(os.path.dirname(os.path.dirname(PROGRAM)), "lib"), self.path("lib"))
        done = subprocess.run([alone, "verify", "--list"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("--target osculate-verify", done.stderr)

    def test_domain(self):
        saddle = os.path.join(SOURCE, "examples", "domains", "saddle.yaml")
        done = self.run_program("domain", saddle, "-o", "saddle.vtu", "--page", "saddle.html", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        found = json.loads(done.stdout)
        self.assertEqual(list(found["classes"]), ["hyperbolic"])
        self.assertAlmostEqual(found["above"]["reach"]["value"], 1, places=7)
        self.assertIn("wrote saddle.vtu", done.stderr)
        for name in ["saddle.vtu", "saddle.html"]:
            self.assertGreater(os.path.getsize(self.path(name)), 1000)
        ellipse = os.path.join(SOURCE, "examples", "domains", "ellipse.yaml")
        done = self.run_program("domain", ellipse)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("reach         0.0833333, curvature at (", done.stdout)
        self.assertIn("reach between 0.0825 and 0.0833333 (within 1 %)", done.stdout)
        broken = self.model("nurbs: {degree: [2]}\n", "broken.yaml")
        done = self.run_program("domain", broken, "-o", "broken.vtu")
        self.assertEqual(done.returncode, 2)
        self.assertIn("broken.yaml:1", done.stderr)
        self.assertFalse(os.path.exists(self.path("broken.vtu")))

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

    def test_what_is_no_command_or_no_model_is_answered_with_what_to_do(self):
        with open(self.path("part.msh"), "w") as file:
            file.write("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")
        with open(self.path("part.geo"), "w") as file:
            file.write("Point(1) = {0, 0, 0};\n")
        for arguments, said in ((("chekc", "m.yaml"), "unknown command 'chekc'; did you mean 'check'?"),
                                (("m.yaml",), "for a model file or deck: `osculate run m.yaml`"),
                                (("run", "part.msh"), "it is a mesh of Gmsh; `osculate init part.msh` writes a model file for it"),
                                (("run", "part.geo"), "mesh it (`gmsh -3 part.geo`, in the plane -2)")):
            with self.subTest(arguments=arguments):
                done = self.run_program(*arguments)
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertIn(said, done.stderr)

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

    def test_two_models_of_one_name_keep_their_results_apart(self):
        for folder in ("a", "b"):
            os.mkdir(self.path(folder))
        self.model(BLOCK.replace("SIDE", "0.1"), "a/model.yaml")
        self.model(BLOCK.replace("SIDE", "0.2"), "b/model.yaml")
        self.assertEqual(self.run_program("run", "a/model.yaml", "-o", "out").returncode, 0)
        before = self.text("out/history.csv")
        result = self.run_program("run", "b/model.yaml", "-o", "out")
        self.assertEqual(result.returncode, 2)
        self.assertIn("holds the results of another 'model.yaml'", result.stderr)
        self.assertEqual(self.text("out/history.csv"), before)
        self.assertEqual(self.run_program("run", "a/model.yaml", "-o", "out").returncode, 0)

    def test_what_a_killed_run_was_about_to_write_is_no_file_of_others(self):
        self.model(BLOCK.replace("SIDE", "0.1"))
        os.mkdir(self.path("out"))
        for name in ("running.lock", "writable.part", "writable.part.part", "history.csv.part"):
            self.model("", os.path.join("out", name))
        done = self.run_program("run", "model.yaml", "-o", "out", "--until", "weight")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_files_of_others_in_a_result_folder_stay(self):
        self.model(BLOCK.replace("SIDE", "0.1"))
        self.assertEqual(self.run_program("run", "model.yaml", "-o", "out").returncode, 0)
        kept = ["mine.vtu", "old.pvd", "movie.mkv.part", "bodies_final.vtu", "contacts_00001.vtu",
                "bodies_00777.vtu", "contact0_00777.csv"]
        for name in kept:
            self.model("mine", os.path.join("out", name))
        self.assertEqual(self.run_program("run", "model.yaml", "-o", "out").returncode, 0)
        for name in kept:
            self.assertEqual(self.text(os.path.join("out", name)), "mine", name)

    def test_field_files_of_a_longer_run_do_not_stay(self):
        self.model(BLOCK.replace("SIDE", "0.1"))
        self.assertEqual(self.run_program("run", "model.yaml", "-o", "out").returncode, 0)
        fields = [n for n in os.listdir(self.path("out")) if n.endswith(".vtu")]
        self.assertGreater(len(fields), 2)
        self.assertEqual(sorted(self.text("out/written.txt").split()), sorted(fields))
        done = self.run_program("run", "model.yaml", "-o", "out", "--until", "weight")
        self.assertEqual(done.returncode, 0)
        left = [n for n in os.listdir(self.path("out")) if n.endswith(".vtu")]
        self.assertLess(len(left), len(fields))
        self.assertEqual(sorted(self.text("out/written.txt").split()), sorted(left))

    def test_one_run_at_a_time_in_a_folder(self):
        self.model(BLOCK.replace("SIDE", "0.1"))
        os.mkdir(self.path("out"))
        lock = open(self.path("out/running.lock"), "w")
        lock.write("process 4242 on there since then")
        lock.flush()
        fcntl.flock(lock, fcntl.LOCK_EX)
        result = self.run_program("run", "model.yaml", "-o", "out")
        self.assertEqual(result.returncode, 2)
        self.assertIn("folder 'out' is in use by process 4242 on there since then", result.stderr)
        self.assertEqual(os.listdir(self.path("out")), ["running.lock"])
        lock.close()  # its owner is dead: the file alone is nothing
        self.assertEqual(self.run_program("run", "model.yaml", "-o", "out").returncode, 0)
        self.assertNotIn("running.lock", os.listdir(self.path("out")))

    def test_the_same_bits_with_one_and_two_threads(self):
        self.expect_the_same_bits(self.model(BLOCK.replace("SIDE", "0.1")))

    def test_until(self):
        name = self.model(BLOCK.replace("SIDE", "0.1"))
        done = self.run_program("run", name, "--until", "weight", "--json", "--quiet")
        self.assertEqual(len(json.loads(done.stdout)["steps"]), 1)
        wrong = self.run_program("run", name, "--until", "wait")
        self.assertEqual(wrong.returncode, 2)
        self.assertIn("did you mean 'weight'", wrong.stderr)

    def case(self, name, text):
        """A verification case beside a copy of the program, which finds it there; what is said of it."""
        program = os.path.join(os.path.dirname(PROGRAM), "osculate-verify")
        if not os.path.exists(program):
            self.skipTest("the verification cases were not built")
        folder = self.path(os.path.join("share", "osculate", "verification", name))
        os.makedirs(self.path("bin"), exist_ok=True)
        libraries = os.path.join(os.path.dirname(PROGRAM), os.pardir, "lib")  # of a build tree
        if os.path.isdir(libraries) and not os.path.exists(self.path("lib")):
            os.symlink(os.path.abspath(libraries), self.path("lib"))
        os.makedirs(folder)
        copy = self.path(os.path.join("bin", "osculate-verify"))
        shutil.copy(program, copy)
        with open(os.path.join(folder, "block.yaml"), "w") as file:
            file.write(BLOCK.replace("SIDE", "0.1"))
        with open(os.path.join(folder, "case.yaml"), "w") as file:
            file.write(text)
        done = subprocess.run([copy, name, "--json", self.path(name + ".json")], capture_output=True, text=True)
        with open(self.path(name + ".json")) as file:
            return done.returncode, json.load(file)

    def test_a_verification_case_is_a_folder(self):
        code, rows = self.case("weights", CASE)
        self.assertEqual(code, 0, rows)
        self.assertEqual([row["quantity"] for row in rows], ["side 0.1: weight", "side 0.2: weight", "increments",
                                                             "side that holds it, over the other"])
        self.assertAlmostEqual(rows[3]["computed"], 2, places=8)

    def test_a_bad_verification_case_is_one_failing_row(self):
        for number, (right, wrong, said) in enumerate((
                ("within:", "whithin:", "unknown key 'whithin'; did you mean 'within'?"),
                ("c.normal_force", "c.normal_forc", "did you mean 'normal_force'?"),
                ("steps.0", "steps.7", "no item '7' in the model"),
                ("body_force.0.fx", "name.fx", "no key 'fx' in the model"),
                ("set:", "sett:", "unknown key 'sett'; did you mean 'set'?"),
                ("at: 1,\n", "less: [[0, 1]],\n", "expected at least 2 values, got 1"),
                ("model: block", "model: blok", "blok.yaml: cannot be read"),
                ("run: steep", "run: step", "unknown run 'step'"),
                ("step: more", "step: moer", "no increment"))):
            code, rows = self.case(f"wrong{number}", CASE.replace(right, wrong))
            self.assertEqual((code, len(rows)), (1, 1), rows)
            self.assertIn(said, rows[0]["quantity"])
            self.assertRegex(rows[0]["quantity"], r"case\.yaml:[0-9]+: |blok")

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

    def test_keys_as_words_and_a_search_for_what_analysts_call_it(self):
        whole = self.run_program("doc", "contact.normal.penalty")
        self.assertEqual(self.run_program("doc", "contact", "normal", "penalty").stdout, whole.stdout)
        for arguments in (("axisymmetric",), ("--search", "axisymmetric")):
            found = self.run_program("doc", *arguments)
            self.assertEqual(found.returncode, 0, found.stderr)
            self.assertIn("sections[].element: axisymmetric", found.stdout)
        for word in ("damage", "gasket"):
            self.assertIn(f"'{word}': not available: see `osculate doc limits`", self.run_program("doc", word).stdout)
        self.assertIn("# What Osculate cannot do", self.run_program("doc", "limits").stdout)
        self.assertEqual(self.run_program("doc", "xyzzy").returncode, 2)
        self.assertEqual(self.run_program("doc", "--search", "xyzzy").returncode, 2)

    def test_a_material_that_is_not_there_is_answered_with_those_that_are(self):
        name = self.model(BLOCK.replace("SIDE", "0").replace("linear_elastic", "plastic"))
        done = self.run_program("check", name)
        self.assertEqual(done.returncode, 2)
        self.assertIn("elastoplastic, norton, deformation_plasticity, rubber, ogden, hyperfoam, arruda_boyce, orthotropic, anisotropic, viscoelastic, user; others are not available", done.stderr)

    def test_parameters_are_set_on_the_command_line(self):
        name = self.model(BLOCK.replace("title:", "parameters: {side: 0.1}\ntitle:").replace("SIDE", "=side"))
        run = json.loads(self.run_program("run", name, "--json", "--set", "side=0.2").stdout)
        self.assertEqual(run["parameters"], {"side": "0.2"})
        check = json.loads(self.run_program("check", "--set", "side=0.25", name, "--json").stdout)
        self.assertAlmostEqual(check["steps"][0]["total"]["force"][0], 2)
        self.assertEqual(self.text("model.results/history.csv").split("\n")[0].split(","), ["step", "increment", "time"] + check["history"])
        self.assertEqual(self.run_program("tangent", name, "--set", "side=0.2").returncode, 0)
        for wrong, said in (("sid=1", "did you mean 'side'?"), ("side", "expected NAME=VALUE"),
                            ("side=x", "expected a number, got the text 'x'")):
            done = self.run_program("check", name, "--set", wrong)
            self.assertEqual(done.returncode, 2, wrong)
            self.assertIn(said, done.stderr)

    def test_a_budget_ends_a_run_in_plain_words(self):
        name = self.model(BLOCK.replace("SIDE", "0.1"))
        done = self.run_program("run", name, "--max-iterations", "1")
        self.assertEqual(done.returncode, 3)
        self.assertIn("the 1 iterations that --max-iterations allows are used up; everything that converged is kept",
                      done.stderr)
        self.assertNotIn("\r", done.stderr)
        self.assertEqual(self.run_program("run", name, "--max-minutes", "60").returncode, 0)
        self.assertEqual(self.run_program("run", name, "--max-minutes", "0").returncode, 2)

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
        self.assertEqual((last["c.slipping"], last["c.closed"]), (15, 15))
        self.assertTrue(0.02 < last["c.slip"] < 0.05, last["c.slip"])  # the top goes by 0.05, the bottom lags
        self.assertAlmostEqual((x * x + y * y) ** 0.5 / normal, 0.3, places=2)
        self.assertAlmostEqual(last["b.top.rfz"] / normal, -1, places=8)
        with open(self.path("model.results/report.html")) as file:
            self.assertIn('"dimension":3', file.read())
        self.assertTrue(os.path.exists(self.path("model.results/contact0_00005.vtu")))
        tangent = self.run_program("tangent", name)
        self.assertEqual(tangent.returncode, 0, tangent.stdout + tangent.stderr)
        check = self.run_program("check", name)
        self.assertIn("15 of 15 slave points face the master, 15 touch", check.stdout)

    def test_the_same_bits_with_one_and_two_threads_in_space(self):
        self.expect_the_same_bits(self.model(SPACE))

    def points(self, rows, name="points.csv"):
        with open(self.path(name), "w") as file:
            file.write(rows)
        return name

    def test_closest_points_of_the_example(self):
        folder = os.path.join(SOURCE, "examples/closest_points")
        box, points = os.path.join(folder, "box.yaml"), os.path.join(folder, "points.csv")
        done = self.run_program("project", box, points)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("6 points", done.stderr)
        rows = list(csv.DictReader(done.stdout.splitlines()))
        self.assertEqual([row["id"] for row in rows], list("012345"))
        self.assertEqual([row["feature"] for row in rows[:4]], ["face", "edge", "corner", "face"])
        self.assertEqual([row["facet"] for row in (rows[0], rows[3])], ["1", "0"])
        for row, distance in zip(rows, (2, 2 ** 0.5, 3 ** 0.5, -0.25, -0.5)):
            self.assertAlmostEqual(float(row["distance"]), distance, places=12)
        self.assertEqual([row["status"] for row in rows[:4]], 4 * ["projected"])
        self.assertEqual([row["unique"] for row in rows], ["1", "1", "1", "1", "0", ""])
        self.assertAlmostEqual(float(rows[3]["margin"]), 0.5, places=12)
        self.assertEqual((rows[4]["status"], rows[5]["status"]), ("ambiguous", "invalid"))
        self.assertEqual(self.run_program("project", box, points, "-o", "out.csv", "--fast").returncode, 0)
        with open(self.path("out.csv")) as file:
            fast = list(csv.DictReader(file))
        self.assertEqual([row["feature"] for row in fast[:4]], ["face", "edge", "corner", "face"])
        self.assertEqual({row["margin"] for row in fast}, {""})

    def test_closest_points_have_the_same_bytes_with_one_and_two_threads(self):
        rows = ["x,y,z"] + [f"{i % 37 / 9},{i % 41 / 10 - 1},{i % 43 / 11 - 1}" for i in range(5000)]
        points = self.points("\n".join(rows))
        box = os.path.join(SOURCE, "examples/closest_points/box.yaml")
        texts = [self.run_program("project", box, points, "--threads", n).stdout for n in "12"]
        self.assertEqual(texts[0].count("\n"), 5001)
        self.assertEqual(texts[0], texts[1])

    def test_bad_surfaces_and_points_end_with_2_and_write_nothing(self):
        good = self.model("sphere: {center: [0, 0, 0], radius: 1}\n", "good.yaml")
        bad = self.model("sphere: {center: [0, 0, 0], radios: 1}\n", "bad.yaml")
        points = self.points("x,y,z\n1,2,3\n")
        self.points("kept", "out.csv")
        for surface, table, message in (
            (bad, points, "error: bad.yaml:1: sphere: unknown key 'radios'; did you mean 'radius'?\n"),
            ("no.yaml", points, "error: no.yaml: no such file\n"),
            (good, "no.csv", "error: no.csv: no such file\n"),
            (good, self.points("x,y,z\n1,2,3\n1,2,c\n", "c.csv"),
             "error: c.csv:3: z: expected a number, found 'c'\n"),
            (good, self.points("x,y\n1,2\n", "xy.csv"),
             "error: xy.csv:1: there is no column 'z' in the header line; it has: x, y\n"),
        ):
            done = self.run_program("project", surface, table, "-o", "out.csv")
            self.assertEqual((done.returncode, done.stdout, done.stderr), (2, "", message))
            with open(self.path("out.csv")) as file:
                self.assertEqual(file.read(), "kept")
        self.assertFalse(os.path.exists(self.path("out.csv.part")))
        self.assertEqual(self.run_program("project", good, points, "-o", "no/out.csv").returncode, 3)
        self.assertEqual(self.run_program("project", good).returncode, 2)
        self.assertIn("tube_radius", self.run_program("doc", "--surface", "torus").stdout)
        self.assertIn("facets", json.loads(self.run_program("schema", "--surface").stdout)["properties"])

    def test_outputs_never_take_the_place_of_an_input(self):
        surface = "circle: {center: [0, 0], radius: 1}\n"
        self.model(surface, "s.yaml")
        self.model("x,y\n2,0\n", "p.csv")
        for arguments in (("domain", "s.yaml", "-o", "s.yaml"), ("domain", "s.yaml", "--page", "./s.yaml"),
                          ("project", "s.yaml", "p.csv", "-o", "p.csv"), ("domain", "s.yaml", "-o", "a", "--page", "a")):
            result = self.run_program(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertIn("named for two outputs" if "a" in arguments else "is the input", result.stderr)
        self.assertEqual(self.text("s.yaml"), surface)
        self.assertEqual(self.text("p.csv"), "x,y\n2,0\n")

    def test_options_that_are_no_numbers_are_refused(self):
        self.model("circle: {center: [0, 0], radius: 1}\n", "s.yaml")
        for option in ("--kink", "--tolerance", "--length"):
            for value in ("nan", "inf", "-nan"):
                self.assertEqual(self.run_program("domain", "s.yaml", f"{option}={value}").returncode, 2, option)

    def test_interrupted_closest_points_leave_no_file(self):
        surface = self.model("sphere: {center: [0, 0, 0], radius: 1}\n", "good.yaml")
        os.mkfifo(self.path("endless.csv"))
        command = [PROGRAM, "project", surface, "endless.csv", "-o", "out.csv"]
        with subprocess.Popen(command, cwd=self.folder.name, stderr=subprocess.PIPE, text=True) as program:
            table = os.open(self.path("endless.csv"), os.O_WRONLY)  # waits for the program to read it
            os.write(table, b"x,y,z\n")
            program.send_signal(signal.SIGINT)
            try:
                for _ in range(1000):
                    os.write(table, 10000 * b"1,2,3\n")
            except BrokenPipeError:
                pass
            os.close(table)
            message = program.stderr.read()
        self.assertEqual(program.returncode, 3, message)
        self.assertIn("out.csv was not written", message)
        self.assertEqual([name for name in os.listdir(self.folder.name) if name.startswith("out")], [])

    def test_a_clip_closes_on_itself_and_opens_again(self):
        model = os.path.join(SOURCE, "examples", "clip", "clip.yaml")
        check = self.run_program("check", model)
        self.assertIn("body 1 with itself", check.stdout)
        self.assertIn("all.1-1", check.stdout)
        done = self.run_program("run", model, "-o", self.path("clip"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("clip/history.csv")) as file:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
        for row in rows:
            self.assertAlmostEqual(row["low.rfy"], -row["up.rfy"], delta=1e-6)
        closed, opened = rows[10], rows[-1]
        self.assertGreater(closed["all.normal_force"], 1)
        self.assertAlmostEqual(closed["all.normal_force"], closed["low.rfy"], delta=0.02 * closed["low.rfy"])
        self.assertEqual(opened["all.normal_force"], 0)
        self.assertAlmostEqual(opened["low.rfy"], 0, delta=1e-6)

    def test_a_disc_is_thrown_on_a_beam_and_bounces(self):
        model = os.path.join(SOURCE, "examples", "thrown_disc", "thrown_disc.yaml")
        done = self.run_program("run", model, "-o", self.path("disc"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("disc/history.csv")) as file:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
        kinetic = 0.5 * 3 * (6 ** 2 + 8 ** 2) + 0.5 * (0.5 * 3 * 2 ** 2) * 20 ** 2
        self.assertAlmostEqual(rows[0]["energy.kinetic"], kinetic, delta=1e-9)
        self.assertAlmostEqual(rows[-1]["elapsed"], 1.2, delta=1e-12)
        for before, after in zip(rows, rows[1:]):  # what friction takes does not come back
            self.assertLessEqual(after["disc.wz"], before["disc.wz"] + 1e-9)
            self.assertGreaterEqual(after["energy.friction"], before["energy.friction"])
        lowest = min(range(len(rows)), key=lambda i: rows[i]["disc.uy"])
        self.assertLess(rows[lowest]["disc.uy"], -2.5)
        self.assertGreater(rows[-1]["disc.uy"], 0.5)
        self.assertEqual(rows[-1]["hit.normal_force"], 0)

    def test_small_strains_of_a_strip_that_turns_are_told_of(self):
        strip = """osculate: 1
mesh: {generate: {s: {box: {x: [0, 10], y: [0, 1], elements: [20, 2]}}}}
materials: {m: {linear_elastic: {E: 1000, nu: 0.3}}}
sections: [{on: s, material: m, element: plane_strain}]
rigid: {grip: {set: s.right, reference: [10, 0.5]}}
steps: [{name: s, increments: 10, prescribe: [{on: s.left, ux: 0, uy: 0}, {on: grip, rz: ANGLE}]}]
"""
        for angle, told in (("0.05", False), ("1.5", True)):
            done = self.run_program("run", self.model(strip.replace("ANGLE", angle)))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual("section 's' is computed with small strains, but has strains" in done.stderr, told)

    def test_a_soft_block_tumbles_down_a_slope(self):
        model = os.path.join(SOURCE, "examples", "tumbling_block", "tumbling_block.yaml")
        done = self.run_program("run", model, "-o", self.path("block"))
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("block/history.csv")) as file:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
        mass = 4 * 2
        self.assertAlmostEqual(rows[0]["energy.kinetic"], 0.5 * mass * (4 ** 2 + 6 ** 2), delta=1e-9)
        for row in rows:  # above the slope, but for what the penalty lets in
            self.assertGreater(0.45 * (2 + row["block.top_right.ux"]) + 3.4 + row["block.top_right.uy"], -0.1)
        for before, after in zip(rows, rows[1:]):
            self.assertGreaterEqual(after["energy.friction"], before["energy.friction"])
            self.assertGreaterEqual(after["energy.damping"], before["energy.damping"])
        impacts = sum(a["hit.normal_force"] == 0 < b["hit.normal_force"] for a, b in zip(rows, rows[1:]))
        self.assertGreater(impacts, 3)
        with open(self.path("block/log.txt")) as file:
            self.assertIn("time steps of", file.read())

    def test_the_examples_are_valid(self):
        examples = os.path.join(SOURCE, "examples")
        found = [os.path.join(folder, name) for folder, _, names in os.walk(examples)
                 for name in names if name.endswith(".yaml")]
        self.assertTrue(found)
        for example in found:
            with open(example) as file:
                text = "\n" + file.read()
            if "\nosculate: 1\n" not in text:
                continue  # a surface
            if "library: metal.so" in text or "library: laws.so" in text:
                continue  # has to be compiled first: test_user_material.py, test_user_laws.py
            done = self.run_program("check", example)
            self.assertEqual(done.returncode, 0, example + done.stderr)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
