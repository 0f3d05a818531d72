"""osculate init: a model file to begin with, for a mesh. Usage: test_init.py PROGRAM SOURCE_DIR"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], sys.argv[2]
CLIP = os.path.join(SOURCE, "examples", "clip", "clip.msh")
JOINT = os.path.join(SOURCE, "examples", "bolted_joint", "joint.inp")
DATA = os.path.join(SOURCE, "tests", "unit", "io", "data")


class Init(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True, text=True)

    def start(self, mesh, *arguments):
        done = self.program("init", mesh, "-o", "model.yaml", *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with open(self.path("model.yaml")) as file:
            return file.read()

    def check(self, name="model.yaml"):
        done = self.program("check", name)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_what_it_writes_is_accepted(self):
        for mesh in [CLIP, JOINT] + [os.path.join(DATA, name) for name in (
                "blocks_22.msh", "blocks_41_binary.msh", "partitioned_41.msh", "parametric_41.msh",
                "solids_1_22.msh", "solids_2_41.msh", "solids_3_41_binary.msh")]:
            with self.subTest(mesh=mesh):
                self.start(mesh, "--force")
                self.check()

    def test_the_examples_in_its_comments_are_accepted_too(self):
        for mesh in (CLIP, JOINT, os.path.join(DATA, "blocks_41.msh")):
            with self.subTest(mesh=mesh):
                text = self.start(mesh, "--force")
                more = re.sub(r"^( +)#(?=[-a-z])", r"\1", text, flags=re.M)
                self.assertGreater(len(text) - len(more), 2)
                with open(self.path("more.yaml"), "w") as file:
                    file.write(more)
                self.assertIn("pressure" if mesh == CLIP else "body_force", self.check("more.yaml"))

    def test_it_runs_and_the_flanges_and_the_bolt_touch(self):
        text = self.start(JOINT)
        pairs = re.findall(r"^  - \{name: pair_\d, master: (\w+), slave: (\w+)", text, re.M)
        self.assertEqual({frozenset(pair) for pair in pairs},
                         {frozenset(pair) for pair in (("UPPER_TOP", "HEAD"), ("LOWER_BOTTOM", "NUT"),
                                                       ("UPPER_BOTTOM", "LOWER_TOP"))})
        self.assertEqual(re.findall(r"on: (\w+), material", text), ["BOLT", "LOWER", "UPPER"])
        self.assertRegex(text, r"#   HEAD +10 areas +x -8 to 8, y 0 to 8, z 10 to 10\n")
        done = self.program("run", "model.yaml", "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_surfaces_that_meet_at_an_edge_do_not_touch(self):
        """Half models: the plane of symmetry of either block ends at the edge where the other one stands."""
        blocks = {"low": (0, 3, 0, 1), "up": (1, 2, 1.01, 2)}
        nodes, cells = [], []
        for tag, (x0, x1, z0, z1) in enumerate(blocks.values()):
            corner = [len(nodes) + k for k in range(1, 9)]
            nodes += [(x, y, z) for z in (z0, z1) for x, y in ((x0, 0), (x1, 0), (x1, 1), (x0, 1))]
            for group, kind, picked in ((1, 5, range(8)), (3, 3, (0, 1, 2, 3)), (5, 3, (4, 5, 6, 7)), (7, 3, (0, 1, 5, 4))):
                cells.append((kind, group + tag, [corner[k] for k in picked]))
        names = [(3, "low"), (3, "up"), (2, "low_bottom"), (2, "up_bottom"), (2, "low_top"), (2, "up_top"), (2, "low_half"), (2, "up_half")]
        with open(self.path("halves.msh"), "w") as file:
            print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(names), sep="\n", file=file)
            for number, (dimension, name) in enumerate(names, 1):
                print(dimension, number, f'"{name}"', file=file)
            print("$EndPhysicalNames\n$Nodes", len(nodes), sep="\n", file=file)
            for number, x in enumerate(nodes, 1):
                print(number, *x, file=file)
            print("$EndNodes\n$Elements", len(cells), sep="\n", file=file)
            for number, (kind, group, its) in enumerate(cells, 1):
                print(number, kind, 2, group, group, *its, file=file)
            print("$EndElements", file=file)
        text = self.start(self.path("halves.msh"))
        pairs = re.findall(r"^  - \{name: pair_\d, master: (\w+), slave: (\w+)", text, re.M)
        self.assertEqual(pairs, [("low_top", "up_bottom")])
        self.assertIn("doubtful: their normals are not opposite", text)

    def test_glued_bodies_empty_groups_and_the_way_of_loads_are_told_of(self):
        """Two cubes, one on the other, with the nodes between them in common, and a group of cells that were not meshed."""
        nodes = [(x, y, z) for z in range(3) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
        names = [(3, "low"), (3, "up"), (2, "bottom"), (2, "top"), (3, "missing")]
        cells = [(5, 1, range(1, 9)), (5, 2, range(5, 13)), (3, 3, (1, 4, 3, 2)), (3, 4, (9, 10, 11, 12))]
        with open(self.path("glued.msh"), "w") as file:
            print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames", len(names), sep="\n", file=file)
            for number, (dimension, name) in enumerate(names, 1):
                print(dimension, number, f'"{name}"', file=file)
            print("$EndPhysicalNames\n$Nodes", len(nodes), sep="\n", file=file)
            for number, x in enumerate(nodes, 1):
                print(number, *x, file=file)
            print("$EndNodes\n$Elements", len(cells), sep="\n", file=file)
            for number, (kind, group, its) in enumerate(cells, 1):
                print(number, kind, 2, group, group, *its, file=file)
            print("$EndElements", file=file)
        text = self.start(self.path("glued.msh"))
        self.assertIn("# low and up share 4 nodes: they hold together there.", text)
        self.assertRegex(text, r"#   missing +0 volumes +EMPTY: the mesh has nothing of it\n")
        self.assertIn("      - {on: bottom, ux: 0, uy: 0, uz: 0}\n      #- {on: top, uz: -0.002}\n", text)
        self.assertIn("#total_force: [{on: top, fx: 1}]", text)

    def test_a_file_that_is_there_stays_as_it_is(self):
        shutil.copy(CLIP, self.path("clip.msh"))
        self.assertEqual(self.program("init", "clip.msh").stdout, "wrote clip.yaml\n")
        with open(self.path("clip.yaml"), "w") as file:
            file.write("mine")
        done = self.program("init", "clip.msh")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'clip.yaml' is there already", done.stderr)
        with open(self.path("clip.yaml")) as file:
            self.assertEqual(file.read(), "mine")
        self.assertEqual(self.program("init", "clip.msh", "--force").returncode, 0)
        self.assertIn("the model file is valid", self.check("clip.yaml"))
        self.assertEqual(self.program("init", "clip.msh", "-o", "clip.msh", "--force").returncode, 2)

    def test_the_mesh_is_found_from_the_folder_of_the_model(self):
        os.makedirs(self.path("a/meshes"))
        shutil.copy(CLIP, self.path("a/meshes/clip.msh"))
        done = self.program("init", "a/meshes/clip.msh", "-o", "a/model.yaml")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("a/model.yaml")) as file:
            self.assertIn("mesh: meshes/clip.msh\n", file.read().replace('"', ""))
        self.check("a/model.yaml")

    def test_a_mistake_of_the_mesh_is_said_beside_the_file(self):
        done = self.program("init", os.path.join(DATA, "mixed_2_22.msh"), "-o", "model.yaml")
        self.assertEqual(done.returncode, 1)
        self.assertIn("does not accept it yet: model.yaml:", done.stderr)
        self.assertIn("negative or zero volume", done.stderr)
        self.assertTrue(os.path.exists(self.path("model.yaml")))

    def test_a_mesh_without_bodies_is_refused(self):
        with open(self.path("tool.stl"), "w") as file:
            file.write("solid tool\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 1\n"
                       "endloop\nendfacet\nendsolid tool\n")
        done = self.program("init", "tool.stl")
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("can be a rigid body", done.stderr)
        self.assertFalse(os.path.exists(self.path("tool.yaml")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
