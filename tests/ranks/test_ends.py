"""How several processes end: with one message, and the exit code of one."""
import os
import shutil
import subprocess
import unittest

import ranks_case
from models import MODELS, PLANE, of, pair
from ranks_case import PROGRAM, RanksCase, environment, main, together

MODEL = of(PLANE, pair("sampling: nodes"))


class Ends(RanksCase):
    limit = 60

    def test_bad_input(self):
        self.write(MODEL.replace("E: 100", "E: -100"), "bad.yaml")
        self.expect_message(self.run_program(3, "run", "bad.yaml", code=2), "bad.yaml:6: .*must be > 0, got -100")
        self.expect_message(self.run_program(3, "run", "none.yaml", code=2), "none.yaml: cannot be read")
        self.write(MODEL)
        self.expect_message(self.run_program(2, "run", "model.yaml", "--restart", code=2), "checkpoint")
        self.expect_message(self.run_program(2, "run", "model.yaml", "--until", "never", code=2), "never")

    def test_other_commands_are_for_one(self):
        self.write(MODEL)
        for command in ("check", "tangent"):
            self.expect_message(self.run_program(2, command, "model.yaml", code=2),
                                f"'osculate {command}' is for one process: start it without mpirun")

    def test_command_lines(self):
        """The first one has said what is wrong, however late it is."""
        late = ["bash", "-c", 'sleep 0.3; exec "$0" "$@"', PROGRAM]
        for arguments, message in ((("run", "model.yaml", "--thread"), "--thread"), (("check", "model.yaml"), "'osculate check' is for one")):
            command = together(2, *arguments)
            command[command.index("-n") + 1] = "1"
            done = subprocess.run([*command[:command.index(PROGRAM)], *late, *arguments, ":", "-n", "2", PROGRAM, *arguments],
                                  cwd=self.folder.name, capture_output=True, text=True, env=environment(), timeout=self.limit,
                                  stdin=subprocess.DEVNULL)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertEqual((done.stdout + done.stderr).count(message), 1, done.stdout + done.stderr)

    def test_without_the_library(self):
        self.write(MODEL)
        for folder, file in (("bin", PROGRAM), ("lib", os.path.join(os.path.dirname(PROGRAM), "../lib/libosculate_la.so"))):
            os.mkdir(self.path(folder))
            shutil.copy(file, self.path(folder))
        ranks_case.PROGRAM = self.path("bin", "osculate")
        try:
            self.expect_message(self.run_program(2, "run", "model.yaml", code=2), "'-D OSCULATE_MPI=ON'")
        finally:
            ranks_case.PROGRAM = PROGRAM

    def test_other_programs(self):
        """A byte behind the program's end makes it another one."""
        self.write(MODEL)
        os.mkdir(self.path("bin"))
        os.symlink(os.path.join(os.path.dirname(PROGRAM), "../lib"), self.path("lib"))
        other = shutil.copy(PROGRAM, self.path("bin"))
        command = together(2, "run", "model.yaml")
        command[command.index("-n") + 1] = "1"
        for changed in (False, True):
            if changed:
                with open(other, "ab") as file:
                    file.write(b"x")
            done = subprocess.run([*command, ":", "-n", "1", other, "run", "model.yaml"], cwd=self.folder.name, capture_output=True,
                                  text=True, env=environment(), timeout=self.limit, stdin=subprocess.DEVNULL)
            self.assertEqual(done.returncode, 2 if changed else 0, done.stderr)
        self.expect_message(done, "not of the same program")

    def test_a_budget(self):
        self.write(MODEL)
        for processes in (1, 2):
            self.run_program(processes, "run", "model.yaml", "-o", str(processes), "--max-iterations", "12", code=3)
        self.assertEqual(self.counts("2"), self.counts("1"))
        self.assertEqual(self.summary("2")["message"], self.summary("1")["message"])

    @unittest.skipIf(os.geteuid() != 0, "only root mounts")
    def test_disk_full(self):
        """At the beginning, when the first files are opened, and between increments."""
        self.write(MODEL.replace("increments: 4", "increments: 40"))
        os.mkdir(self.path("small"))
        for kilobytes in (4, 16, 40, 120):
            with self.subTest(kilobytes=kilobytes):
                mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", self.path("small")],
                                         capture_output=True, text=True)
                if mounted.returncode != 0:
                    self.skipTest(mounted.stderr)
                try:
                    done = self.run_program(3, "run", "model.yaml", "-o", "small/results", code=3)
                finally:
                    subprocess.run(["umount", self.path("small")], check=True)
                self.assertEqual((done.stdout + done.stderr).count("No space left on device"), 1, done.stderr)

    def test_one_process_lacks_memory(self):
        """While the others wait for it somewhere else."""
        codes = []
        for name, processes in (("by multigrid", 2), ("by multigrid", 3), ("Gauss points in space", 2), ("swung", 2),
                                ("modes between", 2)):
            self.write(MODELS[name])
            for megabytes in (600, 500, 450, 400, 350):
                with self.subTest(name, processes=processes, megabytes=megabytes):
                    limited = ["bash", "-c", f'ulimit -v {megabytes}000; exec "$0" "$@"', PROGRAM, "run", "model.yaml"]
                    command = together(processes, "run", "model.yaml")
                    command[command.index("-n") + 1] = str(processes - 1)
                    done = subprocess.run([*command, ":", "-n", "1", *limited], cwd=self.folder.name, capture_output=True, text=True,
                                          env=environment(), timeout=self.limit, stdin=subprocess.DEVNULL)
                    codes.append(done.returncode)
                    if done.returncode == 1:  # of Open MPI, which has not even begun
                        continue
                    self.assertIn(done.returncode, (0, 3), done.stdout + done.stderr)
                    self.assertEqual((done.stdout + done.stderr).count("not enough memory"), done.returncode // 3, done.stderr)
        self.assertIn(3, codes)


if __name__ == "__main__":
    main()
