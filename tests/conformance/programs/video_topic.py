"""Reads a camera's frames with the vendor's Python SDK, writes them to a file one behind the other and prints what it
found as one JSON object.

    video_topic.py TOPIC FILE FRAMES
"""

import pathlib
import queue
import sys

from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
from unitree_sdk2py.idl.unitree_go.msg.dds_ import Go2FrontVideoData_

from ending import end_with


def main(topic, file, count):
    ChannelFactoryInitialize(0, "lo")
    came = queue.Queue()
    channel = ChannelSubscriber(topic, Go2FrontVideoData_)
    channel.Init(came.put, 50)
    frames = [came.get(timeout=40) for _ in range(count)]
    pathlib.Path(file).write_bytes(b"".join(bytes(frame.video720p) for frame in frames))
    end_with({
        "times": [frame.time_frame for frame in frames],
        "others": sum(len(frame.video360p) + len(frame.video180p) for frame in frames),
    })  # fmt: skip


main(sys.argv[1], sys.argv[2], int(sys.argv[3]))
