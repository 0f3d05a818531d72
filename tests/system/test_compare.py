"""osculate compare: two result folders beside each other. Usage: test_compare.py PROGRAM"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
MODEL = """osculate: 1
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [4, 2]}}}}
materials: {s: {linear_elastic: {E: 1.0e4, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
rigid: {floor: {line: {point: [0, 0], normal: [0, 1]}}}
contact: [{name: c, master: floor, slave: block.bottom, normal: {penalty: 1.0e6}, friction: {coulomb: {mu: 0.3, penalty: 1.0e6}}}]
steps: [{name: press, increments: INCREMENTS, prescribe: [{on: block.top, ux: 0, uy: DOWN}]}]
output: {fields: 1, history: [{on: c, of: normal_force}, {on: block.top, of: COLUMN}]}
"""


def run(folder, name, down="-0.01", increments=2, column="rfy", more="}\n"):
    path = os.path.join(folder, name + ".yaml")
    with open(path, "w") as file:
        file.write(MODEL.replace("DOWN", down).replace("INCREMENTS", str(increments)).replace("COLUMN", column).replace("]}\n", "]" + more))
    subprocess.run([PROGRAM, "run", path, "--quiet", "-o", os.path.join(folder, name + ".results")], check=True, capture_output=True)
    return os.path.join(folder, name + ".results")


def compare(*arguments):
    return subprocess.run([PROGRAM, "compare", *arguments], capture_output=True, text=True)


def table(output):
    """Quantity: difference, largest, relative, as the program has printed them."""
    rows = {}
    for line in output.split("\n")[2:]:
        cells = re.match(r"(.{32,}?) +(\S+) +(\S+) +(\S+)(?:  \S+)?$", line)
        if cells and re.match(r"[-0-9.inf]", cells[2]):
            rows[cells[1].strip()] = [float(cells[k]) for k in (2, 3, 4)]
    return rows


class Compare(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        cls.a = run(cls.folder, "a")
        cls.b = run(cls.folder, "b", down="-0.011")
        cls.finer = run(cls.folder, "finer", increments=4)
        cls.other = run(cls.folder, "other", column="uy")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_a_run_is_itself(self):
        result = compare(self.a, self.a, "--tolerance", "0")
        self.assertEqual(result.returncode, 0)
        rows = table(result.stdout)
        self.assertIn("c.normal_force", rows)
        self.assertIn("bodies S", rows)
        self.assertIn("c CPRESS", rows)
        self.assertTrue(all(row[0] == 0 for row in rows.values()), rows)
        self.assertTrue(result.stdout.startswith("3 increments in both\n"))

    def test_another_load_is_told_by_its_share(self):
        result = compare(self.a, self.b)
        self.assertEqual(result.returncode, 0)
        rows = table(result.stdout)
        for quantity in ("c.normal_force", "bodies U", "bodies S", "block.top.rfy"):
            self.assertAlmostEqual(rows[quantity][2], 0.1 / 1.1, delta=0.002, msg=quantity)
        self.assertAlmostEqual(rows["bodies U"][0], 0.001, delta=1e-5)
        self.assertAlmostEqual(rows["bodies U"][1], 0.011, delta=1e-5)
        self.assertEqual(compare(self.a, self.b, "--tolerance", "0.2").returncode, 0)
        self.assertEqual(compare(self.a, self.b, "--tolerance", "0.05").returncode, 1)

    def test_increments_are_those_of_the_same_time(self):
        result = compare(self.a, self.finer, "--tolerance", "1e-6")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("3 increments in both", result.stdout)
        self.assertIn(f"only {self.finer} has 2 further increments", result.stdout)

    def test_what_only_one_has_is_told(self):
        output = compare(self.a, self.other).stdout
        self.assertIn(f"only {self.a} has the columns block.top.rfy", output)
        self.assertIn(f"only {self.other} has the columns block.top.uy", output)

    def test_what_one_lacks_is_no_agreement(self):
        self.assertEqual(compare(self.a, self.other, "--tolerance", "1e300").returncode, 1)

        def with_lines(name, keep):
            damaged = os.path.join(self.folder, "lacks.results")
            shutil.rmtree(damaged, ignore_errors=True)
            shutil.copytree(self.a, damaged)
            path = os.path.join(damaged, name)
            with open(path) as file:
                lines = file.read().split("\n")
            with open(path, "w") as file:
                file.write("\n".join(line for line in lines if keep(line)))
            for pair in ((self.a, damaged), (damaged, self.a)):
                result = compare(*pair, "--tolerance", "1e300")
                self.assertEqual(result.returncode, 1, result.stdout)
                yield result.stdout

        for output in with_lines("results.pvd", lambda line: "contact0" not in line):
            self.assertIn(f"only {self.a} has the results c", output)
        for output in with_lines("results.pvd", lambda line: "DataSet" not in line):
            self.assertIn(f"only {self.a} has the results ", output)
        for output in with_lines("history.csv", lambda line: not line.startswith("1,2,")):
            self.assertIn(f"only {self.a} goes on after time 0.5", output)

    def test_a_missing_number_is_no_agreement(self):
        damaged = os.path.join(self.folder, "damaged.results")
        shutil.copytree(self.a, damaged)
        path = os.path.join(damaged, "history.csv")
        with open(path) as file:
            lines = file.read().split("\n")
        lines[2] = re.sub(r",[^,]*$", ",nan", lines[2])
        with open(path, "w") as file:
            file.write("\n".join(lines))
        self.assertEqual(compare(self.a, damaged, "--tolerance", "1e300").returncode, 1)
        fields = os.path.join(damaged, "bodies_00001.vtu")
        with open(fields, "rb") as file:
            os.truncate(fields, file.read().find(b"<AppendedData") + 100)
        result = compare(self.a, damaged)
        self.assertEqual(result.returncode, 2)
        self.assertIn("bodies_00001.vtu", result.stderr)

    def test_what_is_no_result_is_bad_input(self):
        result = compare(self.a, self.folder)
        self.assertEqual(result.returncode, 2)
        self.assertIn("history.csv", result.stderr)
        self.assertEqual(compare(self.a, self.b, "--tolerance", "-1").returncode, 2)


class ResultFilesOfCalculiX(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        files = ", frd: [{of: [U, S]}]}\n"
        cls.a = run(cls.folder, "a", more=files)
        cls.b = run(cls.folder, "b", down="-0.011", more=files)
        cls.finer = run(cls.folder, "finer", increments=4, more=files)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def file(self, name):
        return os.path.join(self.folder, name + ".results", name + ".frd")

    def changed(self, old, new):
        with open(self.file("a")) as file:
            text = file.read()
        self.assertIn(old, text)
        path = os.path.join(self.folder, f"changed{len(os.listdir(self.folder))}.frd")
        with open(path, "w") as file:
            file.write(text.replace(old, new))
        return path

    def test_files_and_folders_with_one(self):
        for pair in ((self.file("a"), self.file("a")), (self.a, self.file("a")), (self.file("a"), self.a)):
            result = compare(*pair, "--tolerance", "0")
            self.assertEqual(result.returncode, 0, result.stdout)
            self.assertEqual({name: row[0] for name, row in table(result.stdout).items()}, {"DISP": 0, "STRESS": 0})

    def test_another_load_is_told_by_its_share(self):
        result = compare(self.a, self.file("b"))
        self.assertEqual(result.returncode, 0)
        self.assertTrue(result.stdout.startswith("2 increments in both\n"), result.stdout)
        for name, row in table(result.stdout).items():
            self.assertAlmostEqual(row[2], 0.1 / 1.1, delta=0.002, msg=name)
        self.assertAlmostEqual(table(result.stdout)["DISP"][0], 0.001, delta=1e-7)
        self.assertEqual(compare(self.a, self.file("b"), "--tolerance", "0.2").returncode, 0)
        self.assertEqual(compare(self.a, self.file("b"), "--tolerance", "0.05").returncode, 1)

    def test_times_are_those_of_both(self):
        result = compare(self.a, self.file("finer"), "--tolerance", "1e-4")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertIn("2 increments in both", result.stdout)
        self.assertIn(f"only {self.file('finer')} has 2 further times", result.stdout)

    def test_what_one_lacks_is_no_agreement(self):
        for path, says in ((self.changed(" -4  STRESS ", " -4  STRAIN "), "has the results STRESS"),
                           (self.changed("1.000000000", "2.000000000"), "has 1 further times"),
                           (self.changed(" -1         1 0.00000E+00", " -1         1 1.00000E+00"), "1 nodes of")):
            for pair in ((self.file("a"), path), (path, self.file("a"))):
                result = compare(*pair, "--tolerance", "1e300")
                self.assertEqual(result.returncode, 1, result.stdout)
                self.assertIn(says, result.stdout)

    def test_contact_is_compared_by_quantities_of_one_unit(self):
        """A gap that differs by all it has is not hidden behind the pressures of the same rows."""
        row = "\n -4  CONTACT     6    1\n" + "".join(f" -5  {name:<8}    1    4    1    1\n" for name in (
            "COPEN", "CSLIP1", "CSLIP2", "CPRESS", "CSHEAR1", "CSHEAR2"))
        paths = []
        for number, values in enumerate(([1e-3, 0, 2e-3, 400, 30, 40], [2e-3, 0, 2e-3, 400, 30, 44])):
            path = os.path.join(self.folder, f"contact{number}.frd")
            with open(self.file("a")) as file:
                text = file.read()
            head = re.findall(r"\n  100CL.*", text)[-1]
            block = head + row + " -1" + f"{1:10d}" + "".join(f"{value:12.5E}" for value in values) + "\n -3"
            with open(path, "w") as file:
                file.write(text.replace("\n 9999", block + "\n 9999"))
            paths.append(path)
        rows = table(compare(*paths).stdout)
        self.assertEqual({name: row[0] for name, row in rows.items()},
                         {"DISP": 0, "STRESS": 0, "CONTACT COPEN": 1e-3, "CONTACT CSLIP": 0, "CONTACT CPRESS": 0, "CONTACT CSHEAR": 4})
        self.assertAlmostEqual(rows["CONTACT COPEN"][2], 0.5)

    def test_what_cannot_be_read_is_bad_input(self):
        empty = os.path.join(self.folder, "empty")
        os.makedirs(empty, exist_ok=True)
        self.assertIn("has not one .frd file", compare(self.file("a"), empty).stderr)
        path = self.changed(" -4  STRESS ", " -4")
        with open(path, "rb") as file:
            os.truncate(path, file.read().rfind(b" -3"))
        result = compare(self.file("a"), path)
        self.assertEqual(result.returncode, 2)
        self.assertIn("ends within a block", result.stderr)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_beside_ccx(self):
        deck = """*NODE, NSET=ALL
1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1
*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=M\n*ELASTIC\n1000, 0.3\n*SOLID SECTION, ELSET=E, MATERIAL=M
*BOUNDARY\n1, 1, 3\n2, 2, 3\n3, 3\n4, 1\n4, 3
*STEP\n*STATIC\n*CLOAD\n5, 3, 1\n6, 3, 1\n7, 3, 1\n8, 3, 3\n*NODE FILE\nU\n*EL FILE\nS\n*END STEP
"""
        for name, command in (("theirs", ["ccx"]), ("ours", [PROGRAM, "ccx"])):
            with open(os.path.join(self.folder, name + ".inp"), "w") as file:
                file.write(deck)
            subprocess.run([*command, "-i", name], cwd=self.folder, check=True, capture_output=True)
        result = compare(os.path.join(self.folder, "theirs.frd"), os.path.join(self.folder, "ours.frd"), "--tolerance", "3e-5")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(set(table(result.stdout)), {"DISP", "STRESS"})
        self.assertGreater(table(result.stdout)["DISP"][1], 1e-3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
