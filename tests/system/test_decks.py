"""Decks of Abaqus and CalculiX as they are. Usage: test_decks.py PROGRAM"""
import csv
import gzip
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from test_answers import read_dat, read_frd, read_vtu

PROGRAM = sys.argv[1]
ROOT = pathlib.Path(__file__).resolve().parents[2]
CALCULIX = pathlib.Path("/usr/share/doc/calculix-ccx-test/examples/test")
YOUNG, POISSON, PRESSURE = 100.0, 0.3, 1.0


def deck(cells):
    """A column 1 x 2 of two bodies in plane strain, cells along its width, pressed on its top."""
    lines = ["*HEADING", "a column", "*NODE"]
    tag = lambda body, i, j: 1000 * (body + 1) + 100 * j + i + 1
    corners = lambda body: [(i, j) for j in range(2) for i in range(cells + 1)]
    for body in range(2):
        lines += [f"{tag(body, i, j)}, {i / cells}, {body + j}" for i, j in corners(body)]
    for body, name in enumerate(("LOW", "HIGH")):
        lines.append(f"*ELEMENT, TYPE=CPE4, ELSET={name}")
        lines += [f"{100 * body + i + 1}, {tag(body, i, 0)}, {tag(body, i + 1, 0)}, {tag(body, i + 1, 1)}, "
                  f"{tag(body, i, 1)}" for i in range(cells)]
    lines += ["*NSET, NSET=BASE", *(f"{tag(0, i, 0)}," for i in range(cells + 1)),
              "*NSET, NSET=SIDE", *(f"{tag(body, 0, j)}," for body in range(2) for j in range(2)),
              "*SURFACE, NAME=ROOF", "LOW, S3", "*SURFACE, NAME=FLOOR", "HIGH, S1",
              "*MATERIAL, NAME=RUBBER", "*ELASTIC", f"{YOUNG}, {POISSON}",
              "*SOLID SECTION, ELSET=LOW, MATERIAL=RUBBER", "1.,", "*SOLID SECTION, ELSET=HIGH, MATERIAL=RUBBER",
              "*SURFACE INTERACTION, NAME=SI", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", "1.E6",
              "*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE", "FLOOR, ROOF",
              "*BOUNDARY", "BASE, 2", "SIDE, 1",
              "*STEP", "*STATIC", "1., 1.", "*RESTART, WRITE", "*DLOAD", f"HIGH, P3, {PRESSURE}", "*NODE PRINT, NSET=BASE", "RF",
              "*END STEP", ""]
    return "\n".join(lines)


class Decks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("column.inp", deck(3))

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w") as file:
            file.write(text)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True)

    def test_a_deck_runs(self):
        done = self.run_program("run", "column.inp", "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["status"], "done")
        self.assertTrue(os.path.exists(os.path.join(self.folder, "column.results", "report.html")))
        said = self.run_program("check", "column.inp").stdout
        self.assertIn("of 'column.inp' these are left out: *RESTART", said)

    def test_the_model_file_of_a_deck_has_the_closed_solution(self):
        done = self.run_program("convert", "column.inp", "-o", "column.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(os.path.join(self.folder, "column.yaml")) as file:
            model = file.read()
        self.assertIn("\noutput:\n", model)
        self.write("column.yaml", model.replace(
            "\noutput:\n", "\noutput:\n  history: [{on: P3 of HIGH, of: uy}, {on: BASE, of: rfy}]\n"))
        done = self.run_program("run", "column.yaml")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(os.path.join(self.folder, "column.results", "history.csv")) as file:
            row = list(csv.DictReader(file))[-1]
        sunk = 2 * PRESSURE * (1 - POISSON**2) / YOUNG + PRESSURE / 1e6
        self.assertAlmostEqual(float(row["P3 of HIGH.uy"]), -sunk, delta=1e-12)
        self.assertAlmostEqual(float(row["BASE.rfy"]), PRESSURE, delta=1e-11)

    def test_what_is_not_understood_is_bad_input(self):
        for right, wrong in (("*STATIC", "*COMPLEXFREQUENCY"), ("SIDE, 1", "SIED, 1")):
            self.write("broken.inp", deck(1).replace(right, wrong))
            done = self.run_program("run", "broken.inp")
            self.assertEqual(done.returncode, 2)
            self.assertIn("broken.inp:", done.stderr)
            self.assertIn(wrong.split(",")[0], done.stderr)
            self.assertFalse(os.path.exists(os.path.join(self.folder, "broken.results")))

    def last_fields(self, model, folder):
        done = self.run_program("run", str(model), "-o", folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return read_vtu(sorted(pathlib.Path(self.folder, folder).glob("bodies_*.vtu"))[-1])

    def test_a_model_file_becomes_a_deck_with_the_same_results(self):
        """Contact, finite plastic strain with the load taken back, temperatures, kinematic hardening, second order, expansion by directions,
        viscoelastic, rubber that relaxes."""
        for model in ("contact_patch/matching", "plastic_bar/stretch", "plastic_bar/cycle_space", "plastic_cylinder/cylinder",
                      "temperature/bimetal", "plastic_bar/heated", "temperature/tube", "viscoelastic/bar",
                      "relaxation/shear"):
            with self.subTest(model):
                source = ROOT / "verification" / f"{model}.yaml"
                name = model.replace("/", "_")
                done = self.run_program("convert", str(source), "-o", f"{name}.inp")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("(solver, output) are left out", done.stderr)
                ours, again = self.last_fields(source, f"{name}.ours"), self.last_fields(f"{name}.inp", f"{name}.again")
                for field in ("U", "S", "RF"):
                    largest = max(abs(v) for row in ours[field].values() for v in row)
                    self.assertGreater(largest, 0)
                    self.assertEqual(ours[field].keys(), again[field].keys())
                    for node, row in ours[field].items():
                        for a, b in zip(row, again[field][node], strict=True):
                            self.assertLess(abs(a - b), 1e-9 * largest)

    def calculix_deck(self, name):
        """A deck of CalculiX' own tests, in the folder of the test."""
        source = CALCULIX / f"{name}.inp"
        text = source.read_text() if source.exists() else gzip.open(f"{source}.gz", "rt", errors="replace").read()
        self.write(f"{name}.inp", text)

    @unittest.skipUnless(CALCULIX.is_dir(), "CalculiX' decks are not installed")
    def test_a_deck_written_anew_has_the_same_answers(self):
        """Axes, equations, MPCs, rigid bodies, gravity, plastic and hyperelastic bodies, contact, inertia, vibrations, buckling; shells, beams
        and trusses, layers, hollow sections, knots, temperatures across shells; pretension, stresses at first."""
        for name in ("achteld", "aniso", "axial", "beam8b", "beam8f", "beamd", "beamdelay", "beamdy1", "beamdy8", "beamhf",
                     "beamimpdy1", "beamnldyp", "beamnlmpc", "beampfix", "beampiso", "beampkin", "beamrb", "fricloop", "mpcforce",
                     "segmentf", "b31", "beammr", "beamfsh1", "boxprofile", "contact10", "edgeload", "pret1", "resstress1", "rot4",
                     "segmentbeam", "shell1", "shell3", "shellnor", "simplebeampipe1", "solidshell2", "swing", "truss"):
            with self.subTest(name):
                self.calculix_deck(name)
                done = self.run_program("convert", f"{name}.inp", "-o", f"{name}_anew.inp")
                self.assertEqual(done.returncode, 0, done.stderr)
                found = []
                for deck_file in (name, f"{name}_anew"):
                    self.assertEqual(self.run_program("run", f"{deck_file}.inp", "-o", deck_file).returncode, 0)
                    files = sorted(path for pattern in ("bodies_*.vtu", "modes_*.vtu", "buckling_*.vtu", "modes_*.csv", "buckling_*.csv")
                                   for path in pathlib.Path(self.folder, deck_file).glob(pattern))
                    self.assertGreater(len(files), 0)
                    found.append(files)
                self.assertEqual([path.name for path in found[0]], [path.name for path in found[1]])
                for ours, again in zip(*found):
                    if ours.suffix == ".csv":
                        rows, others = (list(csv.reader(path.read_text().splitlines())) for path in (ours, again))
                        largest = max(abs(float(row[1])) for row in rows[1:])  # beside rigid motions of frequency 0
                        for row, other in zip(rows[1:], others[1:], strict=True):
                            size = abs(float(row[1]))
                            limit = 1e-9 * size if size > 1e-6 * largest else 1e-6 * largest
                            self.assertLessEqual(abs(float(row[1]) - float(other[1])), limit)
                    elif ours.name.startswith("bodies"):
                        before, after = read_vtu(ours)["U"], read_vtu(again)["U"]
                        largest = max(abs(v) for row in before.values() for v in row)
                        for node, row in before.items():
                            for a, b in zip(row, after[node], strict=True):
                                self.assertLessEqual(abs(a - b), 1e-10 * largest)

    @unittest.skipUnless(shutil.which("ccx") and CALCULIX.is_dir(), "CalculiX is not installed")
    def test_calculix_runs_a_deck_written_anew(self):
        """Its answers are those to its own deck."""
        for name in ("aniso", "beamd", "beamhf", "beamnlmpc", "beampfix", "beamrb", "pret2", "rot1", "solidshell1"):
            with self.subTest(name):
                self.calculix_deck(name)
                done = self.run_program("convert", f"{name}.inp", "-o", f"{name}_anew.inp")
                self.assertEqual(done.returncode, 0, done.stderr)
                found = []
                for job in (name, f"{name}_anew"):
                    done = subprocess.run(["ccx", "-i", job], cwd=self.folder, capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, done.stdout)
                    found.append({key: rows for key, rows in read_dat(os.path.join(self.folder, f"{job}.dat")).items()
                                  if key[0].startswith("displacements")})
                self.assertEqual(found[0].keys(), found[1].keys())
                self.assertGreater(sum(map(len, found[0].values())), 0)
                for key, rows in found[0].items():
                    largest = max(abs(v) for row in rows for v in row[1:])
                    others = {row[0]: row[1:] for row in found[1][key]}
                    for row in rows:
                        for a, b in zip(row[1:], others[row[0]], strict=True):
                            self.assertLess(abs(a - b), 1e-4 * largest)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_calculix_reads_such_a_deck(self):
        for model, tolerance in (("plastic_bar/stretch", 1e-5), ("temperature/brick", 1e-5)):
            with self.subTest(model):
                source = ROOT / "verification" / f"{model}.yaml"
                self.assertEqual(self.run_program("convert", str(source), "-o", "job.inp").returncode, 0)
                self.assertEqual(subprocess.run(["ccx", "-i", "job"], cwd=self.folder, capture_output=True).returncode, 0)
                theirs, inside = {}, False
                for line in pathlib.Path(self.folder, "job.frd").read_text().splitlines():
                    inside = line.startswith(" -4  DISP") or (inside and not line.startswith(" -3"))
                    if inside and line.startswith(" -1"):
                        theirs[int(line[3:13])] = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(2)]
                ours = self.last_fields(source, f"{source.stem}.ours")["U"]
                largest = max(abs(v) for row in ours.values() for v in row)
                common = [node for node in ours if node in theirs]
                self.assertGreater(len(common), 7)
                for node in common:
                    for a, b in zip(ours[node][:2], theirs[node]):
                        self.assertLess(abs(a - b), tolerance * largest)

    def test_what_a_deck_cannot_say_is_named_with_its_line(self):
        text = (ROOT / "verification/temperature/brick.yaml").read_text()
        self.write("brick.yaml", text + "rigid: {floor: {plane: {point: [0, 0, -9], normal: [0, 0, 1]}}}\n")
        done = self.run_program("convert", "brick.yaml", "-o", "brick.inp")
        self.assertEqual(done.returncode, 2)
        self.assertIn(f"brick.yaml:{len(text.splitlines()) + 1}: rigid.floor.plane", done.stderr)
        self.assertIn("has no counterpart", done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "brick.inp")))

    def test_convert_writes_over_no_deck(self):
        self.assertEqual(self.run_program("convert", "column.inp", "-o", "column.inp").returncode, 2)
        self.assertEqual(self.run_program("convert", "column.yaml").returncode, 2)

    def test_plane_elements_beside_solids_have_a_model_file_with_the_same_results(self):
        for name, kinds in (("lame_and_block", {1, 10}), ("stress_shared", {4, 10}), ("all_kinds", {1, 7, 8, 9, 10})):
            with self.subTest(name):
                shutil.copy(ROOT / "tests" / "decks" / "own" / f"{name}.inp", self.folder)
                done = self.run_program("convert", f"{name}.inp", "-o", f"{name}.yaml")
                self.assertEqual(done.returncode, 0, done.stderr)
                done = self.run_program("convert", f"{name}.yaml", "-o", f"{name}_anew.inp")
                self.assertEqual(done.returncode, 0, done.stderr)
                blocks = []
                for source in (f"{name}.inp", f"{name}.yaml", f"{name}_anew.inp"):
                    done = self.run_program("run", source, "-o", f"{source}.results")
                    self.assertEqual(done.returncode, 0, done.stderr)
                    _, elements, values = read_frd(os.path.join(self.folder, f"{source}.results", f"{source.split('.')[0]}.frd"))
                    self.assertEqual({kind for kind, _ in elements.values()}, kinds)
                    blocks.append(values)
                self.assertEqual(*blocks[:2])
                for ours, again in zip(blocks[0], blocks[2], strict=True):
                    self.assertEqual(ours["name"], again["name"])
                    largest = max(abs(v) for row in ours["values"].values() for v in row)
                    for node, row in ours["values"].items():
                        for a, b in zip(row, again["values"][node], strict=True):
                            self.assertLessEqual(abs(a - b), 1e-5 * largest)  # six digits

    def test_a_restart_goes_on_from_the_deck_before(self):
        done = self.run_program("ccx", "-i", "column")
        self.assertEqual(done.returncode, 0, done.stdout)
        os.rename(os.path.join(self.folder, "column.rout"), os.path.join(self.folder, "next.rin"))
        more = "*STEP\n*STATIC\n1., 1.\n*DLOAD\nHIGH, P3, 2.\n*NODE PRINT, NSET=BASE\nRF\n*END STEP\n"
        self.write("next.inp", "*RESTART, READ, STEP=1\n" + more)
        self.write("whole.inp", deck(3) + more)
        for job in ("next", "whole"):
            done = self.run_program("ccx", "-i", job)
            self.assertEqual(done.returncode, 0, done.stdout)
        read = lambda name: pathlib.Path(self.folder, name).read_text()
        self.assertEqual(read("next.dat"), read("whole.dat"))
        self.assertIn("time  0.2000000E+01", read("next.dat"))
        held = "*BOUNDARY\n1004, 1, 1, 0.01\n"  # before the next step, as in it
        for before, within in ((held, ""), ("", held)):
            self.write("next.inp", "*RESTART, READ, STEP=1\n" + before + more.replace("*DLOAD", within + "*DLOAD"))
            done = self.run_program("ccx", "-i", "next")
            self.assertEqual(done.returncode, 0, done.stdout)
            os.rename(os.path.join(self.folder, "next.dat"), os.path.join(self.folder, f"{len(before)}.dat"))
        self.assertEqual(read("0.dat"), read(f"{len(held)}.dat"))
        self.assertNotEqual(read("0.dat"), read("whole.dat"))
        self.write("next.inp", "*RESTART, READ, STEP=2\n" + more)
        self.assertIn("there are 1 steps to go on from, not 2", self.run_program("ccx", "-i", "next").stdout)
        self.write("next.rin", "not text")
        self.assertIn("is no file that `osculate ccx` has written", self.run_program("ccx", "-i", "next").stdout)

    def test_a_deck_may_ask_for_no_analysis(self):
        text = deck(3).replace("*STATIC\n1., 1.", "*NO ANALYSIS")
        self.assertIn("*RESTART, WRITE", text)
        self.write("column.inp", text)
        done = self.run_program("run", "column.inp")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("*NO ANALYSIS: the deck is read and checked, nothing is solved", done.stdout + done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "column.results")))
        self.assertEqual(self.run_program("ccx", "-i", "column").returncode, 0)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "column.rout")))

    def test_the_bolted_joint_of_the_tutorial(self):
        """The bolt keeps its 10 kN while the flanges press on each other, and takes all once they have parted."""
        joint = pathlib.Path(__file__).resolve().parents[2] / "examples/bolted_joint/joint.inp"
        text = joint.read_text()
        for pull, expected, within in ((600, 9995.1, 1), (2000, 20000, 0.1)):
            self.write("joint.inp", text.replace(", 3, 600\n", f", 3, {pull}\n").replace(", 3, 300\n", f", 3, {pull / 2}\n"))
            done = self.run_program("ccx", "-i", "joint")
            self.assertEqual(done.returncode, 0, done.stderr)
            lines = (pathlib.Path(self.folder) / "joint.dat").read_text().splitlines()
            rows = [line.split() for line in lines if line.split()[:1] == ["760"]]
            self.assertEqual(len(rows), 4)
            self.assertAlmostEqual(float(rows[-1][1]), expected, delta=within)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
