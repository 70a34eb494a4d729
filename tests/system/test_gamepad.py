"""A gamepad, from SDL's driver interface to the 40 bytes that a program reads from rt/lowstate."""

import os
import re
import shutil
import struct
import subprocess

import pytest

from gamepads import LEAST, MOST, Gamepad, mapping, preloaded
from peers import listener
from robots import eventually, understudy

# What is pressed on the gamepad, and its bit in the vendor's unitree_joystick.hpp.
BITS = {"rightshoulder": 0, "leftshoulder": 1, "start": 2, "back": 3, "righttrigger": 4, "lefttrigger": 5,
        "leftstick": 6, "rightstick": 7, "a": 8, "b": 9, "x": 10, "y": 11,
        "dpup": 12, "dpright": 13, "dpdown": 14, "dpleft": 15}


def block(*pressed, lx=0.0, ly=0.0, rx=0.0, ry=0.0):
    """The 40 bytes as hardware sends them: head, keys, lx, rx, ry, L2, ly, nothing."""
    keys = sum(1 << BITS[name] for name in pressed)
    return struct.pack("<2sHfffff16x", b"\x55\x51", keys, lx, rx, ry, float("lefttrigger" in pressed), ly)


@pytest.fixture
def gamepad(runtime_dir):
    one = Gamepad(runtime_dir)
    yield one
    one.close()


@pytest.fixture
def guid(runtime_dir):
    """What `understudy remote` says that this gamepad needs a mapping for."""
    folder = runtime_dir / "listed"
    folder.mkdir()
    listed = Gamepad(folder)
    listed.plug()
    done = understudy("remote", "--list-gamepads", env=listed.environment)
    listed.close()
    found = re.fullmatch(r"1  Red Gamepad  unknown, guid ([0-9a-f]{32})\n", done.stdout)
    assert found, f"{done.stdout}{done.stderr}"
    return found[1]


def reader(states):
    """reads(bytes): waits until a program on rt/lowstate has them, all 40."""
    def reads(expected):
        eventually(lambda: expected in [bytes(state.wireless_remote) for state in states.take()],
                   what=f"wireless_remote is {expected.hex(' ', 4)}")

    return reads


def test_a_gamepad_that_comes_and_goes_beside_a_run_is_the_robots_remote(play, gamepad, guid):
    environment = {**gamepad.environment, "SDL_GAMECONTROLLERCONFIG": mapping(guid)}
    robot = play("go2", "--gamepad", "--released", env=environment)
    with listener() as states:
        reads = reader(states)
        reads(bytes(40))  # no remote is there

        gamepad.plug()
        reads(block())  # it is switched on
        for name in BITS:
            gamepad.press(name)
            reads(block(name))
            gamepad.release(name)
            reads(block())

        gamepad.press("lefttrigger")
        gamepad.press("b")
        reads(block("lefttrigger", "b"))
        for stick, value, shown in [("leftx", MOST, {"lx": 1}), ("leftx", LEAST, {"lx": -1}),
                                    ("lefty", LEAST, {"ly": 1}), ("lefty", MOST, {"ly": -1}),
                                    ("rightx", MOST, {"rx": 1}), ("righty", LEAST, {"ry": 1})]:
            gamepad.move(stick, value)
            reads(block("lefttrigger", "b", **shown))
            gamepad.move(stick, 0)
            reads(block("lefttrigger", "b"))

        # Held for longer than the robot waits for news of it.
        gamepad.move("lefty", LEAST)
        reads(block("lefttrigger", "b", ly=1))
        states.take()
        assert {bytes(state.wireless_remote) for state in states.take_for(1.5)} == {
            block("lefttrigger", "b", ly=1)}

        gamepad.unplug()  # while all of that is held
        reads(block())
        states.take()
        assert {bytes(state.wireless_remote) for state in states.take_for(1)} == {block()}

        gamepad.plug()
        gamepad.press("start")
        reads(block("start"))
    said = [line["message"] for line in robot.log() if "Red Gamepad" in line["message"]]
    assert len(robot.log()) == len(robot.said().splitlines())
    assert [message.partition("Red Gamepad ")[2] for message in said] == [
        "is the remote controller", "has gone", "is the remote controller"]


def test_a_mapping_in_a_file_makes_a_gamepad_known_to_understudy_remote(play, gamepad, guid, runtime_dir):
    robot = play("go2")
    gamepad.plug()  # before anybody looks
    file = runtime_dir / "gamecontrollerdb.txt"
    file.write_text(mapping(guid) + "\n")
    remote = subprocess.Popen(
        [os.environ["UNDERSTUDY"], "remote", "--no-keyboard", "--name", robot.name, "--mapping", file],
        env=gamepad.environment, stderr=subprocess.PIPE, text=True)
    with remote, listener() as states:
        reads = reader(states)
        reads(block())
        gamepad.press("x")
        reads(block("x"))
        remote.terminate()  # while it is held
        reads(block())
        assert remote.wait(10) == 0
        assert remote.stderr.read() == "understudy remote: Red Gamepad is the remote controller\n"


def test_a_gamepad_whose_buttons_nobody_knows_is_told_of_and_the_robot_goes_on(play, gamepad, guid):
    robot = play("go2", "--gamepad", env=gamepad.environment)
    gamepad.plug()
    eventually(lambda: f"SDL_GAMECONTROLLERCONFIG, for guid {guid}" in robot.said(), what="it is told of")
    gamepad.unplug()
    then = robot.status()["time"]
    assert robot.becomes(lambda now: now["time"] > then + 0.5)["remote"]["there"] is False
    assert "continues without" not in robot.said()


def test_a_system_that_has_no_gamepads_to_offer_is_no_error(play):
    robot = play("go2", "--gamepad", env=preloaded("broken"))
    eventually(lambda: "no gamepads: there is no such thing here" in robot.said(), what="it is told")
    then = robot.status()["time"]
    assert robot.becomes(lambda now: now["time"] > then + 0.5)["remote"]["there"] is False
    assert "continues without" not in robot.said()


def test_an_installation_without_the_remotes_program_is_no_error(play, runtime_dir, monkeypatch):
    (runtime_dir / "bin").mkdir()
    alone = shutil.copy(os.environ["UNDERSTUDY"], runtime_dir / "bin")
    monkeypatch.setenv("UNDERSTUDY", str(alone))
    robot = play("go2", "--gamepad")
    robot.heard("build the target understudy-remote", "warning")
    robot.becomes(lambda now: now["time"] > 0.5)
