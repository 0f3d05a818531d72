#!/usr/bin/env python3
"""Tables of the pages from what benchmarks/beside_ccx.py has kept (benchmarks/history.csv), so that page and record cannot differ.

    benchmarks/records.py            says which pages differ (exit code 1)
    benchmarks/records.py --write    puts the tables into them

A table stands between `<!-- history WHICH -->` and `<!-- end -->`. WHICH is a day (its rows), or `latest` (the last row of each problem, with its day).
"""
import csv
import pathlib
import re
import sys

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "benchmarks"))
import beside_ccx  # noqa: E402

PAGES = ("benchmarks/README.md", "docs/performance.md")
NUMBERS = {"seconds", "seconds_ccx", "ratio", "from", "to", "memory", "memory_ccx", "own", "own_ccx", "difference", *beside_ccx.PHASES}


def history(path=ROOT / "benchmarks/history.csv"):
    """Rows as beside_ccx.row_of has them, and their day; what was not noted is missing."""
    with path.open(newline="") as file:
        return [{k: float(v) if k in NUMBERS else v for k, v in row.items() if v != ""} for row in csv.DictReader(file, restval="")]


def table(rows, which):
    """The rows of a day, or the last one of each problem."""
    if which == "latest":
        last = {row["problem"]: row for row in rows}
        return beside_ccx.table(["day", *beside_ccx.HEADS], [[row["day"], *beside_ccx.line_of(row)] for row in last.values()])
    chosen = [row for row in rows if row["day"] == which]
    if not chosen:
        raise SystemExit(f"benchmarks/records.py: no rows of {which}")
    return beside_ccx.table(beside_ccx.HEADS, map(beside_ccx.line_of, chosen))


def renewed(page, rows):
    """The text of a page with its tables as the rows have them."""
    return re.sub(r"(<!-- history (\S+) -->\n).*?(<!-- end -->)",
                  lambda found: f"{found[1]}{table(rows, found[2])}\n{found[3]}", page, flags=re.S)


def main():
    rows, differ = history(), []
    for name in PAGES:
        text = (ROOT / name).read_text()
        new = renewed(text, rows)
        if new != text:
            differ.append(name)
            if "--write" in sys.argv[1:]:
                (ROOT / name).write_text(new)
    if differ and "--write" not in sys.argv[1:]:
        print(f"not as benchmarks/history.csv has it: {', '.join(differ)}; benchmarks/records.py --write")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
