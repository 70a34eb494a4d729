"""Sends a robot commands that it has to refuse, one kind after the other, and watches one motor.

While good commands ask that motor to be in one place, bad ones in between ask for another place;
each bad one is signed and right but for its one fault. A refused command moves nothing. At the end
good commands ask for the other place, and the motor goes there: it could have followed all along.
Prints one JSON object: per kind, how many were sent and how far the motor followed (0 not at all, 1
all the way).
"""

import json
import math
import sys
import time

from sdk_session import (
    CONTROL_PERIOD,
    ROBOTS,
    Commander,
    LowStateFeed,
    arguments,
    is_go,
    release_motion_services,
    slots_of,
)

# The watched motor, its place and the place that bad commands ask for [rad]: a joint that is free
# to move whether the robot stands, lies or hangs.
HIP = (0, -0.35, -0.05)  # FR hip
WATCHED = {
    **dict.fromkeys(("go2", "go2w", "b2", "b2w"), HIP),
    "h1": (16, -0.3, 0.0),  # left shoulder pitch
    "g1": (19, 0.3, 0.6),  # left wrist roll
    "g1_23dof": (19, 0.3, 0.6),  # left wrist roll
    "h1_2": (17, 0.3, 0.6),  # left wrist roll
    "h2": (19, 0.3, 0.6),  # left wrist roll
    "r1": (19, 0.3, 0.6),  # left wrist roll
}
KP, KD = 40.0, 2.0  # N·m/rad, N·m·s/rad, of the watched motor
HOLD_KP, HOLD_KD = 40.0, 1.0  # and of the others, which hold the place where they are found
STAGE = 0.6  # s
RETURN = 0.3  # s, between two kinds: a motor that followed must not count for the next one
SETTLE = 1.5  # s


def spoil(kind, message, motor):
    """Makes the message bad in one way; returns the bits to flip in its CRC."""
    if kind == "crc":
        return 1
    if kind == "head":
        message.head = [0xFE, 0xEE]
    elif kind == "mode_machine":
        message.mode_machine += 1
    elif kind == "mode_pr":
        message.mode_pr = 7
    elif kind == "motor_mode":
        motor.mode = 5
    elif kind == "not_finite":
        motor.q = math.nan
    elif kind == "gain":
        motor.kp = -KP
    return 0


def kinds_for(robot):
    """The faults that a message of this robot's family can have."""
    header = ["head"] if is_go(robot) else ["mode_machine", "mode_pr"]
    return ["crc", *header, "motor_mode", "not_finite", "gain"]


class Rehearsal:
    """One robot, and the watched motor on it."""

    def __init__(self, robot):
        self._feed = LowStateFeed(robot)
        release_motion_services()
        first = self._feed.wait_first()
        self._mode_machine = 0 if is_go(robot) else first.mode_machine
        self._commander = Commander(robot, self._mode_machine)
        self._slot, self._place, self._other = WATCHED[robot]
        for slot in slots_of(robot):
            self._commander.motor(slot, first.motor_state[slot].q, HOLD_KP, HOLD_KD)

    def send_good(self, other=False):
        self._repair()
        self._commander.motor(self._slot, self._other if other else self._place, KP, KD)
        self._commander.send()

    def send_bad(self, kind):
        self._repair()
        self._commander.motor(self._slot, self._other, KP, KD)
        message = self._commander.message
        flipped = spoil(kind, message, message.motor_cmd[self._slot])
        self._commander.send(flipped)

    def followed(self):
        """How far the motor is on its way to the other place, 0 to 1; NaN if it is lost."""
        q = self._feed.latest.motor_state[self._slot].q
        return (q - self._place) / (self._other - self._place)

    def _repair(self):
        message = self._commander.message
        if hasattr(message, "head"):
            message.head = [0xFE, 0xEF]
        else:
            message.mode_machine = self._mode_machine
            message.mode_pr = 0


def run_stage(rehearsal, seconds, kind=None, other=False):
    """Commands for a while; returns how many bad ones were sent and how far the motor went."""
    sent, furthest = 0, 0.0
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        rehearsal.send_good(other)
        time.sleep(CONTROL_PERIOD)
        if kind is not None:
            rehearsal.send_bad(kind)
            sent += 1
            time.sleep(CONTROL_PERIOD)
        now = rehearsal.followed()
        furthest = now if not abs(now) <= abs(furthest) else furthest
    return sent, furthest


def main():
    parsed = arguments(__doc__.splitlines()[0],
                       lambda parser: parser.add_argument("robot", choices=ROBOTS))
    rehearsal = Rehearsal(parsed.robot)
    run_stage(rehearsal, SETTLE)
    report = {"robot": parsed.robot, "followed_good_at_first": 1.0 - rehearsal.followed()}
    report["refusals"] = {}
    for kind in kinds_for(parsed.robot):
        run_stage(rehearsal, RETURN)
        sent, furthest = run_stage(rehearsal, STAGE, kind)
        report["refusals"][kind] = {"sent": sent, "followed": furthest}
    run_stage(rehearsal, SETTLE, other=True)
    report["followed_good_at_last"] = rehearsal.followed()
    print(json.dumps(report))

    for end in ("first", "last"):
        if not report[f"followed_good_at_{end}"] > 0.6:
            sys.exit(f"the motor did not follow the good commands at {end}")
    for kind, seen in report["refusals"].items():
        if not abs(seen["followed"]) < 0.4:
            sys.exit(f"the motor followed a command with a bad {kind}")


if __name__ == "__main__":
    main()
