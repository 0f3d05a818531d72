"""docs/tutorials: the code of each page runs as it stands, and makes the pictures that the page shows."""
import contextlib
import io
import os
import pathlib
import re
import shutil
import tempfile
import unittest

PAGES = sorted((pathlib.Path(os.environ["SOURCE"]) / "docs/tutorials").glob("*.md"))


def run_page(page, names):
    """All its pieces of Python, one after the other."""
    for number, piece in enumerate(re.findall(r"^```python\n(.*?)^```", page.read_text(), re.M | re.S)):
        exec(compile(piece, f"{page.name}, piece {number + 1}", "exec"), names)


class Tutorials(unittest.TestCase):
    def test_there_are_some(self):
        self.assertGreaterEqual(len(PAGES), 8)


def test_of(page):
    def test(self):
        before, printed = os.getcwd(), io.StringIO()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                with contextlib.redirect_stdout(printed):
                    run_page(page, {"__name__": "page"})
            finally:
                os.chdir(before)
            pictures = re.findall(r"!\[[^]]*\]\(([^)]*)\)", page.read_text())
            for picture in pictures:
                made, kept = pathlib.Path(folder) / picture, page.parent / picture
                self.assertTrue(made.is_file(), f"{page.name} shows {picture} and does not draw it")
                if "PICTURES" in os.environ:  # to draw them anew
                    shutil.copy(made, kept)
                self.assertTrue(kept.is_file(), f"{picture} is not in the repository")
        if "PICTURES" in os.environ:
            print(printed.getvalue())

    return test


for _page in PAGES:
    setattr(Tutorials, f"test_{_page.stem}", test_of(_page))

if __name__ == "__main__":
    unittest.main()
