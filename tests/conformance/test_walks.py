"""Quadrupeds walk where the vendor's sport clients say, by their own word and by the truth."""

import concurrent.futures
import math

import pytest

from fleet import fleet, quadrupeds, with_api

ROBOTS = quadrupeds()
GAIN = {"go2": 0.92}  # of a real one's forward speed (docs/dev/walking.md)
HELD = {"b2w": 0.5}  # s that a Move that is not renewed goes on for; else 1
AGILE, FREE_WALK = {"state": 100, "mode": 0}, {"state": 0, "mode": 9}  # error_code and mode
WAYS = {"ahead": (0, 0.5), "left": (1, 0.3), "turn": (2, 0.5)}  # axis, m/s or rad/s; less than half a turn


@pytest.fixture(scope="module")
def walks(rehearse):
    """By robot, what walks.py reports; two at a time."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = pool.map(
            lambda robot: rehearse(robot, "walks.py", ",".join(fleet()[robot]["apis"]),
                                   options=("--start", "standing", "--clock", "simulated")), ROBOTS)
        return {robot: run.report for robot, run in zip(ROBOTS, runs) if run.succeeded()}


def wanted_speed(robot, way):
    axis, speed = WAYS[way]
    return axis, speed * (GAIN.get(robot, 1) if axis < 2 else 1)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_robot_comes_as_far_as_it_is_moved(walks, robot, way):
    axis, speed = wanted_speed(robot, way)
    expected = speed * (walks[robot][way]["commanded"] + HELD.get(robot, 1))
    came = walks[robot][way]["true"]
    assert math.remainder(came[axis] - expected, math.tau if axis == 2 else math.inf) == pytest.approx(0, abs=0.2 * expected)
    aside = [abs(x) for i, x in enumerate(came) if i != axis]
    assert max(aside) < 0.3, came


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_robot_tells_how_far_it_came_and_how_fast(walks, robot, way):
    axis, speed = wanted_speed(robot, way)
    walk = walks[robot][way]
    assert walk["told"] == pytest.approx(walk["true"], abs=0.25), "legs drift"
    assert walk["told"] != walk["true"], "an estimate, not the truth"
    assert walk["speed"][axis] == pytest.approx(speed, rel=0.15)
    assert walk["true_speed"][axis] == pytest.approx(speed, rel=0.15)


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_robot_stands_once_it_is_left_alone(walks, robot, way):
    walk = walks[robot][way]
    assert walk["rest"] < 0.05
    told = {key: walk[key] for key in FREE_WALK}
    assert told == (AGILE if robot in with_api("sport_go2") else FREE_WALK)


def test_obstacles_avoid_moves_a_robot_once_it_is_told_to_hear_the_api(walks):
    report = walks["go2"]
    assert max(abs(x) for x in report["unheard"]["true"]) < 0.05
    assert report["codes"] == [0, 0]
    assert report["avoiding"]["true"][0] == pytest.approx(0.46 * 5, rel=0.2)


def test_obstacles_avoid_moves_a_robot_to_a_place(walks):
    assert walks["go2"]["to_a_place"]["true"] == pytest.approx([0.8, 0.3, 0.5], abs=0.25)
