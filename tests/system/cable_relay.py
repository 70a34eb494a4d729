"""A cable with faults: passes frames between two interfaces of its own network, late, or not at all.

    cable_relay.py LEFT RIGHT '{"delay": 0.01, "loss": 0.2, "multicast": false}'

It says "ready" when it relays. A cable of veth ends alone would need the kernel's netem, which not every kernel has.
Frames keep what the kernel says of their checksums (virtio_net_hdr), which it leaves to the card.
"""

import heapq
import json
import random
import select
import socket
import subprocess
import sys
import time

SOL_PACKET, PACKET_VNET_HDR, ETH_P_ALL = 263, 15, 3
HEADER = 10  # bytes of virtio_net_hdr
LARGE = 800  # bytes: LowCmd and LowState are longer, and the datagrams beside DDS shorter


def open_end(name):
    subprocess.run(["ip", "link", "set", name, "up"], check=True)
    end = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(ETH_P_ALL))
    end.setsockopt(SOL_PACKET, PACKET_VNET_HDR, 1)
    end.bind((name, 0))
    end.setblocking(False)
    return end


def main():
    left, right = open_end(sys.argv[1]), open_end(sys.argv[2])
    faults = json.loads(sys.argv[3])
    chance = random.Random(1)
    other = {left: right, right: left}
    under_way = []  # (when, number, end, frame)
    number = 0
    print("ready", flush=True)
    while True:
        wait = max(0.0, under_way[0][0] - time.monotonic()) if under_way else None
        for end in select.select([left, right], [], [], wait)[0]:
            try:
                frame, address = end.recvfrom(70000)
            except OSError:  # an end that went down says so once
                continue
            if address[2] == socket.PACKET_OUTGOING:
                continue
            group = frame[HEADER] & 1 and frame[HEADER:HEADER + 6] != b"\xff" * 6
            if group and not faults.get("multicast", True):
                continue
            if len(frame) > LARGE and chance.random() < faults.get("loss", 0):
                continue
            number += 1
            heapq.heappush(under_way, (time.monotonic() + faults.get("delay", 0), number, other[end], frame))
        while under_way and under_way[0][0] <= time.monotonic():
            _, _, end, frame = heapq.heappop(under_way)
            try:
                end.send(frame)
            except OSError:  # an end that is down or full loses it
                pass


if __name__ == "__main__":
    main()
