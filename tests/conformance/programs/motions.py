"""Asks a Go2 that stands for every motion that is played, one after the other, by the vendor's client.

Prints one JSON object: for each call its name, its code and the states that the robot went through,
as rt/sportmodestate gives them in error_code.
"""

import json
import time

from unitree_sdk2py.core.channel import ChannelSubscriber
from unitree_sdk2py.go2.sport.sport_client import SportClient
from unitree_sdk2py.idl.unitree_go.msg.dds_ import SportModeState_

from sdk_session import arguments

# Call, arguments, the state in which it ends (of the vendor's Go2 page).
BALANCE, LOCKED, POSE, SIT, LYING, AGILE, WALK = 1013, 1002, 1091, 1007, 1004, 100, 1015
CALLS = [
    ("BalanceStand", (), BALANCE),
    ("Euler", (0.1, 0.1, 0.1), BALANCE),
    ("Pose", (True,), POSE),
    ("Pose", (False,), BALANCE),
    ("Hello", (), BALANCE),
    ("Stretch", (), BALANCE),
    ("Content", (), BALANCE),
    ("Scrape", (), BALANCE),
    ("Heart", (), BALANCE),
    ("Dance2", (), BALANCE),
    ("Sit", (), SIT),
    ("RiseSit", (), BALANCE),
    ("StopMove", (), BALANCE),
    ("StandUp", (), LOCKED),
    ("FreeWalk", (), AGILE),
    ("StaticWalk", (), WALK),
    ("StandUp", (), LOCKED),
    ("StandDown", (), LYING),
]
LEAST = 4.0  # s of the robot's time after a call, so that its state has begun, however late states come
PATIENCE = 30.0  # s of this machine's


class States:
    """The states that the robot went through since `forget`, and its clock [s]."""

    def __init__(self):
        self.seen, self.clock = [], 0.0
        self._subscriber = ChannelSubscriber("rt/sportmodestate", SportModeState_)
        self._subscriber.Init(self._receive, 10)

    def forget(self):
        self.seen = []

    def _receive(self, message):
        self.clock = message.stamp.sec + 1e-9 * message.stamp.nanosec
        if self.seen[-1:] != [message.error_code]:
            self.seen.append(message.error_code)


def main():
    arguments(__doc__.splitlines()[0])
    client = SportClient()
    client.SetTimeout(10.0)
    client.Init()
    states = States()
    report = []
    for name, given, end in CALLS:
        states.forget()
        deadline = time.monotonic() + PATIENCE
        code = getattr(client, name)(*given)
        start = states.clock
        while code == 0 and time.monotonic() < deadline:
            if states.seen[-1:] == [end] and states.clock > start + LEAST:
                break
            time.sleep(0.01)
        report.append([name, code, states.seen])
    print(json.dumps({"calls": report}))


if __name__ == "__main__":
    main()
