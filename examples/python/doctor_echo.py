#!/usr/bin/env python3
"""The far end of `understudy doctor --peer`, for a computer on which Understudy is not built, such as a robot's Jetson.

    python3 doctor_echo.py --interface eth0 --as jetson

It answers as `understudy doctor --echo` does and needs this file alone, Python 3.8 or later, and the vendor's SDK for
Python (unitree_sdk2py, with cyclonedds 0.10.2). On the other computer: understudy doctor --interface eth0 --peer jetson.
Exit codes: 0 after Ctrl-C or SIGTERM, 2 for a wrong command line, 5 where the network cannot be used.
"""

import argparse
import os
import signal
import socket
import struct
import sys
import threading
import time

try:
    from cyclonedds.core import InstanceState, ReadCondition, SampleState, ViewState, WaitSet
    from cyclonedds.domain import Domain, DomainParticipant
    from cyclonedds.pub import DataWriter
    from cyclonedds.qos import Policy, Qos
    from cyclonedds.sub import DataReader
    from cyclonedds.topic import Topic
    from cyclonedds.util import duration
    from unitree_sdk2py.idl import default
    from unitree_sdk2py.idl.unitree_go.msg import dds_ as go
    from unitree_sdk2py.idl.unitree_hg.msg import dds_ as hg
except ImportError as error:
    sys.exit(f"doctor_echo.py: {error}; run it where the vendor's examples run: unitree_sdk2py with cyclonedds 0.10.2")

GROUP = "239.255.0.1"  # of DDS discovery: DDSI-RTPS 2.2, section 9.6.1.4
ANNOUNCED = "understudy doctor echo "
NETWORK = 5  # the exit code
DEPTH = 256  # messages, 0.5 s of pings, as the other echo keeps them
LITTLE_ENDIAN = 1  # second byte of a message's header

# Messages are taken and sent as bytes: to make objects of them takes Python longer than the round trip that is measured.
# Where a mark lies in them is found out once, by numbers that occur nowhere else.
SIGNS = [0x5A5AC301, 0x5A5AC302, 0x5A5AC303]


class Raw(bytes):
    """A message as it came; cyclonedds adds `sample_info` to it."""


def offsets(message, values):
    """Where these numbers lie in a message, bytes from its beginning."""
    return [message.index(struct.pack("<I", value)) for value in values]


class Half:
    """Answers the pings of one family of messages: LowCmd in, LowState out.

    A ping says who asks (session), who is to answer (target) and its number. A pong says so too, and when it was
    written, ns since 1970, low word first.
    """

    def __init__(self, participant, name, types, state, command, mark):
        for message, field in ((state, mark), (command, mark)):
            getattr(message, field)[:2] = SIGNS[:2]
            message.crc = SIGNS[2]
        ping = command.serialize()
        self.ping_size = len(ping)
        self.ping_marks = offsets(ping, SIGNS)
        state.version[:] = [0x5A5AC304, 0x5A5AC305]
        self.pong = bytearray(state.serialize())
        self.pong_marks = offsets(self.pong, SIGNS)
        self.pong_time = offsets(self.pong, state.version)
        types.LowCmd_.deserialize = classmethod(lambda cls, data, **_: Raw(data))
        types.LowState_.serialize = lambda message, **_: bytes(self.pong)
        self.state = state
        best = Qos(Policy.Reliability.BestEffort, Policy.History.KeepLast(DEPTH))
        last = Qos(Policy.Reliability.Reliable(0), Policy.History.KeepLast(1))
        self.reader = DataReader(participant, Topic(participant, f"understudy_doctor/{name}/ping", types.LowCmd_), best)
        self.writer = DataWriter(participant, Topic(participant, f"understudy_doctor/{name}/pong", types.LowState_), last)

    def answer(self, tag):
        """Answers what has come for `tag`; returns how many."""
        count = 0
        for ping in self.reader.take(N=64):
            if not isinstance(ping, Raw) or len(ping) < self.ping_size or ping[1] != LITTLE_ENDIAN:
                continue
            marks = [ping[at:at + 4] for at in self.ping_marks]
            if struct.unpack("<I", marks[1])[0] != tag:
                continue
            for at, mark in zip(self.pong_marks, marks):
                self.pong[at:at + 4] = mark
            for at, word in zip(self.pong_time, struct.unpack("<II", struct.pack("<q", time.time_ns()))):
                struct.pack_into("<I", self.pong, at, word)
            self.writer.write(self.state)
            count += 1
        return count


def tag_of(participant):
    """The number by which a participant is meant: FNV-1a of its GUID."""
    tag = 2166136261
    for byte in participant.guid.bytes:
        tag = (tag ^ byte) * 16777619 & 0xFFFFFFFF
    return tag


class Datagrams(threading.Thread):
    """Answers the datagrams that the doctor sends beside DDS, to the sender and to the group.

    52 bytes: "UNDERDOC", kind, three zeros, session, number, name of who answers. Kinds: 1 asks one, 2 asks the group,
    3, 4 and 5 answer one, the group's sender, and to the group.
    """

    FORM = struct.Struct("!8sB3xII32s")

    def __init__(self, interface, domain, name):
        super().__init__(daemon=True)
        self.name_bytes = name.encode()[:32]
        self.port = 7400 + 250 * domain + 130
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        self.socket.bind(("", self.port))
        group = socket.inet_aton(GROUP) + struct.pack("@4xi", socket.if_nametoindex(interface))
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, group)
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, group)

    def run(self):
        while True:
            bytes_, sender = self.socket.recvfrom(self.FORM.size + 1)
            if len(bytes_) != self.FORM.size:
                continue
            magic, kind, session, number, _ = self.FORM.unpack(bytes_)
            if magic == b"UNDERDOC" and kind in (1, 2):
                self.send(kind + 2, session, number, sender)
            if magic == b"UNDERDOC" and kind == 1:
                self.send(5, session, number, (GROUP, self.port))

    def send(self, kind, session, number, to):
        try:
            self.socket.sendto(self.FORM.pack(b"UNDERDOC", kind, session, number, self.name_bytes), to)
        except OSError:
            pass  # the doctor counts what does not arrive


def domain_number(text):
    number = int(text)
    if not 0 <= number <= 230:
        raise argparse.ArgumentTypeError(f"{text}: expected 0 to 230")
    return number


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--interface", default="lo", metavar="NAME", help="network interface [lo]")
    parser.add_argument("--domain", type=domain_number, default=0, metavar="N", help="DDS domain, 0 to 230 [0]")
    parser.add_argument("--as", dest="name", default=socket.gethostname(), metavar="NAME",
                        help="name of the echo, for --peer [the host's]")
    return parser.parse_args()


def stop(*_):
    raise KeyboardInterrupt


def main():
    asked = arguments()
    signal.signal(signal.SIGTERM, stop)
    interfaces = [name for _, name in socket.if_nameindex()]
    if asked.interface not in interfaces:
        print(f"doctor_echo.py: no network interface '{asked.interface}'; there are {', '.join(interfaces)}", file=sys.stderr)
        return NETWORK
    os.environ.pop("CYCLONEDDS_URI", None)  # --interface says where
    answered = 0
    try:
        settings = (f'<CycloneDDS><Domain Id="any"><General><Interfaces><NetworkInterface name="{asked.interface}" '
                    'multicast="default"/></Interfaces></General></Domain></CycloneDDS>')
        domain = Domain(asked.domain, settings)  # noqa: F841: it lives as long as its participants
        participant = DomainParticipant(asked.domain, Qos(Policy.Userdata((ANNOUNCED + asked.name).encode())))
        halves = [Half(participant, "go", go, default.unitree_go_msg_dds__LowState_(),
                       default.unitree_go_msg_dds__LowCmd_(), "sn"),
                  Half(participant, "hg", hg, default.unitree_hg_msg_dds__LowState_(),
                       default.unitree_hg_msg_dds__LowCmd_(), "reserve")]
        Datagrams(asked.interface, asked.domain, asked.name).start()
    except Exception as error:  # of cyclonedds, and of sockets
        print(f"doctor_echo.py: {asked.interface}, domain {asked.domain}: {error}", file=sys.stderr)
        return NETWORK
    tag = tag_of(participant)
    waiting = WaitSet(participant)
    for half in halves:
        waiting.attach(ReadCondition(half.reader, SampleState.Any | ViewState.Any | InstanceState.Any))
    print(f"{asked.name} answers on {asked.interface}, domain {asked.domain}; Ctrl-C ends it", flush=True)
    try:
        while True:
            waiting.wait(duration(milliseconds=200))
            answered += sum(half.answer(tag) for half in halves)
    except KeyboardInterrupt:
        print(f"answered {answered} messages")
    return 0


if __name__ == "__main__":
    sys.exit(main())
