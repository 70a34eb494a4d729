"""Serves what a humanoid's cameras see over ZeroMQ, as the vendor's teleimager does on a robot: its client, and with it
xr_teleoperate, read that unchanged.

image_server.py [--binocular] [--host 127.0.0.1]. Needs pyzmq, `understudy` in the PATH and a running robot. Port 60000
answers each request with what is served, as JSON; 55555, 55556 and 55557 publish head, left wrist and right wrist, one
JPEG a message. A camera is looked through while somebody reads it. Ends with the robot, once that is noticed by a
reader's camera, or with Ctrl-C."""

import argparse
import contextlib
import os
import signal
import subprocess
import sys

import zmq

BEGIN, END = b"\xff\xd8", b"\xff\xd9"  # of a JPEG, in which END stands nowhere else
REQUESTS = 60000
HZ = 30  # at most; a machine without a graphics card draws fewer
# Of teleimager: its cameras, their ports; here: what `understudy camera` calls them.
SERVED = {
    "head_camera": (55555, "head"),
    "left_wrist_camera": (55556, "left_wrist"),
    "right_wrist_camera": (55557, "right_wrist"),
}
BINOCULAR = "head_stereo"  # its eyes stand side by side


def sizes():
    """Height and width of each camera's pictures."""
    listed = subprocess.run(["understudy", "camera"], stdout=subprocess.PIPE, text=True)
    if listed.returncode != 0:
        sys.exit(listed.returncode)
    rows = [line.split() for line in listed.stdout.splitlines()[1:]]
    return {row[0]: [int(side) for side in reversed(row[1].split("x"))] for row in rows}


def configuration(binocular):
    """What teleimager's file cam_config_server.yaml says; a camera that the robot lacks is not enabled."""
    known = sizes()
    served = {}
    for name, (port, camera) in SERVED.items():
        two = binocular and name == "head_camera"
        shape = known.get(BINOCULAR if two else camera)
        served[name] = {
            "enable_zmq": shape is not None, "zmq_port": port,
            "enable_webrtc": False, "webrtc_port": REQUESTS + 1 + len(served), "webrtc_codec": None,
            "type": "opencv", "image_shape": shape or [480, 640], "binocular": two, "fps": HZ,
            "video_id": None, "serial_number": None, "physical_path": None,
        }
    return served


def bound(kind, endpoint):
    """A socket that listens there."""
    socket = zmq.Context.instance().socket(kind)
    socket.setsockopt(zmq.SNDHWM, 1)  # who is slow gets the newest
    socket.setsockopt(zmq.LINGER, 0)
    try:
        socket.bind(endpoint)
    except zmq.ZMQError as error:
        sys.exit(f"cannot listen at {endpoint}: {error}")
    return socket


class Feed:
    """One camera: its socket, and the program that looks through it while somebody reads."""

    def __init__(self, camera, endpoint):
        self.camera = camera
        self.socket = bound(zmq.XPUB, endpoint)  # as PUB, and reports readers
        self.readers = set()  # what they subscribe to
        self.looks = None
        self.unread = b""

    def attend(self, poller):
        """Readers have come or gone."""
        told = self.socket.recv()
        (self.readers.add if told[:1] == b"\1" else self.readers.discard)(told[1:])
        (self.begin if self.readers else self.end)(poller)

    def begin(self, poller):
        if self.looks is None:
            command = ["understudy", "camera", self.camera, "--out", "-", "--hz", str(HZ)]
            self.looks = subprocess.Popen(command, stdout=subprocess.PIPE)
            poller.register(self.looks.stdout.fileno(), zmq.POLLIN)

    def end(self, poller):
        if self.looks is not None:
            poller.unregister(self.looks.stdout.fileno())
            self.looks.terminate()
            self.looks.communicate()
            self.looks, self.unread = None, b""

    def forward(self):
        """Sends what has been seen."""
        piece = os.read(self.looks.stdout.fileno(), 1 << 16)
        if not piece:
            sys.exit(self.looks.wait())  # the robot has ended, or why it gives no pictures is said
        self.unread += piece
        while (end := self.unread.find(END)) >= 0:
            picture, self.unread = self.unread[:end + 2], self.unread[end + 2:]
            if picture.startswith(BEGIN):
                self.socket.send(picture)


def serve(served, host):
    requests = bound(zmq.REP, f"tcp://{host}:{REQUESTS}")
    print(f"image server at tcp://{host}:{REQUESTS}", flush=True)
    poller = zmq.Poller()
    poller.register(requests, zmq.POLLIN)
    feeds = []
    for name, camera in served.items():
        if camera["enable_zmq"]:
            looked = BINOCULAR if camera["binocular"] else SERVED[name][1]
            feeds.append(Feed(looked, f"tcp://{host}:{camera['zmq_port']}"))
            poller.register(feeds[-1].socket, zmq.POLLIN)
    try:
        while True:
            ready = dict(poller.poll())
            if requests in ready:
                requests.recv()
                requests.send_json(served)
            for feed in feeds:
                if feed.looks is not None and feed.looks.stdout.fileno() in ready:
                    feed.forward()
                if feed.socket in ready:
                    feed.attend(poller)
    finally:
        for feed in feeds:
            feed.end(poller)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--binocular", action="store_true", help="the head's stereo camera, in place of its D435i")
    arguments.add_argument("--host", default="127.0.0.1", help="address to listen on [127.0.0.1]; 0.0.0.0: all")
    given = arguments.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(0))
    with contextlib.suppress(KeyboardInterrupt):
        serve(configuration(given.binocular), given.host)


if __name__ == "__main__":
    main()
