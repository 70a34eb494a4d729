"""Saves what a Go2's camera sees as front.jpg: picture.py [INTERFACE [DOMAIN]]. Exit code 1: no picture came."""

import sys

from unitree_sdk2py.core.channel import ChannelFactoryInitialize
from unitree_sdk2py.go2.video.video_client import VideoClient


def main():
    ChannelFactoryInitialize(int(sys.argv[2]) if len(sys.argv) > 2 else 0, sys.argv[1] if len(sys.argv) > 1 else "lo")
    client = VideoClient()
    client.SetTimeout(10.0)  # s; the first picture takes longest
    client.Init()
    code, data = client.GetImageSample()
    if code != 0:
        sys.exit(f"no picture came: code {code}")
    with open("front.jpg", "wb") as file:
        file.write(bytes(data))
    print(f"front.jpg: {len(data)} bytes")


if __name__ == "__main__":
    main()
