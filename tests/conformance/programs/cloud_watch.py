"""Reads a Go2's clouds with the vendor's Python SDK, alone, with the switch off and with the motion service released, and
looks for a wall in them. Prints what it found as one JSON object.

    cloud_watch.py SECONDS
"""

import sys
import time

import numpy as np
from base_truth import Truth
from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient
from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.idl.sensor_msgs.msg.dds_ import PointCloud2_
from unitree_sdk2py.idl.std_msgs.msg.dds_ import String_

from ending import end_with

POINT = np.dtype({
    "names": ["x", "y", "z", "gap", "intensity", "ring", "time", "tail"],
    "formats": ["<f4", "<f4", "<f4", "<u4", "<f4", "<u2", "<f4", "<u4"],
    "offsets": [0, 4, 8, 12, 16, 20, 24, 28], "itemsize": 32,
})  # fmt: skip
# From a recording of a real one.
ROTATION = np.array([[0.526114, -0.810136, 0.258620], [-0.838668, -0.544643, 0], [0.140854, -0.216897, -0.965979]])
PLACE = np.array([0.28216, 0, 0])


class Clouds:
    """What has come on a topic."""

    def __init__(self, topic):
        self.messages = []
        self._channel = ChannelSubscriber(topic, PointCloud2_)
        self._channel.Init(self.messages.append, 100)

    def during(self, seconds):
        """How many come within that time, after what is under way."""
        time.sleep(0.2)
        before = len(self.messages)
        time.sleep(seconds)
        return len(self.messages) - before


def points_of(message):
    return np.frombuffer(bytes(message.data), dtype=POINT)


def stamp_of(message):
    return message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec


def wall_in(messages):
    """Distance [m] from the base and direction [rad] of the plane ahead and over the ground."""
    seen = np.concatenate([points_of(message) for message in messages])
    points = np.stack([seen["x"], seen["y"], seen["z"]], axis=1) @ ROTATION.T + PLACE
    points = points[(points[:, 2] > -0.2) & (points[:, 0] > 0.8)]
    middle = points.mean(axis=0)
    normal = np.linalg.svd(points - middle, full_matrices=False)[2][2]
    normal *= np.sign(normal[0])
    return {"points": len(points), "distance": float(normal @ middle), "yaw": float(np.arctan2(normal[1], normal[0]))}


def facts_of(messages):
    sizes = [message.width for message in messages]
    stamps = [stamp_of(message) for message in messages]
    grid = np.concatenate([points_of(message)["time"] for message in messages]) * 43200
    return {
        "frame": messages[0].header.frame_id,
        "fields": [[field.name, field.offset, field.datatype, field.count] for field in messages[0].fields],
        "point_step": messages[0].point_step,
        "row_step_fits": all(m.row_step == 32 * m.width == len(m.data) for m in messages),
        "hz": (len(stamps) - 1) / (stamps[-1] - stamps[0]),
        "sizes": [min(sizes), max(sizes)],
        "off_grid": float(np.abs(grid - np.round(grid)).max()),
        "gaps": sorted({int(gap) for m in messages for gap in points_of(m)["gap"]}),
        "tails": sorted({int(tail) for m in messages for tail in points_of(m)["tail"]}),
    }


def main():
    seconds = float(sys.argv[1])
    ChannelFactoryInitialize(0, "lo")
    lidar, base = Clouds("rt/utlidar/cloud"), Clouds("rt/utlidar/cloud_base")
    switch = ChannelPublisher("rt/utlidar/switch", String_)
    switch.Init()
    time.sleep(1 + seconds)
    clouds, bases = list(lidar.messages), list(base.messages)
    report = {"cloud": facts_of(clouds), "cloud_base": facts_of(bases)}
    stamps = {stamp_of(message) for message in clouds}
    report["stamps_shared"] = sum(stamp_of(message) in stamps for message in bases) / len(bases)
    _, truth = Truth().read()
    report["wall"] = {"seen": wall_in(clouds[-10:]), "x": truth[0], "yaw": truth[2]}

    switch.Write(String_("OFF"))
    report["off"] = lidar.during(0.5)
    switch.Write(String_("ON"))
    report["on"] = lidar.during(0.5)
    switcher = MotionSwitcherClient()
    switcher.SetTimeout(5)
    switcher.Init()
    switcher.ReleaseMode()
    report["base_released"], report["cloud_released"] = base.during(0.5), lidar.during(0.5)
    end_with(report)


if __name__ == "__main__":
    main()
