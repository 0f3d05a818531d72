"""The comparison with CalculiX, without running either program."""
import importlib.util
import pathlib
import sys
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
spec = importlib.util.spec_from_file_location("compare", ROOT / "benchmarks/compare.py")
compare = importlib.util.module_from_spec(spec)
spec.loader.exec_module(compare)


def run(forces):
    return compare.Run(1.0, 1.0, 10, [3] * len(forces), forces, {})


class Decks(unittest.TestCase):
    """Both texts describe the same mesh, loads and contact."""

    def setUp(self):
        self.model = compare.parse_model("6x4:3")
        self.deck = compare.ccx_deck(self.model, "matched", "node")
        self.text = compare.osculate_model(self.model, "matched")

    def block(self, keyword):
        lines = self.deck.splitlines()
        out, at = [], lines.index(keyword) + 1
        while at < len(lines) and not lines[at].startswith("*"):
            out.append(lines[at])
            at += 1
        return out

    def test_the_same_number_of_nodes_and_elements(self):
        block, base = 7 * 5, 8 * 3  # nodes of 6 x 4 and 7 x 2 elements
        self.assertEqual(len(self.block("*NODE, NSET=ALL")), block + base)
        self.assertEqual(len(self.block("*ELEMENT, TYPE=CPE4, ELSET=BLOCK")), 6 * 4)
        self.assertEqual(len(self.block("*ELEMENT, TYPE=CPE4, ELSET=BASE")), 7 * 2)
        for counts in ("elements: [6, 4]", "elements: [7, 2]"):
            self.assertIn(counts, self.text)

    def test_elements_turn_counterclockwise(self):
        nodes = {}
        for line in self.block("*NODE, NSET=ALL"):
            n, x, y, _ = line.split(",")
            nodes[int(n)] = (float(x), float(y))
        for name in ("BLOCK", "BASE"):
            for line in self.block(f"*ELEMENT, TYPE=CPE4, ELSET={name}"):
                p = [nodes[int(n)] for n in line.split(",")[1:]]
                area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(p, p[1:] + p[:1])) / 2
                self.assertGreater(area, 0)

    def test_contact_sides_meet(self):
        nodes = dict(enumerate((tuple(map(float, line.split(",")[1:3]))
                                for line in self.block("*NODE, NSET=ALL")), 1))
        self.assertEqual({nodes[int(line.strip(" ,"))][1] for line in self.block("*NSET, NSET=TOP")},
                         {max(y for _, y in nodes.values())})
        self.assertEqual({nodes[int(line.strip(" ,"))][1] for line in self.block("*NSET, NSET=GROUND")},
                         {min(y for _, y in nodes.values())})

    def test_increments(self):
        self.assertIn("increments: 3", self.text)
        self.assertIn("0.333333333333, 1.", self.deck)


class Comparison(unittest.TestCase):
    def test_differences_are_relative_to_the_largest_force(self):
        ours = run([(1.0, 10.0, 0.0), (2.0, 10.0, 3.0)])
        theirs = run([(1.0, 10.0, 0.0), (2.0, 10.5, 2.9)])
        normal, shear = compare.force_difference(ours, theirs)
        self.assertAlmostEqual(normal, 0.5 / 10.5)
        self.assertAlmostEqual(shear, 0.1 / 2.9)

    def test_other_increments_are_refused(self):
        with self.assertRaises(RuntimeError):
            compare.force_difference(run([(1.0, 1.0, 1.0)]), run([(0.5, 1.0, 1.0)]))
        with self.assertRaises(RuntimeError):
            compare.force_difference(run([(1.0, 1.0, 1.0)]), run([]))

    def test_model_names(self):
        self.assertEqual(compare.parse_model("80x40").name, "80x40")
        for wrong in ("80", "0x3", "80x40:0", "x"):
            with self.assertRaises(Exception):
                compare.parse_model(wrong)


if __name__ == "__main__":
    unittest.main()
