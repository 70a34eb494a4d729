"""Every example of every help does its work, typed as it stands there, at a desk where the files that it names lie."""

import signal
import subprocess

import pytest

from desk import ETH0, FAR, ON_A_STAND, bash, go_on, prepare, works
from helps import examples_of, verbs
from namespaces import host_on_a_cable
from page_session import Session, typed
from robots import understudy

BESIDE_A_ROBOT = ("view", "picture", "film", "excite")
# Of which robot.
START = {"excite": ON_A_STAND, "ctl": ("--start", "hanging")}
COMMANDS = [verb[0] for verb in verbs() if len(verb) == 1 and verb[0] not in ("ctl", "doctor", "run", "remote")]


@pytest.mark.parametrize("command", COMMANDS)
def test_every_example_of_a_help_works(command, desk, play, screen, monkeypatch):
    monkeypatch.setenv("DISPLAY", screen.name)
    if command == "judge":
        assert understudy("rehearse", "stand_up", cwd=desk, timeout=120).returncode == 0
    if command == "rehearse":  # those that are to be merged
        for part in (1, 3, 4):
            assert understudy("rehearse", "shoves.yaml", "--shard", f"{part}/4", "--out", f"part{part}", cwd=desk,
                              timeout=120).returncode in (0, 10)
    robot = None
    if command in BESIDE_A_ROBOT:
        robot = play("go2", *START.get(command, ()), name="left")
    for line in examples_of(command):
        if line.startswith("understudy run"):  # below
            continue
        if "--network-interface eth0" in line:
            robot.end()
            with host_on_a_cable(ETH0, FAR):
                play("go2", *START[command], "--interface", "eth0")
                works(line, desk)
            continue
        if "--commands" in line:  # to a robot of today
            robot = play("go2", *START["excite"])
        works(line, desk)


def test_every_robot_of_a_help_starts_and_has_its_remote_controller(desk, screen, monkeypatch):
    monkeypatch.setenv("DISPLAY", screen.name)
    lines = [line for verb in verbs() for line in examples_of(*verb) if line.startswith("understudy run")]
    with Session(desk, {}) as session:
        for line in dict.fromkeys(lines + examples_of("remote")):
            if " & " not in line:  # that one is below
                session.type(*typed("sh", line))


def test_every_example_of_the_doctor_works(desk):
    with host_on_a_cable(ETH0, FAR) as there:
        lines = examples_of("doctor")
        echo, = (line for line in lines if "--echo" in line)
        with subprocess.Popen([*there, "bash", "-c", f"exec {echo}"], cwd=desk, stdout=subprocess.PIPE,
                              text=True) as far:
            assert far.stdout.readline().startswith("far answers on eth0")
            for line in lines:
                if line != echo:
                    works(line, desk)
            far.send_signal(signal.SIGINT)
            assert far.wait(20) == 0


def ctl_examples():
    """All but that which stops the robot."""
    return [line for verb in verbs() if verb[0] == "ctl" and verb != ("ctl", "stop") for line in examples_of(*verb)]


@pytest.fixture(name="left")
def left_fixture(desk):
    """A robot in the background, which the last example of all stops."""
    started = understudy("run", "go2", *START["ctl"], "--name", "left", "--detach")
    assert started.returncode == 0, started.stderr
    yield
    stop, = examples_of("ctl", "stop")
    works(stop, desk)


def test_every_example_of_ctl_works(desk, left):
    for line in ctl_examples():
        if not line.startswith("understudy run"):
            prepare(line)
            works(line, desk)
            go_on()


def test_a_robot_in_the_background_is_waited_for(desk):
    line, = (line for line in ctl_examples() if line.startswith("understudy run"))
    code, told = bash(f"{line}; code=$?; kill %1; wait %1; exit $code", desk)
    assert code == 0, told


def test_every_help_has_an_example():
    assert not [verb for verb in verbs() if not examples_of(*verb)]
