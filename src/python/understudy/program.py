"""The command `understudy` of this installation."""

import os
import pathlib
import sys


def main():
    program = pathlib.Path(__file__).parent / "bin" / "understudy"
    os.execv(program, [str(program), *sys.argv[1:]])
