"""Pages that a new user follows: every command of them is run. Usage: test_pages.py PROGRAM SOURCE_DIR"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()


def blocks(page):
    """(language, text) of the code of a page."""
    return re.findall(r"^```(\w*)\n(.*?)^```", (SOURCE / page).read_text(), re.M | re.S)


def is_in(shown, printed):
    """Whether a line of a page, whose `...` stands for anything, is one of those printed."""
    pattern = ".*".join(re.escape(part) for part in shown.split("..."))
    return re.search(f"^{pattern}$", printed, re.M)


class Pages(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "examples").symlink_to(SOURCE / "examples")

    def shell(self, commands):
        """What each prints on both streams; each must succeed."""
        environment = {**os.environ, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}", "LC_ALL": "C"}
        for command in commands.strip().split("\n"):
            if command.startswith("! "):
                command = f"if {command[2:]}; then false; fi"
            done = subprocess.run(["bash", "-ec", command], cwd=self.folder, env=environment, text=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
            self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}")
            yield done.stdout

    def follow(self, page, files):
        """Saves the page's files under these names, runs its commands, and looks for what it shows in what they print."""
        printed, commands = "", 0
        names = iter(files)
        for language, text in blocks(page):
            if language == "sh":
                outputs = list(self.shell(text))
                printed, commands = "\n".join(outputs), commands + len(outputs)
            elif language == "text":
                for line in text.splitlines():
                    self.assertTrue(is_in(line, printed), f"{page} shows\n{line}\nof\n{printed}")
            elif language == "yaml":
                (self.folder / next(names)).write_text(text)
        return commands

    def test_getting_started(self):
        self.assertGreater(self.follow("docs/getting_started.md", ["roller.yaml"]), 12)
        last = (self.folder / "roller.results/history.csv").read_text().splitlines()[-1].split(",")
        self.assertAlmostEqual(float(last[4]) / float(last[3]), 0.3, delta=0.01)
        for name in ("roller.results/report.html", "roller.results/results.pvd", "roller.study/touch.force_x.svg"):
            self.assertTrue((self.folder / name).is_file(), name)

    def test_a_deck_from_nothing(self):
        deck = next(text for _, text in blocks("docs/inp.md") if text.startswith("*HEADING"))
        (self.folder / "pad.inp").write_text(deck)
        printed = "".join(self.shell("osculate check pad.inp\nosculate run pad.inp\nosculate ccx -i pad"))
        self.assertIn("the model file is valid", printed)
        totals = re.findall(r"total force.*\n\n(.*)", (self.folder / "pad.dat").read_text())
        x, y, z = (float(value) for value in totals[-1].split())
        self.assertAlmostEqual(x / z, 0.3, delta=1e-4)  # it slides
        self.assertAlmostEqual(z, -600, delta=1e-6)
        self.assertLess(abs(y), 1e-6)
        self.assertTrue((self.folder / "pad.frd").is_file())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
