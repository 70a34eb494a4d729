"""Has a standing quadruped walk by the vendor's client and says how far it came.

Each way is commanded as programs do it, again and again, and then left to end by itself. Prints one
JSON object: for each way how far it came ahead and to the left of where it stood [m] and turned [rad],
by rt/sportmodestate and by the simulation's truth; for how long it was commanded [s]; how fast it was
in its second half, by both; and how fast it still was in the end.
"""

import json
import math
import time

from unitree_sdk2py.b2.sport.sport_client import SportClient as B2SportClient
from unitree_sdk2py.core.channel import ChannelSubscriber
from unitree_sdk2py.go2.obstacles_avoid.obstacles_avoid_client import ObstaclesAvoidClient
from unitree_sdk2py.go2.sport.sport_client import SportClient as Go2SportClient
from unitree_sdk2py.idl.unitree_go.msg.dds_ import SportModeState_
from unitree_sdk2py.rpc.client import Client

from base_truth import Truth, way_from
from sdk_session import arguments

WAYS = [("ahead", (0.5, 0.0, 0.0)), ("left", (0.0, 0.3, 0.0)), ("turn", (0.0, 0.0, 0.5))]  # m/s, rad/s
PLACE = (0.8, 0.3, 0.5)  # m, rad: from where it stands
COMMANDED, LEFT_ALONE = 4.0, 5.0  # s of the robot's time
TIMED = 2.0, 3.25  # s into it, between which the simulation's speed is taken
PATIENCE = 60.0  # s of this machine's


class A2SportClient(Client):
    """The pinned SDK has none: the two calls that are needed, by the ids of the C++ header."""

    def __init__(self):
        super().__init__("sport", False)

    def Init(self):
        for api in (1002, 1008):
            self._RegistApi(api, 0)

    def BalanceStand(self):
        return self._Call(1002, "{}")[0]

    def Move(self, vx, vy, vyaw):
        return self._Call(1008, json.dumps({"x": vx, "y": vy, "z": vyaw}))[0]


CLIENTS = {  # by table of docs/reference/services.md
    "sport_go2": Go2SportClient,
    "sport_go2w": Go2SportClient,
    "sport_b2": B2SportClient,
    "sport_b2w": B2SportClient,
    "sport_a2": A2SportClient,
}


class Feed:
    """The newest rt/sportmodestate and the robot's clock [s]."""

    def __init__(self):
        self.state, self.clock = None, 0.0
        self._subscriber = ChannelSubscriber("rt/sportmodestate", SportModeState_)
        self._subscriber.Init(self._receive, 10)

    def _receive(self, message):
        self.clock = message.stamp.sec + 1e-9 * message.stamp.nanosec
        self.state = message

    def until(self, clock, each=lambda: None):
        deadline = time.monotonic() + PATIENCE
        while self.clock < clock:
            if time.monotonic() > deadline:
                raise SystemExit(f"the robot's clock stands at {self.clock:.1f} s")
            each()
            time.sleep(0.02)

    def place(self):
        return [*self.state.position[:2], self.state.imu_state.rpy[2]]


def go(feed, command):
    """Commands for a while, then leaves the robot alone."""
    told, true, start, speeds, timed = feed.place(), Truth().read()[1], feed.clock, [], []
    last = start

    def step():
        nonlocal last
        command(feed.clock - start)
        last = feed.clock
        if feed.clock > start + COMMANDED / 2:
            yaw = feed.state.imu_state.rpy[2]
            vx, vy = feed.state.velocity[:2]
            speeds.append((vx * math.cos(yaw) + vy * math.sin(yaw),
                           vy * math.cos(yaw) - vx * math.sin(yaw), feed.state.yaw_speed))
        if len(timed) < len(TIMED) and feed.clock > start + TIMED[len(timed)]:
            timed.append(Truth())

    feed.until(start + COMMANDED, step)
    feed.until(feed.clock + LEFT_ALONE)
    (since, before), (until, after) = (truth.read() for truth in timed)
    return {
        "commanded": last - start,
        "told": way_from(told, feed.place()),
        "true": way_from(true, Truth().read()[1]),
        "speed": [sum(axis) / len(speeds) for axis in zip(*speeds)],
        "true_speed": [way / (until - since) for way in way_from(before, after)],
        "rest": math.hypot(*feed.state.velocity[:2]),
        "state": feed.state.error_code,
        "mode": feed.state.mode,
    }


def main():
    parsed = arguments(__doc__.splitlines()[0],
                       lambda parser: parser.add_argument("apis", help="of the robot, joined by commas"))
    apis = parsed.apis.split(",")
    feed = Feed()
    client = next(CLIENTS[api] for api in apis if api in CLIENTS)()
    client.SetTimeout(10.0)
    client.Init()
    report = {"balance": client.BalanceStand()}
    feed.until(feed.clock + 2)
    for name, velocity in WAYS:
        report[name] = go(feed, lambda _, velocity=velocity: client.Move(*velocity))
    if "sport_go2" in apis:
        avoid = ObstaclesAvoidClient()
        avoid.SetTimeout(10.0)
        avoid.Init()
        report["unheard"] = go(feed, lambda _: avoid.Move(0.5, 0.0, 0.0))
        report["codes"] = [avoid.SwitchSet(True), avoid.UseRemoteCommandFromApi(True)]
        report["avoiding"] = go(feed, lambda _: avoid.Move(0.5, 0.0, 0.0))
        asked = []
        report["to_a_place"] = go(
            feed, lambda _: asked or asked.append(avoid.MoveToIncrementPosition(*PLACE)))
    print(json.dumps(report))


if __name__ == "__main__":
    main()
