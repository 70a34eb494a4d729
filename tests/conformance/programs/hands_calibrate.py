"""Opens both hands of a make, then closes and opens the left one as a stack does that calibrates it, and says nothing of
the right one meanwhile.

usage: hands_calibrate.py MAKE [INTERFACE]. Prints what it saw of the right hand as one JSON object:
  waited  its q after that; where hands share messages its entries were 0, as in a new message
  kept    its q after the same with its entries as they were last; null where it has messages of its own
  called  its q after it was closed
"""

import itertools
import json
import sys
import time

from hands_close import MAKES, NEAR, PATIENCE, PERIOD, Hand, first_states, move
from sdk_session import arguments

CALIBRATES = 2.5  # s at least: longer than the time-out of a gripper


def sides(hands, motors):
    """By side: its hand, and its slots in the messages of that."""
    if len(hands) == 2:
        return {topic.split("/")[1]: (hand, range(motors)) for topic, hand in hands.items()}
    (hand,) = hands.values()
    return {"right": (hand, range(motors // 2)), "left": (hand, range(motors // 2, motors))}


def q_of(side):
    hand, slots = side
    return [hand.q()[slot] for slot in slots]


def lead(side, q, others):
    """Has a side go there; the other entries of its messages are `others`."""
    hand, slots = side
    end = time.monotonic() + PATIENCE
    while any(abs(one - q) > NEAR for one in q_of(side)):
        if time.monotonic() > end:
            sys.exit(f"not at {q} within {PATIENCE:.0f} s")
        hand.send([q if slot in slots else others for slot in range(hand.motors)])
        time.sleep(PERIOD)


def calibrate(side, opened, closed, others):
    begin = time.monotonic()
    for q in itertools.cycle((closed, opened)):
        lead(side, q, others)
        if q == opened and time.monotonic() - begin > CALIBRATES:
            return


def main():
    make = arguments(__doc__, lambda parser: parser.add_argument("make", choices=MAKES)).make
    topics, motors, opened, closed = MAKES[make]
    hands = {topic: Hand(topic, motors) for topic in topics}
    first_states(hands)
    left, right = (sides(hands, motors)[side] for side in ("left", "right"))
    report = {"kept": None}
    move(hands, opened)
    calibrate(left, opened, closed, others=0.0)
    report["waited"] = q_of(right)
    if len(hands) == 1:
        move(hands, opened)
        calibrate(left, opened, closed, others=opened)
        report["kept"] = q_of(right)
    lead(right, opened, others=opened)
    lead(right, closed, others=opened)
    report["called"] = q_of(right)
    print(json.dumps(report))


if __name__ == "__main__":
    main()
