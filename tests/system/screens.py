"""A virtual screen (Xvfb), its pictures, and its mouse and keyboard (xdotool)."""

import os
import pathlib
import struct
import subprocess
import tempfile

from robots import PATIENCE, eventually

WIDTH, HEIGHT = 640, 480


class Screen:
    """An X server of its own."""

    def __init__(self):
        self._folder = tempfile.TemporaryDirectory(prefix="understudy-screen-")
        reading, writing = os.pipe()
        self._server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-nolisten", "tcp", "-noreset",
             "-fbdir", self._folder.name, "+extension", "GLX"],
            pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as number:
            self.name = f":{number.readline().strip()}"
        assert self.name != ":", "Xvfb did not start"

    @property
    def environment(self):
        return {**os.environ, "DISPLAY": self.name}

    def pixels(self, left, top, width, height):
        """What is in that rectangle: bytes of blue, green, red and nothing."""
        data = pathlib.Path(self._folder.name, "Xvfb_screen0").read_bytes()
        head = struct.unpack(">25I", data[:100])  # of an xwd file
        line, begin = head[12], head[0] + 12 * head[19]
        rows = range(top, top + height)
        return b"".join(data[begin + row * line + 4 * left:begin + row * line + 4 * (left + width)]
                        for row in rows)

    def xdotool(self, *arguments):
        return subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, check=True,
                              capture_output=True, text=True, timeout=PATIENCE).stdout

    def find(self, title):
        """The id of the window of that title; empty while there is none."""
        return subprocess.run(["xdotool", "search", "--name", title], env=self.environment,
                              capture_output=True, text=True, timeout=PATIENCE).stdout.strip()

    def window(self, title):
        """Waits until there is a window of that title; its id."""
        return eventually(lambda: self.find(title), what=f"a window '{title}'")

    def end(self):
        self._server.terminate()
        self._server.wait()
        self._folder.cleanup()


def difference(a, b):
    """The share of bytes that differ by more than a little."""
    return sum(abs(x - y) > 12 for x, y in zip(a, b)) / len(a)
