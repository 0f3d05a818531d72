"""Completion in shells and the manual page, as the shells themselves use them. Usage: test_completion.py PROGRAM"""
import re
import shutil
import subprocess
import sys
import unittest

PROGRAM = sys.argv[1]


def output(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=True).stdout


def shell(name, script, *options):
    run = subprocess.run([name, *options, "-c", script], capture_output=True, text=True)
    return run.stdout.split("\n"), run.stderr


def commands():
    """Names of commands, out of the program's help."""
    listed = output("--help").split("Subcommands:\n")[1]
    return re.findall(r"^  ([a-z]+)", listed, re.M)


def long_options(command):
    """Out of the help of a command; that of `verify` is another program's, to which it hands on everything."""
    if command == "verify":
        return set()
    return set(re.findall(r"--[a-z][a-z-]*", output(command, "--help").split("Options:")[1].replace("`osculate doc --", "")))


class Bash(unittest.TestCase):
    def completed(self, *words):
        listed = " ".join(f"'{word}'" for word in words)
        lines, errors = shell("bash", f'source <("{PROGRAM}" completion bash); COMP_WORDS=({listed}); '
                              f'COMP_CWORD={len(words) - 1}; _osculate; printf "%s\\n" "${{COMPREPLY[@]}}"')
        self.assertEqual(errors, "")
        return [line for line in lines if line]

    def test_commands_are_those_of_the_program(self):
        self.assertGreater(len(commands()), 10)
        self.assertEqual(self.completed("osculate", ""), commands() + ["--help", "--version"])
        self.assertEqual(self.completed("osculate", "ru"), ["run"])

    def test_options_are_those_of_the_command(self):
        for command in commands():
            self.assertEqual({word for word in self.completed("osculate", command, "-") if word.startswith("--")},
                             long_options(command), command)
        self.assertEqual(self.completed("osculate", "run", "model.yaml", "--thr"), ["--threads"])

    def test_files_are_left_to_the_shell(self):
        self.assertEqual(self.completed("osculate", "run", "mod"), [])
        lines, _ = shell("bash", f'source <("{PROGRAM}" completion bash); complete -p osculate')
        self.assertEqual(lines[0], "complete -o default -F _osculate osculate")

    def test_another_shell_is_refused(self):
        run = subprocess.run([PROGRAM, "completion", "tcsh"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 2)
        self.assertIn("tcsh", run.stderr)


class OtherShells(unittest.TestCase):
    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh(self):
        script = output("completion", "zsh")
        lines, errors = shell("zsh", f'autoload -Uz compinit; compinit -D; source <("{PROGRAM}" completion zsh); '
                              "print ${_comps[osculate]}", "-f")
        self.assertEqual((lines[0], errors), ("_osculate", ""))
        for command in commands():
            line = next(line for line in script.split("\n") if line.startswith(f"    {command}) _arguments"))
            self.assertEqual(set(re.findall(r"\)(--[a-z-]+)\[", line)), long_options(command))

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish(self):
        def completed(line):
            lines, errors = shell("fish", f'"{PROGRAM}" completion fish | source; complete -C "{line}"')
            self.assertEqual(errors, "")
            return [line.split("\t")[0] for line in lines if line]

        self.assertEqual(sorted(completed("osculate ")), sorted(commands()))
        for command in commands():
            self.assertLessEqual(long_options(command), set(completed(f"osculate {command} --")), command)


class Manual(unittest.TestCase):
    def test_it_has_every_command_and_option(self):
        page = output("doc", "--man").replace("\\-", "-")
        self.assertTrue(page.startswith(".TH OSCULATE 1"))
        parts = dict(re.findall(r"^\.SS osculate (\w+)[^\n]*\n(.*?)(?=^\.S)", page, re.M | re.S))
        self.assertEqual(list(parts), commands())
        for command, text in parts.items():
            self.assertLessEqual(long_options(command), set(re.findall(r"--[a-z][a-z-]*", text)), command)

    @unittest.skipUnless(shutil.which("groff"), "groff is not installed")
    def test_it_can_be_read(self):
        run = subprocess.run(["groff", "-man", "-Tascii", "-ww", "-P-cbou"], input=output("doc", "--man"), capture_output=True, text=True)
        self.assertEqual((run.returncode, run.stderr), (0, ""))
        self.assertIn("osculate run MODEL", run.stdout)
        self.assertIn("EXIT STATUS", run.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
