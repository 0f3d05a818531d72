"""The program `osculate` of a wheel, which has it beside the package."""
import os
import sys


def main():
    """Becomes the program, with the arguments of this one."""
    program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin", "osculate")
    if not os.path.exists(program):
        sys.exit("osculate: this package has no program beside it; that of the system is another one")
    os.execv(program, [program, *sys.argv[1:]])
