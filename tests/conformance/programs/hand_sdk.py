"""Moves a pair of Dex1-1 by rt/hand_sdk, with the messages of the vendor's g1_hand_sdk_example.

usage: hand_sdk.py [INTERFACE]. Prints where left and right were at last, as one JSON object:
  opened    as the example with tau -0.3 has it: one message a second, full weight
  closed    the same with tau 0.3
  left      the left half of the motors opens, the right half closes
  fallen    a while after the messages stopped, while rt/dex1 asks for half open
  damped    the example opens while the motion service damps
"""

import json
import time

from sdk_session import arguments
from unitree_sdk2py.core.channel import ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.g1.loco.g1_loco_client import LocoClient
from unitree_sdk2py.idl.default import unitree_go_msg_dds__MotorCmd_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import MotorCmds_, MotorStates_

SIDES = ("left", "right")
TAU = 0.3  # N·m, of the example; positive closes
HALF_OPEN = 2.7  # rad
DAMPING = 1  # fsm id


def cmds(count, **fields):
    motors = [unitree_go_msg_dds__MotorCmd_() for _ in range(count)]
    for motor in motors:
        for name, value in fields.items():
            setattr(motor, name, value)
    return motors


class Session:
    def __init__(self):
        self._sdk = ChannelPublisher("rt/hand_sdk", MotorCmds_)
        self._sdk.Init()
        self._own, self._states, self._latest = {}, {}, {}
        for side in SIDES:
            self._own[side] = ChannelPublisher(f"rt/dex1/{side}/cmd", MotorCmds_)
            self._own[side].Init()
            self._states[side] = ChannelSubscriber(f"rt/dex1/{side}/state", MotorStates_)
            self._states[side].Init(lambda state, side=side: self._latest.update({side: state.states[0].q}), 10)
        while len(self._latest) < len(SIDES):
            time.sleep(0.01)

    def sdk(self, *taus, seconds=3):
        """As the example: a message a second."""
        for _ in range(seconds):
            motors = cmds(4)
            motors[0].mode = 100
            for motor, tau in zip(motors, taus, strict=True):
                motor.tau = tau
            self._sdk.Write(MotorCmds_(motors))
            time.sleep(1)
        return self.q()

    def own(self, q, seconds):
        """By the topics of the hands themselves."""
        for _ in range(seconds * 20):
            for publisher in self._own.values():
                publisher.Write(MotorCmds_(cmds(1, q=q, kp=5.0, kd=0.05)))
            time.sleep(0.05)
        return self.q()

    def q(self):
        return [round(self._latest[side], 3) for side in SIDES]


def main():
    arguments(__doc__)
    session = Session()
    report = {"opened": session.sdk(*[-TAU] * 4), "closed": session.sdk(*[TAU] * 4)}
    report["left"] = session.sdk(-TAU, -TAU, TAU, TAU)
    report["fallen"] = session.own(HALF_OPEN, 5)
    loco = LocoClient()
    loco.SetTimeout(10.0)
    loco.Init()
    loco.SetFsmId(DAMPING)
    report["damped"] = session.sdk(*[-TAU] * 4)
    print(json.dumps(report))


if __name__ == "__main__":
    main()
