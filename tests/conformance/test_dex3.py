"""The vendor's hand example, through the Python SDK, on a G1 that has two Dex3-1 hands."""

import pytest

ROBOT = "g1_29dof_dex3"
SIDES = ("left", "right")


@pytest.fixture
def grip(rehearse):
    run = rehearse(ROBOT, "dex3_grip.py", options=("--start", "clamped", "--clock", "simulated"))
    assert run.succeeded()
    return run


@pytest.mark.parametrize("side", SIDES)
def test_a_hand_has_seven_motors_and_nine_pads(grip, side):
    assert grip.report["shape"][side] == [7, 9, list(range(7))]


@pytest.mark.parametrize("side", SIDES)
def test_a_hand_grips_where_the_example_grips(grip, side):
    assert max(abs(missed) for missed in grip.report["missed"][side]) < 0.09


@pytest.mark.parametrize("side", SIDES)
def test_a_command_to_one_hand_leaves_the_other_alone(grip, side):
    assert grip.report["others"][side] < 0.1


@pytest.mark.parametrize("side", SIDES)
def test_states_come_on_the_fast_topic_and_on_the_slow_one_that_the_example_reads(grip, side):
    assert grip.report["states"][side] > 5 * grip.report["lf_states"][side] > 0


@pytest.mark.parametrize("side", SIDES)
def test_watched_motors_lock_when_commands_stop_and_follow_again_once_cleared(grip, side):
    assert grip.report["watched"][side] == [slot | 1 << 7 for slot in range(7)]
    assert grip.report["cleared"][side] == [slot | 1 << 4 for slot in range(7)]


def test_no_command_of_the_grip_is_refused(grip):
    assert grip.refused_by_hands == [{}, {}]
    for hand in grip.hands:
        assert hand["accepted"] > 0
        assert hand["timeouts"] == 1


def test_a_hand_says_nothing_while_its_program_is_switched_off(rehearse):
    report = rehearse(ROBOT, "dex3_service.py", options=("--start", "clamped")).report

    assert report["codes"] == [0, 0]
    assert report["off"]["left"] == 0
    assert min(report["off"]["right"], *report["on"].values()) > 100
