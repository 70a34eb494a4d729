"""A Go2 walks the course of examples/course: straight, a turn, sideways, a slope, stairs."""

import json
import os
import pathlib
import subprocess
import sys

COURSE = pathlib.Path(__file__).parents[2] / "examples" / "course"
LENGTH = 28.0  # m along x, with 1 m to the left and back and a turn


def test_a_go2_walks_thirty_metres_and_knows_where_it_is():
    then_where = '"$@" && "$UNDERSTUDY" ctl snapshot --parts qpos'
    done = subprocess.run(
        [os.environ["UNDERSTUDY"], "exec", "go2", "--seed", "1", "--clock", "simulated",
         "--scene", str(COURSE / "course.yaml"), "--",
         "sh", "-c", then_where, "then-where", sys.executable, str(COURSE / "walk.py")],
        capture_output=True, text=True, timeout=110)  # fmt: skip

    assert done.returncode == 0, done.stdout + done.stderr
    *_, said, where = done.stdout.splitlines()
    x, y, z, w, i, j, k = json.loads(where)["qpos"][:7]
    assert abs(x - LENGTH) < 0.05 * LENGTH and abs(y) < 0.05 * LENGTH, where
    assert z > 0.25 and i * i + j * j < 0.05**2, f"it does not stand level: {where}"
    believed = [float(number.strip(",")) for number in said.split() if number[0].isdigit() or number[0] == "-"]
    assert abs(believed[0] - x) > 1e-6, "odometry that does not drift at all is the simulator's truth"
    assert abs(believed[0] - LENGTH) < 0.2 and abs(believed[1]) < 0.2
