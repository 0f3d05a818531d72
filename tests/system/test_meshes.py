"""A model of several mesh files and generated parts. Usage: test_meshes.py PROGRAM"""
import csv
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]

# Two blocks 4 x 2 on each other, the upper one of a file in metres and upside down, on a disc that is generated.
STACK = """osculate: 1
mesh:
  files:
    low: block.msh
    high: {file: metres.msh, scale: 1000, angle: 180, about: [2, 1], move: [0, 2]}
  generate:
    wheel: {disc: {radius: 3, angle: [0, 180], elements: [8, 4], center: [2, -3]}}
materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}
sections:
  - {on: low, material: m, element: plane_strain}
  - {on: high, material: m, element: plane_strain}
  - {on: wheel, material: m, element: plane_strain}
contact:
  - {name: under, master: low.bottom, slave: wheel.outer}
  - {name: between, master: low.top, slave: high.top}
steps:
  - name: press
    increments: 1
    prescribe:
      - {on: [wheel.from, wheel.to], ux: 0, uy: 0}
      - {on: [low.left], ux: 0}
      - {on: high.bottom, ux: 0, uy: -0.05}
output: {history: [{on: between, of: normal_force}, {on: under, of: normal_force}, {on: high.bottom, of: rfy}]}
"""


def block(size):
    """MSH 2.2 of 4 x 2 in unit cells, times size; nodes are numbered by tens."""
    tag = lambda i, j: 10 * (5 * j + i + 1)
    nodes = [f"{tag(i, j)} {size * i} {size * j} 0" for j in range(3) for i in range(5)]
    cells = [f"1 2 {group} {group} {tag(i, j)} {tag(i + 1, j)}" for group, j in ((2, 0), (3, 2)) for i in range(4)]
    cells += [f"1 2 4 4 {tag(0, j)} {tag(0, j + 1)}" for j in range(2)]
    cells += [f"3 2 1 1 {tag(i, j)} {tag(i + 1, j)} {tag(i + 1, j + 1)} {tag(i, j + 1)}"
              for j in range(2) for i in range(4)]
    names = ['2 1 "block"', '1 2 "bottom"', '1 3 "top"', '1 4 "left"']
    return "\n".join(
        ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))] + names +
        ["$EndPhysicalNames", "$Nodes", str(len(nodes))] + nodes + ["$EndNodes", "$Elements", str(len(cells))] +
        [f"{k + 1} {cell}" for k, cell in enumerate(cells)] + ["$EndElements", ""])


class Meshes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for name, text in (("block.msh", block(1)), ("metres.msh", block(0.001)), ("m.yaml", STACK)):
            with open(os.path.join(self.folder, name), "w") as file:
                file.write(text)

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True)

    def test_check_lists_the_sets_under_the_names_of_their_files(self):
        found = json.loads(self.run_program("check", "m.yaml", "--json").stdout)
        sets = {entry["name"]: (entry["kind"], entry["cells"]) for entry in found["sets"]}
        self.assertEqual(sets["low"], ("areas", 8))
        self.assertEqual(sets["low.block"], ("areas", 8))
        self.assertEqual(sets["high.bottom"], ("lines", 4))
        self.assertEqual(sets["wheel.outer"], ("lines", 32))
        self.assertEqual(found["size"]["high"], [5, 4])

    def test_two_files_and_a_part_run_in_contact(self):
        done = self.run_program("run", "m.yaml")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(os.path.join(self.folder, "m.results", "history.csv")) as file:
            row = {key: float(value) for key, value in list(csv.DictReader(file))[-1].items() if "." in key}
        self.assertGreater(row["between.normal_force"], 0.1)
        self.assertAlmostEqual(row["under.normal_force"] / row["between.normal_force"], 1, delta=0.02)
        self.assertAlmostEqual(-row["high.bottom.rfy"] / row["between.normal_force"], 1, delta=1e-4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
