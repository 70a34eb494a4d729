#!/usr/bin/env python3
"""Plays understudy-view, which draws what cameras see: a picture is the text CAMERA QUALITY LIGHT TIME-OF-THE-STATE, a
frame of the video the same as a NAL unit. Its second argument is the file of the control socket: one is made there, and where it is "dark" there is no OpenGL."""

import json
import pathlib
import socket
import struct
import sys

talk = socket.socket(fileno=0)
place = pathlib.Path(sys.argv[2])
place.write_text("")


def receive():
    head = talk.recv(4, socket.MSG_WAITALL)
    return json.loads(talk.recv(struct.unpack("I", head)[0], socket.MSG_WAITALL)) if head else None


last = {}
while order := receive():
    state = receive()
    picture = f"{order['camera']} {order['quality']} {order['light']:.2f} {state['time']:.3f}".encode()
    if order["noise"]:
        picture += f" noise {order['noise']:g}".encode()
    if order["again"]:
        picture = last.get(order["camera"], picture)
    last[order["camera"]] = picture
    jpeg = picture if order["jpeg"] else b""
    depth = f"depth of {order['camera']} within {order['range']}".encode() if order["depth"] else b""
    frame = b"\0\0\1\x65" + picture if order["frame"] else b""
    reply = b"-no OpenGL" if place.name == "dark" else b"+" + struct.pack("II", len(jpeg), len(depth)) + jpeg + depth + frame
    talk.sendall(struct.pack("I", len(reply)) + reply)
