"""Prints the clouds of a Go2's lidar for two seconds: cloud.py [INTERFACE [DOMAIN]]. Exit code 1: none came."""

import sys
import time

from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
from unitree_sdk2py.idl.sensor_msgs.msg.dds_ import PointCloud2_

SECONDS = 2


def main():
    ChannelFactoryInitialize(int(sys.argv[2]) if len(sys.argv) > 2 else 0, sys.argv[1] if len(sys.argv) > 1 else "lo")
    clouds = ChannelSubscriber("rt/utlidar/cloud", PointCloud2_)
    clouds.Init()
    heard, until = 0, time.monotonic() + SECONDS
    while time.monotonic() < until:
        cloud = clouds.Read(0.5)
        if cloud is not None:
            heard += 1
            print(f"{cloud.header.stamp.sec}.{cloud.header.stamp.nanosec:09d} s: {cloud.width} points in {cloud.header.frame_id}")
    if heard == 0:
        sys.exit("no cloud came: is a Go2 there?")


if __name__ == "__main__":
    main()
