"""`understudy remote`: a terminal's keyboard as the robot's remote controller."""

import contextlib
import fcntl
import json
import os
import pathlib
import pty
import signal
import struct
import subprocess
import termios
import time

import pytest

from peers import GoLowState, listener
from robots import eventually, understudy

NO_PADS = {"SDL_GAMECONTROLLER_IGNORE_DEVICES_EXCEPT": "0x5eed/0x5eed"}
STICK = struct.Struct("<xxxxfffff")  # lx, rx, ry, L2, ly


class Terminal:
    """A terminal with `understudy remote` in it."""

    def __init__(self, robot, *options):
        self.master, self._slave = pty.openpty()
        fcntl.ioctl(self._slave, termios.TIOCSWINSZ, struct.pack("HHHH", 30, 100, 0, 0))
        self.before = self.modes()
        self.screen = b""
        self.process = subprocess.Popen(
            [os.environ["UNDERSTUDY"], "remote", "--name", robot.name, *options],
            stdin=self._slave, stdout=self._slave, stderr=subprocess.PIPE,
            env={**os.environ, **NO_PADS}, start_new_session=True)
        os.set_blocking(self.master, False)
        self.sees(b"remote controller of " + robot.name.encode())

    def modes(self):
        return termios.tcgetattr(self._slave)

    def type(self, keys):
        os.write(self.master, keys)

    def sees(self, text):
        """Waits until the text has been on the screen."""
        def seen():
            with contextlib.suppress(BlockingIOError):
                self.screen += os.read(self.master, 65536)
            return text in self.screen

        eventually(seen, what=f"the screen shows {text}")

    def ends(self):
        code = self.process.wait(10)
        return code, self.process.stderr.read().decode()

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stderr.close()
        os.close(self.master)
        os.close(self._slave)


@pytest.fixture
def hold():
    """hold(robot, ...): a Terminal that is the robot's remote; closed after the test."""
    terminals = []

    def start(*arguments):
        terminals.append(Terminal(*arguments))
        return terminals[-1]

    yield start
    for terminal in terminals:
        terminal.close()


@contextlib.contextmanager
def heard_remote():
    """A function that waits for a wireless_remote block, as the vendor's SDK reads it."""
    with listener("rt/lowstate", GoLowState) as states:
        def wait(condition, what):
            return eventually(
                lambda: next((bytes(state.wireless_remote) for state in states.take()
                              if condition(bytes(state.wireless_remote))), None), what=what)

        yield wait


def keys(low, high=0):
    return lambda block: block[:4] == bytes([0x55, 0x51, low, high])


def test_keys_and_sticks_of_a_terminal_reach_the_vendors_sdk_and_go_up_again(play, hold):
    robot = play("go2")
    terminal = hold(robot)
    with heard_remote() as remote:
        remote(keys(0), "the remote is switched on")
        terminal.type(b" w")  # L2, kept
        remote(keys(0x20), "L2")
        terminal.type(b" b")
        block = remote(keys(0x20, 0x02), "L2+B")
        assert STICK.unpack_from(block) == (0, 0, 0, 1, 0)
        terminal.sees(b"\x1b[7m B:b ")
        terminal.type(b" b w")
        remote(keys(0), "both are up")
        terminal.type(b" e J")  # J is j with shift
        remote(lambda block: STICK.unpack_from(block) == (0, -0.5, 0, 0, 1), "the sticks")
        terminal.type(b"\x1b")
        remote(lambda block: not any(block[2:]), "Esc lets go")


def test_a_key_stays_down_while_it_is_held_and_longer_than_the_robot_waits(play, hold):
    robot = play("go2")
    terminal = hold(robot)
    terminal.type(b" a")
    robot.becomes(lambda now: now["remote"]["keys"] == "A")
    with listener("rt/lowstate", GoLowState) as states:
        states.wait()
        blocks = {bytes(state.wireless_remote[2:4]) for state in states.take_for(1.5)}
    assert blocks == {b"\x00\x01"}


def test_a_key_that_is_not_kept_goes_up_by_itself(play, hold):
    robot = play("go2")
    terminal = hold(robot)
    terminal.type(b"x")
    robot.becomes(lambda now: now["remote"]["keys"] == "X")
    robot.becomes(lambda now: now["remote"]["keys"] == "")


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM])
def test_however_it_ends_all_is_let_go_and_the_terminal_is_as_before(play, hold, end):
    robot = play("go2")
    terminal = hold(robot)
    terminal.type(b" w e")
    robot.becomes(lambda now: now["remote"]["keys"] == "L2" and now["remote"]["ly"] == 1)
    assert terminal.modes() != terminal.before
    terminal.process.send_signal(end)
    code, said = terminal.ends()
    assert (code, said) == (0, "")
    robot.becomes(lambda now: now["remote"]["keys"] == "" and now["remote"]["ly"] == 0)
    eventually(lambda: terminal.modes() == terminal.before, what="the terminal's modes")
    terminal.sees(b"\x1b[?25h\x1b[?1049l")


def test_one_that_is_killed_lets_go(play, hold):
    robot = play("go2")
    terminal = hold(robot)
    terminal.type(b" w e")
    robot.becomes(lambda now: now["remote"]["keys"] == "L2" and now["remote"]["ly"] == 1)
    terminal.process.kill()
    robot.becomes(lambda now: now["remote"]["keys"] == "" and now["remote"]["ly"] == 0)


def test_one_that_hangs_lets_go_and_presses_nothing_again_by_itself(play, hold):
    robot = play("go2")
    terminal = hold(robot)
    terminal.type(b" w")
    robot.becomes(lambda now: now["remote"]["keys"] == "L2")
    terminal.process.send_signal(signal.SIGSTOP)
    robot.becomes(lambda now: now["remote"]["keys"] == "")
    terminal.process.send_signal(signal.SIGCONT)
    time.sleep(1)  # in which it renews what it holds
    terminal.type(b"q")
    robot.becomes(lambda now: now["remote"]["keys"] == "L1+L2")

    events = json.loads(robot.ctl("events", "--json"))["events"]
    assert [event["detail"]["keys"] for event in events if event["kind"] == "remote"] == ["L2", "", "L1+L2"]


def test_it_keeps_what_is_held_at_twenty_times_the_speed(play, hold):
    robot = play("go2", "--speed", "20")
    terminal = hold(robot)
    terminal.type(b" w")
    robot.becomes(lambda now: now["remote"]["keys"] == "L2")
    held = 0
    for _ in range(20):
        held += robot.status()["remote"]["keys"] == "L2"
        time.sleep(0.02)
    # What is renewed as slowly as at real time is held for a quarter of it. A busy computer may be late once or twice.
    assert held >= 15


def test_it_ends_with_the_robot(play, hold):
    robot = play("go2")
    terminal = hold(robot)
    robot.end()
    code, said = terminal.ends()
    assert code == 1
    assert "broke off" in said
    eventually(lambda: terminal.modes() == terminal.before, what="the terminal's modes")


def test_without_a_robot_it_says_so_and_leaves_the_terminal_alone():
    done = understudy("remote")
    assert done.returncode == 1
    assert "no robot runs" in done.stderr


def child_of(pid):
    (child,) = pathlib.Path(f"/proc/{pid}/task/{pid}/children").read_text().split()
    return child


def gamepad_of(robot):
    """The process of its gamepad: between them is a keeper, which ends what a program leaves."""
    keeper = child_of(robot.pid)
    return eventually(lambda: pathlib.Path(f"/proc/{keeper}/task/{keeper}/children").read_text().strip())


def test_a_run_with_a_gamepad_goes_on_without_one(play):
    robot = play("go2", "--gamepad", env={**os.environ, **NO_PADS})
    gamepad = gamepad_of(robot)
    eventually(lambda: pathlib.Path(f"/proc/{gamepad}/comm").read_text() == "understudy-remo\n")
    robot.becomes(lambda now: now["time"] > 0.5)
    assert robot.status()["remote"]["there"] is False
    os.kill(int(gamepad), signal.SIGKILL)
    robot.heard("the robot continues without it", "warning")
    robot.send(signal.SIGINT)
    assert robot.exit_code() == 0


def test_the_gamepad_of_a_run_ends_with_it(play):
    robot = play("go2", "--gamepad", env={**os.environ, **NO_PADS})
    gamepad = gamepad_of(robot)
    robot.send(signal.SIGKILL)
    stat = pathlib.Path(f"/proc/{gamepad}/stat")
    eventually(lambda: not stat.exists() or " Z " in stat.read_text(), what="it is gone")


def test_the_gamepads_of_this_machine_are_listed():
    done = understudy("remote", "--list-gamepads", env={**os.environ, **NO_PADS})
    assert done.returncode == 0
    assert done.stdout == "no gamepad is plugged in\n"


def test_where_there_is_no_terminal_it_says_so_and_waits_for_a_gamepad(play):
    robot = play("go2")
    process = subprocess.Popen([os.environ["UNDERSTUDY"], "remote", "--name", robot.name], stdin=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, env={**os.environ, **NO_PADS})
    assert "no keyboard: this is no terminal" in process.stderr.readline()
    assert process.poll() is None
    process.send_signal(signal.SIGINT)
    assert process.wait(10) == 0
    process.stderr.close()


def test_a_dead_zone_that_is_no_number_is_refused():
    done = understudy("remote", "--dead-zone", "nan")
    assert done.returncode == 2
    assert "from 0 to 0.9" in done.stderr


def test_a_mapping_that_is_not_there_is_a_mistake_of_configuration(play):
    robot = play("go2")
    done = understudy("remote", "--name", robot.name, "--mapping", "/nowhere/pads.txt")
    assert done.returncode == 3
    assert "/nowhere/pads.txt" in done.stderr
