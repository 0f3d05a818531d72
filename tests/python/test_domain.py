"""osculate.domain beside `osculate domain`. PROGRAM: the program, SOURCE: its sources."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import osculate

DOMAINS = pathlib.Path(os.environ["SOURCE"]) / "examples" / "domains"


def of_program(path, *options):
    """What the program prints, as text and as JSON."""
    def said(*more):
        return subprocess.run([os.environ["PROGRAM"], "domain", path, *options, *more], check=True, text=True,
                              capture_output=True).stdout

    return said(), json.loads(said("--json"))


class Domains(unittest.TestCase):
    def test_it_says_what_the_program_says(self):
        for name in ("ellipse.yaml", "saddle.yaml"):
            with self.subTest(name), tempfile.TemporaryDirectory() as folder:
                path, ours, theirs = str(DOMAINS / name), f"{folder}/ours.vtu", f"{folder}/theirs.vtu"
                found = osculate.domain(path, samples=500, output=ours, page=f"{folder}/page.html")
                text, facts = of_program(path, "--samples", "500", "-o", theirs)
                self.assertEqual(found.facts, facts)
                self.assertEqual(found.text, text.replace(f"wrote {theirs}\n", ""))
                self.assertEqual(pathlib.Path(ours).read_bytes(), pathlib.Path(theirs).read_bytes())
                self.assertGreater(os.path.getsize(f"{folder}/page.html"), 1000)

    def test_the_picture_is_arrays(self):
        found = osculate.domain(DOMAINS / "ellipse.yaml")
        self.assertEqual(found.points.shape[1], 2)
        for values in found.fields.values():
            self.assertEqual(values.shape, found.points.shape[:1])
        for kind, nodes, part, piece in found.cells:
            self.assertEqual((kind, nodes.shape[1]), ("line2", 2))
            self.assertEqual(part.shape, piece.shape)
            self.assertTrue((nodes >= 0).all() and (nodes < len(found.points)).all())
        bound = found.fields["BOUND_ABOVE"], found.fields["BOUND_BELOW"]
        least = min(np.nanmin(values) for values in bound)
        limits = [found.facts[side]["curvature"]["value"] for side in ("above", "below")]
        self.assertAlmostEqual(least / min(v for v in limits if v is not None), 1, delta=0.02)

    def test_a_sphere_of_a_dictionary(self):
        found = osculate.domain({"sphere": {"center": np.zeros(3), "radius": 2.0}})
        self.assertAlmostEqual(found.facts["below"]["reach"]["value"], 2)
        self.assertIsNone(found.facts["above"]["reach"]["value"])
        self.assertEqual(set(found.facts["classes"]), {"elliptic"})

    def test_facets_of_arrays(self):
        found = osculate.domain({"dimension": 2, "nodes": np.array([[0, 0], [1, 0], [1, -1.0]]),
                                 "facets": {"line2": np.array([[0, 1], [1, 2]])}})
        self.assertEqual((found.facts["pieces"], found.facts["convex"]["count"]), (2, 1))
        self.assertAlmostEqual(found.facts["convex"]["largest_degrees"], 90)

    def test_what_cannot_be_used_is_refused(self):
        with self.assertRaisesRegex(osculate.InputError, "radius"):
            osculate.domain({"sphere": {"center": [0, 0, 0]}})
        with self.assertRaisesRegex(osculate.Refused, "samples: expected a number from 10 to 1e[+]07, got 3"):
            osculate.domain(DOMAINS / "ellipse.yaml", samples=3)
        with self.assertRaises(osculate.InputError):
            osculate.domain("nothing.yaml")


if __name__ == "__main__":
    unittest.main()
