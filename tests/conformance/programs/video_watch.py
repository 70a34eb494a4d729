"""Reads a camera's stream as RTP for some seconds; meanwhile ffmpeg joins it in its middle and decodes a few frames to
a file, then PyAV to another, and LowState is read with the vendor's Python SDK. Prints what it found as one JSON object.

    video_watch.py PORT FILE FILE_OF_PYAV SECONDS
"""

import pathlib
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

import av
from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowState_

from ending import end_with

GROUP, FRAMES = "230.1.1.1", 5
SDP = """v=0
o=- 0 0 IN IP4 127.0.0.1
s=robot
c=IN IP4 {group}
t=0 0
m=video {port} RTP/AVP 96
a=rtpmap:96 H264/90000
"""


def joined(port):
    member = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    member.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    member.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
    member.bind((GROUP, port))
    here = struct.pack("4s4si", socket.inet_aton(GROUP), bytes(4), socket.if_nametoindex("lo"))
    member.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, here)
    member.settimeout(0.2)
    return member


def type_of(payload):
    """Of a NAL unit, or 0 for a fragment that is not its first."""
    kind = payload[0] & 31
    return kind if kind != 28 else payload[1] & 31 if payload[1] & 128 else 0


def decode_by_pyav(sdp, file):
    """Of what comes before a frame that stands for itself a decoder may complain."""
    frames = 0
    with av.open(str(sdp), options={"protocol_whitelist": "file,udp,rtp"}, timeout=50) as stream, open(file, "wb") as out:
        for packet in stream.demux(video=0):
            try:
                decoded = packet.decode()
            except av.error.InvalidDataError:
                continue
            for frame in decoded:
                out.write(frame.to_ndarray(format="rgb24").tobytes())
                frames += 1
            if frames >= FRAMES:
                return


def decode(port, file, file_of_pyav):
    with tempfile.TemporaryDirectory() as folder:
        sdp = pathlib.Path(folder) / "robot.sdp"
        sdp.write_text(SDP.format(group=GROUP, port=port))
        subprocess.run(["ffmpeg", "-loglevel", "fatal", "-protocol_whitelist", "file,udp,rtp", "-i", sdp, "-frames:v",
                        str(FRAMES), "-f", "rawvideo", "-pix_fmt", "rgb24", file], check=True, timeout=50)  # fmt: skip
        decode_by_pyav(sdp, file_of_pyav)


def main(port, file, file_of_pyav, seconds):
    ChannelFactoryInitialize(0, "lo")
    states = []
    channel = ChannelSubscriber("rt/lowstate", LowState_)
    channel.Init(lambda state: states.append((time.monotonic(), state.tick)), 50)
    member = joined(port)
    decoder = threading.Thread(target=decode, args=(port, file, file_of_pyav))
    packets, end = [], None
    while end is None or time.monotonic() < end or decoder.is_alive():
        try:
            packets.append(member.recv(2000))
        except TimeoutError:
            continue
        if end is None:
            end = time.monotonic() + seconds
        if time.monotonic() > end - seconds / 2 and decoder.ident is None:
            decoder.start()
    heads = [struct.unpack(">BBHII", packet[:12]) for packet in packets]
    kinds = [type_of(packet[12:]) for packet in packets]
    times = [time for _, mark, _, time, _ in heads if mark & 128]
    (first, first_tick), (last, last_tick) = states[0], states[-1]
    end_with({
        "kinds": sorted({(flags, mark & 127) for flags, mark, *_ in heads}),
        "sources": len({source for *_, source in heads}),
        "longest": max(map(len, packets)),
        "lost": sum((b[2] - a[2]) % 65536 != 1 for a, b in zip(heads, heads[1:])),
        "frames": len(times),
        "keys": kinds.count(5),
        "before_keys": sorted({tuple(kinds[i - 2:i]) for i, kind in enumerate(kinds) if kind == 5 and i > 2 and kinds[i - 1] != 6}),
        "seconds": (times[-1] - times[0]) / 90000,
        "steps": [(b - a) / 90000 for a, b in zip(times, times[1:])],
        "states_per_tick": len(states) / ((last_tick - first_tick) / 2 + 1),
        "pace": (last_tick - first_tick) / 1000 / (last - first),
    })  # fmt: skip


main(int(sys.argv[1]), *sys.argv[2:4], float(sys.argv[4]))
