"""Robots of Unitree in this process: those that `understudy run` plays, to the bit, without a network.

    import understudy

    robot = understudy.Robot("go2", set={"start.pose": "standing", "motion.service": "none"}, seed=7)
    for _ in range(500):
        robot.command(q=robot.standing, kp=60, kd=5)
        robot.step(0.002)
    print(robot.truth.position, robot.state.gyroscope)

Units are SI; quaternions w, x, y, z; motors in the vendor's order (`Robot.joints`).
"""

import pathlib

from . import _understudy
from ._understudy import Batch, Definition, Error, Network, Robot, State, Truth, World, robot_names
from .policy import Policy, save_weights
from .testing import robot

_understudy._set_data_dir(str(pathlib.Path(__file__).parent / "share" / "understudy"))

__all__ = [
    "Batch", "Definition", "Error", "Network", "Policy", "Robot", "State", "Truth", "World", "robot", "robot_names",
    "save_weights",
]  # fmt: skip
