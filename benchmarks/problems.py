"""Contact problems as decks (Abaqus/CalculiX), which both programs read: SI units, Coulomb friction 0.3.

A problem is a function of its fineness that gives the text of a deck. Its first step presses, its second
slides; each prints the total force on the nodes GROUND after every increment.
"""
import dataclasses
import math

YOUNG, POISSON, FRICTION = 2.1e10, 0.3, 0.3


@dataclasses.dataclass
class Grid:
    """A block of cells, counts of them along the axes, at the places that a function of [0, 1]^d gives."""
    name: str
    counts: tuple
    place: object  # (s, t[, r]) -> coordinates

    def nodes(self):
        counts = self.counts + (0,) * (3 - len(self.counts))
        for k in range(counts[2] + 1):
            for j in range(counts[1] + 1):
                for i in range(counts[0] + 1):
                    yield self.place(*(a / max(1, n) for a, n in zip((i, j, k), self.counts)))

    def number(self, i, j, k=0):
        nx, ny = self.counts[0] + 1, self.counts[1] + 1
        return i + nx * (j + ny * k)

    def cells(self):
        nx, ny = self.counts[:2]
        if len(self.counts) == 2:
            for j in range(ny):
                for i in range(nx):
                    yield [self.number(i + a, j + b) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
            return
        for k in range(self.counts[2]):
            for j in range(ny):
                for i in range(nx):
                    yield [self.number(i + a, j + b, k + c) for c in (0, 1)
                           for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]

    def side(self, last):
        """Nodes, cells and Abaqus' face number of the lower or upper end of the last axis."""
        layer = math.prod(n + 1 for n in self.counts[:-1])
        cells = math.prod(self.counts[:-1])
        n = self.counts[-1]
        face = {2: ("S1", "S3"), 3: ("S1", "S2")}[len(self.counts)][last]
        return (range(n * layer, (n + 1) * layer) if last else range(layer),
                range((n - 1) * cells, n * cells) if last else range(cells), face)


def box(name, lower, upper, counts):
    return Grid(name, counts, lambda *s: [a + (b - a) * t for a, b, t in zip(lower, upper, s)])


def mesh(grids, element):
    lines, at, cell = [], 1, 1
    for grid in grids:
        lines.append(f"*NODE, NSET=N{grid.name}")
        nodes = list(grid.nodes())
        # CalculiX reads 20 characters of a number
        lines += [", ".join([str(at + n), *(f"{x:.12g}" for x in p)]) for n, p in enumerate(nodes)]
        lines.append(f"*ELEMENT, TYPE={element}, ELSET={grid.name}")
        cells = list(grid.cells())
        lines += [", ".join(map(str, [cell + e, *(at + n for n in c)])) for e, c in enumerate(cells)]
        for last, end in enumerate(("LOWER", "UPPER")):
            of_nodes, of_cells, face = grid.side(last)
            lines.append(f"*NSET, NSET={grid.name}_{end}")
            lines += [f"{at + n}," for n in of_nodes]
            lines.append(f"*SURFACE, NAME={grid.name}_{end}_FACES, TYPE=ELEMENT")
            lines += [f"{cell + e}, {face}" for e in of_cells]
        at += len(nodes)
        cell += len(cells)
    return lines


def deck(grids, element, sections, contact, steps, tolerance):
    """sections: (set, Young's modulus); contact: (type, penalty, slave, master); steps: (options,
    increments, supports)."""
    lines = mesh(grids, element)
    for name, young in sections:
        lines += [f"*MATERIAL, NAME=M{name}", "*ELASTIC", f"{young!r}, {POISSON!r}",
                  f"*SOLID SECTION, ELSET={name}, MATERIAL=M{name}", *(["1."] if element.startswith("C") and
                                                                      not element.startswith("C3D") else [])]
    kind, penalty, slave, master = contact
    lines += ["*SURFACE INTERACTION, NAME=FLOOR", "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
              f"{penalty!r}", "*FRICTION", f"{FRICTION!r}, {penalty!r}",
              f"*CONTACT PAIR, INTERACTION=FLOOR, TYPE={kind}", f"{slave}, {master}"]
    ground = grids[0].name + "_LOWER"
    lines += ["*BOUNDARY", f"{ground}, 1, {2 if element.startswith('CP') else 3}, 0."]
    for options, increments, supports in steps:
        lines += [f"*STEP, INC={1000}{options}", "*STATIC, DIRECT", f"{1 / increments:.12g}, 1."]
        if tolerance is not None:
            lines += ["*CONTROLS, PARAMETERS=FIELD", f"{tolerance:.1e}, 0.01"]
        lines += ["*BOUNDARY", *supports, f"*NODE PRINT, NSET={ground}, TOTALS=ONLY", "RF", "*END STEP"]
    return "\n".join(lines) + "\n"


def sheared_block(n, tolerance):
    """A block of n x n/2 CPE4 on a longer base whose elements do not match its own, small strain."""
    length, penalty = 0.02, 200 * YOUNG / 0.02
    grids = [box("BASE", (-length / 4, -length / 4), (1.25 * length, 0), (int(1.3 * n), max(1, n // 4))),
             box("BLOCK", (0, 0), (length, length / 2), (n, n // 2))]
    press = [("BLOCK_UPPER, 1, 1, 0."), ("BLOCK_UPPER, 2, 2, -2e-5")]
    return deck(grids, "CPE4", [("BASE", YOUNG), ("BLOCK", YOUNG)],
                ("NODE TO SURFACE", penalty, "BLOCK_LOWER_FACES", "BASE_UPPER_FACES"),
                [("", 1, press), ("", 10, ["BLOCK_UPPER, 1, 1, 3e-5", "BLOCK_UPPER, 2, 2, -2e-5"])], tolerance)


def blocks(n, tolerance, options=""):
    """A block of n x n x n/2 C3D8 on a base of other elements, small strain."""
    length, penalty = 0.02, 50 * YOUNG / 0.02
    grids = [box("BASE", (-0.004, -0.004, -0.01), (0.024, 0.024, 0), (int(1.2 * n), int(1.2 * n), max(1, n // 3))),
             box("BLOCK", (0, 0, 0), (length, length, length / 2), (n, n, n // 2))]
    upper = ["BLOCK_UPPER, 1, 2, 0.", "BLOCK_UPPER, 3, 3, -2e-5"]
    return deck(grids, "C3D8", [("BASE", YOUNG), ("BLOCK", YOUNG)],
                ("SURFACE TO SURFACE", penalty, "BLOCK_LOWER_FACES", "BASE_UPPER_FACES"),
                [(options, 1, upper),
                 (options, 3, ["BLOCK_UPPER, 1, 1, 2e-5", "BLOCK_UPPER, 2, 2, 0.", "BLOCK_UPPER, 3, 3, -2e-5"])],
                tolerance)


def finite_blocks(n, tolerance):
    """The same with NLGEOM."""
    return blocks(n, tolerance, ", NLGEOM")


def ironing(n, tolerance):
    """A half ring slides over a soft strip, NLGEOM. CalculiX has the normals of the beginning of an increment, which adds
    way of an increment over radius to its ratio of the forces: 40 increments of 0.05 9 %, of 0.0125 2.3 %."""
    def ring(s, t):
        angle, radius = math.pi * s, 1.0 - 0.4 * t
        return [1.5 - radius * math.cos(angle), 1.02 - radius * math.sin(angle)]
    grids = [box("STRIP", (0, -1), (6, 0), (6 * n, n)), Grid("RING", (4 * n, max(1, n // 2)), ring)]
    top = "RING_UPPER"
    return deck(grids, "CPE4", [("STRIP", 1e6), ("RING", 1e8)],
                ("SURFACE TO SURFACE", 1e8, "RING_LOWER_FACES", "STRIP_UPPER_FACES"),
                [(", NLGEOM", 10, [f"{top}, 1, 1, 0.", f"{top}, 2, 2, -0.15"]),
                 (", NLGEOM", 80, [f"{top}, 1, 1, 1.0", f"{top}, 2, 2, -0.15"])], tolerance)


# name: (deck of a fineness, finenesses from quick to long)
PROBLEMS = {
    "sheared_block": (sheared_block, (20, 80, 200)),
    "blocks": (blocks, (10, 16, 22, 30)),
    "finite_blocks": (finite_blocks, (10, 16, 22, 30)),
    "ironing": (ironing, (8, 16)),
}
