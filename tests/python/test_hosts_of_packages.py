"""Hosts whose packages are large (tools/gate hosts). DEALII is the program of examples/hosts/dealii."""
import os
import sys
import unittest

from hosts import HOSTS, compare


class Hosts(unittest.TestCase):
    def test_deal_ii(self):
        compare(self, "dealii/blocks.yaml", [os.environ["DEALII"]])

    def test_snes(self):
        compare(self, "plane_blocks.yaml", [sys.executable, HOSTS / "snes.py"])

    def test_dolfinx(self):
        compare(self, "total_lagrangian.yaml", [sys.executable, HOSTS / "dolfinx_blocks.py"])


if __name__ == "__main__":
    unittest.main()
