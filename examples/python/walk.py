"""Walks a Go2 a metre ahead by its motion service: walk.py [INTERFACE [DOMAIN]]

SportClient.Move lasts for a second, so it is repeated; where the robot is, rt/sportmodestate says. Exit code 1: no robot
was heard, or it did not come that far.
"""

import sys
import time

from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
from unitree_sdk2py.go2.sport.sport_client import SportClient
from unitree_sdk2py.idl.unitree_go.msg.dds_ import SportModeState_

AHEAD = 0.5  # m/s
FAR = 1.0  # m


def main():
    ChannelFactoryInitialize(int(sys.argv[2]) if len(sys.argv) > 2 else 0, sys.argv[1] if len(sys.argv) > 1 else "lo")
    states = ChannelSubscriber("rt/sportmodestate", SportModeState_)
    states.Init()
    sport = SportClient()
    sport.SetTimeout(5.0)
    sport.Init()
    for what, code in (("StandUp", sport.StandUp()), ("BalanceStand", sport.BalanceStand())):
        if code != 0:
            sys.exit(f"{what} is answered {code}: is a robot there?")
        time.sleep(2)

    def x():
        return states.Read().position[0]

    start, until = x(), time.monotonic() + 20
    while x() < start + FAR:
        if time.monotonic() > until:
            sys.exit("it has not come a metre in 20 s")
        sport.Move(AHEAD, 0, 0)
        time.sleep(0.05)
    sport.StopMove()
    time.sleep(1)
    print("walked %.1f m" % (x() - start), flush=True)


if __name__ == "__main__":
    main()
