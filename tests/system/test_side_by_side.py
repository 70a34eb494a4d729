"""Any number of `exec` at once, each with its robot on domain 0 of lo."""

import json
import os
import pathlib
import subprocess
import sys

PROGRAM = pathlib.Path(__file__).parents[1] / "conformance" / "programs" / "lowstate_watch.py"


def test_two_exec_at_the_same_time_do_not_hear_each_other():
    watches = [
        subprocess.Popen([os.environ["UNDERSTUDY"], "exec", robot, "--", sys.executable, PROGRAM,
                          robot, "2"], stdout=subprocess.PIPE, text=True)
        for robot in ("go2", "go2", "g1")
    ]  # fmt: skip
    heard = [watch.communicate(timeout=30)[0] for watch in watches]

    assert [watch.returncode for watch in watches] == [0, 0, 0]
    for text, step in zip(heard, ("2", "2", "1")):
        report = json.loads(text)
        # A second robot's ticks in between would show as other steps.
        assert list(report["tick_steps_ms"]) == [step]
        assert report["crc_errors"] == 0


def test_exec_does_not_hear_a_robot_that_runs_outside(play, understudy):
    outside = play("go2")
    done = understudy("exec", "go2", "--", "true")

    assert done.returncode == 0, done.stderr
    assert outside.status()["silenced"] is False
    assert not any("rt/lowstate" in line["message"] for line in outside.log())


def test_exec_on_the_hosts_network_shares_it(play, understudy):
    play("go2")
    done = understudy("exec", "go2", "--network", "host", "--", "true")

    assert done.returncode == 6
