"""Hands whose services speak MotorCmds_ and MotorStates_, through the vendor's Python SDK."""

import pytest

# By robot, who bears which.
BEARERS = [("g1", "dex1"), ("g1", "dex1_old"), ("g1", "inspire"), ("g1", "brainco"), ("h1_2", "inspire")]
# By make: topics, motors in a message, states a second, q open and q closed.
MAKES = {
    "dex1": (("dex1/left", "dex1/right"), 1, 500, 5.4, 0.0),
    "dex1_old": (("unitree_actuator",), 2, 200, 5.4, 0.0),
    "inspire": (("inspire",), 12, 100, 1.0, 0.0),
    "brainco": (("brainco/left", "brainco/right"), 6, 500, 0.0, 1.0),
}


@pytest.fixture(params=BEARERS, ids="-".join)
def hands(request, rehearse):
    robot, make = request.param
    run = rehearse(robot, "hands_close.py", make,
                   options=("--start", "clamped", "--hands", make, "--clock", "simulated"))  # fmt: skip
    assert run.succeeded()
    return make, run


def test_each_topic_has_the_motors_of_its_service(hands):
    make, run = hands
    topics, motors = MAKES[make][:2]
    assert run.report["motors"] == dict.fromkeys(topics, motors)


def test_states_come_at_the_rate_of_the_service(hands):
    make, run = hands
    assert 0.5 < run.report["rate"] / MAKES[make][2] < 1.1  # fewer on a busy machine


def test_q_opens_and_closes_in_the_sense_of_its_service(hands):
    make, run = hands
    for word, q in zip(("open", "closed"), MAKES[make][3:]):
        for seen in run.report[word].values():
            assert seen == pytest.approx([q] * len(seen), abs=0.1)


def test_a_closed_hand_stays_closed_when_commands_stop(hands):
    make, run = hands
    for seen in run.report["stopped"].values():
        assert seen == pytest.approx([MAKES[make][4]] * len(seen), abs=0.2)


def test_only_a_gripper_times_out(hands):
    make, run = hands
    assert [hand["timeouts"] for hand in run.hands] == [int(make.startswith("dex1"))] * len(run.hands)
    assert not any(run.refused_by_hands)
    assert all(hand["accepted"] > 0 for hand in run.hands)


@pytest.fixture(params=BEARERS[:4], ids="-".join)
def calibrated(request, rehearse):
    robot, make = request.param
    run = rehearse(robot, "hands_calibrate.py", make,
                   options=("--start", "clamped", "--hands", make, "--clock", "simulated"))  # fmt: skip
    assert run.succeeded()
    return make, run


def test_a_hand_that_waits_while_the_other_calibrates_stays_unless_they_share_messages(calibrated):
    make, run = calibrated
    topics, _, _, opened, closed = MAKES[make]
    waits_at = opened if len(topics) == 2 else 0.0  # what a new message has
    assert run.report["waited"] == pytest.approx([waits_at] * len(run.report["waited"]), abs=0.2)
    assert run.report["called"] == pytest.approx([closed] * len(run.report["called"]), abs=0.2)


def test_a_hand_stays_while_the_other_calibrates_in_messages_that_repeat_its_entries(calibrated):
    make, run = calibrated
    topics, _, _, opened, _ = MAKES[make]
    kept = run.report["kept"]
    assert (kept is None) == (len(topics) == 2)
    assert kept is None or kept == pytest.approx([opened] * len(kept), abs=0.2)


def test_only_a_gripper_that_waits_times_out(calibrated):
    make, run = calibrated
    timeouts = {hand["name"]: hand["timeouts"] for hand in run.hands}
    if "right" in timeouts:
        assert (timeouts["right"] > 0) == (make == "dex1")
