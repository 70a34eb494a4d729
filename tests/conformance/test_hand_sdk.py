"""rt/hand_sdk over a pair of Dex1-1 of a G1, through the vendor's Python SDK."""

import pytest

from conftest import refusals

OPEN, CLOSED, HALF_OPEN = 5.4, 0.0, 2.7  # rad
NEAR = 0.2


@pytest.fixture(scope="module")
def run(rehearse):
    run = rehearse("g1", "hand_sdk.py", options=("--start", "clamped", "--hands", "dex1", "--clock", "simulated"))
    assert run.succeeded()
    return run


@pytest.mark.parametrize(
    "moment, left, right",
    [("opened", OPEN, OPEN), ("closed", CLOSED, CLOSED), ("left", OPEN, CLOSED), ("fallen", HALF_OPEN, HALF_OPEN)],
)
def test_a_positive_torque_closes_and_silence_falls_back_to_the_hands_own_topic(run, moment, left, right):
    assert run.report[moment] == pytest.approx([left, right], abs=NEAR)


def test_nothing_of_it_moves_a_hand_while_the_service_damps(run):
    assert run.report["damped"] == pytest.approx(run.report["fallen"], abs=NEAR)
    assert refusals(run.hand_sdk) == {"damping": 3}
    assert run.hand_sdk["accepted"] == 9
