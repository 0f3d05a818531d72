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


def deck(size):
    """The same as an Abaqus deck: elements BLOCK, surfaces Bottom and Top, nodes LEFT."""
    tag = lambda i, j: 10 * (5 * j + i + 1)
    nodes = [f"{tag(i, j)}, {size * i}, {size * j}" for j in range(3) for i in range(5)]
    cells = [f"{4 * j + i + 1}, {tag(i, j)}, {tag(i + 1, j)}, {tag(i + 1, j + 1)}, {tag(i, j + 1)}"
             for j in range(2) for i in range(4)]
    return "\n".join(
        ["*Heading", "block, size", "*Node", *nodes, "*Element, type=CPE4, elset=BLOCK", *cells,
         "*Surface, name=Bottom, type=ELEMENT", "LOWER, S1", "*Surface, name=Top", "5, S3", "6, S3", "7, s3", "8, S3",
         "*Elset, elset=lower, generate", "1, 4, 1", "*Nset, nset=LEFT", "10, 60", "110",
         "*Material, name=none", "*Step", "*Static", "*End Step", ""])


# Two bricks on each other: of the deck, and generated.
BRICKS = """osculate: 1
mesh: MESH
materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}
sections:
  - {on: LOW, material: m, element: solid}
  - {on: HIGH, material: m, element: solid}
contact: [{name: between, master: ROOF, slave: FLOOR, normal: {penalty: 1e4}, friction: {coulomb: {mu: 0.3, penalty: 1e3}}}]
steps:
  - name: press
    increments: 2
    prescribe:
      - {on: BASE, ux: 0, uy: 0, uz: 0}
      - {on: LID, ux: 0.01, uy: 0, uz: -0.05}
output: {history: [{on: between, of: normal_force}, {on: between, of: shear_force}, {on: LID, of: rfz}]}
"""
OF_DECK = dict(LOW="Low.Body", HIGH="high.body", ROOF="roof", FLOOR="Floor", BASE="low.base", LID="HIGH.LID",
               MESH="assembly.inp")
BOX = "box: {x: [0, 1], y: [0, 1], z: %s, elements: [2, 2, 2]}"
GENERATED = dict(LOW="low", HIGH="high", ROOF="low.top", FLOOR="high.bottom", BASE="low.bottom", LID="high.top",
                 MESH="{generate: {low: {%s}, high: {%s}}}" % (BOX % "[0, 1]", BOX % "[1, 2]"))


def assembly():
    """One part of 2 x 2 x 2 cells, twice."""
    tag = lambda i, j, k: 9 * k + 3 * j + i + 1
    two, three = range(2), range(3)
    nodes = [f"{tag(i, j, k)}, {i / 2}, {j / 2}, {k / 2}" for k in three for j in three for i in three]
    cells = [", ".join(map(str, [4 * k + 2 * j + i + 1] + [
        tag(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]))
             for k in two for j in two for i in two]
    return "\n".join(
        ["*Part, name=Cube", "*Node", *nodes, "*Element, type=C3D8, elset=Body", *cells, "*Nset, nset=Base, generate",
         "1, 9, 1", "*Nset, nset=Lid, generate", "19, 27, 1", "*End Part", "*Assembly, name=Both",
         "*Instance, name=Low, part=Cube", "*End Instance", "*Instance, name=High, part=Cube", "0., 0., 1.",
         "*End Instance", "*Elset, elset=_Roof_S2, internal, instance=Low, generate", "5, 8, 1",
         "*Elset, elset=_Floor_S1, internal, instance=High, generate", "1, 4, 1",
         "*Surface, type=ELEMENT, name=Roof", "_Roof_S2, S2", "*Surface, type=ELEMENT, name=Floor", "_Floor_S1, S1",
         "*End Assembly", ""])


def filled(names):
    text = BRICKS
    for name, value in names.items():
        text = text.replace(name, value)
    return text


class Meshes(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        for name, text in (("block.msh", block(1)), ("metres.msh", block(0.001)), ("m.yaml", STACK),
                           ("block.inp", deck(1)), ("metres.inp", deck(0.001)),
                           ("d.yaml", STACK.replace(".msh", ".inp")), ("assembly.inp", assembly()),
                           ("assembly.yaml", filled(OF_DECK)), ("boxes.yaml", filled(GENERATED))):
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

    def last_row(self, model):
        done = self.run_program("run", model + ".yaml")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(os.path.join(self.folder, model + ".results", "history.csv")) as file:
            return {key: float(value) for key, value in list(csv.DictReader(file))[-1].items() if "." in key}

    def test_two_files_and_a_part_run_in_contact(self):
        row = self.last_row("m")
        self.assertGreater(row["between.normal_force"], 0.1)
        self.assertAlmostEqual(row["under.normal_force"] / row["between.normal_force"], 1, delta=0.02)
        self.assertAlmostEqual(-row["high.bottom.rfy"] / row["between.normal_force"], 1, delta=1e-4)

    def test_decks_give_the_numbers_of_gmsh_files(self):
        expected, found = self.last_row("m"), self.last_row("d")
        self.assertEqual(expected.keys(), found.keys())
        for key, value in expected.items():
            self.assertAlmostEqual(found[key] / value, 1, delta=1e-9, msg=key)

    def test_instances_give_the_numbers_of_generated_boxes(self):
        expected, found = self.last_row("boxes"), self.last_row("assembly")
        self.assertGreater(expected["between.normal_force"], 0.1)
        for key, value in expected.items():
            own = key.replace("high.top", "HIGH.LID")
            self.assertAlmostEqual(found[own] / value if value else found[own] + 1, 1, delta=1e-7, msg=key)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
