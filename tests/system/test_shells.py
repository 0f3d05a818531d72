"""Shells and beams of decks against closed solutions. Usage: test_shells.py PROGRAM"""
import csv
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
YOUNG, LENGTH, FORCE = 2.0e5, 10.0, 1.0


def material():
    """Without lateral strain, so that plates are beams."""
    return ["*MATERIAL, NAME=M", "*ELASTIC", f"{YOUNG}, 0."]


def line(places, kind):
    """Nodes 1, 2, ... at places and elements of two or three of them."""
    step = 2 if kind.startswith("B32") else 1
    rows = ["*NODE, NSET=N", *(f"{i + 1}, " + ", ".join(f"{c:.12g}" for c in x) for i, x in enumerate(places))]
    rows.append(f"*ELEMENT, TYPE={kind}, ELSET=E")
    for e in range((len(places) - 1) // step):
        rows.append(f"{e + 1}, " + ", ".join(str(step * e + k + 1) for k in range(step + 1)))
    return rows


def beam(kind, elements, load):
    """Along x, its section 0.4 along y times 0.3 along z, clamped at node 1."""
    count = elements * (2 if kind.startswith("B32") else 1)
    rows = line([(LENGTH * i / count, 0, 0) for i in range(count + 1)], kind) + material()
    rows += ["*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT", "0.4, 0.3", "0, 1, 0",
             "*BOUNDARY", "1, 1, 6", "*STEP", "*STATIC", "*CLOAD", f"{count + 1}, {load}", "*END STEP", ""]
    return "\n".join(rows), count + 1


def plate(kind, elements, section="0.2"):
    """Along x, 1 wide and thin along z, clamped at x = 0; the force is shared out over the end."""
    second = kind in ("S6", "S8", "S8R")
    n = 2 * elements if second else elements
    wide = 2 if second else 1
    tag = lambda i, j: 10 * i + j + 1
    rows = ["*NODE"]
    for i in range(n + 1):
        rows += [f"{tag(i, j)}, {LENGTH * i / n:.12g}, {j / wide:.12g}, 0" for j in range(wide + 1)]
    rows.append(f"*ELEMENT, TYPE={kind}, ELSET=E")
    step = 2 if second else 1
    for e in range(elements):
        a, b, c, d = tag(step * e, 0), tag(step * e + step, 0), tag(step * e + step, wide), tag(step * e, wide)
        ab, bc, cd, da, mid = a + 10, b + 1, d + 10, a + 1, a + 11
        rows += {"S3": [f"{2 * e + 1}, {a}, {b}, {c}", f"{2 * e + 2}, {a}, {c}, {d}"],
                 "S4": [f"{e + 1}, {a}, {b}, {c}, {d}"],
                 "S6": [f"{2 * e + 1}, {a}, {b}, {c}, {ab}, {bc}, {mid}",
                        f"{2 * e + 2}, {a}, {c}, {d}, {mid}, {cd}, {da}"],
                 "S8R": [f"{e + 1}, {a}, {b}, {c}, {d}, {ab}, {bc}, {cd}, {da}"]}[kind]
    ends = range(wide + 1)
    weights = [1 / 6, 2 / 3, 1 / 6] if second else [1 / 2, 1 / 2]
    rows += ["*NSET, NSET=CLAMP", *(f"{tag(0, j)}," for j in ends), *material(),
             "*SHELL SECTION, ELSET=E, MATERIAL=M", section, "*BOUNDARY", "CLAMP, 1, 6", "*STEP", "*STATIC", "*CLOAD",
             *(f"{tag(n, j)}, 3, {FORCE * weights[j]:.15g}" for j in ends), "*END STEP", ""]
    return "\n".join(rows), tag(n, 0)


class Shells(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def said(self, deck):
        with open(os.path.join(self.folder, "a.inp"), "w", encoding="utf-8") as file:
            file.write(deck)
        done = subprocess.run([PROGRAM, "run", "a.inp"], cwd=self.folder, capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout + done.stderr

    def test_knots_hold_nodes_together(self):
        """Corners of frames have nodes at one place, which is no flaw."""
        for step in ("*STEP", "*STEP, NLGEOM"):
            rows = line([(0, 0, 0), (1, 0, 0), (2, 0, 0), (2, 1, 0), (2, 2, 0)], "B32R") + material()
            rows += ["*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT", "0.1, 0.1", "0, 0, 1", "*BOUNDARY", "1, 1, 6",
                     step, "*STATIC", "*CLOAD", "5, 3, 1.E-6", "*END STEP", ""]
            said = self.said("\n".join(rows))
            self.assertNotIn("at the same place", said)
            self.assertNotIn("warning", said)

    def test_triangles_that_lock_say_so(self):
        """Long S3 are sheared as they bend, S6 are not."""
        self.assertIn("S6 in place of S3", self.said(plate("S3", 2)[0]))
        self.assertNotIn("they lock", self.said(plate("S6", 2)[0]))

    def test_rows_of_reduced_integration_have_an_answer(self):
        """A row of S8R, and of B32R with rectangles, in few iterations."""
        for deck in (plate("S8R", 10)[0], beam("B32R", 20, "2, 1.")[0], beam("B32R", 4, "4, 1.")[0]):
            self.assertNotIn("halving", self.said(deck))

    def displacement(self, deck, node, component):
        """Of a node that the deck loads."""
        with open(os.path.join(self.folder, "a.inp"), "w") as file:
            file.write(deck)
        subprocess.run([PROGRAM, "convert", "a.inp", "-o", "a.yaml"], cwd=self.folder, check=True, capture_output=True)
        with open(os.path.join(self.folder, "a.yaml"), "a") as file:
            file.write(f"output: {{history: [{{on: {node}, of: {component}, name: it}}]}}\n")
        done = subprocess.run([PROGRAM, "run", "a.yaml"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open(os.path.join(self.folder, "a.results", "history.csv")) as file:
            return float(list(csv.DictReader(file))[-1]["it"])

    def bent(self, width, height):
        """Timoshenko's cantilever, Poisson's ratio 0."""
        inertia, area = width * height**3 / 12, width * height
        return FORCE * LENGTH**3 / (3 * YOUNG * inertia) + FORCE * LENGTH / (5 / 6 * YOUNG / 2 * area)

    def check(self, errors, last):
        for before, after in zip(errors, errors[1:]):
            self.assertLess(after, before + 1e-9)  # S8R has the cubic deflection itself, whatever their number
        self.assertLess(errors[-1], last)

    def test_cantilever_beams(self):
        for kind, counts, last in (("B31", (4, 8, 16), 0.004), ("B32R", (1, 2, 4), 0.002)):
            for direction, exact in ((2, self.bent(0.3, 0.4)), (3, self.bent(0.4, 0.3))):
                with self.subTest(kind=kind, direction=direction):
                    errors = []
                    for n in counts:
                        deck, end = beam(kind, n, f"{direction}, {FORCE}")
                        u = self.displacement(deck, f"node {end}", "u" + "xyz"[direction - 1])
                        errors.append(abs(u / exact - 1))
                    self.check(errors, last)

    def test_moments_at_the_end_of_a_beam(self):
        for direction, along, sign, inertia in ((5, "uz", -1, 0.4 * 0.3**3 / 12), (6, "uy", 1, 0.3 * 0.4**3 / 12)):
            deck, end = beam("B32", 2, f"{direction}, {FORCE}")
            turn = FORCE * LENGTH / (YOUNG * inertia)
            component = "u" + "xyz"[direction - 4]
            # the corners, where the moment's forces act and whose mean is meant, turn more than the section
            self.assertAlmostEqual(self.displacement(deck, f"rotations of node {end}", component) / turn, 1, delta=0.003)
            deck += "** its deflection\n"
            self.assertAlmostEqual(self.displacement(deck.replace("*CLOAD", f"*CLOAD\n{end}, 1, 0."), f"node {end}",
                                                     along) / (sign * turn * LENGTH / 2), 1, delta=1e-3)

    def test_cantilever_plates(self):
        exact = self.bent(1.0, 0.2)
        for kind, counts, last in (("S4", (4, 8, 16), 0.004), ("S6", (4, 8), 0.01), ("S8R", (1, 2, 4), 0.002)):
            with self.subTest(kind=kind):
                errors = []
                for n in counts:
                    deck, end = plate(kind, n)
                    errors.append(abs(self.displacement(deck, f"node {end}", "uz") / exact - 1))
                self.check(errors, last)

    def test_an_elbow_of_beams_is_stiff(self):
        leg, size, n = 5.0, 0.1, 4
        places = [(leg * i / (2 * n), 0, 0) for i in range(2 * n + 1)]
        places += [(leg, leg * i / (2 * n), 0) for i in range(1, 2 * n + 1)]
        end = len(places)
        rows = line(places, "B32") + material()
        rows += ["*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT", f"{size}, {size}", "0, 0, 1",
                 "*BOUNDARY", "1, 1, 6", "*STEP", "*STATIC", "*CLOAD", f"{end}, 1, 1.E-3", "*END STEP", ""]
        bending = YOUNG * size**4 / 12
        exact = 1e-3 * (leg**3 / 3 + leg**3) / bending  # the second leg bends, the first one turns it
        self.assertAlmostEqual(self.displacement("\n".join(rows), f"node {end}", "ux") / exact, 1, delta=0.02)

    def test_trusses_carry_no_moment(self):
        rows = line([(0, 0, 0), (3, 0, 4), (6, 0, 0)], "T3D2") + material()
        rows += ["*SOLID SECTION, ELSET=E, MATERIAL=M", "0.01", "*BOUNDARY", "1, 1, 3", "3, 1, 3", "2, 2", "*STEP",
                 "*STATIC", "*CLOAD", "2, 3, 1.", "*END STEP", ""]
        exact = 5 / (2 * YOUNG * 0.01 * 0.8**2)
        self.assertAlmostEqual(self.displacement("\n".join(rows), "node 2", "uz") / exact, 1, delta=1e-9)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
