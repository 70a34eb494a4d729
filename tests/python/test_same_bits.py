"""A robot in this process is the daemon's robot over DDS, bit for bit, with its noise."""

import os
import subprocess

import numpy as np
import pytest

import understudy

SETS = {"motion.service": "none", "sensors.seed": 11}
STARTS = {"go2": "standing", "g1": "hanging"}
CONTROL_STEPS = 100  # of 20 ms


def states_in_process(name, sets, before, targets):
    robot = understudy.Robot(name, set=sets)
    robot.step(before * 0.001)
    rows = []
    for target in targets:
        robot.command(q=target, kp=60, kd=2)
        robot.step(0.02)
        s = robot.state
        rows.append([s.tick, *s.quaternion, *s.gyroscope, *s.accelerometer, *s.q, *s.dq, *s.tau_est])
    return np.array(rows, np.float32)


@pytest.mark.parametrize("name", STARTS)
def test_two_seconds_of_states_are_the_daemons(name, tmp_path, sdk_python, programs):
    sets = SETS | {"start.pose": STARTS[name]}
    robot = understudy.Robot(name)
    time = np.arange(CONTROL_STEPS)[:, None]
    targets = robot.standing + 0.1 * np.sin(0.1 * time + np.arange(len(robot.joints)))
    targets = targets.astype(np.float32)
    np.save(tmp_path / "targets.npy", targets)
    options = [word for key, value in sets.items() for word in ("--set", f"{key}={value}")]
    done = subprocess.run(
        [os.environ["UNDERSTUDY"], "exec", name, *options, "--", sdk_python, programs / "daemon_states.py", name,
         tmp_path / "targets.npy", tmp_path / "states.npz"],
        capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    daemon = np.load(tmp_path / "states.npz")
    ours = states_in_process(name, sets, int(daemon["before"]), targets)
    differ = ours.view(np.uint32) != daemon["rows"].view(np.uint32)
    rows, columns = np.nonzero(differ)
    assert not differ.any(), f"{differ.sum()} of {differ.size} floats differ, first in row {rows[0]}: columns {set(columns)}"
    assert np.ptp(ours[:, 11 : 11 + len(robot.joints)], axis=0).max() > 0.1, "the joints were to move"
