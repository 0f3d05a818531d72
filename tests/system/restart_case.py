"""What tests of restart share: runs of the program in a folder of their own, compared bit by bit."""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
OWN_FILES = ("log.txt", "iterations.csv", "summary.json", "report.json", "report.html", "journal.bin",
             "checkpoint.bin", "checkpoint.previous.bin")


def without_times(summary):
    return {k: v for k, v in summary.items() if k not in ("seconds", "contact_seconds", "peak_memory_mb")}


class RestartCase(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def write(self, text, name="model.yaml"):
        with open(self.path(name), "w") as file:
            file.write(text)

    def command(self, out, *more):
        return [PROGRAM, "run", "model.yaml", "-o", out, *more]

    def run_to_end(self, out, *more, code=0, **how):
        done = subprocess.run(self.command(out, *more), cwd=self.folder.name, capture_output=True,
                              text=True, **how)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def results(self, out):
        found = {}
        for name in sorted(os.listdir(self.path(out))):
            with open(self.path(out, name), "rb") as file:
                content = file.read()
            if name == "summary.json":
                found[name] = without_times(json.loads(content))
            elif name == "report.json":
                report = json.loads(content)
                report["summary"] = without_times(report["summary"])
                found[name] = report
            elif name not in OWN_FILES:
                found[name] = content
        return found

    def expect_the_same(self, out, reference):
        ours, wanted = self.results(out), self.results(reference)
        self.assertEqual(list(ours), list(wanted))
        for name in wanted:
            self.assertTrue(ours[name] == wanted[name], name + " differs")
