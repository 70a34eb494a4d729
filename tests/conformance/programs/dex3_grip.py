"""Moves both Dex3-1 hands as the vendor's g1_dex3_example does: a grip with kp 1.5, then a stop.

Prints what it saw as one JSON object:
  states       left and right: how many HandState_ came on the fast topic in a second
  lf_states    the same of the slow topic that the vendor's example reads
  shape        of the first state: motors, pads, and ids by slot
  missed       by how much each motor missed the grip [rad], hand by hand
  others       the furthest that a hand moved while the other one was commanded [rad]
  watched      modes after commands have stopped that had the motors watched
  cleared      modes after a command that has none watched
"""

import json
import sys
import time

from sdk_session import arguments
from unitree_sdk2py.core.channel import ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.idl.default import unitree_hg_msg_dds__HandCmd_
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import HandCmd_, HandState_

MOTORS = 7
SIDES = ("left", "right")
# Limits [rad] in the example's tables; it grips in their middle.
MAX = {"left": [1.05, 1.05, 1.75, 0, 0, 0, 0], "right": [1.05, 0.742, 0, 1.57, 1.75, 1.57, 1.75]}
MIN = {"left": [-1.05, -0.724, 0, -1.57, -1.75, -1.57, -1.75], "right": [-1.05, -1.05, -1.75, 0, 0, 0, 0]}
KP, KD = 1.5, 0.1
PERIOD = 0.01  # s; the vendor's teleoperation commands hands at 100 Hz
SETTLED = 0.5  # s from there on until it rests, still following what it was told last
NEAR = 0.09  # rad; what a real pair missed its aims by at most, at kp 1
PATIENCE = 40.0  # s


def grip(side):
    return [(low + high) / 2 for low, high in zip(MIN[side], MAX[side])]


class Hand:
    """One hand: its publisher, its newest states and how many came."""

    def __init__(self, side):
        self.latest, self.count, self.lf_count = None, 0, 0
        self._publisher = ChannelPublisher(f"rt/dex3/{side}/cmd", HandCmd_)
        self._publisher.Init()
        self._state = ChannelSubscriber(f"rt/dex3/{side}/state", HandState_)
        self._state.Init(self._receive, 10)
        self._lf_state = ChannelSubscriber(f"rt/lf/dex3/{side}/state", HandState_)
        self._lf_state.Init(self._receive_lf, 10)

    def _receive(self, state):
        self.latest = state
        self.count += 1

    def _receive_lf(self, _):
        self.lf_count += 1

    def q(self):
        return [motor.q for motor in self.latest.motor_state]

    def modes(self):
        return [motor.mode for motor in self.latest.motor_state]

    def send(self, q, kp=KP, kd=KD, timeout=0):
        """All motors to q [rad], at rest; mode as the example packs it."""
        message = unitree_hg_msg_dds__HandCmd_()
        for i in range(MOTORS):
            motor = message.motor_cmd[i]
            motor.mode = (i & 0x0F) | (1 << 4) | (timeout << 7)
            motor.q, motor.dq, motor.tau, motor.kp, motor.kd = q[i], 0.0, 0.0, kp, kd
        self._publisher.Write(message)


def wait_for(what, done):
    deadline = time.monotonic() + PATIENCE
    while not done():
        if time.monotonic() > deadline:
            sys.exit(f"no {what} within {PATIENCE:.0f} s")
        time.sleep(PERIOD)


def main():
    arguments(__doc__)
    hands = {side: Hand(side) for side in SIDES}
    wait_for("states of both hands", lambda: all(hand.latest for hand in hands.values()))
    first = {side: hands[side].latest for side in SIDES}
    report = {"shape": {side: [len(first[side].motor_state), len(first[side].press_sensor_state),
                               [motor.mode & 0x0F for motor in first[side].motor_state]]
                        for side in SIDES}}

    counts = {side: (hands[side].count, hands[side].lf_count) for side in SIDES}
    time.sleep(1.0)
    report["states"] = {side: hands[side].count - counts[side][0] for side in SIDES}
    report["lf_states"] = {side: hands[side].lf_count - counts[side][1] for side in SIDES}

    report["missed"], report["others"] = {}, {}
    for side in SIDES:
        hand, other = hands[side], hands["right" if side == "left" else "left"]
        rest = other.q()
        aim = grip(side)

        def arrived():
            hand.send(aim)
            return all(abs(q - to) < NEAR for q, to in zip(hand.q(), aim))

        wait_for(f"grip of the {side} hand", arrived)
        time.sleep(SETTLED)
        report["missed"][side] = [round(q - to, 3) for q, to in zip(hand.q(), aim)]
        report["others"][side] = max(abs(now - then) for now, then in zip(other.q(), rest))

    for side in SIDES:
        hands[side].send(grip(side), timeout=1)
    wait_for("time-out", lambda: all(mode >> 7 for hand in hands.values() for mode in hand.modes()))
    report["watched"] = {side: hands[side].modes() for side in SIDES}
    for side in SIDES:
        hands[side].send(grip(side))
    wait_for("end of the time-out",
             lambda: not any(mode >> 7 for hand in hands.values() for mode in hand.modes()))
    report["cleared"] = {side: hands[side].modes() for side in SIDES}
    print(json.dumps(report))


if __name__ == "__main__":
    main()
