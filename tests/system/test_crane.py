"""The crane and the clamp, by `ctl`."""

import pytest


def height(robot):
    return robot.status()["base"]["height"]


def settled(robot):
    """The status once the winch has stopped."""
    status = robot.status()
    return robot.becomes(lambda now: now["time"] > status["time"] + 0.3)


@pytest.mark.parametrize("robot", ["g1", "go2"])
def test_a_robot_hangs_from_the_crane(play, robot):
    hanging = play(robot, "--start", "hanging")
    status = settled(hanging)

    assert status["crane"]["attached"]
    assert status["crane"]["tension"] > 50
    assert status["base"]["height"] > 0.5


@pytest.mark.parametrize("robot", ["g1", "go2"])
def test_the_crane_lowers_the_base_as_far_as_told_and_raises_it_again(play, robot):
    hanging = play(robot, "--start", "hanging", "--set", "crane.speed=1")
    before = settled(hanging)

    hanging.ctl("crane", "lower", "0.05")
    hanging.becomes(lambda now: now["crane"]["length"] > before["crane"]["length"] + 0.0499)
    low = settled(hanging)
    hanging.ctl("crane", "raise", "0.05")
    hanging.becomes(lambda now: now["crane"]["length"] < before["crane"]["length"] + 0.0001)
    high = settled(hanging)

    assert before["base"]["height"] - low["base"]["height"] == pytest.approx(0.05, abs=0.03)
    assert high["base"]["height"] - low["base"]["height"] == pytest.approx(0.05, abs=0.03)


def test_a_g1_let_down_by_0_3_m_loses_weight_to_the_ground(play):
    robot = play("g1", "--start", "hanging", "--set", "crane.speed=1")
    before = settled(robot)

    robot.ctl("crane", "lower", "0.3")
    after = robot.becomes(
        lambda now: now["crane"]["length"] > before["crane"]["length"] + 0.2999)

    assert after["base"]["height"] < before["base"]["height"] - 0.05
    robot.becomes(lambda now: now["crane"]["tension"] < before["crane"]["tension"] - 50)


def test_a_robot_can_be_hung_up_where_it_lies_and_raised(play):
    robot = play("go2", "--set", "crane.speed=1")
    low = settled(robot)["base"]["height"]

    robot.ctl("crane", "attach")
    robot.ctl("crane", "raise", "0.2")

    robot.becomes(lambda now: now["base"]["height"] > low + 0.15)
