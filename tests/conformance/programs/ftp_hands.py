"""Opens and closes two Inspire FTP hands by their registers, as the vendor's driver understands them.

usage: ftp_hands.py [INTERFACE]. Prints what it saw of the left hand as one JSON object:
  lengths  cells of each field of a touch message, in their order
  open     a state after it was opened
  closed   a state after it was closed
  halfway  angles after a position command to half of the way, and with which status it got there
  kept     angles of a finger whose angle_set was -1, before and after all others moved
  speed    permille a second of a finger at speed 500
  ignored  angles before and after a command with mode 0
  stopped  angles a while after commands have stopped
  rates    messages of state and touch a second
  touched  the sum of all cells of all touch messages
  right    angles of the right hand in the end
"""

import dataclasses
import json
import sys
import time

import cyclonedds.idl as idl
import cyclonedds.idl.annotations as annotate
from cyclonedds.idl.types import int8, int16, sequence, uint8
from sdk_session import arguments
from unitree_sdk2py.core.channel import ChannelPublisher, ChannelSubscriber

FINGERS = ("one", "two", "three", "four")
TOUCH = [(f"finger{n}_{part}_touch", cells) for n in FINGERS for part, cells in (("tip", 9), ("top", 96), ("palm", 80))]  # fmt: skip
TOUCH += [("fingerfive_tip_touch", 9), ("fingerfive_top_touch", 96), ("fingerfive_middle_touch", 9),
          ("fingerfive_palm_touch", 96), ("palm_touch", 112)]  # fmt: skip


def message(name, fields):
    """A message type of the module inspire with these fields, as the vendor's driver has it."""
    made = type(name, (idl.IdlStruct,), {"__annotations__": dict(fields)}, typename=f"inspire.{name}")
    return annotate.final(annotate.autoid("sequential")(dataclasses.dataclass(made)))


SIX, SIX_BYTES = sequence[int16, 6], sequence[uint8, 6]
Ctrl = message("inspire_hand_ctrl", [(f"{word}_set", SIX) for word in ("pos", "angle", "force", "speed")] + [("mode", int8)])  # fmt: skip
State = message("inspire_hand_state", [(word, SIX) for word in ("pos_act", "angle_act", "force_act", "current")]
                + [(word, SIX_BYTES) for word in ("err", "status", "temperature")])  # fmt: skip
Touch = message("inspire_hand_touch", [(name, sequence[int16, cells]) for name, cells in TOUCH])

ANGLE, POSITION, SPEED = 1, 2, 8
PERIOD = 0.02  # s
PATIENCE = 40.0  # s


class Hand:
    def __init__(self, side):
        self.state, self.touch = None, None
        self.states = self.touches = self.touched = 0
        self._publisher = ChannelPublisher(f"rt/inspire_hand/ctrl/{side}", Ctrl)
        self._publisher.Init()
        self._readers = [ChannelSubscriber(f"rt/inspire_hand/state/{side}", State),
                         ChannelSubscriber(f"rt/inspire_hand/touch/{side}", Touch)]  # fmt: skip
        self._readers[0].Init(self._on_state, 10)
        self._readers[1].Init(self._on_touch, 10)

    def _on_state(self, state):
        self.state = state
        self.states += 1

    def _on_touch(self, touch):
        self.touch = touch
        self.touches += 1
        self.touched += sum(sum(getattr(touch, name)) for name, _ in TOUCH)

    def angles(self):
        return list(self.state.angle_act)

    def told(self):
        return {field.name: list(getattr(self.state, field.name)) for field in dataclasses.fields(self.state)}

    def send(self, mode, angle=(0,) * 6, pos=(0,) * 6, speed=(0,) * 6):
        self._publisher.Write(Ctrl(pos_set=list(pos), angle_set=list(angle), force_set=[0] * 6,
                                   speed_set=list(speed), mode=mode))  # fmt: skip

    def stay(self, seconds, mode, **values):
        """Sends a command for a while and then gives the last state time to come."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.send(mode, **values)
            time.sleep(PERIOD)


def wait_for(what, reason):
    end = time.monotonic() + PATIENCE
    while not what():
        if time.monotonic() > end:
            sys.exit(f"{reason} within {PATIENCE:.0f} s")
        time.sleep(PERIOD)


def main():
    arguments(__doc__)
    left, right = Hand("l"), Hand("r")
    wait_for(lambda: all(hand.state and hand.touch for hand in (left, right)), "no states and touches")
    report = {"lengths": [len(getattr(left.touch, name)) for name, _ in TOUCH]}
    left.stay(2, ANGLE, angle=[1000] * 6)
    report["open"] = left.told()
    left.stay(2, ANGLE, angle=[0] * 6)
    report["closed"] = left.told()
    left.stay(2, POSITION, pos=[1000] * 6)
    report["halfway"] = {"angles": left.angles(), "status": list(left.state.status)}
    before = left.angles()
    left.stay(2, ANGLE, angle=[1000, -1, 1000, 1000, 1000, 1000])
    report["kept"] = [before[1], left.angles()[1]]
    left.send(SPEED, speed=[500] * 6)
    begin, at = time.monotonic(), left.angles()[0]
    left.stay(0.6, ANGLE, angle=[0] * 6)
    report["speed"] = (at - left.angles()[0]) / (time.monotonic() - begin)
    left.stay(2, ANGLE, angle=[0] * 6)
    before = left.angles()
    left.stay(1, 0, angle=[1000] * 6, pos=[0] * 6)
    report["ignored"] = [before, left.angles()]
    left.send(ANGLE, angle=[300] * 6)
    states, touches, begin = left.states, left.touches, time.monotonic()
    time.sleep(3)
    passed = time.monotonic() - begin
    report["rates"] = [(left.states - states) / passed, (left.touches - touches) / passed]
    report["stopped"] = left.angles()
    report["touched"] = left.touched
    report["right"] = right.angles()
    print(json.dumps(report))


if __name__ == "__main__":
    main()
