"""The problems of the comparison with CalculiX, and its figures, without running either program."""
import contextlib
import importlib.util
import io
import pathlib
import re
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
spec = importlib.util.spec_from_file_location("beside_ccx", ROOT / "benchmarks/beside_ccx.py")
beside = importlib.util.module_from_spec(spec)
spec.loader.exec_module(beside)
problems = beside.problems


def blocks_of(deck):
    """[(keyword line, data lines)] of a deck."""
    found = []
    for line in deck.splitlines():
        if line.startswith("*"):
            found.append((line, []))
        else:
            found[-1][1].append(line)
    return found


class Records(unittest.TestCase):
    def test_pages_have_what_was_kept(self):
        sys.path.insert(0, str(ROOT / "benchmarks"))
        import records
        rows = records.history()
        self.assertGreater(len(rows), 10)
        for name in records.PAGES:
            with self.subTest(page=name):
                text = (ROOT / name).read_text()
                self.assertIn("<!-- history ", text)
                self.assertEqual(records.renewed(text, rows), text, "benchmarks/records.py --write")
                self.assertNotEqual(records.renewed(text, [{**row, "seconds": 1e9} for row in rows]), text)


class Problems(unittest.TestCase):
    def setUp(self):
        self.decks = {name: make(4, 1e-9) for name, (make, _) in problems.PROBLEMS.items()}

    def nodes(self, deck):
        return {int(w[0]): tuple(map(float, w[1:])) for key, lines in blocks_of(deck) if key.startswith("*NODE,")
                for w in (line.split(",") for line in lines)}

    def test_cells_are_not_inside_out(self):
        for name, deck in self.decks.items():
            nodes = self.nodes(deck)
            for key, lines in blocks_of(deck):
                for line in lines if key.startswith("*ELEMENT") else []:
                    p = [nodes[int(n)] for n in line.split(",")[1:]]
                    a, b = ([y - x for x, y in zip(p[0], p[k])] for k in (1, 3))
                    size = a[0] * b[1] - a[1] * b[0]
                    if len(p) == 8:
                        size *= p[4][2] - p[0][2]
                    self.assertGreater(size, 0, f"{name}: {line}")

    def test_the_sides_face_each_other(self):
        for name, deck in self.decks.items():
            nodes, sets = self.nodes(deck), {k.split("NSET=")[1]: lines for k, lines in blocks_of(deck)
                                             if k.startswith("*NSET")}
            slave, master = next(lines for k, lines in blocks_of(deck) if k.startswith("*CONTACT PAIR"))[0].split(", ")
            lowest = min(nodes[int(n.strip(" ,"))][-1] for n in sets[slave.removesuffix("_FACES")])
            top = {nodes[int(n.strip(" ,"))][-1] for n in sets[master.removesuffix("_FACES")]}
            self.assertEqual(len(top), 1, name)
            self.assertGreaterEqual(lowest, top.pop(), name)

    def test_finer_is_finer(self):
        for name, (make, sizes) in problems.PROBLEMS.items():
            counts = [len(self.nodes(make(n, None))) for n in (4, 6)]
            self.assertLess(counts[0], counts[1], name)
            self.assertEqual(list(sizes), sorted(sizes))

    def test_own_tolerances_have_no_controls(self):
        make = problems.PROBLEMS["blocks"][0]
        self.assertNotIn("*CONTROLS", make(4, None))
        self.assertEqual(self.decks["blocks"].count("*CONTROLS"), 2)


class Figures(unittest.TestCase):
    def run_of(self, cpu, forces):
        return beside.Run(cpu, 10.0, 4.0, 100, 7, 3, forces, {**dict.fromkeys(beside.PHASES, 0.1), "total": 1.0})

    def test_forces_differ_by_their_share_of_the_largest(self):
        self.assertAlmostEqual(beside.force_difference([(1, 0, 2)], [(1, 0.02, 2)]), 0.01)
        with self.assertRaisesRegex(RuntimeError, "1 and 2 increments"):
            beside.force_difference([(1, 0, 2)], [(1, 0, 2), (1, 0, 2)])

    def test_ratios_are_those_of_pairs(self):
        pairs = [(self.run_of(1, [(1, 0, 0)]), self.run_of(c, [(1, 0, 0)])) for c in (2, 5, 3)]
        row = beside.row_of("blocks", 4, pairs)
        self.assertEqual((row["ratio"], row["from"], row["to"]), (3, 2, 5))
        self.assertEqual(len(beside.line_of(row)), len(beside.HEADS))

    def test_rows_are_kept(self):
        row = beside.row_of("blocks", 4, [(self.run_of(1, [(1, 0, 0)]), self.run_of(2, [(1, 0, 0)]))])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "history.csv"
            beside.keep([row], path)
            beside.keep([row], path)
            lines = path.read_text().splitlines()
        self.assertEqual(len(lines), 3)
        self.assertTrue(re.match(r"\d{4}-\d\d-\d\d,[^,]+,blocks:4,100,", lines[1]))

    def test_columns_are_those_of_the_record(self):
        row = beside.row_of("blocks", 4, [(self.run_of(1, [(1, 0, 0)]), self.run_of(2, [(1, 0, 0)]))])
        with open(ROOT / "benchmarks/history.csv") as file:
            self.assertEqual(file.readline().strip().split(","), ["day", "commit", *row])

    def test_pages_of_its_own_are_fewer_than_all(self):
        with tempfile.TemporaryDirectory() as folder:
            _, memory, own, text = beside.timed([sys.executable, "-c", "x = bytearray(50_000_000); print(len(x))"], pathlib.Path(folder))
        self.assertEqual(text, "50000000\n")
        self.assertGreater(own, 45)
        self.assertGreater(memory, own)

    def test_problems_are_chosen_by_name(self):
        self.assertEqual(beside.chosen(["blocks:7,9"], False), [("blocks", 7), ("blocks", 9)])
        self.assertEqual([name for name, _ in beside.chosen([], False)], list(problems.PROBLEMS))
        with self.assertRaisesRegex(ValueError, "no problem 'block'"):
            beside.chosen(["block"], False)

    def test_help_names_the_tolerances(self):
        out = io.StringIO()
        with self.assertRaises(SystemExit), contextlib.redirect_stdout(out):
            sys.argv = ["beside_ccx.py", "--help"]
            beside.main()
        self.assertIn("{matched,own}", out.getvalue())


if __name__ == "__main__":
    unittest.main()
