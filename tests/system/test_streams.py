"""Streams and files that cannot be written, and names that are no UTF-8. Usage: test_streams.py PROGRAM"""
import json
import os
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv[1]
MODEL = """osculate: 1
mesh: {generate: {block: {box: {x: [0, 4], y: [0, 2], elements: [8, 4]}}}}
materials: {s: {linear_elastic: {E: 1.0e4, nu: 0.3}}}
sections: [{on: block, material: s, element: plane_strain}]
steps: [{name: pull, increments: 2, prescribe: [{on: block.bottom, ux: 0, uy: 0}, {on: block.top, uy: 0.1}]}]
output: {history: [{on: block.top, of: rfy}]}
"""
# Those that print on standard output.
PRINTING = (("run", "m.yaml", "--json", "-o", "other"), ("check", "m.yaml"), ("check", "m.yaml", "--json"),
            ("tangent", "m.yaml"), ("tangent", "m.yaml", "--json"), ("domain", "s.yaml"), ("domain", "s.yaml", "--json"),
            ("project", "s.yaml", "p.csv"), ("schema",), ("doc",), ("report", "done"), ("--help",), ("--version",),
            ("run", "--help"))
TELLING = (("run", "m.yaml", "-o", "other"), ("project", "s.yaml", "p.csv"))  # on standard error


class Streams(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        for name, text in (("m.yaml", MODEL), ("s.yaml", "circle: {center: [0, 0], radius: 1}\n"), ("p.csv", "x,y\n2,0\n")):
            self.write(name, text)
        self.assertEqual(self.code(("run", "m.yaml", "-o", "done")), 0)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def write(self, name, text):
        with open(os.path.join(os.fsencode(self.folder.name), os.fsencode(name)), "w") as file:
            file.write(text)

    def code(self, arguments, shell="", **how):
        """Exit code with a redirection of the shell; minus the number of a signal."""
        command = [PROGRAM, *arguments]
        if shell:
            command = ["sh", "-c", 'exec "$0" "$@" ' + shell, *command]
        how = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **how}
        return subprocess.run(command, cwd=self.folder.name, **how).returncode

    def closed_pipe(self):
        end, pipe = os.pipe()
        os.close(end)
        self.addCleanup(os.close, pipe)
        return pipe

    def test_what_cannot_be_printed_ends_with_3(self):
        for arguments in PRINTING:
            with self.subTest(arguments=arguments):
                self.assertEqual(self.code(arguments, ">/dev/full"), 3)
                self.assertEqual(self.code(arguments, ">&-"), 3)
                self.assertEqual(self.code(arguments, ">&- 2>&-"), 3)
                self.assertEqual(self.code(arguments, stdout=self.closed_pipe()), 3)
        for arguments in TELLING:
            with self.subTest(arguments=arguments):
                self.assertEqual(self.code(arguments, "2>/dev/full"), 3)
                self.assertEqual(self.code(arguments, "2>&-"), 3)
                self.assertEqual(self.code(arguments, stderr=self.closed_pipe()), 3)
        for arguments in (("run", "no.yaml"), ("check", "no.yaml"), ("nonsense",), ("doc", "no.such.key"), ("report", "no")):
            for shell in ("2>/dev/full", "2>&-", ">&- 2>&-", "<&- >&- 2>&-"):
                self.assertEqual(self.code(arguments, shell), 2, arguments)
        with open("/dev/full", "w") as full:
            said = subprocess.run([PROGRAM, "schema"], stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual(said.stderr, "stopped: standard output cannot be written\n")

    def test_an_analysis_goes_on_when_nobody_reads_its_messages(self):
        for shell in ("2>&-", "2>/dev/full", "<&- >&- 2>&-"):
            self.assertEqual(self.code(("run", "m.yaml", "-o", "quiet"), shell), 3)
            for name in sorted(os.listdir(self.path("done"))):
                if name.endswith((".csv", ".vtu", ".pvd")):
                    with open(self.path("done", name), "rb") as ours, open(self.path("quiet", name), "rb") as theirs:
                        self.assertEqual(ours.read(), theirs.read(), name)
            with open(self.path("quiet", "summary.json")) as file:
                self.assertEqual(json.load(file)["status"], "done")
        self.assertEqual(self.code(("run", "m.yaml", "-o", "quiet", "--quiet"), "<&- >&- 2>&-"), 0)

    def test_what_cannot_be_written_ends_with_3_in_every_command(self):
        verify = os.path.join(os.path.dirname(PROGRAM), "osculate-verify")
        commands = [("run", "m.yaml", "-o", "m.yaml/out"), ("run", "m.yaml", "-o", "/proc/out"),
                    ("tangent", "m.yaml", "-o", "/proc/out"), ("domain", "s.yaml", "-o", "no/out.vtu"),
                    ("domain", "s.yaml", "--page", "no/out.html"), ("project", "s.yaml", "p.csv", "-o", "no/out.csv")]
        if os.path.exists(verify):
            commands += [("verify", "--json", "no/out.json", "contact_patch"), ("verify", "--curves", "m.yaml/out", "contact_patch"),
                         ("verify", "--plots", "/proc/out", "contact_patch")]
        for arguments in commands:
            self.assertEqual(self.code(arguments), 3, arguments)
        os.remove(self.path("done", "report.html"))
        os.mkdir(self.path("done", "report.html"))
        self.assertEqual(self.code(("report", "done")), 3)

    def test_names_that_are_no_utf8(self):
        os.mkdir(os.fsencode(self.folder.name) + b"/\xff")
        name, surface = b"\xff/m\xe9.yaml", b"\xff/s\xe9.yaml"
        self.write(name, MODEL)
        self.write(surface, "circle: {center: [0, 0], radius: 1}\n")
        for arguments in (("run", name, "--json", "-o", b"\xff/out"), ("check", name, "--json"),
                          ("tangent", name, "--json", "-o", b"\xff/out"), ("domain", surface, "--json", "--page", b"\xff/p.html")):
            for _ in "twice":
                done = subprocess.run([PROGRAM, *arguments], cwd=self.folder.name, capture_output=True)
                self.assertEqual(done.returncode, 0, done.stderr)
                json.loads(done.stdout.decode("utf-8"))
        with open(os.fsencode(self.folder.name) + b"/\xff/out/summary.json", encoding="utf-8") as file:
            self.assertEqual(json.load(file)["model"], "m\\xe9.yaml")
        self.write(name, MODEL.replace("0.1", "0.2"))  # the same file, edited
        self.assertEqual(self.code(("run", name, "-o", b"\xff/out")), 0)
        self.assertEqual(self.code(("run", b"no\xff.yaml")), 2)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
