"""Every example of every help does its work, typed as it stands there, at a desk where the files that it names lie."""

import signal
import subprocess

import pytest

from console import Typed
from desk import ETH0, FAR, ON_A_STAND, bash, go_on, prepare, works
from helps import examples_of, verbs
from namespaces import host_on_a_cable
from page_session import Session
from robots import understudy

ALONE = ("ctl", "doctor", "remote")  # have a test of their own
COMMANDS = [verb[0] for verb in verbs() if len(verb) == 1 and verb[0] not in ALONE]


@pytest.mark.parametrize("command", COMMANDS)
def test_every_example_of_a_help_works(command, desk, screen, monkeypatch):
    monkeypatch.setenv("DISPLAY", screen.name)
    if command == "judge":
        assert understudy("rehearse", "stand_up", cwd=desk, timeout=120).returncode == 0
    if command == "rehearse":  # those that are to be merged
        for part in (1, 3, 4):
            assert understudy("rehearse", "shoves.yaml", "--shard", f"{part}/4", "--out", f"part{part}", cwd=desk,
                              timeout=120).returncode in (0, 10)
    with Session(desk, {}) as session:
        for line in examples_of(command):
            if "--network-interface eth0" in line:
                with host_on_a_cable(ETH0, FAR):
                    session.type(Typed("", f"understudy run go2 {' '.join(ON_A_STAND)} --interface eth0", []))
                    session.type(Typed("", line, []))
                    session.stop_robots()
            elif "--as-robot" in line:
                with host_on_a_cable(ETH0, FAR):
                    session.type(Typed("", line, []))
                    session.stop_robots()
            else:
                session.type(Typed("", line, []))


def test_every_example_of_the_remote_controller_works(desk):
    with Session(desk, {}) as session:
        for line in examples_of("remote"):
            session.type(Typed("", line, []))


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
    """All but the one that stops the robot, each once: a group's is one of its requests'."""
    lines = [line for verb in verbs() if verb[0] == "ctl" and verb != ("ctl", "stop") for line in examples_of(*verb)]
    return list(dict.fromkeys(lines))


@pytest.fixture(name="left")
def left_fixture(desk):
    """A robot in the background, which the last example of all stops."""
    started = understudy("run", "go2", "--start", "hanging", "--set", "objects=[{kind: cube, pos: [2, 0, 0]}]",
                         "--name", "left", "--detach")
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
