"""Hosts that need NumPy and SciPy alone."""
import importlib.util
import subprocess
import sys
import unittest

from hosts import HOSTS, compare, run_host


@unittest.skipUnless(importlib.util.find_spec("scipy"), "needs SciPy")
class Hosts(unittest.TestCase):
    def test_numpy_and_scipy(self):
        compare(self, "plane_blocks.yaml", [sys.executable, HOSTS / "plane_blocks.py"])

    def test_total_lagrangian(self):
        compare(self, "total_lagrangian.yaml", [sys.executable, HOSTS / "total_lagrangian.py"])

    def test_a_host_that_hangs_is_ended(self):
        with self.assertRaises(subprocess.CalledProcessError):
            run_host([sys.executable, "-c", "while True: pass"], processor_seconds=1)
        with self.assertRaises(subprocess.TimeoutExpired):
            run_host([sys.executable, "-c", "import time; time.sleep(60)"], seconds=1)


if __name__ == "__main__":
    unittest.main()
