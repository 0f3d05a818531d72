"""What some processes began, others go on with; and what is left when one of them is killed."""
import array
import fcntl
import os
import random
import re
import select
import shutil
import signal
import subprocess
import termios
import threading
import time
from concurrent.futures import ThreadPoolExecutor

from models import MODELS, PLANE, of, pair
from ranks_case import RanksCase, environment, main, together

LONG = of(PLANE, pair("sampling: nodes")).replace("increments: 4", "increments: 12")
INCREMENTS = 14


def number_of(process):
    """What mpirun has started it as; None: it has not become the program yet, or has ended."""
    try:
        with open(f"/proc/{process}/environ", "rb") as file:
            number = re.search(rb"\0OMPI_COMM_WORLD_RANK=(\d+)\0", file.read())
        with open(f"/proc/{process}/comm") as file:
            return int(number[1]) if number and file.read() == "osculate\n" else None
    except OSError:
        return None


class Slow:
    """In place of a file that is about to be written: a pipe that takes so many bytes, and no more."""
    size = 4096

    def __init__(self, path):
        self.path = path
        os.mkfifo(path)
        self.pipe = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
        fcntl.fcntl(self.pipe, 1031, self.size)  # F_SETPIPE_SZ

    def full(self):
        waiting = array.array("i", [0])
        fcntl.ioctl(self.pipe, termios.FIONREAD, waiting)
        return waiting[0] == self.size

    def leave(self):
        """What a file has when its writing ends there; nothing where who wrote it has removed it."""
        data = os.read(self.pipe, self.size)
        os.close(self.pipe)
        if not os.path.exists(self.path):
            return
        os.remove(self.path)
        with open(self.path, "wb") as file:
            file.write(data)


class Moment:
    """A process is killed so many increments and seconds after the beginning, or while the first one writes a file."""

    def __init__(self, at, increments, seconds, file=None, rank=None):
        self.processes = at.choice((2, 3))
        self.rank = at.randrange(self.processes) if rank is None else rank
        self.increments, self.seconds, self.file = increments, at.uniform(seconds / 2, seconds), file

    def __str__(self):
        when = f" while {self.file} is written" if self.file else f" and {self.seconds:.3f} s"
        return f"process {self.rank} of {self.processes} after {self.increments} increments{when}"


def moments():
    """Twenty, from the beginning to the end; the first one is before there is a checkpoint."""
    at = random.Random(20261128)
    begun = [Moment(at, 0, seconds) for seconds in (0, 0.2, 0.5, 1)]  # before a process knows of the others, and later
    within = [Moment(at, increments, 0.05) for increments in sorted(at.sample(range(1, INCREMENTS), 10))]
    writing = [Moment(at, *what) for what in (
        (3, 0, "checkpoint.bin", 0), (8, 0, "checkpoint.bin", 1), (5, 0, "bodies_00007.vtu", 0),
        (10, 0, "summary.json", 0), (11, 0, "report.json", 0), (9, 0, "report.html", 1))]
    return begun + within + writing


class Killed:
    """What is left of a run."""

    def __init__(self, moment, folder):
        self.moment, self.folder = moment, folder
        self.increments, self.said, self.slow, self.when = 0, "", None, None
        command = together(moment.processes, "run", "model.yaml", "-o", folder, quiet=False)
        with subprocess.Popen(command, cwd=os.path.dirname(folder), text=True, env=environment(OSCULATE_SHARE_FROM="0"), stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as self.mpirun:
            listening = threading.Thread(target=self.listen)
            listening.start()
            of_run = self.kill()
            try:
                self.mpirun.wait(timeout=60)
            except subprocess.TimeoutExpired:
                self.mpirun.kill()
                raise
            self.seconds = time.monotonic() - self.when if self.when else None
            listening.join()
        self.code = self.mpirun.returncode
        self.alive = [process for process in of_run.values() if number_of(process) is not None]
        if self.slow:
            self.slow.leave()

    def listen(self):
        for line in self.mpirun.stdout:
            self.said += line
            self.increments += line.startswith(("press  ", "drag  "))

    def children(self):
        with open(f"/proc/{self.mpirun.pid}/task/{self.mpirun.pid}/children") as file:
            found = {number_of(process): int(process) for process in file.read().split()}
        return {number: process for number, process in found.items() if number is not None}

    def has_come(self):
        if self.increments < self.moment.increments:
            return False
        if self.moment.file and not self.slow:
            try:
                self.slow = Slow(os.path.join(self.folder, self.moment.file + ".part"))
            except FileExistsError:  # at the next time
                return False
        return not self.slow or self.slow.full()

    def kill(self):
        of_run = {}
        while self.mpirun.poll() is None:
            if len(of_run) < self.moment.processes:
                of_run = self.children()
            elif self.has_come():
                time.sleep(self.moment.seconds)
                try:
                    os.kill(of_run[self.moment.rank], signal.SIGKILL)
                    self.when = time.monotonic()
                except ProcessLookupError:  # it has ended by itself
                    pass
                break
            time.sleep(0.001)
        return of_run


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

    def expect_the_end(self, killed):
        self.assertIsNotNone(killed.when, killed.said)
        self.assertLess(killed.seconds, 10)
        self.assertNotEqual(killed.code, 0)
        named = rf"process rank {killed.moment.rank} with PID \d+ on node .* exited on signal 9 \(Killed\)"
        if killed.moment.increments == 0:  # before they know of each other, mpirun may only know that one is gone
            named += r"|1 process returned\s+a non-zero exit code"
        self.assertRegex(killed.said, named)
        self.assertEqual(killed.alive, [])

    def go_on(self, out, processes):
        """Returns whether there was a checkpoint; without one a run begins anew."""
        there = os.path.exists(self.path(out, "checkpoint.bin"))
        if not there:
            self.expect_message(self.run_program(processes, "run", "model.yaml", "-o", out, "--restart", code=2),
                                "there is no checkpoint in .*; run without --restart")
        self.run_program(processes, "run", "model.yaml", "-o", out, *["--restart"] * there)
        self.assertEqual(self.counts(out), self.counts("whole"))
        self.expect_the_same(out, "whole")
        return there

    def end_and_go_on(self, number, moment):
        out = f"parts{number}"
        killed = Killed(moment, self.path(out))
        while killed.code == 0 and moment.seconds > 0.001:  # it was faster
            shutil.rmtree(self.path(out))
            moment.seconds /= 3
            killed = Killed(moment, self.path(out))
        self.expect_the_end(killed)
        there = self.go_on(out, (1, 2, 3, 8)[number % 4])
        print(f"{moment}: ended {killed.seconds:.2f} s later, {'gone on' if there else 'begun anew'}", flush=True)
        return there

    def test_one_is_killed(self):
        self.write(LONG)
        self.run_program(1, "run", "model.yaml", "-o", "whole")
        with ThreadPoolExecutor(4) as pool:
            jobs = [(moment, pool.submit(self.end_and_go_on, i, moment)) for i, moment in enumerate(moments())]
            self.assertEqual(len(jobs), 20)
            for moment, done in jobs:
                with self.subTest(moment=str(moment)):
                    done.result()
        gone_on = [done.result() for _, done in jobs]
        self.assertGreaterEqual(sum(gone_on), 15)
        self.assertFalse(gone_on[0])


if __name__ == "__main__":
    main()
