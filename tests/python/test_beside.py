"""What is asked beside a run: tangent, comparison, picture of a model, report in a notebook."""
import html
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import numpy as np
import osculate
from models import block


class Beside(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_the_tangent_of_a_model(self):
        found = osculate.tangent(block())
        self.assertTrue(found.passed)
        self.assertEqual([row["part"] for row in found.rows], ["bulk", "contact", "all"])
        contact = found.rows[1]
        self.assertTrue(contact["exact"] or abs(contact["order"] - 2) < 0.2, contact)
        self.assertIn("contact points:", found.text)

    def test_a_wrong_law_of_the_user_is_found(self):
        for slope, passed in ((2e5, True), (2.02e5, False)):
            law = osculate.normal_law(lambda gap: (1e5 * gap * gap, slope * gap))
            model = block()
            del model["contact"][0]["normal"]
            model["contact"][0]["normal"] = law
            self.assertEqual(osculate.tangent(model).passed, passed, slope)

    def test_a_later_state(self):
        found = osculate.tangent(block(), state=2)
        self.assertTrue(found.passed)
        with self.assertRaises(osculate.InputError):
            osculate.tangent(block(), state=1000)

    def test_results_are_compared_as_the_program_does(self):
        a = osculate.run(block(), self.folder / "a")
        b = osculate.run(block(), self.folder / "b", parameters={"mu": 0.1})
        same, other = osculate.compare(a, a), osculate.compare(a, self.folder / "b")
        self.assertEqual((same.largest, same.lacks), (0, False))
        self.assertGreater(other.largest, 0.01)
        largest, scale, relative, time = other.quantities["c.shear_force"]
        column = [one.history["c.shear_force"] for one in (a, b)]
        self.assertEqual(largest, np.abs(column[0] - column[1]).max())
        self.assertEqual(scale, np.abs(column).max())
        self.assertEqual(relative, largest / scale)
        said = subprocess.run([os.environ["PROGRAM"], "compare", "a", "b"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(osculate.compare(self.folder / "a", self.folder / "b").text.replace(f"{self.folder}/", ""), said.stdout)
        with self.assertRaises(osculate.InputError):
            osculate.compare(a, self.folder)

    def test_the_report_stands_in_a_notebook(self):
        result = osculate.run(block(), self.folder / "a")
        shown = result.view(height=300)._repr_html_()
        page = html.unescape(re.fullmatch(r'<iframe srcdoc="([^"]*)" sandbox="allow-scripts allow-downloads" style="[^"]*300px[^"]*"></iframe>',
                                          shown).group(1))
        self.assertEqual(page, (self.folder / "a/report.html").read_text())
        without = osculate.run(block(output={"report": False}))
        with self.assertRaisesRegex(osculate.InputError, "output: report"):
            without.view()

    def test_a_model_is_drawn_before_it_runs(self):
        import matplotlib
        matplotlib.use("agg")
        held = [{"name": "s", "increments": 1, "prescribe": [{"on": "block.top", "ux": 0, "uy": -0.01}]}]
        axes = osculate.plot_model(block(steps=held), file=self.folder / "model.png")
        self.assertEqual((self.folder / "model.png").read_bytes()[:4], b"\x89PNG")
        legend = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertEqual(legend, ["prescribed", "slave of c", "block"])
        cells, contact = axes.collections[0], axes.collections[-1]
        self.assertGreater(len(cells.get_paths()), 20)
        low = min(path.vertices[:, 1].min() for path in cells.get_paths())
        self.assertEqual({float(y) for path in contact.get_paths() for y in path.vertices[:, 1]}, {float(low)})
        self.assertEqual(sorted(axes.lines[0].get_xdata()), [0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4])  # the nodes of the top
        self.assertEqual(set(axes.lines[0].get_ydata()), {2})
        cube = {"osculate": 1, "mesh": {"generate": {"cube": {"box": {"x": [0, 2], "y": [0, 2], "z": [0, 1], "elements": [4, 4, 2]}}}},
                "materials": {"m": {"linear_elastic": {"E": 1e4, "nu": 0.3}}},
                "sections": [{"on": "cube", "material": "m", "element": "solid"}],
                "rigid": {"ball": {"sphere": {"center": [1, 1, 3.01], "radius": 2}}},
                "contact": [{"name": "c", "master": "ball", "slave": "cube.top"}],
                "steps": [{"name": "s", "increments": 1, "prescribe": [{"on": "cube.bottom", "ux": 0, "uy": 0, "uz": 0}]}]}
        axes = osculate.plot_model(cube)
        self.assertEqual(len(axes.collections[0].get_paths()), 64 + 16)  # outer faces, and those of the slave
        self.assertEqual(len(axes.lines[0].get_xdata()), 25)
        with self.assertRaisesRegex(osculate.InputError, "did you mean 'contact'"):
            osculate.plot_model({**cube, "contac": []})


if __name__ == "__main__":
    unittest.main()
