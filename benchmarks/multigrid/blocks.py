#!/usr/bin/env python3
"""Two blocks of hex8 with friction, pressed and sheared, by factors and by multigrid.

    benchmarks/multigrid/blocks.py 18 27              elements along an edge of the lower block
    benchmarks/multigrid/blocks.py 39 --solvers multigrid --material "{neo_hooke: {E: 200, nu: 0.3}}"

Prints a row of a table for each size: seconds, memory and iterations. The last displacements of both
solvers must agree, as far as history.csv tells.
"""
import argparse
import csv
import json
import pathlib
import resource
import subprocess
import tempfile

MODEL = """osculate: 1
mesh:
  generate:
    low: {{box: {{x: [0, 1], y: [0, 1], z: [0, 1], elements: [{n}, {n}, {n}]}}}}
    high: {{box: {{x: [0.1, 0.9], y: [0.1, 0.9], z: [1, 1.8], elements: [{m}, {m}, {m}]}}}}
materials:
  s: {material}
sections:
  - {{on: low, material: s, element: solid}}
  - {{on: high, material: s, element: solid}}
contact:
  - name: joint
    master: low.top
    slave: high.bottom
    friction: {{coulomb: {{mu: 0.2}}}}
steps:
  - name: press
    increments: 1
    prescribe: [{{on: low.bottom, ux: 0, uy: 0, uz: 0}}, {{on: high.top, ux: 0, uy: 0, uz: -0.005}}]
  - {{name: shear, increments: 2, prescribe: [{{on: high.top, ux: 0.004}}]}}
solver: {{linear: {linear}}}
output: {{fields: none, report: false, checkpoint: none, history: [{{on: joint, of: normal_force}}, {{on: low.bottom, of: rfx}}]}}
"""


def run(program, folder, n, material, linear, threads):
    model = folder / f"{n}_{linear}.yaml"
    model.write_text(MODEL.format(n=n, m=max(2, round(0.8 * n)), material=material, linear=linear))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([pathlib.Path(program).absolute(), "run", model, "--threads", str(threads)],
                   check=True, cwd=folder, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    results = folder / f"{n}_{linear}.results"
    summary = json.loads((results / "summary.json").read_text())
    with open(results / "history.csv", newline="") as file:
        last = [float(x) for x in list(csv.reader(file))[-1]]
    return summary, last, seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("sizes", type=int, nargs="+")
    parser.add_argument("--osculate", default="build/release/bin/osculate")
    parser.add_argument("--solvers", default="direct,multigrid")
    parser.add_argument("--material", default="{linear_elastic: {E: 200, nu: 0.3}}")
    parser.add_argument("--threads", type=int, default=1)
    a = parser.parse_args()
    print("| solver | unknowns | seconds of the processor | in the solver | memory [MB] | iterations | of the solver, each |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for n in a.sizes:
            forces = []
            for linear in a.solvers.split(","):
                s, last, seconds = run(a.osculate, pathlib.Path(folder), n, a.material, linear, a.threads)
                forces.append(last)
                work = s.get("multigrid")
                each = f"{work['iterations'] / max(1, work['solutions']):.1f}" if work else "-"
                print(f"| {linear} | {s['unknowns']} | {seconds:.1f} | "
                      f"{s['seconds']['solver'] / s['seconds']['total']:.0%} | {s['peak_memory_mb']:.0f} | "
                      f"{s['total']['iterations']} | {each} |", flush=True)
            for x, y in zip(forces[0], forces[-1]):
                if abs(x - y) > 1e-6 * max(abs(x), abs(y), 1e-3):
                    raise SystemExit(f"{n}: the solvers do not agree: {forces}")


if __name__ == "__main__":
    main()
