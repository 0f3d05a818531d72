"""Materials that are routines of shared libraries. Usage: test_user_material.py PROGRAM SOURCE_FOLDER"""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
EXAMPLES = SOURCE / "examples" / "user_material"

BRICK = """*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
*ELEMENT, TYPE=C3D8, ELSET=E
1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=ABAQUS_1
*USER MATERIAL, CONSTANTS=2
200., 0.3
*SOLID SECTION, ELSET=E, MATERIAL=ABAQUS_1
*BOUNDARY
1, 1, 3
4, 1
5, 1, 2
8, 1
2, 2
2, 3
6, 2
3, 3
4, 3
*STEP
*STATIC
1., 1.
*CLOAD
5, 3, 0.5
6, 3, 0.5
7, 3, 0.5
8, 3, 0.5
*NODE PRINT, NSET=TOP
U
*END STEP
""".replace("*MATERIAL", "*NSET, NSET=TOP\n7,\n*MATERIAL", 1)


class UserMaterials(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
        cls.compile("metal.so", EXAMPLES / "metal.c")
        shutil.copy(EXAMPLES / "bar.yaml", cls.folder)

    @classmethod
    def compile(cls, name, source):
        subprocess.run([cls.compiler, "-shared", "-fPIC", "-O2", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I",
                        SOURCE / "include", "-o", cls.folder / name, source, "-lm"], check=True)

    def run_program(self, *arguments, library=None):
        environment = {k: v for k, v in os.environ.items() if k != "OSCULATE_USER_MATERIAL"}
        if library:
            environment["OSCULATE_USER_MATERIAL"] = str(library)
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True, env=environment)

    def last_force(self, model):
        with open(self.folder / (model + ".results") / "history.csv") as file:
            return float(list(csv.reader(file))[-1][-1])

    def test_an_example_runs_and_equals_the_built_in_metal(self):
        text = (EXAMPLES / "bar.yaml").read_text()
        user = "user: {library: metal.so, name: steel, constants: [200, 0.3, 1, 20], state: 7}"
        self.assertIn(user, text)
        (self.folder / "built_in.yaml").write_text(
            text.replace(user, "elastoplastic: {E: 200, nu: 0.3, yield: 1, isotropic: 20}"))
        for model in ("bar", "built_in"):
            done = self.run_program("run", model + ".yaml")
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(self.last_force("bar"), self.last_force("built_in"), delta=1e-12)
        self.assertLess(self.last_force("bar"), -1.5)
        fields = b"".join(path.read_bytes() for path in (self.folder / "bar.results").rglob("*.vtu"))
        self.assertIn(b'"SDV7"', fields)
        self.assertNotIn(b'"SDV8"', fields)

    def test_threads_do_not_meet_in_a_routine(self):
        (self.folder / "counts.c").write_text("""
#include <osculate/user_material.h>
osculate_user_material umat_;
static int inside;
""" + (EXAMPLES / "metal.c").read_text().replace("osculate_user_material umat_;", "").replace(
            "  double elastic[6]", "  volatile int turns;\n  double elastic[6]").replace(
            "  for (i = 0; i < *ntens; ++i)\n    elastic", """  if (inside++) pnewdt[0] = 0.01;
  for (turns = 0; turns < 2000; ++turns) continue;
  for (i = 0; i < *ntens; ++i)
    elastic""", 1).replace("  *sse = ", "  --inside;\n  *sse = ", 1))
        self.compile("counts.so", self.folder / "counts.c")
        text = (self.folder / "bar.yaml").read_text().replace("metal.so", "counts.so")
        (self.folder / "counts.yaml").write_text(text.replace("elements: [1, 1, 2]", "elements: [4, 4, 8]"))
        # The same routine for many materials.
        bars = range(16)
        user = "{user: {library: counts.so, name: steel, constants: [200, 0.3, 1, 20], state: 7}}"
        box = "box: {{x: [{}, {}], y: [0, 1], z: [0, 2], elements: [2, 2, 2], type: hex8}}"
        (self.folder / "many.yaml").write_text("\n".join([
            "osculate: 1", "mesh: {generate: {" + ", ".join(f"b{i}: {{{box.format(2 * i, 2 * i + 1)}}}" for i in bars) + "}}",
            "materials: {" + ", ".join(f"m{i}: {user}" for i in bars) + "}",
            "sections: [" + ", ".join(f"{{on: b{i}, material: m{i}, element: solid}}" for i in bars) + "]",
            "sets: {" + ", ".join(f"{side}: {{union: [{', '.join(f'b{i}.{side}' for i in bars)}]}}"
                                  for side in ("bottom", "left", "front", "top")) + "}",
            text[text.index("steps:"):text.index("output:")].replace("on: b.", "on: ")]))
        for model in ("counts", "many"):
            with self.subTest(model=model):
                done = self.run_program("run", model + ".yaml", "--threads", "2", "--json")
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual([len(step["increments"]) for step in json.loads(done.stdout)["steps"]], [4, 8])

    def test_a_routine_that_has_no_answer_ends_the_run_with_its_reason(self):
        source = (EXAMPLES / "metal.c").read_text()
        for change, said in (("*pnewdt = 0.5;", "it asked for a shorter increment, PNEWDT = 0.5"),
                             ("ddsdde[0] = 0.0 / 0.0;", "it returned NaN or infinity (it has 4 constants and 7 state")):
            (self.folder / "wrong.c").write_text(source.replace(
                "  *sse = ", "  if (dstran[2] != 0 && time[0] > 0.4) " + change + "\n  *sse = ", 1))
            self.compile("wrong.so", self.folder / "wrong.c")
            (self.folder / "wrong.yaml").write_text(
                (self.folder / "bar.yaml").read_text().replace("metal.so", "wrong.so"))
            done = self.run_program("run", "wrong.yaml")
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(said, done.stdout + done.stderr)
            self.assertNotIn("Traceback", done.stderr)

    def test_a_library_that_is_none_is_refused(self):
        text = (self.folder / "bar.yaml").read_text()
        (self.folder / "text.so").write_text("no library")
        for old, new, said in (("metal.so", "nowhere.so", "steel.user.library: there is no file './nowhere.so'"),
                               ("metal.so", "text.so", "steel.user.library: cannot be loaded: "),
                               ("name: steel", "function: usermat", "steel.user.function: the library has no function 'usermat'"),
                               ("[200, 0.3, 1, 20]", "[200]", "umat_ has no answer for the unloaded material"),
                               ("duration: 1,", "", "needs the duration of every step")):
            (self.folder / "refused.yaml").write_text(text.replace(old, new))
            done = self.run_program("check", "refused.yaml")
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(said, done.stderr)

    def test_a_run_goes_on_from_its_checkpoint(self):
        text = (self.folder / "bar.yaml").read_text()
        (self.folder / "parts.yaml").write_text(text.replace("output: {", "output: {checkpoint: 1, "))
        (self.folder / "whole.yaml").write_text(text)
        for arguments in (("whole.yaml",), ("parts.yaml", "--until", "pull"), ("parts.yaml", "--restart")):
            done = self.run_program("run", *arguments)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(self.last_force("parts"), self.last_force("whole"), delta=1e-14)

    def test_a_routine_is_told_the_temperature(self):
        (self.folder / "warm.c").write_text((EXAMPLES / "metal.c").read_text().replace(
            "const double young = props[0]", "const double young = props[0] * (1 - 0.001 * (*temp + *dtemp))").replace(
            "  for (i = 0; i < *ntens; ++i)\n    elastic", """  if (*dtime > 1e-9 && fabs(*temp - 20 - statev[0]) > 1e-9) *pnewdt = 0.1;
  if (*dtime > 1e-9) statev[0] += *dtemp;
  for (i = 0; i < *ntens; ++i)
    elastic""", 1))
        self.compile("warm.so", self.folder / "warm.c")
        (self.folder / "warm.yaml").write_text("""osculate: 1
mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [1, 1, 1], type: hex8}}}}
materials: {m: {user: {library: warm.so, constants: [200, 0], state: 1}}}
sections: [{on: b, material: m, element: solid}]
initial_temperature: [{on: b, value: 20}]
steps:
  - {name: heat, increments: 2, duration: 1, temperature: [{on: b, value: 220}],
     prescribe: [{on: b.bottom, uz: 0}, {on: b.left, ux: 0}, {on: b.front, uy: 0}, {on: b.top, uz: 0.01}]}
  - {name: cool, increments: 4, duration: 1, temperature: [{on: b, value: 120}]}
output: {history: [{on: b.top, of: rfz}]}
""")
        done = self.run_program("run", "warm.yaml", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual([len(step["increments"]) for step in json.loads(done.stdout)["steps"]], [2, 4])
        self.assertAlmostEqual(self.last_force("warm"), 0.01 * 200 * (1 - 0.12), delta=1e-12)

    def deck_displacement(self):
        path = next((self.folder / "brick.results").glob("*.dat"))
        return float(path.read_text().split()[-1])

    def test_a_deck_takes_the_library_of_the_environment(self):
        (self.folder / "brick.inp").write_text(BRICK)
        done = self.run_program("run", "brick.inp")
        self.assertEqual(done.returncode, 2)
        self.assertIn("brick.inp:15: *USERMATERIAL: its routine is in a shared library: name that in the environment "
                      "variable OSCULATE_USER_MATERIAL", done.stderr)
        done = self.run_program("run", "brick.inp", library="metal.so")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(self.deck_displacement(), 2 / 200, places=9)
        self.assertEqual(self.run_program("convert", "brick.inp", "-o", "brick.yaml", library="metal.so").returncode, 0)
        done = self.run_program("check", "brick.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)

    @unittest.skipUnless(shutil.which("gfortran"), "no gfortran")
    def test_a_routine_in_fortran_runs_as_it_is(self):
        subprocess.run(["gfortran", "-shared", "-fPIC", "-O2", "-o", self.folder / "elastic.so", EXAMPLES / "elastic.f"],
                       check=True)
        (self.folder / "brick.inp").write_text(BRICK)
        done = self.run_program("run", "brick.inp", library=self.folder / "elastic.so")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(self.deck_displacement(), 2 / 200, places=9)


if __name__ == "__main__":
    if not (shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")):
        print("no C compiler")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
