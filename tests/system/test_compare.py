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


def run(folder, name, down="-0.01", increments=2, column="rfy"):
    path = os.path.join(folder, name + ".yaml")
    with open(path, "w") as file:
        file.write(MODEL.replace("DOWN", down).replace("INCREMENTS", str(increments)).replace("COLUMN", column))
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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
