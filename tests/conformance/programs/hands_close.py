"""Opens and closes both hands of a make, as its service understands q, and stops.

usage: hands_close.py MAKE [INTERFACE]. Prints what it saw as one JSON object:
  motors   of a state of each topic: how many
  first    q of the first state of each topic
  open     q of each topic after it was opened
  closed   the same after it was closed
  rate     states a second on the first topic
  stopped  q of each topic a while after commands have stopped
"""

import json
import sys
import time

from sdk_session import arguments
from unitree_sdk2py.core.channel import ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.idl.default import unitree_go_msg_dds__MotorCmd_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import MotorCmds_, MotorStates_

# By make: topics, motors in a message, q open and q closed.
MAKES = {
    "dex1": (("dex1/left", "dex1/right"), 1, 5.4, 0.0),
    "dex1_old": (("unitree_actuator",), 2, 5.4, 0.0),
    "inspire": (("inspire",), 12, 1.0, 0.0),
    "brainco": (("brainco/left", "brainco/right"), 6, 0.0, 1.0),
}
PERIOD = 0.01  # s
NEAR = 0.1  # rad or share
PATIENCE = 40.0  # s


class Hand:
    def __init__(self, topic, motors):
        self.latest, self.count, self.motors = None, 0, motors
        self._publisher = ChannelPublisher(f"rt/{topic}/cmd", MotorCmds_)
        self._publisher.Init()
        self._state = ChannelSubscriber(f"rt/{topic}/state", MotorStates_)
        self._state.Init(self._receive, 10)

    def _receive(self, state):
        self.latest = state
        self.count += 1

    def q(self):
        return [round(motor.q, 3) for motor in self.latest.states]

    def send(self, qs):
        message = MotorCmds_()
        message.cmds = [unitree_go_msg_dds__MotorCmd_() for _ in range(self.motors)]
        for motor, q in zip(message.cmds, qs, strict=True):  # gains of a Dex1-1, full speed of a Revo2
            motor.q, motor.dq, motor.kp, motor.kd = q, 1.0, 5.0, 0.05
        self._publisher.Write(message)


def first_states(hands):
    deadline = time.monotonic() + PATIENCE
    while not all(hand.latest for hand in hands.values()):
        if time.monotonic() > deadline:
            sys.exit(f"no states within {PATIENCE:.0f} s")
        time.sleep(PERIOD)


def move(hands, q):
    end = time.monotonic() + PATIENCE
    while any(abs(one - q) > NEAR for hand in hands.values() for one in hand.q()):
        if time.monotonic() > end:
            sys.exit(f"not at {q} within {PATIENCE:.0f} s")
        for hand in hands.values():
            hand.send([q] * hand.motors)
        time.sleep(PERIOD)
    return {topic: hand.q() for topic, hand in hands.items()}


def main():
    make = arguments(__doc__, lambda parser: parser.add_argument("make", choices=MAKES)).make
    topics, motors, opened, closed = MAKES[make]
    hands = {topic: Hand(topic, motors) for topic in topics}
    first_states(hands)
    report = {"motors": {topic: len(hand.latest.states) for topic, hand in hands.items()}}
    report["first"] = {topic: hand.q() for topic, hand in hands.items()}
    report["open"] = move(hands, opened)
    report["closed"] = move(hands, closed)
    counted = hands[topics[0]].count
    time.sleep(2.0)  # longer than the time-out of a gripper
    report["rate"] = (hands[topics[0]].count - counted) / 2.0
    report["stopped"] = {topic: hand.q() for topic, hand in hands.items()}
    print(json.dumps(report))


if __name__ == "__main__":
    main()
