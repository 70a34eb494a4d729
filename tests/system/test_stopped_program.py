"""Every robot when the program that commands it is stopped, goes on, and is killed, as a process."""

import json
import pathlib
import signal
import subprocess
import sys

import pytest

from robots import understudy

PROGRAM = pathlib.Path(__file__).parent / "speaks_lowcmd.py"
ROBOTS = {one["name"]: one for one in json.loads(understudy("robots", "--json").stdout)}


@pytest.mark.parametrize("name", ROBOTS)
def test_damps_while_a_program_is_stopped_and_once_it_is_killed_and_follows_it_in_between(play, name):
    robot = play(name, "--released", "--start", "clamped")
    program = subprocess.Popen([sys.executable, "-B", PROGRAM, ROBOTS[name]["wire"],
                                str(ROBOTS[name]["mode_machine"])])
    try:
        def is_in(state, timeouts):
            return lambda status: (status["commands"]["state"] == state
                                   and status["commands"]["timeouts"] >= timeouts)

        robot.becomes(is_in("following", 0))
        program.send_signal(signal.SIGSTOP)
        stopped = robot.becomes(is_in("damping", 1))["commands"]
        program.send_signal(signal.SIGCONT)
        robot.becomes(is_in("following", stopped["timeouts"]))
        program.send_signal(signal.SIGKILL)
        program.wait()
        told = robot.becomes(is_in("damping", stopped["timeouts"] + 1))
        assert told["commands"]["accepted"] > stopped["accepted"]
        assert sum(told["commands"]["refused"].values()) == 0
    finally:
        program.kill()
        program.wait()
