#!/usr/bin/env python3
"""Times Osculate beside CalculiX on the same decks, alternately in one run.

    benchmarks/beside_ccx.py                             the quick size of every problem, 5 pairs of runs each
    benchmarks/beside_ccx.py --all --pairs 3             every size
    benchmarks/beside_ccx.py blocks:10 ironing:8,16      these sizes of these problems (problems.py)
    benchmarks/beside_ccx.py --tolerance own             each program ends an increment as it does by default
    benchmarks/beside_ccx.py --keep benchmarks/history.csv      adds its rows to a file

Needs `ccx` (Debian: calculix-ccx) and a built `osculate`. One thread each. Exit code 1 if a program failed, repeated an
increment, or their forces differ by more than 3 %.
"""
import argparse
import collections
import csv
import datetime
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

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "benchmarks"))
import problems  # noqa: E402

FORCE_LIMIT = 0.03  # of the largest force of the history
RESIDUAL = 1e-9     # of CalculiX, relative; what Osculate ends with by default is of that order
PHASES = ("input", "bulk", "contact", "assembly", "solver", "output")
Run = collections.namedtuple("Run", "cpu memory own unknowns iterations factorisations forces seconds")


def own_pages(pid):
    """MB that a process has of its own now: without the pages of files, which all processes share."""
    try:
        found = re.search(r"RssAnon:\s+(\d+)", pathlib.Path(f"/proc/{pid}/status").read_text())
    except OSError:  # it has ended
        found = None
    return int(found[1]) / 1024 if found else 0


def timed(command, folder):
    """Processor seconds, MB at most, those of its own (every 2 ms), and the output of one run."""
    with (folder / "out.txt").open("w+") as out:
        process = subprocess.Popen(command, cwd=folder, stdout=out, stderr=subprocess.STDOUT,
                                   env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
        own = ended = 0
        while not ended:
            own = max(own, own_pages(process.pid))
            time.sleep(0.002)
            ended, status, usage = os.wait4(process.pid, os.WNOHANG)
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read()
    if process.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))} ended with {process.returncode}:\n{text[-2000:]}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, own, text


def forces_of(path):
    """The total force of each increment of a .dat file."""
    text = path.read_text()
    found = re.findall(r"total force \(fx,fy,fz\) for set \S+ and time\s+\S+\s+(\S+)\s+(\S+)\s+(\S+)", text)
    return [tuple(map(float, force)) for force in found]


def run_osculate(program, folder):
    shutil.rmtree(folder / "results", ignore_errors=True)
    cpu, memory, own, _ = timed([str(program), "run", "deck.inp", "-o", "results", "--threads", "1", "--quiet"], folder)
    summary = json.loads((folder / "results/summary.json").read_text())
    increments = [i for step in summary["steps"] for i in step["increments"]]
    if any(i["cutbacks"] for i in increments):
        raise RuntimeError("osculate cut an increment")
    count = {key: sum(i[key] for i in increments)
             for key in ("iterations", "factorisations", "factorisations_of_contact")}
    return Run(cpu, memory, own, summary["unknowns"], count["iterations"],
               f"{count['factorisations']} + {count['factorisations_of_contact']}",
               forces_of(folder / "results/deck.dat"), summary["seconds"])


def run_ccx(program, folder):
    for suffix in (".dat", ".sta"):
        (folder / f"deck{suffix}").unlink(missing_ok=True)
    cpu, memory, own, text = timed([str(program), "deck"], folder)
    if "*ERROR" in text:
        raise RuntimeError("ccx: " + text[text.index("*ERROR"):][:500])
    attempts = [line.split() for line in (folder / "deck.sta").read_text().splitlines()[2:]]
    if any(int(a[2]) != 1 for a in attempts):
        raise RuntimeError("ccx repeated an increment")
    iterations = sum(int(a[3]) for a in attempts)
    unknowns = int(re.findall(r"number of equations\s+(\d+)", text)[0])
    return Run(cpu, memory, own, unknowns, iterations, iterations, forces_of(folder / "deck.dat"), {})


def force_difference(ours, theirs):
    """Largest difference of a component over the history, of the largest force."""
    if len(ours) != len(theirs):
        raise RuntimeError(f"{len(ours)} and {len(theirs)} increments")
    largest = max(abs(x) for force in theirs for x in force)
    return max(abs(a - b) for f, g in zip(ours, theirs) for a, b in zip(f, g)) / largest


def measure(name, fineness, options):
    """Pairs of runs of a problem, of which the first one is not counted where there are several."""
    make = problems.PROBLEMS[name][0]
    with tempfile.TemporaryDirectory(prefix="beside_ccx_") as made:
        folder = pathlib.Path(made)
        (folder / "deck.inp").write_text(make(fineness, RESIDUAL if options.tolerance == "matched" else None))
        pairs = []
        for k in range(options.pairs + (options.pairs > 1)):
            both = {}
            for ours in (k % 2 == 0, k % 2 != 0):
                both[ours] = run_osculate(options.osculate, folder) if ours else run_ccx(options.ccx, folder)
            pairs.append((both[True], both[False]))
    for series in zip(*pairs):
        if any((r.iterations, r.forces) != (series[0].iterations, series[0].forces) for r in series):
            raise RuntimeError("repeated runs gave different results")
    return pairs[options.pairs > 1:]


def row_of(name, fineness, pairs):
    ours, theirs = ([p[k] for p in pairs] for k in (0, 1))
    ratios = [c.cpu / o.cpu for o, c in pairs]
    o, c = ours[0], theirs[0]
    return {"problem": f"{name}:{fineness}", "unknowns": o.unknowns, "unknowns_ccx": c.unknowns,
            "seconds": statistics.median(r.cpu for r in ours), "seconds_ccx": statistics.median(r.cpu for r in theirs),
            "ratio": statistics.median(ratios), "from": min(ratios), "to": max(ratios),
            "iterations": o.iterations, "factorisations": o.factorisations, "iterations_ccx": c.iterations,
            "memory": max(r.memory for r in ours), "memory_ccx": max(r.memory for r in theirs),
            "difference": force_difference(o.forces, c.forces),
            **{phase: o.seconds[phase] / o.seconds["total"] for phase in PHASES},
            "own": max(r.own for r in ours), "own_ccx": max(r.own for r in theirs)}


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)]
    return "\n".join(lines + ["| " + " | ".join(cells) + " |" for cells in rows])


def line_of(r):
    return [r["problem"], f"{r['unknowns']}", f"{r['seconds']:.2f} / {r['seconds_ccx']:.2f}",
            f"{r['ratio']:.1f}" + (f" ({r['from']:.1f}, {r['to']:.1f})" if "from" in r else ""),
            f"{r['iterations']}" + (f" ({r['factorisations']})" if "factorisations" in r else "") + f" / {r['iterations_ccx']}",
            f"{r['memory']:.0f} / {r['memory_ccx']:.0f}" + (f" ({r['own']:.0f} / {r['own_ccx']:.0f})" if "own" in r else ""),
            f"{r['difference']:.1e}",
            " ".join(f"{r[phase]:.0%}" for phase in PHASES)]


HEADS = ["problem", "unknowns", "seconds of the processor O / C", "C / O, pairs from, to",
         "iterations (factorisations + of contact alone) O / C", "MB O / C (of its own)", "forces differ by", "shares of O: " + ", ".join(PHASES)]


def keep(rows, path):
    """Adds rows to a file, with the day and the commit."""
    commit = subprocess.run(["git", "-C", ROOT, "describe", "--always", "--dirty"], capture_output=True, text=True,
                            check=False).stdout.strip()
    new = not path.exists()
    with path.open("a", newline="") as file:
        writer = csv.DictWriter(file, ["day", "commit", *rows[0]])
        if new:
            writer.writeheader()
        for r in rows:
            figures = {k: f"{v:.4g}" if isinstance(v, float) else v for k, v in r.items()}
            writer.writerow({"day": datetime.date.today().isoformat(), "commit": commit, **figures})


def chosen(words, every):
    """[(problem, fineness)] of 'name' or 'name:fineness,fineness'; nothing said: the quick size of each."""
    result = []
    for word in words or problems.PROBLEMS:
        name, _, sizes = word.partition(":")
        if name not in problems.PROBLEMS:
            raise ValueError(f"no problem '{name}'; there are {', '.join(problems.PROBLEMS)}")
        known = problems.PROBLEMS[name][1]
        result += [(name, size) for size in (map(int, sizes.split(",")) if sizes else known if every else known[:1])]
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problems", nargs="*", metavar="PROBLEM[:FINENESS,...]")
    parser.add_argument("--all", action="store_true", help="every size of a problem")
    parser.add_argument("--pairs", type=int, default=5)
    parser.add_argument("--tolerance", choices=("matched", "own"), default="matched")
    parser.add_argument("--osculate", type=pathlib.Path, default=ROOT / "build/release/bin/osculate")
    parser.add_argument("--ccx", default="ccx")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FILE")
    options = parser.parse_args()
    rows = []
    try:
        for name, fineness in chosen(options.problems, options.all):
            rows.append(row_of(name, fineness, measure(name, fineness, options)))
            print(" | ".join(line_of(rows[-1])), file=sys.stderr, flush=True)
    except (RuntimeError, ValueError) as error:
        print(f"beside_ccx.py: {error}", file=sys.stderr)
        return 1
    print(table(HEADS, map(line_of, rows)))
    if options.keep:
        keep(rows, options.keep)
    different = [r["problem"] for r in rows if r["difference"] > FORCE_LIMIT]
    if different:
        print(f"beside_ccx.py: the forces differ by more than {FORCE_LIMIT:.0%}: {different}", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
