#!/usr/bin/env python3
"""Times Osculate against CalculiX on the same plane contact problem, alternately in one run.

    benchmarks/compare.py                        all sizes, 5 pairs of runs each
    benchmarks/compare.py --models 20x10 80x40 --pairs 9 --contact surface
    benchmarks/compare.py --tolerance own        each program with its own default tolerances
    benchmarks/compare.py --profile              where the time goes (needs Linux perf), no timing

Needs `ccx` (Debian: calculix-ccx) and a built `osculate`. What is compared, and what not, is in
README.md. Exit code 1 if a program failed, the forces differ or the increments are not the same.
"""
import argparse
import csv
import dataclasses
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
FORCE_LIMIT = 0.03  # of the largest normal, respectively shear, force of the history
RESIDUAL = 1e-9     # relative; tight enough that both programs are in their quadratic range

# The problem, in SI units: a block on an elastic base, pressed and then sheared until all slides.
LENGTH = 0.02
YOUNG, POISSON = 2.1e10, 0.3
PENALTY = 200 * YOUNG / LENGTH  # traction per length, normal and tangential
FRICTION = 0.3
PRESS, SHEAR = -2e-5, 3e-5


@dataclasses.dataclass
class Model:
    """A block of nx x ny elements on a longer base, whose elements do not match the block's."""
    nx: int
    ny: int
    increments: int = 10  # of the shear step; the press step has one

    @property
    def name(self):
        return f"{self.nx}x{self.ny}"

    @property
    def boxes(self):
        """name, x range, y range, elements in x and y"""
        base = (int(1.3 * self.nx), max(1, self.ny // 2))
        height = LENGTH * self.ny / self.nx
        return (("block", (0, LENGTH), (0, height), (self.nx, self.ny)),
                ("base", (-LENGTH / 4, 1.25 * LENGTH), (-height / 2, 0), base))


@dataclasses.dataclass
class Run:
    """What one run of a program took and gave."""
    wall: float
    cpu: float
    unknowns: int
    iterations: list  # one number an increment
    forces: list      # (time, normal, shear), one an increment
    seconds: dict     # phases, where the program tells them


# --- the same problem, written twice ---------------------------------------------------------------


def osculate_model(model, tolerance):
    lines = ["osculate: 1", f"title: Benchmark {model.name}", "mesh:", "  generate:"]
    for name, x, y, (nx, ny) in model.boxes:
        lines.append(f"    {name}: {{box: {{x: [{x[0]!r}, {x[1]!r}], y: [{y[0]!r}, {y[1]!r}], "
                     f"elements: [{nx}, {ny}], type: quad4}}}}")
    held = "{on: base.bottom, ux: 0, uy: 0}"
    pressed = f"{{on: block.top, ux: 0, uy: {PRESS!r}}}"
    sheared = f"{{on: block.top, ux: {SHEAR!r}}}"
    lines += [
        f"materials: {{steel: {{linear_elastic: {{E: {YOUNG!r}, nu: {POISSON!r}}}}}}}",
        "sections:",
        "  - {on: block, material: steel, element: plane_strain}",
        "  - {on: base, material: steel, element: plane_strain}",
        "contact:",
        "  - name: floor",
        "    master: base.top",
        "    slave: block.bottom",
        f"    normal: {{penalty: {PENALTY!r}}}",
        f"    friction: {{coulomb: {{mu: {FRICTION!r}, penalty: {PENALTY!r}}}}}",
        "steps:",
        f"  - {{name: press, increments: 1, prescribe: [{pressed}, {held}]}}",
        f"  - {{name: shear, increments: {model.increments}, prescribe: [{sheared}]}}",
    ]
    if tolerance == "matched":
        lines.append(f"solver: {{tolerance: {{residual: {RESIDUAL:.1e}}}}}")
    lines.append("output: {fields: none, report: false, history: [{on: floor, of: normal_force}, "
                 "{on: floor, of: shear_force}]}")
    return "\n".join(lines) + "\n"


def ccx_deck(model, tolerance, contact):
    nodes, cells, ends = [], [], {}
    for name, x, y, (nx, ny) in model.boxes:
        first = len(nodes) + 1
        nodes += [(x[0] + (x[1] - x[0]) * i / nx, y[0] + (y[1] - y[0]) * j / ny)
                  for j in range(ny + 1) for i in range(nx + 1)]
        element = sum(len(c) for _, c in cells) + 1
        at = [first + j * (nx + 1) + i for j in range(ny) for i in range(nx)]
        cells.append((name, [(n, n + 1, n + nx + 2, n + nx + 1) for n in at]))
        ends[name] = {"nodes": (range(first, first + nx + 1), range(len(nodes) - nx, len(nodes) + 1)),
                      "cells": (range(element, element + nx),
                                range(element + nx * (ny - 1), element + nx * ny))}
    lines = ["*NODE, NSET=ALL"]
    # ccx reads 20 characters of a number
    lines += [f"{n}, {x:.12g}, {y:.12g}, 0." for n, (x, y) in enumerate(nodes, 1)]
    number = 0
    for name, list_of_cells in cells:
        lines.append(f"*ELEMENT, TYPE=CPE4, ELSET={name.upper()}")
        for cell in list_of_cells:
            number += 1
            lines.append(", ".join(map(str, (number, *cell))))
    lines += ["*NSET, NSET=TOP", *(f"{n}," for n in ends["block"]["nodes"][1]),
              "*NSET, NSET=GROUND", *(f"{n}," for n in ends["base"]["nodes"][0]),
              "*SURFACE, NAME=SLAVE, TYPE=ELEMENT", *(f"{e}, S1" for e in ends["block"]["cells"][0]),
              "*SURFACE, NAME=MASTER, TYPE=ELEMENT", *(f"{e}, S3" for e in ends["base"]["cells"][1]),
              "*MATERIAL, NAME=STEEL", "*ELASTIC", f"{YOUNG!r}, {POISSON!r}",
              "*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL", "1.",
              "*SOLID SECTION, ELSET=BASE, MATERIAL=STEEL", "1.",
              "*SURFACE INTERACTION, NAME=FLOOR",
              "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR", f"{PENALTY!r}",
              "*FRICTION", f"{FRICTION!r}, {PENALTY!r}",
              f"*CONTACT PAIR, INTERACTION=FLOOR, TYPE={contact.upper()} TO SURFACE", "SLAVE, MASTER",
              "*BOUNDARY", "GROUND, 1, 2, 0."]
    for shear, increments in ((0.0, 1), (SHEAR, model.increments)):
        lines += [f"*STEP, INC={increments + 1}", "*STATIC, DIRECT", f"{1 / increments:.12g}, 1."]
        if tolerance == "matched":
            lines += ["*CONTROLS, PARAMETERS=FIELD", f"{RESIDUAL:.1e}, 0.01"]
        lines += ["*BOUNDARY", f"TOP, 1, 1, {shear!r}", f"TOP, 2, 2, {PRESS!r}",
                  "*NODE PRINT, NSET=GROUND, TOTALS=ONLY", "RF", "*END STEP"]
    return "\n".join(lines) + "\n"


# --- running and reading ---------------------------------------------------------------------------


def timed(command, folder):
    """Wall seconds, processor seconds (user and system) and output of one run."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("CCX_NPROC", "OMP_"))}
    with (folder / "out.txt").open("w+") as out:
        start = time.perf_counter()
        process = subprocess.Popen(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT,
                                   env={**environment, **ONE_THREAD})
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read()
    if process.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))} ended with {process.returncode}:\n"
                           + text[-2000:])
    return wall, usage.ru_utime + usage.ru_stime, text


def osculate_command(program):
    return [str(program), "run", "model.yaml", "-o", "model.results", "--threads", "1", "--quiet"]


def write_inputs(model, options, folder):
    (folder / "model.yaml").write_text(osculate_model(model, options.tolerance))
    (folder / "deck.inp").write_text(ccx_deck(model, options.tolerance, options.contact))


def run_osculate(program, folder):
    shutil.rmtree(folder / "model.results", ignore_errors=True)
    wall, cpu, _ = timed(osculate_command(program), folder)
    summary = json.loads((folder / "model.results/summary.json").read_text())
    with (folder / "model.results/history.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))[1:]  # without the initial state
    return Run(wall, cpu, summary["unknowns"],
               [i["iterations"] + i["wasted_iterations"]
                for step in summary["steps"] for i in step["increments"]],
               [(float(r["time"]), float(r["floor.normal_force"]), float(r["floor.shear_force"]))
                for r in rows], summary["seconds"])


TOTAL = re.compile(r"total force \(fx,fy,fz\) for set GROUND and time\s+(\S+)\s+(\S+)\s+(\S+)\s+\S+")


def run_ccx(program, folder):
    for old in folder.glob("deck.*"):
        if old.suffix != ".inp":
            old.unlink()
    wall, cpu, text = timed([str(program), "deck"], folder)
    if "*ERROR" in text:
        raise RuntimeError("ccx: " + text[text.index("*ERROR"):][:500])
    attempts = [line.split() for line in (folder / "deck.sta").read_text().splitlines()[2:]]
    if any(int(a[2]) != 1 for a in attempts):
        raise RuntimeError("ccx repeated an increment")
    forces = [(float(t), float(fy), float(fx))
              for t, fx, fy in TOTAL.findall((folder / "deck.dat").read_text())]
    unknowns = int(re.search(r"number of equations\s+(\d+)", text).group(1))
    return Run(wall, cpu, unknowns, [int(a[3]) for a in attempts], forces, {})


def force_difference(ours, theirs):
    """Largest differences of normal and shear force over the history, each over its largest value."""
    if len(ours.forces) != len(theirs.forces):
        raise RuntimeError(f"{len(ours.forces)} and {len(theirs.forces)} increments")
    if any(abs(a[0] - b[0]) > 1e-6 for a, b in zip(ours.forces, theirs.forces)):
        raise RuntimeError("the increments are not the same")
    return [max(abs(a[k] - b[k]) for a, b in zip(ours.forces, theirs.forces))
            / max(abs(b[k]) for b in theirs.forces) for k in (1, 2)]


def run_pair(options, folder, ours_first):
    """One run of each, in the given order."""
    both = {}
    for ours in (ours_first, not ours_first):
        both[ours] = (run_osculate(options.osculate, folder) if ours
                      else run_ccx(options.ccx, folder))
    return both[True], both[False]


def measure(model, options):
    with tempfile.TemporaryDirectory(prefix="compare_") as name:
        folder = pathlib.Path(name)
        write_inputs(model, options, folder)
        run_pair(options, folder, True)  # not counted: fills the caches
        pairs = [run_pair(options, folder, k % 2 == 0) for k in range(options.pairs)]
    for series in zip(*pairs):
        if any((r.iterations, r.forces) != (series[0].iterations, series[0].forces) for r in series):
            raise RuntimeError("repeated runs gave different results")
    return pairs


# --- tables ----------------------------------------------------------------------------------------


def row(model, pairs):
    ours, theirs = ([p[k] for p in pairs] for k in (0, 1))
    normal, shear = force_difference(ours[0], theirs[0])
    result = {"model": model.name, "increments": len(ours[0].forces), "pairs": len(pairs),
              "normal_difference": normal, "shear_difference": shear,
              "last_ratio": [-r[0].forces[-1][2] / r[0].forces[-1][1] for r in (ours, theirs)],
              "ratios": [t.wall / o.wall for o, t in pairs], "phases": ours[0].seconds}
    for name, runs in (("osculate", ours), ("ccx", theirs)):
        median = statistics.median(r.wall for r in runs)
        result[name] = {"unknowns": runs[0].unknowns, "iterations": sum(runs[0].iterations),
                        "per_increment": runs[0].iterations, "min": min(r.wall for r in runs),
                        "median": median, "cpu": statistics.median(r.cpu for r in runs),
                        "per_iteration": median / sum(runs[0].iterations)}
    return result


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(cells) + " |" for cells in rows])


def print_tables(rows):
    both = [(r, r["osculate"], r["ccx"]) for r in rows]
    seconds = "{:.3g}".format
    print("\nSeconds of a run (O Osculate, C CalculiX); a ratio above 1: Osculate takes less.\n")
    print(table(["model", "unknowns O, C", "O min", "O median", "C min", "C median", "C / O",
                 "pairs from, to"],
                [[r["model"], f"{o['unknowns']}, {c['unknowns']}", seconds(o["min"]), seconds(o["median"]),
                  seconds(c["min"]), seconds(c["median"]), f"{c['median'] / o['median']:.2f}",
                  f"{min(r['ratios']):.2f}, {max(r['ratios']):.2f}"] for r, o, c in both]))
    print("\nIterations, and milliseconds of a whole run for each of them.\n")
    print(table(["model", "increments", "iterations O", "C", "C / O", "ms each O", "C", "C / O",
                 "processor / wall O", "C"],
                [[r["model"], str(r["increments"]), str(o["iterations"]), str(c["iterations"]),
                  f"{c['iterations'] / o['iterations']:.2f}", f"{1e3 * o['per_iteration']:.2f}",
                  f"{1e3 * c['per_iteration']:.2f}", f"{c['per_iteration'] / o['per_iteration']:.2f}",
                  f"{o['cpu'] / o['median']:.2f}", f"{c['cpu'] / c['median']:.2f}"] for r, o, c in both]))
    print("\nSame answer? Largest difference of the contact forces over all increments, shear over "
          "normal force at the end.\n")
    print(table(["model", "normal force", "shear force", "T / N at the end O", "C"],
                [[r["model"], f"{r['normal_difference']:.2%}", f"{r['shear_difference']:.2%}",
                  *(f"{x:.4f}" for x in r["last_ratio"])] for r, _, _ in both]))


# --- profile ---------------------------------------------------------------------------------------

# Library, symbol, part of the run; the first line that fits both.
PARTS = {
    "osculate": (
        (r"metis|scotch", r"", "ordering"),
        (r"libosculate_la|^osculate$", r"la::MatrixBuilder|la::SparseMatrix", "assembly"),
        (r"libosculate_la", r"", "factorisation and solve"),
        (r"openblas", r"", "factorisation and solve"),
        (r"^osculate$", r"osculate::(pairing|contact|projection|search|geometry)", "contact"),
        (r"^osculate$", r"osculate::(solid|material|model|cell)|Eigen", "assembly"),
        (r"kernel|\[", r"", "kernel"),
        (r"", r"", "rest")),
    "ccx": (
        (r"spooles", r"ETree|Graph|MSMD|DSTree|GPart|BPG|Network|BKL|SymbFac", "ordering"),
        (r"spooles|openblas|lapack", r"", "factorisation and solve"),
        (r"^ccx$|libm\.so", r"", "assembly"),  # with contact: the program has no symbols
        (r"kernel|\[", r"", "kernel"),
        (r"", r"", "rest")),
}


def profile(program, command, folder):
    """Share of the samples in each part of a program, by the names of libraries and functions."""
    timed(["perf", "record", "-q", "-F", "1999", "-e", "cpu-clock", "-o", "perf.data", *command], folder)
    report = subprocess.run(["perf", "report", "-i", "perf.data", "--stdio", "-q", "-F",
                             "overhead,dso,symbol", "-t", ";"], cwd=folder, capture_output=True,
                            text=True, check=True).stdout
    shares = dict.fromkeys((part for _, _, part in PARTS[program]), 0.0)
    top = []
    for line in report.splitlines():
        fields = [f.strip() for f in line.split(";", 2)]
        if len(fields) != 3 or not fields[0].endswith("%"):
            continue
        share, library, symbol = float(fields[0][:-1]), fields[1], fields[2]
        part = next(p for lib, sym, p in PARTS[program]
                    if re.search(lib, library) and re.search(sym, symbol))
        shares[part] += share
        top.append((share, part, library, symbol))
    return shares, top


def print_profiles(models, options):
    if not shutil.which("perf"):
        raise RuntimeError("--profile needs perf (Debian: linux-perf)")
    parts = ["ordering", "factorisation and solve", "assembly", "contact", "kernel", "rest"]
    rows = []
    for model in models:
        with tempfile.TemporaryDirectory(prefix="compare_") as name:
            folder = pathlib.Path(name)
            write_inputs(model, options, folder)
            for program, command in (("osculate", osculate_command(options.osculate)),
                                     ("ccx", [str(options.ccx), "deck"])):
                shares, top = profile(program, command, folder)
                rows.append([model.name, program,
                             *(f"{shares[p]:.0f} %" if p in shares else "in assembly" for p in parts)])
                for share, part, library, symbol in sorted(top, reverse=True)[:options.top]:
                    print(f"{model.name} {program:9} {share:5.1f} % {part:24} {library[:24]:24} "
                          f"{symbol[:90]}")
    print("\nShare of the processor time, by the names of libraries and functions.\n")
    print(table(["model", "program", *parts], rows))


# --- command line ----------------------------------------------------------------------------------


def parse_model(text):
    match = re.fullmatch(r"(\d+)x(\d+)(?::(\d+))?", text)
    if not match or min(int(g) for g in match.groups() if g) < 1:
        raise argparse.ArgumentTypeError(f"{text!r}: expected NXxNY or NXxNY:INCREMENTS, such as 80x40")
    return Model(*(int(g) for g in match.groups() if g))


def parse(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    default = ROOT / "build/release/bin/osculate"
    if not default.exists():
        default = ROOT / "build/release/bin/osculate"
    parser.add_argument("--osculate", type=pathlib.Path, default=default, metavar="PROGRAM")
    parser.add_argument("--ccx", default="ccx", metavar="PROGRAM")
    parser.add_argument("--models", nargs="+", type=parse_model, metavar="NXxNY[:INCREMENTS]",
                        default=[Model(20, 10), Model(80, 40), Model(200, 100, 4)])
    parser.add_argument("--pairs", type=int, default=5, help="counted pairs of runs of each model")
    parser.add_argument("--contact", choices=("node", "surface"), default="node",
                        help="contact of CalculiX: node to surface (as Osculate), surface to surface")
    parser.add_argument("--tolerance", choices=("matched", "own"), default="matched")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write the numbers too")
    parser.add_argument("--profile", action="store_true", help="where the time goes, instead of timing")
    parser.add_argument("--top", type=int, default=0, help="with --profile: functions to name")
    options = parser.parse_args(arguments)
    options.osculate = options.osculate.resolve()
    options.ccx = shutil.which(options.ccx)
    if options.pairs < 1:
        parser.error("--pairs: expected 1 or more")
    if not options.osculate.exists():
        parser.error(f"no program {options.osculate}: build it (tools/quickstart) or give --osculate")
    if not options.ccx:
        parser.error("no ccx: install CalculiX (Debian: calculix-ccx) or give --ccx")
    return options


def version(command):
    text = subprocess.run(command, capture_output=True, text=True, check=False).stdout
    return " ".join(text.split())


def main():
    options = parse()
    print(f"{version([options.osculate, '--version'])}; ccx: {version([options.ccx, '-v'])}; "
          f"contact of ccx: {options.contact} to surface; tolerances: {options.tolerance}")
    try:
        if options.profile:
            print_profiles(options.models, options)
            return 0
        rows = [row(model, measure(model, options)) for model in options.models]
    except RuntimeError as error:
        print(f"compare.py: {error}", file=sys.stderr)
        return 1
    print_tables(rows)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")
    different = [r["model"] for r in rows
                 if max(r["normal_difference"], r["shear_difference"]) > FORCE_LIMIT]
    if different:
        print(f"compare.py: the forces differ by more than {FORCE_LIMIT:.0%}: {different}",
              file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
