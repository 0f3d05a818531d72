"""Results in the files of CalculiX. Usage: test_answers.py PROGRAM

Compares with ccx itself, and reads with cgx and FreeCAD, where they are installed."""
import glob
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

PROGRAM = sys.argv[1]


# ---- readers that know nothing of the writers ----------------------------------------------------------------


def read_frd(path):
    """Nodes, elements (type, nodes) and blocks (name, step, increment, time, values by node)."""
    nodes, elements, blocks, part, block = {}, {}, [], None, None
    for line in pathlib.Path(path).read_text().splitlines(keepends=True):
        line = line.rstrip("\n")
        if line.startswith("    2C"):
            part, expected = "nodes", int(line[6:36])
        elif line.startswith("    3C"):
            assert len(nodes) == expected
            part, expected = "elements", int(line[6:36])
        elif line.startswith("    1PSTEP"):
            numbers = [int(line[36 + 12 * k:48 + 12 * k]) for k in range(2)]
        elif line.startswith("  100C"):
            part, block = "values", {"time": float(line[12:24]), "increment": numbers[0], "step": numbers[1], "values": {}}
        elif line.startswith(" -4"):
            block["name"], block["components"] = line[5:13].strip(), []
            blocks.append(block)
        elif line.startswith(" -5") and line[33:].strip() != "0    1ALL":
            block["components"].append(line[5:13].strip())
        elif line.startswith(" -1") and part == "elements":
            element = int(line[3:13])
            elements[element] = (int(line[13:18]), [])
        elif line.startswith(" -2"):
            elements[element][1].extend(int(line[3 + 10 * k:13 + 10 * k]) for k in range(len(line[3:]) // 10))
        elif line.startswith(" -1"):
            values = [float(line[13 + 12 * k:25 + 12 * k]) for k in range(len(line[13:]) // 12)]
            (nodes if part == "nodes" else block["values"])[int(line[3:13])] = values
    assert line == " 9999", "the end of the file is missing"
    return nodes, elements, blocks


def last(blocks, name):
    return [block for block in blocks if block["name"] == name][-1]["values"]


def read_dat(path):
    """Rows by (title, time) with all words of the title."""
    tables, rows = {}, None
    for line in pathlib.Path(path).read_text().splitlines(keepends=True):
        title = re.match(r"^ ([a-z].*?) *(?:and|for)? time +(\S+)$", line.rstrip("\n"))
        if title:
            rows = tables.setdefault((title[1], float(title[2])), [])
        elif line.strip():
            rows.append([float(word) for word in line.split()])
    return tables


def read_vtu(path):
    """Point fields by node number."""
    content = pathlib.Path(path).read_bytes()
    head = content[:content.index(b"<AppendedData")]
    start = content.index(b"_", len(head)) + 1
    fields = {}
    for m in re.finditer(rb'<DataArray type="Float64" Name="(\w+)" NumberOfComponents="(\d+)"[^>]*?offset="(\d+)"', head):
        at = start + int(m[3])
        count = struct.unpack_from("<Q", content, at)[0]
        data, place = b"", at + 24 + 8 * count
        for size in struct.unpack_from(f"<{count}Q", content, at + 24):
            data += zlib.decompress(content[place:place + size])
            place += size
        width, values = int(m[2]), struct.unpack(f"<{len(data) // 8}d", data)
        fields[m[1].decode()] = [values[k:k + width] for k in range(0, len(values), width)]
    numbers = [int(n[0]) for n in fields["NodeNumber"]]
    return {name: dict(zip(numbers, values)) for name, values in fields.items()}


# ---- decks -----------------------------------------------------------------------------------------------------


REQUESTS = """*NODE PRINT, NSET=TOP
U
*NODE PRINT, NSET=BASE, TOTALS=YES
RF
*EL PRINT, ELSET=BEAM
S, E
*EL PRINT, ELSET=BEAM, TOTALS=YES
EVOL, ELSE
*NODE FILE
U, RF
*EL FILE
S, E
"""


def middle(a, b):
    return tuple((p + q) / 2 for p, q in zip(a, b))


def places(kind, k):
    """Nodes of the cells of the k-th storey, by their places."""
    if kind == "C3D10":  # six tetrahedra around a diagonal
        corners = [(x, y, k + z) for z in range(2) for y in range(2) for x in range(2)]
        for path in ((1, 3), (3, 2), (2, 6), (6, 4), (4, 5), (5, 1)):
            a, b, c, d = (corners[i] for i in (0, *path, 7))
            yield [a, b, c, d, middle(a, b), middle(b, c), middle(c, a), middle(a, d), middle(b, d), middle(c, d)]
        return
    base = [(0, 0), (1, 0), (1, 1), (0, 1)] if kind == "C3D20" else [(0, 0), (1, 0), (0, 1)]
    low, high = [(*p, k) for p in base], [(*p, k + 1) for p in base]
    ring = lambda corners: [middle(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
    yield low + high + ring(low) + ring(high) + [middle(a, b) for a, b in zip(low, high)]


def bar(kind):
    """Three storeys of bricks, wedges or tetrahedra of second order, bent and sheared: C3D20, C3D15 or C3D10."""
    lines, tags = ["*HEADING", f"bent {kind}", "*NODE"], {}
    def tag(x, y, z):
        if (x, y, z) not in tags:
            tags[x, y, z] = 3 * len(tags) + 2
            lines.append(f"{tags[x, y, z]}, {x + 0.1 * z * y}, {y}, {1.5 * z}")
        return tags[x, y, z]
    cells = [[tag(*p) for p in cell] for k in range(3) for cell in places(kind, k)]
    for k, nodes in enumerate(cells):
        lines += [f"*ELEMENT, TYPE={kind}, ELSET=BEAM", f"{10 * k + 4}, " + ", ".join(map(str, nodes[:9])) + ",",
                  ", ".join(map(str, nodes[9:]))]
    for name, z in (("BASE", 0), ("TOP", 3)):
        lines += [f"*NSET, NSET={name}", *(f"{n}," for place, n in tags.items() if place[2] == z)]
    return "\n".join(lines + ["*MATERIAL, NAME=STEEL", "*ELASTIC", "2.1E5, 0.3",
                              "*SOLID SECTION, ELSET=BEAM, MATERIAL=STEEL", "*BOUNDARY", "BASE, 1, 3",
                              "*STEP", "*STATIC", "1., 1.", "*CLOAD", "TOP, 1, 3.", "TOP, 3, -7.",
                              REQUESTS.strip(), "*END STEP", ""])


BLOCKS = """*NODE, NSET=ALL
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
11, 0.1, 0.1, 1
12, 0.8, 0.1, 1
13, 0.8, 0.8, 1
14, 0.1, 0.8, 1
15, 0.1, 0.1, 2
16, 0.8, 0.1, 2
17, 0.8, 0.8, 2
18, 0.1, 0.8, 2
*ELEMENT, TYPE=C3D8, ELSET=BOTH
1, 1, 2, 3, 4, 5, 6, 7, 8
5, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=BASE, GENERATE
1, 8
*NSET, NSET=TOP
15, 16, 17, 18
*SURFACE, NAME=M
1, S2
*SURFACE, NAME=S
5, S1
*MATERIAL, NAME=STEEL
*ELASTIC
1000., 0.
*SOLID SECTION, ELSET=BOTH, MATERIAL=STEEL
*SURFACE INTERACTION, NAME=SI
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
1.E3
*CONTACT PAIR, INTERACTION=SI, TYPE=NODE TO SURFACE
S, M
*BOUNDARY
BASE, 1, 3
ALL, 1, 2
*STEP
*STATIC, DIRECT
0.5, 1.
*BOUNDARY
TOP, 3, 3, -0.4
*NODE FILE, FREQUENCY=2
U
*CONTACT FILE, FREQUENCY=2
CDIS, CSTR
*CONTACT PRINT
CDIS, CSTR
*CONTACT PRINT, TOTALS=YES
CELS, CNUM
*END STEP
"""


# A bar that is pulled until it flows.
PLASTIC = """*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 2, 0
4, 0, 2, 0
5, 0, 0, 1.5
6, 1, 0, 1.5
7, 1, 2, 1.5
8, 0, 2, 1.5
*ELEMENT, TYPE=C3D8, ELSET=E
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=BASE
1, 2, 3, 4
*NSET, NSET=TOP
5, 6, 7, 8
*MATERIAL, NAME=M
*ELASTIC
1000., 0.3
*PLASTIC
5., 0.
8., 0.1
*SOLID SECTION, ELSET=E, MATERIAL=M
*BOUNDARY
1, 1, 3
2, 2, 3
3, 3
4, 3
4, 1
*STEP
*STATIC, DIRECT
0.25, 1.
*BOUNDARY
TOP, 3, 3, 0.03
*NODE FILE
U
*EL FILE
S, PEEQ
*EL PRINT, ELSET=E
PEEQ
*EL PRINT, ELSET=E
S, E
*EL PRINT, ELSET=E, TOTALS=ONLY
ELSE
*END STEP
"""


def thin_deck():
    """Squares of 10 by 10, 8 thick, of each kind of shell, and beams of 10, clamped at x = 0 and pulled and bent at x = 10."""
    rows, plates, ends = ["*NODE, NSET=ALL"], [], []
    places = [(0, 0), (10, 0), (10, 10), (0, 10), (5, 0), (10, 5), (5, 10), (0, 5), (5, 5)]
    kinds = {"S3": [(0, 1, 2), (0, 2, 3)], "S4": [(0, 1, 2, 3)], "S6": [(0, 1, 2, 4, 5, 8), (0, 2, 3, 8, 6, 7)],
             "S8": [(0, 1, 2, 3, 4, 5, 6, 7)], "B31": [(0, 1)], "B32": [(0, 4, 1)]}
    element = 1
    for number, (kind, cells) in enumerate(kinds.items()):
        first = 10 * number + 1
        rows += [f"{first + k}, {x}, {y}, {30 * number}" for k, (x, y) in enumerate(places)
                 if any(k in cell for cell in cells)]
        plates.append(f"*ELEMENT, TYPE={kind}, ELSET={'BEAMS' if kind[0] == 'B' else 'PLATES'}")
        for cell in cells:
            plates.append(f"{element}, " + ", ".join(str(first + k) for k in cell))
            element += 1
        ends.append(first)
    held = [f"{first + k}, 1, 6" for first in ends for k in (0, 3, 7) if f"\n{first + k}, " in "\n".join(rows)]
    loads = [f"{first + 1}, {k + 1}, {force}" for first in ends for k, force in enumerate((300, 100, 20))]
    return "\n".join([*rows, *plates, "*MATERIAL, NAME=M", "*ELASTIC", "1.E4, 0.4",
                      "*SHELL SECTION, ELSET=PLATES, MATERIAL=M", "8.",
                      "*BEAM SECTION, ELSET=BEAMS, MATERIAL=M, SECTION=RECT", "6., 4.", "0., 1., 0.",
                      "*BOUNDARY", *held, "*STEP", "*STATIC", "*CLOAD", *loads,
                      "*NODE FILE, OUTPUT=2D", "U, RF", "*EL FILE", "S, E", "*END STEP", ""])


THIN = thin_deck()

# Run by FreeCAD: what its importer has made of bar.frd. It numbers nodes anew, in the
# order of their numbers.
FREECAD = """
import json
import FreeCAD
from feminout import importCcxFrdResults
document = FreeCAD.newDocument("read")
FreeCAD.ActiveDocument = document
result = importCcxFrdResults.importFrd("bar.frd")
mesh = result.Mesh.FemMesh
parts = [result.NodeStressXX, result.NodeStressYY, result.NodeStressZZ,
         result.NodeStressXY, result.NodeStressYZ, result.NodeStressXZ]
found = {"volumes": len(mesh.Volumes), "numbers": list(result.NodeNumbers),
         "place": [list(mesh.Nodes[n]) for n in sorted(mesh.Nodes)],
         "u": [list(u) for u in result.DisplacementVectors], "s": [list(s) for s in zip(*parts)],
         "mises": list(result.vonMises)}
with open("read.json", "w") as file:
    json.dump(found, file)
"""


def thin(kind):
    """Two shells or four beams along x, held at both ends, with forces on the nodes that are held and between, and a
    pressure on shells."""
    shell, second = kind[0] == "S", kind in ("S8", "B32")
    n, wide = (4 if second else 2) if shell else (8 if second else 4), (2 if second else 1) if shell else 0
    tag = {place: k + 1 for k, place in enumerate((i, j) for i in range(n + 1) for j in range(wide + 1)
                                                  if not (shell and second and i % 2 and j % 2))}
    rows = ["*NODE, NSET=N", *(f"{k}, {2 * i / n}, {j / max(wide, 1)}, 0." for (i, j), k in tag.items()),
            f"*ELEMENT, TYPE={kind}, ELSET=E"]
    step = 2 if second else 1
    for e in range(n // step):
        a, b = step * e, step * e + step
        corners = [(a, 0), (b, 0), (b, wide), (a, wide)] if shell else [(a, 0), (b, 0)]
        middles = [(a + 1, 0), (b, 1), (a + 1, wide), (a, 1)] if shell else [(a + 1, 0)]
        if not shell and second:
            corners[1:1], middles = middles, []
        rows.append(", ".join(str(k) for k in [e + 1, *(tag[p] for p in corners + (middles if second else []))]))
    held = [tag[0, j] for j in range(wide + 1)]
    tip = [tag[n, j] for j in range(wide + 1)]
    rows += ["*NSET, NSET=HELD", *(f"{k}," for k in held), "*NSET, NSET=TIP", *(f"{k}," for k in tip),
             "*MATERIAL, NAME=M", "*ELASTIC", "210000., 0.3",
             *(["*SHELL SECTION, ELSET=E, MATERIAL=M", "0.1"] if shell else
               ["*BEAM SECTION, ELSET=E, MATERIAL=M, SECTION=RECT", "0.1, 0.2", "0., 0., 1."]),
             "*BOUNDARY", "HELD, 1, 3", *([] if shell else ["HELD, 4, 4"]), "TIP, 2, 3", "*STEP", "*STATIC",
             "*CLOAD", f"{held[0]}, 1, 10.", f"{held[-1]}, 2, -7.", f"{tip[0]}, 1, 3.", f"{tip[-1]}, 3, -2.",
             f"{tag[n // 2, 0]}, 2, 0.5", *(["*DLOAD", "E, P, 0.5"] if shell else []), "*NODE PRINT, NSET=N", "RF",
             "*NODE PRINT, NSET=HELD, TOTALS=ONLY", "RF", "*NODE FILE", "U", "*END STEP", ""]
    return "\n".join(rows)


class Answers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, name, text):
        with open(self.path(name), "w") as file:
            file.write(text)

    def call(self, *command, cwd=".", **environment):
        return subprocess.run(command, cwd=self.path(cwd), capture_output=True, text=True,
                              env={**os.environ, **environment})

    def solve(self, name, text):
        self.write(f"{name}.inp", text)
        done = self.call(PROGRAM, "ccx", "-i", name)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("\n Job finished\n", done.stdout)
        self.assertEqual(done.stderr, "")

    def close(self, ours, theirs, tolerance):
        """Values by key, relative to the largest of a component's kind."""
        self.assertEqual(sorted(ours), sorted(theirs))
        largest = max(abs(v) for values in theirs.values() for v in values)
        self.assertGreater(largest, 0)
        off = max(abs(a - b) for key in theirs for a, b in zip(ours[key], theirs[key], strict=True))
        self.assertLess(off / largest, tolerance)

    def test_the_files_have_the_numbers_of_the_vtu(self):
        self.solve("bar", bar("C3D20"))
        nodes, elements, blocks = read_frd(self.path("bar.frd"))
        self.assertEqual(len(elements), 3)
        self.assertEqual([block["name"] for block in blocks], ["DISP", "STRESS", "TOSTRAIN", "FORC"])
        self.assertEqual([(b["step"], b["increment"], b["time"]) for b in blocks], 4 * [(1, 1, 1.0)])
        vtu = read_vtu(sorted(glob.glob(self.path("bar.results", "bodies_*.vtu")))[-1])
        self.close(last(blocks, "DISP"), vtu["U"], 1e-5)
        self.close(last(blocks, "STRESS"), vtu["S"], 1e-5)  # XX YY ZZ XY YZ XZ both
        self.close(last(blocks, "TOSTRAIN"), vtu["E"], 1e-5)
        tables = read_dat(self.path("bar.dat"))
        top = tables["displacements (vx,vy,vz) for set TOP", 1.0]
        self.close({int(row[0]): row[1:] for row in top}, {int(row[0]): vtu["U"][int(row[0])] for row in top}, 1e-6)
        forces = tables["forces (fx,fy,fz) for set BASE", 1.0]
        base = {int(row[0]): row[1:] for row in forces}
        self.close(base, {n: vtu["RF"][n] for n in base}, 1e-6)
        total = tables["total force (fx,fy,fz) for set BASE", 1.0][0]
        self.assertEqual([round(f, 5) for f in total], [-24, 0, 56])  # 8 nodes on top
        self.assertAlmostEqual(tables["total volume for set BEAM", 1.0][0][0], 4.5, places=5)
        self.assertEqual(len(pathlib.Path(self.path("bar.sta")).read_text().splitlines()), 3)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_as_ccx_answers(self):
        os.mkdir(self.path("ccx"))
        for kind in ("C3D20", "C3D15", "C3D10"):
            with self.subTest(kind):
                self.solve("bar", bar(kind))
                self.write(os.path.join("ccx", "bar.inp"), bar(kind))
                self.assertEqual(self.call("ccx", "-i", "bar", cwd="ccx").returncode, 0)
                ours, theirs = read_frd(self.path("bar.frd")), read_frd(self.path("ccx", "bar.frd"))
                self.assertEqual(ours[0], theirs[0])
                self.assertEqual(ours[1], theirs[1])
                # Of bricks and wedges ccx extrapolates stresses to the nodes in another way: their points tell.
                for name in ("DISP", "FORC", *(("STRESS", "TOSTRAIN") if kind == "C3D10" else ())):
                    with self.subTest(name):
                        self.close(last(ours[2], name), last(theirs[2], name), 1e-4)
                tables, expected = read_dat(self.path("bar.dat")), read_dat(self.path("ccx", "bar.dat"))
                self.assertEqual(list(tables), list(expected))
                for title, rows in expected.items():
                    with self.subTest(title):
                        self.close(dict(enumerate(tables[title])), dict(enumerate(rows)), 1e-4)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_forces_of_shells_and_beams_that_are_held_and_loaded(self):
        """Of a node the forces of the cells that it was expanded to: its reaction and all that it is loaded with."""
        os.mkdir(self.path("ccx"))
        for kind, off in (("S8", 1e-5), ("S4", 5e-3), ("B31", 1e-5), ("B32", 1e-5)):
            with self.subTest(kind):
                self.solve("thin", thin(kind))
                shutil.copy(self.path("thin.inp"), self.path("ccx"))
                self.assertEqual(self.call("ccx", "-i", "thin", cwd="ccx").returncode, 0)
                ours, theirs = (read_dat(self.path(*where, "thin.dat")) for where in ((), ("ccx",)))
                for title, rows in theirs.items():
                    self.close(dict(enumerate(ours[title])), dict(enumerate(rows)), off)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_forces_through_surfaces_as_ccx_has_them(self):
        """Of a column under the same stress everywhere, whose extrapolation in ccx is exact."""
        nodes = [f"{4 * k + n}, {x}, {y}, {1.5 * k}" for k in range(3) for n, (x, y) in
                 enumerate(((0, 0), (1, 0), (1, 2), (0, 2)), 1)]
        cells = [f"{k}, " + ", ".join(str(4 * k - 4 + n) for n in range(1, 9)) for k in (1, 2)]
        surfaces = (("CUT", "1, S2"), ("FOOT", "1, S1"), ("TIP", "2, S2"), ("SIDE", "2, S4"))
        deck = "\n".join(["*NODE", *nodes, "*ELEMENT, TYPE=C3D8, ELSET=E", *cells,
                          *(f"*SURFACE, NAME={name}\n{side}" for name, side in surfaces),
                          "*MATERIAL, NAME=M", "*ELASTIC", "1000., 0.3", "*SOLID SECTION, ELSET=E, MATERIAL=M",
                          "*BOUNDARY", "1, 1, 3", "2, 2, 3", "3, 3", "4, 3", "*STEP", "*STATIC", "*DLOAD", "2, P2, -7.",
                          *(f"*SECTION PRINT, SURFACE={name}, NAME={name}\nSOF, SOM" for name, _ in surfaces[:3]),
                          "*END STEP", ""])
        self.solve("bar", deck)
        os.mkdir(self.path("ccx"))
        shutil.copy(self.path("bar.inp"), self.path("ccx"))
        self.assertEqual(self.call("ccx", "-i", "bar", cwd="ccx").returncode, 0)
        ours, theirs = (pathlib.Path(self.path(*where, "bar.dat")).read_text() for where in ((), ("ccx",)))
        words = re.compile(r" *[-+]?\d\.\d+E[-+]\d+")
        self.assertEqual(words.sub("#", ours), words.sub("#", theirs))
        for a, b in zip(words.findall(ours), words.findall(theirs), strict=True):
            self.assertAlmostEqual(float(a), float(b), delta=1e-3)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_plastic_strains_as_ccx_has_them(self):
        """PE of the nodes and of the points, stresses, strains and the energy of a bar that flows."""
        self.solve("bar", PLASTIC)
        os.mkdir(self.path("ccx"))
        shutil.copy(self.path("bar.inp"), self.path("ccx"))
        self.assertEqual(self.call("ccx", "-i", "bar", cwd="ccx").returncode, 0)
        ours, theirs = (read_frd(self.path(*where, "bar.frd"))[2] for where in ((), ("ccx",)))
        for name in ("PE", "STRESS", "DISP"):
            with self.subTest(name):
                both = [[block for block in blocks if block["name"] == name] for blocks in (ours, theirs)]
                self.assertEqual([b["time"] for b in both[0]], [b["time"] for b in both[1]])
                self.assertEqual(both[0][-1]["components"], both[1][-1]["components"])
                for a, b in list(zip(*both, strict=True))[1:]:
                    self.close(a["values"], b["values"], 1e-4)  # as far as ccx iterates
        tables, expected = read_dat(self.path("bar.dat")), read_dat(self.path("ccx", "bar.dat"))
        expected = {(title.replace(")for set", ") for set"), time): rows for (title, time), rows in expected.items()}
        self.assertEqual(list(tables), list(expected))
        for title, rows in expected.items():
            with self.subTest(title):
                if any(v for row in rows for v in row[2:] or row):
                    self.close(dict(enumerate(tables[title])), dict(enumerate(rows)), 1e-4)

    def compare_contact(self):
        tables, expected = read_dat(self.path("blocks.dat")), read_dat(self.path("ccx", "blocks.dat"))
        self.assertEqual(list(tables), list(expected))
        for title, rows in expected.items():
            with self.subTest(title):
                self.close(dict(enumerate(tables[title])), dict(enumerate(rows)), 1e-4)
        ours = last(read_frd(self.path("blocks.frd"))[2], "CONTACT")
        theirs = last(read_frd(self.path("ccx", "blocks.frd"))[2], "CONTACT")  # slaves only
        # ccx rounds the onset of contact off, which leaves 0.014 of the 200 here
        self.close({n: ours[n] for n in theirs}, theirs, 1e-4)

    def test_contact_at_the_slaves_nodes(self):
        self.solve("blocks", BLOCKS)
        blocks = read_frd(self.path("blocks.frd"))[2]
        self.assertEqual([(b["name"], b["increment"]) for b in blocks], [("DISP", 2), ("CONTACT", 2)])
        values = last(blocks, "CONTACT")
        self.assertEqual([n for n, v in values.items() if any(v)], [11, 12, 13, 14])
        for row in (values[n] for n in (11, 12, 13, 14)):
            self.assertAlmostEqual(row[3], 200, delta=1e-3)  # springs of 1000 of contact and block in a row
            self.assertAlmostEqual(row[0], -0.2, delta=1e-6)
        if shutil.which("ccx"):
            os.mkdir(self.path("ccx"))
            shutil.copy(self.path("blocks.inp"), self.path("ccx"))
            self.assertEqual(self.call("ccx", "-i", "blocks", cwd="ccx").returncode, 0)
            self.compare_contact()

    def beside_ccx(self, name, text):
        """The tables of both."""
        self.solve(name, text)
        os.mkdir(self.path("ccx"))
        shutil.copy(self.path(f"{name}.inp"), self.path("ccx"))
        self.assertEqual(self.call("ccx", "-i", name, cwd="ccx").returncode, 0)
        return [pathlib.Path(self.path(*where, f"{name}.dat")).read_text() for where in ((), ("ccx",))]

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_shells_and_beams_are_those_of_the_deck_as_with_ccx(self):
        """OUTPUT=2D: cells, and means over thick sections, of each kind."""
        self.beside_ccx("thin", THIN)
        nodes, elements, blocks = read_frd(self.path("thin.frd"))
        places, cells, expected = read_frd(self.path("ccx", "thin.frd"))
        self.close(nodes, places, 1e-6)
        self.assertEqual(elements, cells)
        self.assertEqual(sorted(kind for kind, _ in elements.values()), [7, 7, 8, 8, 9, 10, 11, 12])
        # One element of S3 or S4 is another one there; stresses of C3D20 are extrapolated in another way.
        second = [node for node in places if node > 20]
        for name, of in (("DISP", second), ("FORC", second), ("STRESS", (*range(21, 30), 41, 42)),
                         ("TOSTRAIN", (*range(21, 30), 41, 42))):
            with self.subTest(name):
                here, there = last(blocks, name), last(expected, name)
                self.assertEqual(sorted(here), sorted(there))
                self.close({node: here[node] for node in of}, {node: there[node] for node in of}, 1e-4)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_shear_of_contact_has_the_sign_of_ccx(self):
        """Of a block that sticks while it is pushed along the other one."""
        text = BLOCKS.replace("*CONTACT PAIR", "*FRICTION\n0.5, 1.E3\n*CONTACT PAIR", 1)
        text = text.replace("ALL, 1, 2\n", "").replace("TOP, 3, 3, -0.4\n", "TOP, 3, 3, -0.4\n" + "".join(
            f"{node}, 1, 1, 0.004\n{node}, 2, 2, -0.002\n" for node in range(11, 19)))
        self.beside_ccx("blocks", text)
        tables, expected = read_dat(self.path("blocks.dat")), read_dat(self.path("ccx", "blocks.dat"))
        shears = 0
        for title, rows in expected.items():
            if title[0].startswith(("contact stress", "relative contact")):
                self.close(dict(enumerate(tables[title])), dict(enumerate(rows)), 1e-4)
                shears += sum(len(row) == 4 and abs(row[2]) > 1 for row in rows)
        self.assertGreater(shears, 0)
        ours = last(read_frd(self.path("blocks.frd"))[2], "CONTACT")
        theirs = last(read_frd(self.path("ccx", "blocks.frd"))[2], "CONTACT")
        self.close({node: ours[node] for node in theirs}, theirs, 1e-4)  # 0.02, of shears of 4

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_results_along_the_axes_of_nodes(self):
        text = bar("C3D20").replace("*BOUNDARY", "*TRANSFORM, NSET=TOP\n1., 1., 0., -1., 1., 0.\n*BOUNDARY", 1)
        text = text.replace("*NODE PRINT, NSET=TOP\nU\n",
                            "*NODE PRINT, NSET=TOP, TOTALS=YES\nU, RF\n*NODE PRINT, NSET=TOP, GLOBAL=YES\nU\n")
        ours, theirs = self.beside_ccx("bar", text)
        words = re.compile(r" *[-+]?\d\.\d+E[-+]\d+")
        rows = [[line for line in said.splitlines() if re.match(r" +\d+ .*E|.*(displ|force)", line)]
                for said in (ours, theirs)]
        self.assertEqual(*([words.sub("#", line).strip() for line in of] for of in rows))
        self.assertTrue(any(line.endswith(" L") for line in rows[0]))
        for a, b in zip(*rows):
            for x, y in zip(words.findall(a), words.findall(b), strict=True):
                self.assertAlmostEqual(float(x), float(y), delta=1e-4)

    @unittest.skipUnless(shutil.which("cgx"), "cgx is not installed")
    def test_cgx_reads_the_file(self):
        self.solve("bar", bar("C3D20"))
        self.write("read.fbd", "read bar.frd\nds 1 e 1\nds 2 e 3\nquit\n")
        said = self.call("cgx", "-bg", "read.fbd").stdout
        found = re.findall(r"(\w+) +(\w+) *\n Extremal values.*\n max:(\S+) at node:(\d+)\n min:(\S+) at node:(\d+)", said)
        self.assertEqual([one[:2] for one in found], [("DISP", "D1"), ("STRESS", "SZZ")], said)
        vtu = read_vtu(sorted(glob.glob(self.path("bar.results", "bodies_*.vtu")))[-1])
        for (_, _, most, at_most, least, at_least), (field, k) in zip(found, (("U", 0), ("S", 2))):
            for value, node, extreme in ((most, at_most, max), (least, at_least, min)):
                expected = extreme(v[k] for v in vtu[field].values())
                self.assertAlmostEqual(float(value), expected, delta=2e-5 * abs(float(most)))
                self.assertAlmostEqual(vtu[field][int(node)][k], expected, delta=2e-5 * abs(float(most)))

    @unittest.skipUnless(shutil.which("freecadcmd"), "FreeCAD is not installed")
    def test_freecad_reads_the_file(self):
        """Its importer of results, without a window: nodes, displacements and stresses."""
        self.solve("bar", bar("C3D10"))
        self.write("read.py", FREECAD)
        done = self.call("freecadcmd", "read.py", HOME=self.folder, XDG_RUNTIME_DIR=self.folder)
        self.assertTrue(os.path.exists(self.path("read.json")), done.stdout + done.stderr)
        read = json.loads(pathlib.Path(self.path("read.json")).read_text())
        nodes, elements, blocks = read_frd(self.path("bar.frd"))
        self.assertEqual(read["volumes"], len(elements))
        self.assertEqual(read["numbers"], list(range(1, len(nodes) + 1)))
        of_node = {kind: dict(zip(sorted(nodes), read[kind], strict=True)) for kind in ("place", "u", "s")}
        self.close(of_node["place"], nodes, 1e-9)
        vtu = read_vtu(sorted(glob.glob(self.path("bar.results", "bodies_*.vtu")))[-1])
        self.close(of_node["u"], vtu["U"], 1e-5)
        self.close(of_node["s"], vtu["S"], 1e-5)  # XX YY ZZ XY YZ XZ both
        self.assertGreater(max(read["mises"]), 0)

    def test_exit_codes_and_messages_are_those_of_ccx(self):
        self.assertEqual(self.call(PROGRAM, "ccx").returncode, 201)
        self.assertIn("CalculiX.exe -i jobname", self.call(PROGRAM, "ccx").stdout)
        version = self.call(PROGRAM, "ccx", "-v")
        self.assertEqual(version.returncode, 201)
        self.assertIn("This is Version 2.20", version.stdout)
        self.assertIn("Osculate", version.stdout)
        self.write("wrong.inp", BLOCKS.replace("TOP, 3, 3", "TIP, 3, 3"))
        wrong = self.call(PROGRAM, "ccx", "-i", "wrong")
        self.assertEqual(wrong.returncode, 201)
        self.assertIn("*ERROR: wrong.inp:", wrong.stdout)
        self.assertNotIn("Job finished", wrong.stdout)
        torn = BLOCKS.replace("*STATIC, DIRECT", "*STATIC").replace("-0.4\n", "-30.\n").replace("*STEP", "*STEP, NLGEOM")
        self.write("torn.inp", torn)
        torn = self.call(PROGRAM, "ccx", "torn")
        self.assertEqual(torn.returncode, 201)
        self.assertIn(" *ERROR: ", torn.stdout)
        self.assertRegex(pathlib.Path(self.path("torn.sta")).read_text(), r"(?m)^     1 +\d+ +1U +\d+ ")

    def test_a_link_of_the_name_is_called_without_a_command(self):
        os.symlink(os.path.abspath(PROGRAM), self.path("ccx"))
        self.write("blocks.inp", BLOCKS)
        done = self.call("./ccx", "-i ", "blocks", OMP_NUM_THREADS="2")  # as FreeCAD does, with a blank
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertTrue(os.path.exists(self.path("blocks.frd")))

    def test_run_puts_them_among_the_results(self):
        self.write("blocks.inp", BLOCKS)
        self.assertEqual(self.call(PROGRAM, "run", "blocks.inp", "--quiet").returncode, 0)
        self.assertEqual(len(read_frd(self.path("blocks.results", "blocks.frd"))[2]), 2)
        self.assertFalse(os.path.exists(self.path("blocks.frd")))
        self.write("blocks.inp", re.sub(r"(?s)\*NODE FILE.*(?=\*END)", "", BLOCKS))
        self.assertEqual(self.call(PROGRAM, "run", "blocks.inp", "--quiet").returncode, 0)
        self.assertFalse(os.path.exists(self.path("blocks.results", "blocks.frd")))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]])
