"""Takes pictures of a camera with the vendor's Python SDK, and reads LowState meanwhile. Writes the last picture to a
file and prints what it found as one JSON object.

    camera_watch.py front|b2_front|b2_back FILE SECONDS
"""

import importlib
import pathlib
import sys
import time

from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowState_

from ending import end_with

CLIENTS = {
    "front": "unitree_sdk2py.go2.video.video_client.VideoClient",
    "b2_front": "unitree_sdk2py.b2.front_video.front_video_client.FrontVideoClient",
    "b2_back": "unitree_sdk2py.b2.back_video.back_video_client.BackVideoClient",
}


def client_of(camera):
    module, _, name = CLIENTS[camera].rpartition(".")
    client = getattr(importlib.import_module(module), name)()
    client.SetTimeout(10.0)
    client.Init()
    return client


def main(camera, file, seconds):
    ChannelFactoryInitialize(0, "lo")
    states = []
    channel = ChannelSubscriber("rt/lowstate", LowState_)
    channel.Init(lambda state: states.append((time.monotonic(), state.tick)), 50)
    client = client_of(camera)

    codes, took, jpegs = [], [], []
    begin = time.monotonic()
    while not jpegs or time.monotonic() < begin + seconds:
        asked = time.monotonic()
        code, data = client.GetImageSample()
        took.append(time.monotonic() - asked)
        codes.append(code)
        if code != 0:
            break
        jpegs.append(bytes(data))
    if jpegs:
        pathlib.Path(file).write_bytes(jpegs[-1])
    (first, first_tick), (last, last_tick) = states[0], states[-1]
    end_with({
        "codes": sorted(set(codes)),
        "pictures": len(jpegs),
        "sizes": sorted(map(len, jpegs)),
        "took": took,
        "states_per_tick": len(states) / ((last_tick - first_tick) / 2 + 1),
        "pace": (last_tick - first_tick) / 1000 / (last - first),
    })


main(sys.argv[1], sys.argv[2], float(sys.argv[3]))
