"""Walks a G1 ahead, in a curve and sideways by its motion service, and waves: g1_walk.py [INTERFACE [DOMAIN]]

    understudy exec g1 --start standing -- python3 examples/python/g1_walk.py lo

With `--seed 1 --record g1_walk.mcap` it was filmed for the README:

    understudy film g1_walk.webp --recording g1_walk.mcap --from 2 --to 28 --speed 2 --plain --size 360x270 --fps 12

LocoClient.Move lasts for a second, so it is repeated. Exit code 1: the service does not take the walking state.
"""

import sys
import time

from unitree_sdk2py.core.channel import ChannelFactoryInitialize
from unitree_sdk2py.g1.loco.g1_loco_client import LocoClient

WALK = 501  # state of G1's service that walks
WAY = (("ahead", 0.5, 0.0, 0.0, 7.0), ("in a curve", 0.3, 0.0, 0.5, 6.0), ("sideways", 0.0, 0.25, 0.0, 4.0))  # m/s, rad/s, s


def main():
    ChannelFactoryInitialize(int(sys.argv[2]) if len(sys.argv) > 2 else 0, sys.argv[1] if len(sys.argv) > 1 else "lo")
    loco = LocoClient()
    loco.SetTimeout(5.0)
    loco.Init()
    time.sleep(2)
    if (code := loco.SetFsmId(WALK)) not in (0, None):
        sys.exit(f"state {WALK} is answered {code}: does the robot stand?")
    time.sleep(1)
    for name, ahead, left, turn, seconds in WAY:
        print(f"walks {name}", flush=True)
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            loco.Move(ahead, left, turn)
            time.sleep(0.1)
    loco.StopMove()
    time.sleep(2)
    loco.WaveHand()
    time.sleep(5)


if __name__ == "__main__":
    main()
