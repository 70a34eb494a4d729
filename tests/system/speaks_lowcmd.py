"""speaks_lowcmd.py go|hg MODE_MACHINE: commands a robot on domain 0 until it is ended; all motors on, without gains."""

import sys

from peers import GoLowCmd, HgLowCmd, go_command, hg_command, speaker


def main():
    wire, mode_machine = sys.argv[1], int(sys.argv[2])
    message = go_command() if wire == "go" else hg_command(mode_machine)
    with speaker("rt/lowcmd", GoLowCmd if wire == "go" else HgLowCmd) as program:
        while True:
            program.write_for(60, message)


main()
