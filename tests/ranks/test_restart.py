"""What some processes began, others go on with; and what is left when one of them is killed."""
import os
import random
import shutil
import signal
import threading
import time

from models import MODELS, PLANE, of, pair
from ranks_case import RanksCase, main

LONG = of(PLANE, pair("sampling: nodes")).replace("increments: 4", "increments: 12")


def children(process):
    with open(f"/proc/{process}/task/{process}/children") as file:
        return [int(child) for child in file.read().split()]


class Restart(RanksCase):
    tolerance = 1e-10

    def expect_the_same(self, out, reference):
        worst, column = self.difference(out, reference)
        self.assertLess(worst, self.tolerance, column)

    def test_others_go_on(self):
        for name in ("multipliers at nodes", "tied and plastic"):
            with self.subTest(model=name):
                self.write(MODELS[name])
                self.run_program(1, "run", "model.yaml", "-o", "whole")
                self.run_program(2, "run", "model.yaml", "-o", "two", "--until", "press")
                for processes in (1, 3):
                    out = f"by{processes}"
                    shutil.copytree(self.path("two"), self.path(out))
                    done = self.run_program(processes, "run", "model.yaml", "-o", out, "--restart")
                    self.assertIn("restart after increment", done.stdout + done.stderr)
                    self.expect_the_same(out, "whole")
            for out in ("whole", "two", "by1", "by3"):
                shutil.rmtree(self.path(out), ignore_errors=True)

    def kill_one(self, processes, rank, after, delay):
        """While such processes run: one of them, so many increments and seconds after the beginning."""
        shutil.rmtree(self.path("parts"), ignore_errors=True)
        mpirun = self.begin(processes, "run", "model.yaml", "-o", "parts")
        text = threading.Thread(target=mpirun.stdout.read)
        text.start()
        increments, killed = 0, None
        for line in mpirun.stderr:
            increments += line.startswith(("press  ", "drag  "))
            if increments == after and killed is None:
                time.sleep(delay)
                os.kill(children(mpirun.pid)[rank], signal.SIGKILL)
                killed = time.monotonic()
        self.assertIsNotNone(killed)
        mpirun.wait(timeout=10)
        text.join()
        self.assertLess(time.monotonic() - killed, 10)
        self.assertNotEqual(mpirun.returncode, 0)
        mpirun.stdout.close()
        mpirun.stderr.close()

    def test_one_is_killed(self):
        self.write(LONG)
        self.run_program(1, "run", "model.yaml", "-o", "whole")
        moments = random.Random(20261128)
        for number in range(5):
            processes = moments.choice((2, 3))
            rank, after, delay = moments.randrange(processes), moments.randrange(1, 10), moments.uniform(0, 0.02)
            with self.subTest(processes=processes, rank=rank, after=after, delay=delay):
                self.kill_one(processes, rank, after, delay)
                self.run_program((1, 3, 2)[number % 3], "run", "model.yaml", "-o", "parts", "--restart")
                self.expect_the_same("parts", "whole")


if __name__ == "__main__":
    main()
