"""Walks a Go2 over course.yaml, as a program for the real robot would: SportClient.Move and rt/sportmodestate.

    understudy exec go2 --scene examples/course/course.yaml -- python3 examples/course/walk.py

With `--seed 1 --record course.mcap` it was filmed for the README:

    understudy film course.webp --recording course.mcap --from 18 --to 58 --speed 4 --size 480x270 --fps 15

It is somewhere else than it believes in the end: the robot's odometry drifts. Exit code 1: a leg of the course took too
long, or nothing was heard of a robot.
"""

import math
import sys
import threading
import time

from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
from unitree_sdk2py.go2.sport.sport_client import SportClient
from unitree_sdk2py.idl.unitree_go.msg.dds_ import SportModeState_

PERIOD = 0.02  # s
FAST = {"ahead": 0.8, "left": 0.3, "turn": 1.0}  # m/s, m/s, rad/s
LEGS = (("ahead", 4.0), ("turn", math.tau), ("left", 1.0), ("left", -1.0), ("ahead", 24.0))  # m, rad


class Odometry:
    """Where the robot says it is: the newest rt/sportmodestate."""

    def __init__(self):
        self._came = threading.Event()
        self._subscriber = ChannelSubscriber("rt/sportmodestate", SportModeState_)
        self._subscriber.Init(self._take, 1)
        if not self._came.wait(5):
            sys.exit("no rt/sportmodestate in 5 s: is a robot there?")

    def _take(self, state):
        self._state = state
        self._came.set()

    def pose(self):
        """x and y in m, yaw in rad, in the frame of the robot's own odometry."""
        x, y, _ = self._state.position
        return x, y, self._state.imu_state.rpy[2]


def held(value, most):
    return max(-most, min(most, value))


def walk(robot, odometry, target, kind, amount):
    """Walks to `target` (x, y, yaw); a turn of `amount` rad may be more than one round."""
    until = time.monotonic() + 10 + 2 * abs(amount) / FAST[kind]
    turned, before = 0.0, odometry.pose()[2]
    while time.monotonic() < until:
        x, y, yaw = odometry.pose()
        turned += math.remainder(yaw - before, math.tau)
        before = yaw
        dx, dy = target[0] - x, target[1] - y
        ahead = math.cos(yaw) * dx + math.sin(yaw) * dy
        left = math.cos(yaw) * dy - math.sin(yaw) * dx
        turn = amount - turned if kind == "turn" else math.remainder(target[2] - yaw, math.tau)
        if abs({"ahead": ahead, "left": left, "turn": turn}[kind]) < 0.1:
            return
        if kind == "turn":
            ahead = left = 0.0
        robot.Move(held(ahead, FAST["ahead"]), held(left, FAST["left"]), held(2 * turn, FAST["turn"]))
        time.sleep(PERIOD)
    sys.exit(f"{kind} {amount:.1f}: not there in time")


def main():
    ChannelFactoryInitialize(0, sys.argv[1] if len(sys.argv) > 1 else "lo")
    robot = SportClient()
    robot.SetTimeout(5)
    robot.Init()
    odometry = Odometry()
    robot.StandUp()
    time.sleep(2)
    robot.BalanceStand()
    time.sleep(1)

    x, y, yaw = odometry.pose()
    for kind, amount in LEGS:
        print(f"{kind} {amount:.1f}", flush=True)
        along = {"ahead": yaw, "left": yaw + math.pi / 2}.get(kind)
        if along is not None:
            x, y = x + amount * math.cos(along), y + amount * math.sin(along)
        walk(robot, odometry, (x, y, yaw), kind, amount)
    robot.StopMove()
    time.sleep(1)
    print("walked to {:.2f}, {:.2f} m by its own odometry".format(*odometry.pose()))


if __name__ == "__main__":
    main()
