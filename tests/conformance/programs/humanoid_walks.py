"""Has a humanoid walk from its stand by the vendor's LocoClient and says how far it came.

Prints one JSON object: for each way the simulated time that it was commanded [s], how far it came by
the simulation's truth, ahead and to the left of where it stood [m] and turned [rad], and how far it
still came in the last second that it was left alone.
"""

import json
import time

from unitree_sdk2py.g1.loco.g1_loco_client import LocoClient as G1LocoClient
from unitree_sdk2py.h1.loco.h1_loco_client import LocoClient as H1LocoClient

from base_truth import Truth, way_from
from sdk_session import arguments

WALKS = {"sport_g1": (G1LocoClient, 501), "loco_h1": (H1LocoClient, 204)}  # by table of docs/reference/services.md
WAYS = {"ahead": (0.4, 0.0, 0.0), "turn": (0.0, 0.0, 0.4)}  # m/s, rad/s
COMMANDED, LEFT_ALONE = 5.0, 5.0  # s of the robot's time


def go(seconds, command=lambda: None):
    """Goes on for that long by the robot's clock; returns its time and place then."""
    now, place = start = Truth().read()
    while now < start[0] + seconds:
        command()
        time.sleep(0.1)
        now, place = Truth().read()
    return now, place


def main():
    parsed = arguments(__doc__.splitlines()[0],
                       lambda parser: parser.add_argument("apis", help="of the robot, joined by commas"))
    make, walk = next(WALKS[api] for api in parsed.apis.split(",") if api in WALKS)
    client = make()
    client.SetTimeout(10.0)
    client.Init()
    go(1.5)
    client.SetFsmId(walk)
    go(1.0)
    report = {}
    for name, velocity in WAYS.items():
        start, before = Truth().read()
        stopped, _ = go(COMMANDED, lambda velocity=velocity: client.Move(*velocity))
        client.StopMove()
        _, rests = go(LEFT_ALONE)
        _, after = go(1.0)
        report[name] = {"commanded": stopped - start, "true": way_from(before, after), "rest": way_from(rests, after)}
    print(json.dumps(report))


if __name__ == "__main__":
    main()
