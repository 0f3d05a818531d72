#!/usr/bin/env python3
"""Two bolted plates: `contact: all` beside the same contacts as named pairs, in turn in one run.

    benchmarks/contact_all/bolted_plates.py                      tetrahedra, 3 turns
    benchmarks/contact_all/bolted_plates.py --cells hex8 --turns 1 --keep DIR

What is compared is in ../README.md. Exit code 1 if a run failed or the forces differ.
"""
import argparse
import csv
import itertools
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORCE_LIMIT = 0.01  # of the last force

# In cells of the lattice: the plates' size, the middles of the holes, what becomes a circle.
LENGTH, WIDTH, THICKNESS = 20, 10, 2
HOLES = ((5, 5), (15, 5))
HOLE, ROUND, HEAD = 2, 4, 3
CLEARANCE, OVERLAP, TURN = 0.1, 0.01, (0.9659258262890683, 0.25881904510252074)

HEX = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
HEX_EDGES = ((0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7))
TETS = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))
TET_EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3))
# Sides with their normals outwards, and Gmsh's numbers of cell and side by order.
SHAPES = {"hex": (HEX_EDGES, ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (2, 3, 7, 6), (1, 2, 6, 5), (0, 4, 7, 3)),
                  {1: (5, 3), 2: (17, 16)}),
          "tet": (TET_EDGES, ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)), {1: (4, 2), 2: (11, 9)})}


def rounded(x, y):
    """Squares round the middle become circles, fully at the hole's border."""
    size = max(abs(x), abs(y))
    if size == 0 or size >= ROUND:
        return x, y
    part = size / HOLE if size < HOLE else (ROUND - size) / (ROUND - HOLE)
    factor = 1 - part + part * size / (x * x + y * y) ** 0.5
    return factor * x, factor * y


def plate_point(p):
    x, y, z = p
    for cx, cy in HOLES:
        if max(abs(x - cx), abs(y - cy)) < ROUND:
            dx, dy = rounded(x - cx, y - cy)
            return cx + dx, cy + dy, z
    return p


def bolt_point(p, middle):
    """A little thinner than the hole, turned, and shorter than the plates are thick."""
    x, y = rounded(p[0] - middle[0], p[1] - middle[1])
    x, y = (1 - CLEARANCE) * x, (1 - CLEARANCE) * y
    c, s = TURN
    return middle[0] + c * x - s * y, middle[1] + s * x + c * y, p[2] * (1 - OVERLAP / THICKNESS)


def lattice(x, y, z, inside):
    return [c for c in itertools.product(range(*x), range(*y), range(*z)) if inside(*(k + 0.5 for k in c))]


def bodies():
    """name, lattice cells, map of a lattice point, {set: what its sides' lattice corners have in common}"""
    hole = lambda x, y, z: any(max(abs(x - cx), abs(y - cy)) < HOLE for cx, cy in HOLES)
    on_hole = lambda p: any(max(abs(p[0] - cx), abs(p[1] - cy)) == HOLE for cx, cy in HOLES)
    for name, z in (("low", (-THICKNESS, 0)), ("high", (0, THICKNESS))):
        yield (name, lattice((0, LENGTH), (0, WIDTH), z, lambda *c: not hole(*c)), plate_point,
               {"below": lambda p, z=z: p[2] == z[0], "above": lambda p, z=z: p[2] == z[1], "hole": on_hole,
                "left": lambda p: p[0] == 0, "right": lambda p: p[0] == LENGTH})
    for k, (cx, cy) in enumerate(HOLES, 1):
        shank = lambda x, y, z, m=(cx, cy): abs(z) > THICKNESS or max(abs(x - m[0]), abs(y - m[1])) < HOLE
        yield (f"bolt{k}", lattice((cx - HEAD, cx + HEAD), (cy - HEAD, cy + HEAD), (-2 * THICKNESS, 2 * THICKNESS), shank),
               lambda p, m=(cx, cy): bolt_point(p, m),
               {"nut": lambda p: p[2] == -THICKNESS, "head": lambda p: p[2] == THICKNESS,
                "shank": lambda p, m=(cx, cy): abs(p[2]) <= THICKNESS and max(abs(p[0] - m[0]), abs(p[1] - m[1])) == HOLE})


class Mesh:
    """Nodes by body and (doubled) lattice place, elements and the names of their groups, as MSH 2.2."""

    def __init__(self, shape, order):
        self.edges, self.sides, types = SHAPES[shape]
        self.cell_type, self.side_type = types[order]
        self.shape, self.order = shape, order
        self.nodes, self.elements, self.groups = {}, [], {}

    def node(self, body, place, point):
        return self.nodes.setdefault((body, place), (len(self.nodes) + 1, point))[0]

    def add(self, kind, group, dimension, body, corners, to_space):
        edges = self.edges if dimension == 3 else [(k, (k + 1) % len(corners)) for k in range(len(corners))]
        points = [to_space(c) for c in corners]
        nodes = [self.node(body, tuple(2 * k for k in c), p) for c, p in zip(corners, points)]
        if self.order == 2:  # in the middle of straight edges
            nodes += [self.node(body, tuple(a + b for a, b in zip(corners[i], corners[j])),
                                tuple((a + b) / 2 for a, b in zip(points[i], points[j]))) for i, j in edges]
        number = self.groups.setdefault((dimension, group), len(self.groups) + 1)
        self.elements.append((kind, number, nodes))

    def add_body(self, name, cells, to_space, sets):
        faces = {}
        for origin in cells:
            corners = [tuple(o + d for o, d in zip(origin, h)) for h in HEX]
            for local in (TETS if self.shape == "tet" else (range(8),)):
                points = [corners[k] for k in local]
                self.add(self.cell_type, name, 3, name, points, to_space)
                for side in self.sides:
                    face = [points[k] for k in side]
                    faces.setdefault(frozenset(face), []).append(face)
        for face in (f[0] for f in faces.values() if len(f) == 1):
            for part, holds in sets.items():
                if all(holds(p) for p in face):
                    self.add(self.side_type, f"{name}_{part}", 2, name, face, to_space)

    def write(self, path):
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(self.groups))]
        lines += [f'{d} {number} "{name}"' for (d, name), number in self.groups.items()]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(self.nodes))]
        lines += [f"{n} {x!r} {y!r} {z!r}" for n, (x, y, z) in self.nodes.values()]
        lines += ["$EndNodes", "$Elements", str(len(self.elements))]
        lines += [f"{k} {kind} 2 {group} {group} {' '.join(map(str, nodes))}"
                  for k, (kind, group, nodes) in enumerate(self.elements, 1)]
        path.write_text("\n".join(lines + ["$EndElements", ""]))


LAWS = "normal: {penalty: 1e6}, friction: {coulomb: {mu: 0.2, penalty: 3e5}}"


def contacts(named):
    if not named:
        return f"{{all: {{{LAWS}}}}}"
    pairs = [("low_above", "high_below")]
    for k in range(1, len(HOLES) + 1):
        pairs += [("low_below", f"bolt{k}_nut"), ("high_above", f"bolt{k}_head"),
                  ("low_hole", f"bolt{k}_shank"), ("high_hole", f"bolt{k}_shank")]
    return "[" + ", ".join(f"{{name: c{i}, master: {a}, slave: {b}, sampling: nodes, two_pass: true, {LAWS}}}"
                           for i, (a, b) in enumerate(pairs)) + "]"


def model(named):
    sections = ", ".join(f"{{on: {b[0]}, material: steel, element: solid}}" for b in bodies())
    return f"""osculate: 1
title: Bolted plates
mesh: plates.msh
materials: {{steel: {{linear_elastic: {{E: 2.1e5, nu: 0.3}}}}}}
sections: [{sections}]
contact: {contacts(named)}
steps:
  - {{name: pull, increments: 4, prescribe: [{{on: low_left, ux: 0, uy: 0, uz: 0}}, {{on: high_right, ux: 0.1, uy: 0, uz: 0}}]}}
output: {{fields: none, report: false, checkpoint: none, history: [{{name: force, on: low_left, of: rfx}}]}}
"""


def run(program, folder, name):
    out = folder / f"{name}.results"
    done = subprocess.run([program, "run", folder / f"{name}.yaml", "-o", out, "--threads", "1"], capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"{name}: {done.stdout}{done.stderr}")
    summary = json.loads((out / "summary.json").read_text())
    with open(out / "history.csv", encoding="utf-8") as file:
        force = [float(row["force"]) for row in csv.DictReader(file)]
    return summary, force


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--osculate", type=pathlib.Path, default=ROOT / "build/release/bin/osculate")
    parser.add_argument("--cells", choices=("hex8", "hex20", "tet4", "tet10"), default="tet4")
    parser.add_argument("--turns", type=int, default=3)
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the models and their results")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.keep or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        mesh = Mesh(options.cells[:3], 2 if options.cells in ("hex20", "tet10") else 1)
        for body in bodies():
            mesh.add_body(*body)
        mesh.write(folder / "plates.msh")
        for name in ("named", "all"):
            (folder / f"{name}.yaml").write_text(model(name == "named"))
        results = {"named": [], "all": []}
        for _ in range(options.turns):
            for name, list_of_runs in results.items():
                list_of_runs.append(run(options.osculate, folder, name))
    medians, totals = {}, {}
    for name, runs in results.items():
        steps = runs[0][0]["steps"]
        iterations = sum(i["iterations"] for s in steps for i in s["increments"])
        phases = {k: statistics.median(s["contact_seconds"][k] for s, _ in runs) for k in ("search", "projection", "evaluation")}
        medians[name] = phases
        totals[name] = statistics.median(s["seconds"]["total"] for s, _ in runs)
        print(f"{name:6} {len(mesh.nodes)} nodes, {iterations} iterations, "
              f"{totals[name]:.2f} s, contact: "
              + ", ".join(f"{k} {v:.3f}" for k, v in phases.items()) + f"; force {runs[0][1][-1]:.6g}")
    ratio = {k: medians["all"][k] / medians["named"][k] for k in medians["all"]}
    print("all / named: " + ", ".join(f"{k} {v:.2f}" for k, v in ratio.items())
          + f", contact {sum(medians['all'].values()) / sum(medians['named'].values()):.2f}, "
          f"whole run {totals['all'] / totals['named']:.2f}")
    forces = [results[name][0][1] for name in ("named", "all")]
    different = abs(forces[0][-1] - forces[1][-1]) > FORCE_LIMIT * abs(forces[0][-1])  # while all slides
    if different:
        print("bolted_plates.py: the forces differ", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
