"""A stranger on the network who says of its types what it likes: packets made by hand, as DDSI-RTPS 2.2 has them.

All go to the group that everybody in domain 0 listens to.
"""

import os
import socket
import struct
import time
from hashlib import md5

GROUP = ("239.255.0.1", 7400)
CYCLONE, FAST_DDS = b"\x01\x10", b"\x01\x0f"  # makers
# Writer and reader of: participants, writers, questions and answers about types.
PARTICIPANTS = (0x000100C2, 0x000100C7)
WRITERS = (0x000003C2, 0x000003C7)
QUESTIONS = (0x000300C3, 0x000300C4)
ANSWERS = (0x000301C3, 0x000301C4)
GET_TYPES = 0x018252D3
FRAGMENT = 32_000  # bytes
HEARTBEAT, DATA, DATA_FRAG = 0x07, 0x15, 0x16
HAS_ALL = 0xFFFF  # of the built-in ends
MINIMAL, COMPLETE, BOTH = 0xF1, 0xF2, 0xF3
UINT8, STRUCTURE, PLAIN_SEQUENCE, PLAIN_ARRAY, PLAIN_MAP = 0x0D, 0x51, 0x80, 0x90, 0xA0


class Cdr:
    """XCDR2, little-endian."""

    def __init__(self):
        self.bytes = b""

    def put(self, kinds, *values):
        for kind, value in zip(kinds, values, strict=True):
            size = struct.calcsize(kind)
            self.bytes += bytes(-len(self.bytes) % size) + struct.pack("<" + kind, value)
        return self

    def raw(self, data):
        self.bytes += data
        return self

    def sized(self, fill):
        """What fill(self) adds, with its length in front."""
        self.put("I", 0)
        start = len(self.bytes)
        fill(self)
        self.bytes = self.bytes[:start - 4] + struct.pack("<I", len(self.bytes) - start) + self.bytes[start:]
        return self


def array_of(element):
    """Fills in the identifier of an array of two of a primitive type."""
    return lambda cdr: cdr.put("BBHIBB", PLAIN_ARRAY, BOTH, 0, 1, 2, element)


def map_from(key, element, kind):
    """Fills in the identifier of a map from a primitive type to one whose identifier is of that kind."""
    return lambda cdr: element(cdr.put("BBHB", PLAIN_MAP, kind, 0, 2)).put("HB", 0, key)


def sequences(depth):
    """Fills in the identifier of a sequence of sequences of sequences."""
    def fill(cdr):
        cdr.put("BBHB", PLAIN_SEQUENCE, MINIMAL, 0, 1)  # ends at an odd byte, as each further one does
        cdr.raw(bytes((PLAIN_SEQUENCE, MINIMAL, 0, 0, 0, 1)) * (depth - 1))
        return hashed(MINIMAL, bytes(14))(cdr)
    return fill


def structure(member):
    """The minimal description of a structure with one member, and its hash."""
    def body(cdr):
        cdr.put("BBH", MINIMAL, STRUCTURE, 1).sized(lambda header: header.put("B", 0))
        cdr.sized(lambda members: members.put("I", 1).sized(
            lambda one: member(one.put("IH", 0, 0)).raw(md5(b"data").digest()[:4])))
    description = Cdr().sized(body).bytes
    return description, md5(description).digest()[:14]


def hashed(kind, digest):
    """Fills in an identifier that is a hash."""
    return lambda cdr: cdr.put("B", kind).raw(digest)


def information(minimal, complete):
    """What an end says of its type: two identifiers, without what they depend on."""
    def identifier(fill):
        def with_dependencies(cdr):
            cdr.sized(lambda one: fill(one).put("I", 100)).put("i", 0)
            cdr.sized(lambda none: none.put("I", 0))
        return lambda cdr: cdr.sized(with_dependencies)

    def members(cdr):
        for number, fill in ((0x1001, minimal), (0x1002, complete)):
            cdr.put("I", 4 << 28 | number)
            cdr.sized(identifier(fill))
    return Cdr().sized(members).bytes


def member_id(name):
    return int.from_bytes(md5(name).digest()[:4], "little") & 0x0FFFFFFF


def question(asker, identifier):
    """A question about a type."""
    def arguments(cdr):
        cdr.put("I", 4 << 28 | member_id(b"type_ids"))
        cdr.sized(lambda one: one.sized(lambda ids: identifier(ids.put("I", 1))))
    cdr = Cdr().raw(asker).put("iII", 0, 1, 1).raw(b"\0")
    return cdr.sized(lambda call: call.put("i", GET_TYPES).sized(arguments)).bytes


def answer(asker, pairs):
    """An answer about types: identifiers and descriptions."""
    def list_of_pairs(cdr):
        cdr.put("I", len(pairs))
        for identifier, description in pairs:
            identifier(cdr)
            cdr.raw(bytes(-len(cdr.bytes) % 4)).raw(description)

    def result(cdr):
        cdr.put("i", 0).sized(lambda out: out.put("I", 4 << 28 | member_id(b"types")).sized(
            lambda one: one.sized(list_of_pairs)))
    cdr = Cdr().raw(asker).put("iIi", 0, 1, 0)
    return cdr.sized(lambda returned: returned.put("i", GET_TYPES).sized(result)).bytes


def parameters(*pairs):
    told = b""
    for number, value in pairs:
        value += bytes(-len(value) % 4)
        told += struct.pack("<HH", number, len(value)) + value
    return told + struct.pack("<HH", 1, 0)


def text(value):
    return struct.pack("<I", len(value) + 1) + value.encode() + b"\0"


class Stranger:
    """A participant that is only its packets."""

    def __init__(self, maker):
        self._maker, self.prefix = maker, maker + os.urandom(10)
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, socket.inet_aton("127.0.0.1"))
        self._socket.bind(("127.0.0.1", 0))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._socket.close()

    def _send(self, ends, encoding, payload):
        """That a writer has sent nothing yet, and then its first message."""
        writer, reader = (struct.pack(">I", end) for end in ends)
        first = reader + writer + struct.pack("<iI", 0, 1)
        self._packet((HEARTBEAT, 1, first + struct.pack("<iIi", 0, 0, 1)))
        padding = -len(payload) % 4
        payload = encoding + bytes((0, padding)) + payload + bytes(padding)
        if len(payload) <= 2 * FRAGMENT:
            return self._packet((DATA, 5, b"\0\0" + struct.pack("<H", 16) + first + payload))
        for start in range(0, len(payload), FRAGMENT):
            which = struct.pack("<IHHI", start // FRAGMENT + 1, 1, FRAGMENT, len(payload))
            part = payload[start:start + FRAGMENT]
            self._packet((DATA_FRAG, 1, b"\0\0" + struct.pack("<H", 28) + first + which + part))

    def _packet(self, message):
        kind, flags, body = message
        self._socket.sendto(b"RTPS\x02\x02" + self._maker + self.prefix + bytes((kind, flags)) +
                            struct.pack("<H", len(body)) + body, GROUP)

    def joins(self):
        port = self._socket.getsockname()[1]
        locator = struct.pack("<iI", 1, port) + bytes(12) + socket.inet_aton("127.0.0.1")
        guid = self.prefix + struct.pack(">I", 0x000001C1)
        self._send(PARTICIPANTS, b"\0\3", parameters(
            (0x15, b"\2\2"), (0x16, self._maker), (0x50, guid), (0x58, struct.pack("<I", HAS_ALL)),
            (0x02, struct.pack("<iI", 20, 0)), (0x32, locator), (0x31, locator)))

    def writes(self, topic, type_name, about_type):
        """Has a reliable writer."""
        self._send(WRITERS, b"\0\3", parameters(
            (0x5A, self.prefix + struct.pack(">I", 0x00000103)), (0x05, text(topic)), (0x07, text(type_name)),
            (0x1A, struct.pack("<IiI", 2, 0, 0)), (0x75, about_type)))

    def answers(self, pairs):
        self._send(ANSWERS, b"\0\7", answer(self.prefix + struct.pack(">I", QUESTIONS[0]), pairs))

    def asks(self, identifier):
        guid = self.prefix + struct.pack(">I", QUESTIONS[0])
        self._send(QUESTIONS, b"\0\7", question(guid, identifier))

    def insists(self, topic, type_name, about_type, pairs, seconds):
        """Joins, writes and answers again and again, as nothing is heard of what others think of it."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.joins()
            time.sleep(0.1)
            self.writes(topic, type_name, about_type)
            time.sleep(0.1)
            self.answers(pairs)
