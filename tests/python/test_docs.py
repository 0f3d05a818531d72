"""docs/python.md: its code is run as it stands, piece after piece; and the examples."""
import contextlib
import io
import os
import pathlib
import re
import runpy
import sys
import tempfile
import unittest
from unittest import mock

SOURCE = pathlib.Path(os.environ["SOURCE"])


@contextlib.contextmanager
def elsewhere():
    """In a folder of its own; what is printed is given back."""
    before, printed = os.getcwd(), io.StringIO()
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(printed):
        os.chdir(folder)
        try:
            yield printed
        finally:
            os.chdir(before)


class Pages(unittest.TestCase):
    def test_the_code_of_the_page_runs(self):
        page = (SOURCE / "docs/python.md").read_text()
        pieces = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)
        self.assertGreater(len(pieces), 8)
        names = {"__name__": "page"}
        with elsewhere() as printed:
            for number, piece in enumerate(pieces):
                try:
                    exec(compile(piece, f"docs/python.md, piece {number + 1}", "exec"), names)
                except ModuleNotFoundError as error:
                    self.assertEqual(error.name, "matplotlib")
        self.assertEqual(names["stopped"].status, "stopped")
        self.assertLess(len(names["stopped"].increments), len(names["result"].increments))
        self.assertIn("did you mean 'contact'", printed.getvalue())
        self.assertEqual(names["table"].column("status").tolist(), ["done"] * 3)
        self.assertTrue((names["now"].points["normal_traction"] < 0).any())
        self.assertLess(names["iteration"], 29)

    def test_examples_run(self):
        for name in ("sliding_block", "springs"):
            with self.subTest(example=name), elsewhere() as printed, mock.patch.object(sys, "argv", [name]):
                runpy.run_path(str(SOURCE / f"examples/python/{name}.py"), run_name="__main__")
            self.assertIn("normal force", printed.getvalue())


if __name__ == "__main__":
    unittest.main()
