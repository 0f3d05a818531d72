"""What models cost, and how it ends where there is not enough of it. Usage: test_memory.py PROGRAM"""
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = sys.argv[1]
BOX = """osculate: 1
mesh: {generate: {b: {box: {x: [0, 1], y: [0, 1], z: [0, 1], elements: [N, N, N]}}}}
materials: {m: {linear_elastic: {E: 100, nu: 0.3}}}
sections: [{on: b, material: m, element: solid}]
rigid: {floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}}
contact: [{name: c, master: floor, slave: b.bottom}]
steps: [{name: s, increments: 2, prescribe: [{on: b.top, ux: 0, uy: 0, uz: -0.01}]}]
"""
MEGABYTE = 1 << 20


class Memory(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def run_program(self, size, *arguments, limit=None):
        with open(os.path.join(self.folder.name, "box.yaml"), "w") as file:
            file.write(BOX.replace("N", str(size)))
        bound = (lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))) if limit else None
        program = subprocess.Popen([PROGRAM, *arguments], cwd=self.folder.name, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT, text=True, preexec_fn=bound,
                                   env={**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"})
        with program.stdout:
            text = program.stdout.read()
        status, usage = os.wait4(program.pid, 0)[1:]
        program.returncode = os.waitstatus_to_exitcode(status)
        return program.returncode, text, usage.ru_maxrss * 1024

    def test_a_long_iteration_is_left_when_asked_to_end(self):
        with open(os.path.join(self.folder.name, "box.yaml"), "w") as file:
            file.write(BOX.replace("N", "32"))
        with subprocess.Popen([PROGRAM, "run", "box.yaml", "-o", "r", "--threads", "1"], cwd=self.folder.name,
                              stderr=subprocess.PIPE, text=True) as program:
            for line in program.stderr:
                if line.startswith("Steps"):
                    break
            time.sleep(1)  # it assembles, orders and factors for many seconds
            program.send_signal(signal.SIGINT)
            start = time.monotonic()
            message = program.stderr.read()
            program.wait()
            self.assertLess(time.monotonic() - start, 6)  # two seconds, on a busy machine
        self.assertEqual(program.returncode, 3)
        self.assertIn("stopped", message)  # in the middle of an iteration, or before the first

    def test_check_needs_not_much_more_than_the_mesh(self):
        code, small, base = self.run_program(2, "check", "box.yaml")
        self.assertEqual(code, 0, small)
        code, text, most = self.run_program(40, "check", "box.yaml")
        self.assertEqual(code, 0, text)
        self.assertLess(most - base, 60 * MEGABYTE)  # 64 000 cells; the matrix has 190 MB
        self.assertRegex(text, r"Memory +about [0-9.]+ GB for the factors of the tangent")

    def test_too_little_memory_is_the_reason_and_not_halved_steps(self):
        for limit in (450, 600):
            code, text, _ = self.run_program(24, "run", "box.yaml", "-o", "out", limit=limit * MEGABYTE)
            self.assertEqual(code, 3, text)
            self.assertIn("not enough memory for", text)
            self.assertNotIn("halving", text)
            with open(os.path.join(self.folder.name, "out", "summary.json")) as file:
                summary = json.load(file)
            self.assertEqual(summary["status"], "stopped")
            self.assertIn("not enough memory for", summary["message"])
            self.assertNotIn("diagnosis", summary)
        code, text, _ = self.run_program(24, "run", "box.yaml", "-o", "out", limit=100 * MEGABYTE)
        self.assertEqual(code, 3, text)
        self.assertIn("not enough memory", text)

    def test_it_ends_where_memory_is_nearly_enough(self):
        for limit in (800, 900):
            code, text, _ = self.run_program(24, "run", "box.yaml", "-o", "out", limit=limit * MEGABYTE)
            self.assertIn(code, (0, 3), text)
            self.assertIn("done" if code == 0 else "not enough memory", text)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
