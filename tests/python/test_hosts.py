"""Hosts that need NumPy and SciPy alone."""
import importlib.util
import sys
import unittest

from hosts import HOSTS, compare


@unittest.skipUnless(importlib.util.find_spec("scipy"), "needs SciPy")
class Hosts(unittest.TestCase):
    def test_numpy_and_scipy(self):
        compare(self, "plane_blocks.yaml", [sys.executable, HOSTS / "plane_blocks.py"])

    def test_total_lagrangian(self):
        compare(self, "total_lagrangian.yaml", [sys.executable, HOSTS / "total_lagrangian.py"])


if __name__ == "__main__":
    unittest.main()
