"""The common beginning of all programs here, with the vendor's Python SDK.

Joining the robot's network, hearing rt/lowstate, getting hold of the motors, and a command
message as the vendor's examples prepare it. Programs end with a reason by `sys.exit(reason)`,
which prints it on stderr and exits with code 1.
"""

import argparse
import math
import sys
import time

from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient
from unitree_sdk2py.core.channel import (
    ChannelFactoryInitialize,
    ChannelPublisher,
    ChannelSubscriber,
)
from unitree_sdk2py.idl.default import (
    unitree_go_msg_dds__LowCmd_,
    unitree_hg_msg_dds__LowCmd_,
)
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowCmd_ as GoLowCmd
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowState_ as GoLowState
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowCmd_ as HgLowCmd
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowState_ as HgLowState
from unitree_sdk2py.utils.crc import CRC
from unitree_sdk2py.utils.thread import RecurrentThread

CONTROL_PERIOD = 0.002  # s; the vendor's examples command at 500 Hz

# "No position" and "no speed" in the unitree_go messages, unitree_legged_const.py of the SDK.
GO_POSITION_STOP = 2.146e9
GO_SPEED_STOP = 16000.0

# Motor slots in use, by robot; the rest of the 20 (unitree_go) or 35 (unitree_hg) stays empty.
# From the index enumerations in the SDK's low-level examples.
GO_SLOTS = {
    "go2": range(12),
    "b2": range(12),
    "go2w": range(16),
    "b2w": range(16),
    "h1": [slot for slot in range(20) if slot != 9],
}
HG_SLOTS = {
    "g1": range(29),
    "g1_23dof": [slot for slot in range(29) if slot not in (13, 14, 20, 21, 27, 28)],
    "h1_2": range(27),
    "h2": range(31),
    "r1": [slot for slot in range(31) if slot not in (14, 20, 21, 27, 28)],
}
ROBOTS = sorted([*GO_SLOTS, *HG_SLOTS])


def is_go(robot):
    """Whether the robot speaks unitree_go; otherwise unitree_hg."""
    return robot in GO_SLOTS


def slots_of(robot):
    """The motor slots in use, ascending."""
    return list(GO_SLOTS.get(robot) or HG_SLOTS[robot])


def arguments(description, add=lambda parser: None):
    """Parses the command line and joins DDS domain 0 on the interface it names."""
    parser = argparse.ArgumentParser(description=description)
    add(parser)
    parser.add_argument("interface", nargs="?", default="lo", help="network interface (lo)")
    parsed = parser.parse_args()
    ChannelFactoryInitialize(0, parsed.interface)
    return parsed


def release_motion_services():
    """Asks motion_switcher to release the motors until no service holds them, as examples do."""
    client = MotionSwitcherClient()
    client.SetTimeout(5.0)
    client.Init()
    for _ in range(5):
        code, mode = client.CheckMode()
        if code != 0:
            sys.exit(f"motion_switcher: CheckMode returned {code}")
        print(f"motion service: {mode['name'] or 'none'}")
        if not mode["name"]:
            return
        code, _ = client.ReleaseMode()
        if code != 0:
            sys.exit(f"motion_switcher: ReleaseMode returned {code}")
        time.sleep(1.0)
    sys.exit(f"motion_switcher: {mode['name']} still holds the motors after five ReleaseMode")


class LowStateFeed:
    """The newest rt/lowstate. `on_state`, if given, is called with each one that arrives."""

    def __init__(self, robot, on_state=lambda state: None):
        self.latest = None
        self._on_state = on_state
        message = GoLowState if is_go(robot) else HgLowState
        self._subscriber = ChannelSubscriber("rt/lowstate", message)
        self._subscriber.Init(self._receive, 10)

    def wait_first(self, seconds=10.0):
        """The first state to arrive; ends the program when none does."""
        deadline = time.monotonic() + seconds
        while self.latest is None:
            if time.monotonic() > deadline:
                sys.exit(f"no rt/lowstate within {seconds:.0f} s")
            time.sleep(0.01)
        return self.latest

    def _receive(self, state):
        self._on_state(state)
        self.latest = state


class Commander:
    """Owns one rt/lowcmd message: `motor(slot, ...)` fills it, `send()` signs and writes it."""

    def __init__(self, robot, mode_machine=0):
        self._crc = CRC()
        self._publisher = ChannelPublisher("rt/lowcmd", GoLowCmd if is_go(robot) else HgLowCmd)
        self._publisher.Init()
        if is_go(robot):
            self.message = unitree_go_msg_dds__LowCmd_()
            self.message.head = [0xFE, 0xEF]
            self.message.level_flag = 0xFF
            for motor in self.message.motor_cmd:
                motor.mode = 1
                motor.q = GO_POSITION_STOP
                motor.dq = GO_SPEED_STOP
        else:
            self.message = unitree_hg_msg_dds__LowCmd_()
            self.message.mode_machine = mode_machine

    def motor(self, slot, q, kp, kd):
        """Asks a motor to be at q [rad], at rest, with gains kp [N·m/rad], kd [N·m·s/rad]."""
        motor = self.message.motor_cmd[slot]
        motor.mode = 1
        motor.q, motor.dq, motor.tau = q, 0.0, 0.0
        motor.kp, motor.kd = kp, kd

    def send(self):
        """Writes the message with its CRC."""
        self.message.crc = self._crc.Crc(self.message)
        self._publisher.Write(self.message)


def command_until(done, command, clock, patience):
    """Calls command() at the vendor's rate, from the vendor's thread, until clock() says `done` [s].
    Ends the program when that takes longer than `patience` [s on this machine's clock]."""
    thread = RecurrentThread(interval=CONTROL_PERIOD, target=command, name="lowcmd")
    thread.Start()
    deadline = time.monotonic() + patience
    while clock() < done:
        if time.monotonic() > deadline:
            sys.exit(f"the robot's clock made {clock():.1f} s in {patience:.0f} s")
        time.sleep(0.05)
    thread.Wait()


def tilt(quaternion):
    """Angle [rad] between the body's z axis and the vertical; quaternion is w, x, y, z."""
    _, x, y, _ = quaternion
    return math.acos(max(-1.0, min(1.0, 1.0 - 2.0 * (x * x + y * y))))


def blend(start, end, share):
    """Between the poses `start` (share 0 or less) and `end` (share 1 or more)."""
    share = min(max(share, 0.0), 1.0)
    return [a + share * (b - a) for a, b in zip(start, end)]
