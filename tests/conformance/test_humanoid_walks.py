"""Humanoids walk where the vendor's LocoClients say, by the truth."""

import pytest

from fleet import fleet

ROBOTS = ("g1", "h1", "h1_2", "h1_2 inspire")  # a robot and its hands
WAYS = {"ahead": (0, 0.4), "turn": (2, 0.4)}  # axis, m/s or rad/s


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("robot", ROBOTS)
def test_a_robot_comes_as_far_as_it_is_moved_and_stands(rehearse, robot, way):
    robot, *hands = robot.split()
    run = rehearse(robot, "humanoid_walks.py", ",".join(fleet()[robot]["apis"]),
                   options=("--start", "standing", "--clock", "simulated", "--hands", *(hands or ["none"])),
                   patience=120.0)
    assert run.succeeded()
    walk, (axis, speed) = run.report[way], WAYS[way]
    # It sways over to its first foot, gathers speed, and stops within a few steps.
    assert walk["true"][axis] == pytest.approx(speed * (walk["commanded"] - 0.7), rel=0.25)
    assert max(abs(x) for i, x in enumerate(walk["true"]) if i != axis) < 0.3
    assert max(abs(x) for x in walk["rest"]) < 0.02
