#!/usr/bin/env python3
"""CalculiX's own decks in Osculate and in ccx, their displacements side by side.

    tests/decks/beside_ccx.py [--osculate PROGRAM] [--ccx PROGRAM] [--examples FOLDER] [--write FILE] [DECK...]
    tests/decks/beside_ccx.py --test --osculate PROGRAM      every quick row of rows.txt must hold

rows.txt has the decks, what they may differ by, and why. The decks are those of Debian's package
calculix-ccx-test, ccx that of calculix-ccx. Both read the same deck, but for its requests of
output: at the end of each step the displacements of all nodes. What is compared is the state that
either leaves at the end: the largest difference of a node's displacement over the largest displacement,
likewise of its force (reaction and load), and the largest contact pressures; of decks that look for
vibrations at their end the frequencies. Seconds are those of the processor, of both cores together.
"""
import argparse
import gzip
import json
import math
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = "/usr/share/doc/calculix-ccx-test/examples/test"
OUTPUT = ("NODEFILE", "ELFILE", "CONTACTFILE", "NODEOUTPUT", "ELEMENTOUTPUT", "CONTACTOUTPUT", "NODEPRINT",
          "ELPRINT", "CONTACTPRINT", "FACEPRINT", "SECTIONPRINT", "OUTPUT", "RESTART")


class Row:
    """A line of rows.txt: deck, kind, tolerance of the displacements, whether it is quick, reason."""

    def __init__(self, line):
        self.deck, self.kind, tolerance, self.speed, *reason = line.split(None, 4)
        self.tolerance = float(tolerance)
        self.reason = reason[0].strip() if reason else ""


def rows():
    lines = (HERE / "rows.txt").read_text().splitlines()
    return [Row(line) for line in lines if line.strip() and not line.startswith("#")]


def text_of(examples, deck):
    for suffix, opened in ((".inp", open), (".inp.gz", gzip.open)):
        path = pathlib.Path(examples) / (deck + suffix)
        if path.exists():
            with opened(path, "rt", errors="replace") as file:
                return file.read()
    raise FileNotFoundError(f"no deck '{deck}' in {examples}")


def asking_for_results(text):
    """The deck whose steps write displacements and forces of all nodes and contact, and nothing else."""
    lines, skipped = [], False
    wanted = ["*NODE FILE, OUTPUT=2D", "U, RF"]
    if re.search(r"^\*\s*contact\s*pair", text, re.I | re.M):
        wanted += ["*CONTACT FILE", "CDIS, CSTR"]
    for line in text.splitlines():
        if line.startswith("*") and not line.startswith("**"):
            keyword = line[1:].split(",")[0].replace(" ", "").upper()
            skipped = keyword in OUTPUT
            if keyword == "ENDSTEP":
                lines += wanted
        if not skipped:
            lines.append(line)
    return "\n".join(lines) + "\n"


def run(command, folder, limit, threads=1):
    """What it said, its code, and its seconds of the processor; code None: it was stopped."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    environment = os.environ | {"OMP_NUM_THREADS": str(threads)}
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=limit, env=environment)
        code, said, error = done.returncode, done.stdout, done.stderr
    except subprocess.TimeoutExpired:
        code, said, error = None, "", f"stopped after {limit} s"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return code, said, error, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def blocks_of_frd(path):
    """The last results of every kind in a result file: by name, by node, the components."""
    found, name = {}, None
    with open(path, errors="replace") as file:
        for line in file:
            if line.startswith(" -4"):
                name, block = line.split()[1], {}
            elif name and line.startswith(" -1"):
                block[int(line[3:13])] = [float(line[k:k + 12]) for k in range(13, len(line.rstrip()) - 11, 12)]
            elif name and line.startswith(" -3"):
                found[name], name = block, None
    return found


def difference(ours, theirs):
    """(Largest vector, largest difference over it, number of nodes that both have.)"""
    common = [node for node in ours if node in theirs]
    largest = max((math.hypot(*u[:3]) for u in theirs.values()), default=0.0)
    if not common or largest == 0.0:
        return largest, math.nan, len(common)
    return largest, max(math.dist(ours[n][:3], theirs[n][:3]) for n in common) / largest, len(common)


def pressure_difference(ours, theirs):
    """Of the largest contact pressures; nan where a file has none."""
    largest = [max((v[3] for v in block.values() if len(v) > 3), default=0.0) for block in (ours, theirs)]
    return abs(largest[0] / largest[1] - 1) if min(largest) > 0 else math.nan


def frequencies_of_dat(path):
    """Of all steps, one behind the other, each in order."""
    steps, inside = [], False
    for line in open(path, errors="replace"):
        words = line.split()
        if "E I G E N V A L U E" in line:
            steps.append([])
            inside = True
        elif "P A R T I C I P A T I O N" in line:
            inside = False
        elif inside and len(words) in (4, 5) and words[0].isdigit():
            steps[-1].append(float(words[-2]))
    return [sorted(step) for step in steps]


def frequency_difference(ours, theirs):
    """Largest difference of frequencies over the largest of their step; of those that both have."""
    if len(ours) != len(theirs) or not ours:
        return math.nan
    return max(abs(a - b) / max(map(abs, there))
               for here, there in zip(ours, theirs) for a, b in zip(here, there))


def compare(row, options):
    """What both programs made of a deck, as a dictionary; `wrong` says why there is no number."""
    result = {"deck": row.deck}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        text = asking_for_results(text_of(options.examples, row.deck))
        (folder / "deck.inp").write_text(text)
        for file in pathlib.Path(options.examples).glob(row.deck + ".*"):
            if not file.name.startswith((row.deck + ".inp", row.deck + ".dat", row.deck + ".frd")):
                shutil.copy(file, folder)
        code, said, error, result["seconds"] = run(
            [options.osculate, "run", "deck.inp", "--json", "-o", "ours"], folder, options.limit)
        if code != 0:
            return result | {"wrong": "osculate: " + (error.strip().splitlines() or ["?"])[-1][:160]}
        vibrations = [[mode["frequency"] for mode in step["modes"]["found"]]
                      for step in json.loads(said)["steps"] if step.get("modes")]
        result["iterations"] = sum(i["iterations"] for s in json.loads(said)["steps"] for i in s["increments"])
        code, said, error, result["ccx_seconds"] = run([options.ccx, "-i", "deck"], folder, options.limit)
        said += error
        theirs = blocks_of_frd(folder / "deck.frd") if (folder / "deck.frd").exists() else {}
        if code is None or "*ERROR" in said or not (theirs or row.kind.endswith("modes")):
            at = said.find("*ERROR")
            return result | {"wrong": "ccx: " + (said[at:at + 120].replace("\n", " ") if at >= 0 else error)}
        cvg = folder / "deck.cvg"
        result["ccx_iterations"] = not cvg.exists() or sum(line[:1] == " " and line.strip()[:1].isdigit()
                                       for line in cvg.read_text().splitlines())
        if row.kind.endswith("modes"):
            return result | {"nodes": 0, "difference":
                             frequency_difference(vibrations, frequencies_of_dat(folder / "deck.dat"))}
        ours = blocks_of_frd(next((folder / "ours").glob("*.frd")))
        _, result["difference"], result["nodes"] = difference(ours["DISP"], theirs["DISP"])
        _, result["forces"], _ = difference(ours.get("FORC", {}), theirs.get("FORC", {}))
        result["pressure"] = pressure_difference(ours.get("CONTACT", {}), theirs.get("CONTACT", {}))
    return result


def percent(value):
    return "" if value is None or math.isnan(value) else f"{100 * value:.2g} %"


def line_of(row, result):
    reason = row.reason.replace("|", "/")
    if "wrong" in result:
        return f"| {row.deck} | | | | | | | {(reason + ' ' + result['wrong']).strip()} |"
    return (f"| {row.deck} | {result['nodes'] or ''} | {percent(result['difference'])} | "
            f"{percent(result.get('forces'))} | {percent(result.get('pressure'))} | "
            f"{result['iterations']} / {result['ccx_iterations']} | "
            f"{result['seconds']:.2f} / {result['ccx_seconds']:.2f} | {reason} |")


def holds(row, result):
    return "wrong" not in result and result["difference"] <= row.tolerance


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("decks", nargs="*", metavar="DECK")
    parser.add_argument("--osculate", default="osculate", metavar="PROGRAM")
    parser.add_argument("--ccx", default="ccx", metavar="PROGRAM")
    parser.add_argument("--examples", default=EXAMPLES, metavar="FOLDER")
    parser.add_argument("--limit", type=float, default=120, metavar="SECONDS")
    parser.add_argument("--kind", help="rows of this kind only")
    parser.add_argument("--test", action="store_true", help="quick rows only, each must hold")
    parser.add_argument("--write", metavar="FILE", help="the table goes there")
    options = parser.parse_args()
    options.osculate = os.path.abspath(options.osculate) if os.path.exists(options.osculate) else options.osculate
    known = {row.deck: row for row in rows()}
    chosen = [known.get(d) or Row(f"{d} ? 0.01 slow") for d in options.decks] or list(known.values())
    if options.kind:
        chosen = [row for row in chosen if row.kind == options.kind]
    if options.test:
        if not shutil.which(options.ccx) or not os.path.isdir(options.examples):
            print("no ccx or no decks (Debian: calculix-ccx, calculix-ccx-test)")
            return 77
        chosen = [row for row in chosen if row.speed == "quick"]
    lines = ["| deck | nodes | displacements | forces | pressure | iterations | seconds | |",
             "|---|---|---|---|---|---|---|---|"]
    failed = 0
    for row in chosen:
        result = compare(row, options)
        lines.append(line_of(row, result))
        good = holds(row, result)
        failed += not good
        print(("ok      " if good else "DIFFERS ") + lines[-1], flush=True)
    if options.write:
        pathlib.Path(options.write).write_text("\n".join(lines) + "\n")
    print(f"{len(chosen) - failed} of {len(chosen)} hold")
    return 1 if options.test and failed else 0


if __name__ == "__main__":
    sys.exit(main())
