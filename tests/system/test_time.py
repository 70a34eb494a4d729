"""The pace of simulated time. Bounds are loose, so that a busy machine passes and a wrong pace does not."""

import itertools
import signal
import time

from peers import listener


def steps_per_second(robot, seconds=1.0):
    """Physics steps by wall time, from two statuses."""
    first, started = robot.status()["steps"], time.monotonic()
    time.sleep(seconds)
    return (robot.status()["steps"] - first) / (time.monotonic() - started)


def gaps(ticks, step):
    """Pairs of succeeding ticks that are not one step apart."""
    return [pair for pair in itertools.pairwise(ticks) if pair[1] - pair[0] != step]


def test_a_second_is_a_thousand_steps(play):
    assert 800 < steps_per_second(play("go2")) < 1200


def test_at_half_speed_a_second_is_half_a_thousand_steps(play):
    robot = play("go2", "--speed", "0.5")

    assert 400 < steps_per_second(robot) < 600
    assert robot.status()["speed"] == 0.5


def test_as_fast_as_possible_is_faster_than_real_time(play):
    robot = play("go2", "--speed", "max")

    assert steps_per_second(robot) > 1500
    assert robot.status()["pace"]["overruns"] == 0  # nothing is late where nothing is due


def stall(robot, seconds):
    robot.send(signal.SIGSTOP)
    time.sleep(seconds)
    robot.send(signal.SIGCONT)


def test_a_short_stall_is_counted_and_made_up_for_tick_by_tick(play):
    robot = play("go2")
    with listener() as ear:
        ear.wait()
        before = robot.status()
        stall(robot, 0.1)
        after = robot.becomes(lambda status: status["steps"] > before["steps"] + 1000)
        ticks = [state.tick for state in ear.take()]

    assert after["pace"]["overruns"] > before["pace"]["overruns"]
    assert after["pace"]["worst_lateness"] > 0.08
    assert len(ticks) > 400
    assert gaps(ticks, 2) == []
    robot.heard("ticks began late")


def test_a_long_stall_is_counted_and_not_made_up_for(play):
    robot = play("go2")
    first, started = robot.status(), time.monotonic()
    stall(robot, 1.5)
    after = robot.becomes(lambda status: status["steps"] > first["steps"] + 300)
    rate = (after["steps"] - first["steps"]) / (time.monotonic() - started)

    assert rate < 800
    assert after["pace"]["shifts"] > first["pace"]["shifts"]
    assert after["pace"]["shifted"] > 1.4
    robot.heard("does not catch up", "warning")


def test_the_tick_is_in_milliseconds_whatever_the_speed(play):
    play("go2", "--speed", "0.25")
    with listener() as ear:
        ear.wait()
        ticks = [state.tick for state in ear.take_for(0.8)]

    assert gaps(ticks, 2) == []
    assert 60 < len(ticks) < 140
