"""Two robots on one network: which one publishes, and what the log says."""

import os
import pathlib
import subprocess
import sys
import time

import pytest

from peers import go_state, listener, stranger
from robots import eventually

NEIGHBOUR = 6


def silence(robot, other):
    """Has the stranger speak until the robot is silent; gives the robot's status then."""
    def silenced():
        status = robot.status()
        return status if status["silenced"] else None

    return other.speak_until(silenced, go_state())


def test_a_second_robot_on_the_same_network_refuses_and_names_the_first(play, understudy):
    first = play("go2")
    second = understudy("run", "g1", "--duration", "1")

    assert second.returncode == NEIGHBOUR
    assert f"process {first.pid} (understudy)" in second.stderr
    assert "nothing was sent" in second.stderr
    assert first.status()["silenced"] is False


# Without a listening time both publish before they can have heard of each other.
@pytest.mark.parametrize("listen", [0, 0.2])
@pytest.mark.parametrize("offset", [0, 0, 0.02, 0.1, 0.2, 0.3])
def test_of_two_that_start_at_the_same_moment_exactly_one_yields(play, offset, listen):
    options = ("--set", f"guard.listen_loopback={listen}")
    robots = [play("go2", *options, ready=False)]
    time.sleep(offset)
    robots.append(play("go2", *options, ready=False))
    eventually(lambda: any(robot.process.poll() is not None for robot in robots),
               what="one yields\n" + robots[0].said() + robots[1].said())
    time.sleep(0.5)
    codes = [robot.process.poll() for robot in robots]

    assert sorted(codes, key=str) == [NEIGHBOUR, None], [robot.said() for robot in robots]
    yielded, = (robot for robot, code in zip(robots, codes) if code == NEIGHBOUR)
    stayed, = (robot for robot, code in zip(robots, codes) if code is None)
    assert f"process {stayed.pid} " in yielded.said()
    assert not stayed.becomes(lambda status: status["ready"])["silenced"]


def test_beside_a_writer_that_is_silent_a_robot_refuses_and_says_how_to_go_on(understudy):
    with stranger():
        done = understudy("run", "go2", "--duration", "0.1")

    assert done.returncode == NEIGHBOUR
    assert f"process {os.getpid()}" in done.stderr
    assert "has not done so yet; nothing was sent" in done.stderr
    for way in ("start the robot before it", "understudy exec", "--set guard.on_stranger=warn"):
        assert way in done.stderr


def test_told_to_warn_a_robot_starts_beside_a_writer_that_is_silent(play):
    with stranger():
        robot = play("go2", "--set", "guard.on_stranger=warn")

        said = robot.heard("starting anyway", "warning")["message"]
        assert f"process {os.getpid()}" in said


def test_told_to_warn_a_robot_still_refuses_beside_one_that_speaks(play, understudy):
    first = play("go2")
    second = understudy("run", "g1", "--duration", "1", "--set", "guard.on_stranger=warn")

    assert second.returncode == NEIGHBOUR
    assert f"process {first.pid} (understudy)" in second.stderr


def test_a_second_robot_says_nothing_before_it_refuses(play, understudy):
    play("go2")
    with listener() as ear:
        ear.wait()
        understudy("run", "go2", "--duration", "1")
        ticks = [state.tick for state in ear.take()]

    assert ticks == sorted(ticks)


def test_a_second_robot_in_another_domain_plays(play):
    first, second = play("go2"), play("go2", "--domain", "1")

    assert first.status()["ready"] and not first.status()["silenced"]
    assert second.status()["ready"] and not second.status()["silenced"]


def test_a_robot_on_the_other_side_of_an_ended_one_plays(play):
    play("go2").end()

    assert play("go2").status()["ready"]


def test_a_stranger_that_speaks_silences_a_robot_that_moves_on_until_it_has_gone_and_so_does_the_next(play):
    robot = play("go2")
    with stranger() as other, listener() as ear:
        ear.wait()
        silence(robot, other)
        time.sleep(0.1)
        ear.take()
        before = robot.status()

        assert ear.take_for(0.3) == []
        after = robot.becomes(lambda status: status["steps"] > before["steps"] + 200)
        assert after["published"] == before["published"]
        said = robot.heard("another robot speaks", "critical")["message"]
        assert f"process {os.getpid()}" in said
        assert "sends nothing" in said

    robot.becomes(lambda status: not status["silenced"])
    robot.heard("is gone", "info")
    with listener() as ear:
        assert ear.wait()
    with stranger() as other:
        silence(robot, other)
    robot.becomes(lambda status: not status["silenced"])


def test_a_writer_of_lowstate_that_never_speaks_only_draws_a_warning(play):
    robot = play("go2")
    with stranger():
        said = robot.heard("has a writer of rt/lowstate", "warning")["message"]
        time.sleep(0.2)

        assert f"process {os.getpid()}" in said
        assert robot.status()["silenced"] is False


SILENT = """
import sys
from peers import stranger
with stranger():
    sys.stdin.read()
"""


def test_of_several_strangers_each_is_named_and_the_one_that_speaks(play):
    robot = play("go2")
    with subprocess.Popen([sys.executable, "-c", SILENT], stdin=subprocess.PIPE,
                          cwd=pathlib.Path(__file__).parent) as silent:
        robot.heard(f"process {silent.pid} ", "warning")
        with stranger() as other:
            robot.heard(f"process {os.getpid()} ", "warning")
            silence(robot, other)

            said = robot.heard("another robot speaks", "critical")["message"]
            assert f"process {os.getpid()} " in said
            assert f"process {silent.pid} " not in said
        silent.stdin.close()


def test_a_stranger_in_another_domain_is_none(play):
    robot = play("go2", "--domain", "1")
    with stranger() as other:
        other.write(go_state())
        time.sleep(0.3)

        assert robot.status()["silenced"] is False


@pytest.mark.parametrize("action", ["silence", "warn", "stop"])
def test_a_stranger_that_speaks_on_is_reported_once_and_answered_as_is_set(play, action):
    robot = play("go2", "--set", f"guard.on_stranger={action}")
    with stranger() as other:
        other.speak_until(lambda: "another robot speaks" in robot.said(), go_state())
        for _ in range(20):
            other.write(go_state())
            time.sleep(0.01)
        if action == "stop":
            assert robot.exit_code() == NEIGHBOUR
        elif action == "warn":
            published = robot.status()["published"]
            assert not robot.becomes(lambda status: status["published"] > published + 50)["silenced"]
    time.sleep(0.3)

    told, = [line for line in robot.log() if "another robot speaks" in line["message"]]
    assert told["level"] == "critical"
    assert ("guard.on_stranger: warn" in told["message"]) == (action == "warn")
