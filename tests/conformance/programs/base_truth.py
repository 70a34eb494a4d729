"""Where the simulation has the base of the robot, beside what its programs say of it."""

import json
import math
import os
import subprocess


class Truth:
    """The base in the simulation, at a moment of its own: asked for, and read when it is needed."""

    def __init__(self):
        ask = [os.environ["UNDERSTUDY"], "ctl", "snapshot", "--parts", "qpos"]
        self._asked = subprocess.Popen(ask, stdout=subprocess.PIPE, text=True)

    def read(self):
        """Simulated time [s]; x, y [m] and yaw [rad] of the base."""
        said, _ = self._asked.communicate()
        snapshot = json.loads(said)
        px, py, _, w, x, y, z = snapshot["qpos"][:7]
        return snapshot["time"], [px, py, math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))]


def way_from(before, now):
    """Ahead, left [m] and turned [rad], seen from before."""
    x, y, yaw = (b - a for a, b in zip(before, now))
    c, s = math.cos(before[2]), math.sin(before[2])
    return [c * x + s * y, c * y - s * x, math.remainder(yaw, 2 * math.pi)]
