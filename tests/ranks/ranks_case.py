"""What tests of several processes share. Usage of all: TEST PROGRAM MPIRUN PATIENT SOURCE"""
import csv
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, MPIRUN, PATIENT, SOURCE = sys.argv[1:5]
TIMES = ("seconds", "contact_seconds", "peak_memory_mb", "processes")


def environment(**more):
    """Whatever the user's settings are: more processes than cores, as root, too, on this machine alone."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("OMPI_", "PMIX_", "PMI_", "SLURM_", "OSCULATE_"))}
    return kept | {
        "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
        "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_hwloc_base_binding_policy": "none",
        "OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_btl": "self,vader",
        "OMPI_MCA_btl_vader_single_copy_mechanism": "none", "OMPI_MCA_plm": "isolated", "LC_ALL": "C"} | more


def together(processes, *arguments, quiet=True):
    """The command that runs the program so; one process: without mpirun. Quiet: mpirun says nothing of how processes end."""
    if processes == 1:
        return [PROGRAM, *arguments]
    return [MPIRUN, *["-q"] * quiet, "-x", "LD_PRELOAD=" + PATIENT, "-n", str(processes), PROGRAM, *arguments]


def numbers(path):
    """The columns of a table of numbers; other columns as they are."""
    with open(path) as file:
        rows = list(csv.reader(file))

    def number(text):
        try:
            return float(text)
        except ValueError:
            return text
    return {name: [number(row[i]) for row in rows[1:]] for i, name in enumerate(rows[0])}


class RanksCase(unittest.TestCase):
    limit = 120  # seconds, of which a run takes few

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def path(self, *names):
        return os.path.join(self.folder.name, *names)

    def write(self, text, name="model.yaml"):
        with open(self.path(name), "w") as file:
            file.write(text)

    def run_program(self, processes, *arguments, code=0, share_from="0"):
        """`share_from`: matrices of fewer entries are factored by the first process; 0: all are shared."""
        done = subprocess.run(together(processes, *arguments), cwd=self.folder.name, capture_output=True, text=True,
                              env=environment(OSCULATE_SHARE_FROM=share_from), timeout=self.limit, stdin=subprocess.DEVNULL)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def summary(self, out):
        with open(self.path(out, "summary.json")) as file:
            return {k: v for k, v in json.load(file).items() if k not in TIMES}

    def counts(self, out):
        """Of every increment: iterations, cutbacks and what contact points do."""
        return [[increment[name] for name in ("iterations", "cutbacks", "open", "stick", "slipping", "closed", "resisted")]
                for step in self.summary(out)["steps"] for increment in step.get("increments", [])]

    def difference(self, out, reference):
        """The largest one in the history, over the largest value of its column (of all energies, for theirs), and
        the column it is in."""
        ours, wanted = numbers(self.path(out, "history.csv")), numbers(self.path(reference, "history.csv"))
        self.assertEqual(list(ours), list(wanted))
        energies = [abs(v) for name, column in wanted.items() if name.startswith("energy.") for v in column]
        worst = (0.0, "")
        for name, values in wanted.items():
            self.assertEqual(len(ours[name]), len(values), name)
            pairs = list(zip(ours[name], values))
            if not all(isinstance(a, float) and isinstance(b, float) for a, b in pairs):
                self.assertEqual(ours[name], values, name)
                continue
            largest = max(energies if name.startswith("energy.") else map(abs, values), default=0.0) or 1.0
            worst = max(worst, (max((abs(a - b) / largest for a, b in pairs), default=0.0), name))
        return worst

    def expect_message(self, done, pattern):
        """One line and no more, however many processes there are; beside what libraries of Open MPI say of the machine."""
        said = [line for line in (done.stdout + done.stderr).splitlines() if line.strip()]
        lines = [line for line in said if not line.startswith("[")]
        self.assertEqual(len(lines), 1, done.stdout + done.stderr)
        self.assertTrue(re.search(pattern, lines[0]), lines[0])


def main():
    unittest.main(argv=[sys.argv[0]] + sys.argv[5:])
