"""Publishes what a camera sees over ZeroMQ, as teleoperation's image servers do: one JPEG a message.

image_server.py [CAMERA [ENDPOINT]], "head" and "tcp://127.0.0.1:55555" unless told. Needs pyzmq, `understudy` in the PATH and
a running robot. Ends with the robot or with Ctrl-C."""

import subprocess
import sys

import zmq

BEGIN, END = b"\xff\xd8", b"\xff\xd9"  # of a JPEG, in which END stands nowhere else


def pictures(stream):
    """Each JPEG of a stream that has one behind the other."""
    unread = b""
    while piece := stream.read1(1 << 16):
        unread += piece
        while (end := unread.find(END)) >= 0:
            picture, unread = unread[:end + 2], unread[end + 2:]
            if picture.startswith(BEGIN):
                yield picture


def main():
    camera = sys.argv[1] if len(sys.argv) > 1 else "head"
    endpoint = sys.argv[2] if len(sys.argv) > 2 else "tcp://127.0.0.1:55555"
    socket = zmq.Context.instance().socket(zmq.PUB)
    socket.setsockopt(zmq.SNDHWM, 1)  # who is slow gets the newest
    socket.bind(endpoint)
    sees = ["understudy", "camera", camera, "--out", "-", "--hz", "30"]
    with subprocess.Popen(sees, stdout=subprocess.PIPE) as process:
        try:
            for picture in pictures(process.stdout):
                socket.send(picture)
        except KeyboardInterrupt:
            process.terminate()
    sys.exit(process.returncode)


if __name__ == "__main__":
    main()
