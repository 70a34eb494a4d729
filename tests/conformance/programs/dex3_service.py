"""Switches the program of a G1's left hand off and on again, and counts the states of both hands."""

import json
import time

from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
from unitree_sdk2py.go2.robot_state.robot_state_client import RobotStateClient
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import HandState_

states = {"left": 0, "right": 0}


def count(side):
    states[side] += 1


def of_a_second():
    time.sleep(0.3)  # what was under way
    before = dict(states)
    time.sleep(1)
    return {side: states[side] - before[side] for side in states}


ChannelFactoryInitialize(0)
subscribers = []
for side in states:
    subscribers.append(ChannelSubscriber(f"rt/dex3/{side}/state", HandState_))
    subscribers[-1].Init(lambda _, side=side: count(side), 10)
client = RobotStateClient()
client.SetTimeout(5)
client.Init()

codes, off = [client.ServiceSwitch("dex3_service_l", False)], of_a_second()
codes, on = [*codes, client.ServiceSwitch("dex3_service_l", True)], of_a_second()
print(json.dumps({"codes": codes, "off": off, "on": on}))
