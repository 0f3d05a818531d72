#!/usr/bin/env python3
"""CalculiX's own decks and those of FreeCAD in Osculate and in ccx, their displacements side by side.

    tests/decks/beside_ccx.py [--osculate PROGRAM] [--ccx PROGRAM] [--write FILE] [DECK...]
    tests/decks/beside_ccx.py --test --osculate PROGRAM      every quick row of rows.txt must hold
    tests/decks/beside_ccx.py --osculate PROGRAM --write docs/decks.md      all rows, and what is refused

rows.txt has the decks, what they may differ by, and why. The decks are those of Debian's packages
calculix-ccx-test and freecad-common (these begin with `freecad/`), and those of the folder own beside this file (`own/`), of what
those do not have; ccx is that of calculix-ccx. Both read the same deck, but for its requests of
output: in each step the displacements of all nodes. Displacements are compared at all times that both wrote, the
ends of steps among them: the largest difference of a node's displacement over the largest displacement of that
time (or a hundredth of that of all times, where it is more). Of the state that either leaves at the end are
compared forces (reaction and load) likewise, and the largest contact pressures; of decks that look for
vibrations at their end the frequencies, of those that look for buckling loads the factors. Nodes of shells, beams, trusses and of
plane elements beside others, which have no cell of the
solids that those become, are compared by the tables of displacements (.dat), all others by the result files (.frd). Seconds are those of the processor, of both cores together.
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
import typing

HERE = pathlib.Path(__file__).resolve().parent
OUTPUT = ("NODEFILE", "ELFILE", "CONTACTFILE", "NODEOUTPUT", "ELEMENTOUTPUT", "CONTACTOUTPUT", "NODEPRINT",
          "ELPRINT", "CONTACTPRINT", "FACEPRINT", "SECTIONPRINT", "OUTPUT", "RESTART")
PRINTED = "NODESOFLINES"


class Collection(typing.NamedTuple):
    """Decks of one folder: their names begin with the prefix."""
    prefix: str
    folder: pathlib.Path
    package: str
    title: str

    def decks(self):
        """The names of all, without rows or with."""
        return {self.prefix + re.sub(r"\.inp(\.gz)?$", "", path.name) for path in self.folder.iterdir()
                if re.search(r"\.inp(\.gz)?$", path.name)}


COLLECTIONS = (
    Collection("own/", HERE / "own", "", "Own decks"),
    Collection("freecad/", pathlib.Path("/usr/share/freecad/Mod/Fem/femtest/data/calculix"), "freecad-common",
               "FreeCAD's decks"),
    Collection("", pathlib.Path("/usr/share/doc/calculix-ccx-test/examples/test"), "calculix-ccx-test",
               "CalculiX' decks"))


def collection_of(deck):
    return next(collection for collection in COLLECTIONS if deck.startswith(collection.prefix))


class Row:
    """A line of rows.txt: deck, kind, tolerance of the displacements, whether it is quick, reason."""

    def __init__(self, line):
        self.deck, self.kind, tolerance, self.speed, *reason = line.split(None, 4)
        self.tolerance = float(tolerance)
        self.reason = reason[0].strip() if reason else ""


def rows():
    lines = (HERE / "rows.txt").read_text().splitlines()
    return [Row(line) for line in lines if line.strip() and not line.startswith("#")]


def text_of(deck):
    collection = collection_of(deck)
    for suffix, opened in ((".inp", open), (".inp.gz", gzip.open)):
        path = collection.folder / (deck.removeprefix(collection.prefix) + suffix)
        if path.exists():
            with opened(path, "rt", errors="replace") as file:
                return file.read()
    raise FileNotFoundError(f"no deck '{deck}' in {collection.folder}")


def put(deck, folder):
    """The deck as deck.inp, with the files beside it that it may include. Its text as it stands there."""
    text = asking_for_results(text_of(deck))
    (folder / "deck.inp").write_text(text)
    collection = collection_of(deck)
    name = deck.removeprefix(collection.prefix)
    for file in collection.folder.glob(name + ".*"):
        if not file.name.startswith((name + ".inp", name + ".dat", name + ".frd")):
            shutil.copy(file, folder)
    return text


def nodes_of_lines(text):
    """Of shells, beams, trusses and of plane elements beside others, which become solids of which these are no part,
    and of springs."""
    nodes, inside, element = set(), False, True
    kinds = r"B3|S\d|T3D|SPRING|DASHPOT|GAP|MASS"
    if re.search(r"^\*\s*element\b[^\n]*type\s*=\s*(C3D|B3|S\d|T3D)", text, re.I | re.M):
        kinds += "|CPE|CPS|CAX"
    for line in text.splitlines():
        if line.startswith("**") or not line.strip():
            continue
        if line.startswith("*"):
            inside = bool(re.match(rf"\*\s*element\b[^\n]*type\s*=\s*({kinds})", line, re.I))
            element = True
        elif inside:
            numbers = [int(word) for word in re.split(r"[,\s]+", line) if word.isdigit()]
            nodes.update(numbers[1:] if element else numbers)
            element = not line.rstrip().endswith(",")
    return sorted(nodes)


def asking_for_results(text):
    """The deck whose steps write displacements and forces of all nodes and contact, and nothing else."""
    lines, skipped = [], False
    wanted = ["*NODE FILE, OUTPUT=2D", "U, RF"]
    if re.search(r"^\*\s*contact\s*pair", text, re.I | re.M):
        wanted += ["*CONTACT FILE", "CDIS, CSTR"]
    nodes = nodes_of_lines(text)
    if nodes:
        wanted += [f"*NODE PRINT, NSET={PRINTED}", "U"]
    if re.search(r"^(?!\*)(.*,)?\s*ENER\s*(,|$)", text, re.I | re.M):
        wanted += ["*EL FILE", "ENER"]  # without it ccx refuses balances of energy
    for line in text.splitlines():
        if line.startswith("*") and not line.startswith("**"):
            keyword = line[1:].split(",")[0].replace(" ", "").upper()
            skipped = keyword in OUTPUT
            if keyword == "ENDSTEP":
                lines += wanted
            if keyword == "STEP" and nodes:
                lines += [f"*NSET, NSET={PRINTED}"] + [f"{node}," for node in nodes]
                nodes = []
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


def results_of_frd(path):
    """Of a result file, in order: (name, time or None of a vibration, by node the components)."""
    name, time, of_mode = None, 0.0, False
    with open(path, errors="replace") as file:
        for line in file:
            if line.startswith("    1PSTEP"):
                of_mode = False
            elif line.startswith("    1PMODE"):
                of_mode = True
            elif line.startswith("  100C"):
                time = None if of_mode else float(line[12:24])
            elif line.startswith(" -4"):
                name, block = line.split()[1], {}
            elif name and line.startswith(" -1"):
                block[int(line[3:13])] = [float(line[k:k + 12]) for k in range(13, len(line.rstrip()) - 11, 12)]
            elif name and line.startswith(" -3"):
                yield name, time, block
                name = None


def blocks_of_frd(path):
    """The last results of every kind in a result file: by name, by node, the components."""
    return {name: block for name, _, block in results_of_frd(path)}


def places_of_frd(path):
    """Of the nodes, by number."""
    found, inside = {}, False
    for line in open(path, errors="replace"):
        if line.startswith("    2C"):
            inside = True
        elif line.startswith(" -3"):
            break
        elif inside and line.startswith(" -1"):
            found[int(line[3:13])] = [float(line[k:k + 12]) for k in range(13, 49, 12)]
    return found


def nodes_elsewhere(folder):
    """Whose numbers both programs gave to nodes at other places: both add some to those of the deck."""
    files = [next(place.glob("*.frd"), None) for place in (folder / "ours", folder)]
    if None in files:
        return set()
    here, there = map(places_of_frd, files)
    size = max((abs(c) for place in there.values() for c in place), default=0.0)
    return {node for node in here if node in there and math.dist(here[node], there[node]) > 1e-3 * size}


def displacements(folder):
    """By time, by node: of the result file, and of the table of the nodes that the deck prints."""
    frd, dat = next(folder.glob("*.frd"), None), next(folder.glob("*.dat"), None)
    found = {time: block for name, time, block in results_of_frd(frd)
             if name == "DISP" and time is not None} if frd else {}
    inside, of_mode = None, False
    for line in open(dat, errors="replace") if dat else []:
        words = line.split()
        if "N U M B E R" in line:
            of_mode = True
        elif words[:1] == ["displacements"]:
            inside = at_time(found, float(words[-1])) if PRINTED in words and not of_mode else None
            of_mode = False
        elif words and not words[0].isdigit():
            inside = None
        elif words and inside is not None:
            inside[int(words[0])] = [float(word) for word in words[1:4]]
    return found


def at_time(states, time):
    """What there is of a time, to the digits of a table; made where there is nothing yet."""
    near = next((known for known in reversed(states) if abs(known - time) <= 1e-5 * max(abs(time), 1e-30)), time)
    return states.setdefault(near, {})


def difference_at_all_times(ours, theirs, without=frozenset()):
    """(Largest difference, its time, number of nodes of the last time) of states of times that both have. No number
    where the last one in which something moves is not among them."""
    largest = max((math.hypot(*u[:3]) for state in theirs.values() for u in state.values()), default=0.0)
    worst, when, nodes, ends = math.nan, math.nan, 0, False
    for time, state in theirs.items():
        here = {node: u for node, u in at_time(ours, time).items() if node not in without}
        size, found, count = difference(here, state)
        if size == 0:
            continue
        ends = count > 0 and not math.isnan(found)
        if count:
            found *= size / max(size, 0.01 * largest)
            nodes = count
            if not found <= worst:
                worst, when = found, time
            if math.isnan(found):
                return math.nan, time, nodes
    return worst if ends else math.nan, when, nodes


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
    """Of all steps, one behind the other, each in order; 0: below those that were asked for."""
    steps, inside = [], False
    for line in open(path, errors="replace"):
        words = line.split()
        if "E I G E N V A L U E   O U T P U T" in line:
            steps.append([])
            inside = True
        elif "P A R T I C I P A T I O N" in line:
            inside = False
        elif inside and len(words) == 6 and words[0].isdigit():  # a sector: all sectors alike come twice there
            if words[0] != "0" or int(words[1]) % 2:
                steps[-1].append(float(words[-2]))
        elif inside and len(words) in (4, 5) and words[0].isdigit():
            steps[-1] += [0.0] * (int(words[0]) - 1 - len(steps[-1])) + [float(words[-2])]
    return [sorted(step) for step in steps]


def factors_of_dat(path):
    """Of all steps that look for buckling loads, in order."""
    steps, inside = [], False
    for line in open(path, errors="replace"):
        words = line.split()
        if "B U C K L I N G   F A C T O R" in line:
            steps.append([])
            inside = True
        elif inside and len(words) == 2 and words[0].isdigit():
            steps[-1].append(float(words[1]))
        elif "O U T P U T" in line:
            inside = False
    return steps


def frequency_difference(ours, theirs):
    """Largest difference of frequencies (or factors) over the largest of their step; of those that both have."""
    if len(ours) != len(theirs) or not ours:
        return math.nan
    return max(abs(a - b) / max(map(abs, there))
               for here, there in zip(ours, theirs) for a, b in zip(here, there))


def user_material(options, folder):
    """The library of decks with *USER MATERIAL: Hooke's law, as CalculiX has compiled in; none: no compiler."""
    compiler, source = shutil.which("cc"), HERE.parent.parent
    library = pathlib.Path(folder) / "metal.so"
    if compiler:
        subprocess.run([compiler, "-shared", "-fPIC", "-O2", "-I", source / "include", "-o", library,
                        source / "examples" / "user_material" / "metal.c", "-lm"], check=True)
        os.environ["OSCULATE_USER_MATERIAL"] = str(library)


def compare(row, options):
    """What both programs made of a deck, as a dictionary; `wrong` says why there is no number."""
    result = {"deck": row.deck}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        text = put(row.deck, folder)
        if re.search(r"^\*\s*USER\s*MATERIAL", text, re.I | re.M):
            user_material(options, folder)
        code, said, error, result["seconds"] = run(
            [options.osculate, "run", "deck.inp", "--json", "-o", "ours"], folder, options.limit)
        if code != 0:
            return result | {"wrong": "osculate: " + (error.strip().splitlines() or ["?"])[-1][:160]}
        vibrations = [[mode["frequency"] for mode in step["modes"]["found"]]
                      for step in json.loads(said)["steps"] if step.get("modes")]
        factors = [step["buckling"]["factors"] for step in json.loads(said)["steps"] if step.get("buckling")]
        result["iterations"] = sum(i["iterations"] for s in json.loads(said)["steps"] for i in s["increments"])
        code, said, error, result["ccx_seconds"] = run([options.ccx, "-i", "deck"], folder, options.limit)
        said += error
        theirs = blocks_of_frd(folder / "deck.frd") if (folder / "deck.frd").exists() else {}
        if code is None or "*ERROR" in said or not (theirs or row.kind.endswith("modes") or row.kind == "buckling"):
            at = said.find("*ERROR")
            return result | {"wrong": "ccx: " + (said[at:at + 120].replace("\n", " ") if at >= 0 else error)}
        cvg = folder / "deck.cvg"
        result["ccx_iterations"] = not cvg.exists() or sum(line[:1] == " " and line.strip()[:1].isdigit()
                                       for line in cvg.read_text().splitlines())
        if row.kind == "buckling":
            return result | {"nodes": 0, "difference":
                             frequency_difference(factors, factors_of_dat(folder / "deck.dat"))}
        if row.kind.endswith("modes"):
            return result | {"nodes": 0, "difference":
                             frequency_difference(vibrations, frequencies_of_dat(folder / "deck.dat"))}
        ours = blocks_of_frd(next((folder / "ours").glob("*.frd")))
        moved = displacements(folder)
        result["difference"], result["time"], result["nodes"] = difference_at_all_times(
            displacements(folder / "ours"), moved, nodes_elsewhere(folder))
        result["end"] = max(moved, default=0.0)
        if "DISPI" in theirs:  # the imaginary parts of what swings
            _, imaginary, _ = difference(ours["DISPI"], theirs["DISPI"])
            result["difference"] = max(result["difference"], imaginary)
        _, result["forces"], _ = difference(ours.get("FORC", {}), theirs.get("FORC", {}))
        result["pressure"] = pressure_difference(ours.get("CONTACT", {}), theirs.get("CONTACT", {}))
    return result


def percent(value):
    if value is None or math.isnan(value):
        return ""
    return f"{100 * value:.0f} %" if value >= 1 else f"{100 * value:.2g} %"


def line_of(row, result):
    reason = row.reason.replace("|", "/")
    if result.get("difference", 0) > row.tolerance and result.get("time", math.nan) < result.get("end", math.nan):
        reason = f"(at {result['time']:.4g} of {result['end']:.4g}) {reason}"
    name = row.deck.removeprefix(collection_of(row.deck).prefix)
    if "wrong" in result:
        return f"| {name} | | | | | | | {(reason + ' ' + result['wrong']).strip()} |"
    return (f"| {name} | {result['nodes'] or ''} | {percent(result['difference'])} | "
            f"{percent(result.get('forces'))} | {percent(result.get('pressure'))} | "
            f"{result['iterations']} / {result['ccx_iterations']} | "
            f"{result['seconds']:.2f} / {result['ccx_seconds']:.2f} | {reason} |")


# Procedures (and what belongs to them) that Osculate has none of: a deck is refused for these, whichever line it stops at.
ANALYSES = {
    "HEATTRANSFER": "temperatures are solved for (with flow through networks and radiation)",
    "COUPLEDTEMPERATURE-DISPLACEMENT": "temperatures are solved for (with flow through networks and radiation)",
    "UNCOUPLEDTEMPERATURE-DISPLACEMENT": "temperatures are solved for (with flow through networks and radiation)",
    "CFD": "flow (`*CFD`)",
    "ELECTROMAGNETICS": "`*ELECTROMAGNETICS`",
    "COMPLEXFREQUENCY": "`*COMPLEX FREQUENCY`",
    "SENSITIVITY": "sensitivities",
    "DESIGNVARIABLES": "sensitivities",
    "SUBSTRUCTUREGENERATE": "`*SUBSTRUCTURE GENERATE`",
}


def refusal(text, message):
    """Why a deck is refused, in the words of its table: its analysis, else the first message."""
    keywords = {line[1:].split(",")[0].replace(" ", "").strip().upper()
                for line in text.splitlines() if line.startswith("*")}
    for keyword, reason in ANALYSES.items():
        if keyword in keywords:
            return reason
    lines = [line for line in message.splitlines() if line.startswith("error:")] or [message.strip()]
    said = re.sub(r"^error: (deck\.inp:)?\s*(\d+: )?([\w\[\].]+: )?('[^']*' and '[^']*': )?", "", lines[0])
    said = re.sub(r"; known: .*|: in a model file.*|; a model file.*", "", said)
    keyword = re.match(r"\*(\w[\w-]*): (.*)", said)
    if not keyword:
        return said.replace("|", "/")
    spelled = next((line[1:].split(",")[0].strip().upper() for line in text.splitlines() if line.startswith("*")
                    and line[1:].split(",")[0].replace(" ", "").strip().upper() == keyword[1]), keyword[1])
    what = re.sub(r" ?(is|are) not (supported|translated).*", "", keyword[2])
    return f"`*{spelled}`" + (f": {what}" if what else "")


def refused(options, collection, with_rows):
    """Decks by the reason why `osculate check` refuses them; those that it takes though they have no row."""
    reasons, taken = {}, []
    for deck in sorted(collection.decks() - with_rows):
        with tempfile.TemporaryDirectory() as folder:
            put(deck, pathlib.Path(folder))
            code, said, error, _ = run([options.osculate, "check", "deck.inp"], folder, options.limit)
        name = deck.removeprefix(collection.prefix)
        if code == 0:
            taken.append(name)
        else:
            reasons.setdefault(refusal(text_of(deck), error or said), []).append(name)
    return sorted(reasons.items(), key=lambda item: (-len(item[1]), item[0])), taken


HEAD = ["| deck | nodes | displacements | forces | pressure | iterations | seconds | |",
        "|---|---|---|---|---|---|---|---|"]


def section(collection, compared, options):
    """Of the page: what was compared of a collection, and what is refused."""
    of_it = [(row, result) for row, result in compared if collection_of(row.deck) is collection]
    reasons, taken = refused(options, collection, {row.deck for row in rows()})
    count = sum(len(decks) for _, decks in reasons)
    good = sum(holds(row, result) for row, result in of_it)
    text = [
        f"## {collection.title}", "",
        f"{len(of_it)} decks have a row, {good} of them hold, the others say why not; {count} decks are refused.", "",
        *HEAD, *(line_of(row, result) for row, result in of_it), ""]
    if reasons:
        text += [
            "Refused, by the analysis that Osculate has none of, else by the first message: behind it there may be others.",
            "", "| reason | decks | |", "|---|---|---|",
            *(f"| {reason} | {len(decks)} | {', '.join(decks)} |" for reason, decks in reasons), ""]
    if taken:
        text += ["Read, but without an answer to compare within the limits of time and convergence: "
                 + ", ".join(taken) + ".", ""]
    return text


def page(compared, options):
    """docs/decks.md."""
    version = subprocess.run([options.ccx, "-v"], capture_output=True, text=True).stdout
    version = (re.findall(r"\d+\.\d+", version) or ["?"])[0]
    text = [
        "# Decks of CalculiX and FreeCAD, and own ones", "",
        f"The decks that come with CalculiX {version} (Debian's package calculix-ccx-test) and those by which FreeCAD tests what it",
        "writes for CalculiX (freecad-common), and own ones of what those do not have, in Osculate and in CalculiX. Both read the",
        "same deck. Displacements: largest difference at a node over the largest displacement, the worst of all times that both wrote;",
        "of the state that either leaves at the end, the same of forces; of decks that end with vibrations the same of their frequencies, of those with buckling loads the same of the factors. Of forces CalculiX'",
        "have those of constraints (sections of shells, equations) as well. Pressure: of the largest contact pressures. Iterations and seconds (of the processor) are those",
        "of Osculate / CalculiX, which counts iterations of nonlinear steps alone. [rows.txt](../tests/decks/rows.txt) has what a",
        "deck may differ by, and why; its quick rows are a test.", "",
        "To make this page again:", "", "```",
        f"apt install calculix-ccx {' '.join(collection.package for collection in reversed(COLLECTIONS) if collection.package)}",
        "tests/decks/beside_ccx.py --osculate build/release/bin/osculate --write docs/decks.md", "```", ""]
    for collection in reversed(COLLECTIONS):
        text += section(collection, compared, options)
    return "\n".join(text[:-1]) + "\n"


def holds(row, result):
    return "wrong" not in result and result["difference"] <= row.tolerance


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("decks", nargs="*", metavar="DECK")
    parser.add_argument("--osculate", default="osculate", metavar="PROGRAM")
    parser.add_argument("--ccx", default="ccx", metavar="PROGRAM")
    parser.add_argument("--limit", type=float, default=120, metavar="SECONDS")
    parser.add_argument("--kind", help="rows of this kind only")
    parser.add_argument("--test", action="store_true", help="quick rows only, each must hold")
    parser.add_argument("--write", metavar="FILE", help="the page of tables goes there")
    options = parser.parse_args()
    options.osculate = os.path.abspath(options.osculate) if os.path.exists(options.osculate) else options.osculate
    known = {row.deck: row for row in rows()}
    chosen = [known.get(d) or Row(f"{d} ? 0.01 slow") for d in options.decks] or list(known.values())
    if options.kind:
        chosen = [row for row in chosen if row.kind == options.kind]
    if options.test:
        missing = [collection for collection in COLLECTIONS if not collection.folder.is_dir()]
        chosen = [row for row in chosen if row.speed == "quick" and collection_of(row.deck) not in missing]
        if not shutil.which(options.ccx) or not chosen:
            print("no ccx or no decks (Debian: calculix-ccx, calculix-ccx-test, freecad-common)")
            return 77
        for collection in missing:
            print(f"without {collection.title} (Debian: {collection.package})")
    compared = []
    for row in chosen:
        compared.append((row, compare(row, options)))
        print(("ok      " if holds(*compared[-1]) else "DIFFERS ") + line_of(*compared[-1]), flush=True)
    if options.write:
        pathlib.Path(options.write).write_text(page(compared, options))
    good = sum(holds(*pair) for pair in compared)
    print(f"{good} of {len(compared)} hold")
    return 1 if options.test and good < len(compared) else 0


if __name__ == "__main__":
    sys.exit(main())
