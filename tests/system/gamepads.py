"""A gamepad for `understudy remote` on a machine that has none and no /dev/uinput to make one.

tests/remote/virtual_gamepad.cc is preloaded into the program as it is shipped and plugs an SDL joystick in and
out. Everything from SDL's driver interface on is what a gamepad of plastic meets: hot-plug events, the mapping of
its buttons, the loop, the control socket.
"""

import os
import pathlib

LIBRARY = pathlib.Path(os.environ["UNDERSTUDY"]).resolve().parents[1] / "tests/remote/virtual_gamepad.so"
OURS_ONLY = {"SDL_GAMECONTROLLER_IGNORE_DEVICES_EXCEPT": "0x5eed/0x0001"}  # not those of this machine

# Which of its buttons and axes are which, as gamecontrollerdb.txt has it for an Xbox 360 controller on Linux.
BUTTONS = {"a": 0, "b": 1, "x": 2, "y": 3, "leftshoulder": 4, "rightshoulder": 5, "back": 6, "start": 7, "guide": 8,
           "leftstick": 9, "rightstick": 10}
AXES = {"leftx": 0, "lefty": 1, "lefttrigger": 2, "rightx": 3, "righty": 4, "righttrigger": 5}
HAT = {"dpup": 1, "dpright": 2, "dpdown": 4, "dpleft": 8}
LEAST, MOST = -32768, 32767  # of an axis; sticks: left and forward are least; triggers: let go is least


def mapping(guid):
    """The line that makes it known to SDL."""
    parts = [*(f"{name}:b{index}" for name, index in BUTTONS.items()),
             *(f"{name}:a{index}" for name, index in AXES.items()),
             *(f"{name}:h0.{bit}" for name, bit in HAT.items())]
    return f"{guid},Red Gamepad,{','.join(parts)},platform:Linux,"


class Gamepad:
    """Not plugged in at first. `environment`: of the program that is to meet it."""

    def __init__(self, folder):
        fifo = pathlib.Path(folder) / "gamepad"
        os.mkfifo(fifo)
        # Both ends, so that what is said before the program listens is not lost.
        self._wire = os.open(fifo, os.O_RDWR)
        self.environment = preloaded(fifo)

    def close(self):
        os.close(self._wire)

    def plug(self):
        self._say("plug")

    def unplug(self):
        self._say("unplug")

    def press(self, name, down=True):
        """A button, a trigger or a way of the directional pad."""
        if name in BUTTONS:
            self._say(f"button {BUTTONS[name]} {int(down)}")
        elif name in HAT:
            self._say(f"hat 0 {HAT[name] if down else 0}")
        else:
            self._say(f"axis {AXES[name]} {MOST if down else LEAST}")

    def release(self, name):
        self.press(name, False)

    def move(self, axis, value):
        self._say(f"axis {AXES[axis]} {value}")

    def _say(self, line):
        os.write(self._wire, f"{line}\n".encode())


def preloaded(wish):
    """The environment with a gamepad that is told what to do by that FIFO."""
    assert LIBRARY.exists(), f"{LIBRARY}: build the target virtual_gamepad"
    return {**os.environ, **OURS_ONLY, "LD_PRELOAD": str(LIBRARY), "UNDERSTUDY_VIRTUAL_GAMEPAD": str(wish)}
