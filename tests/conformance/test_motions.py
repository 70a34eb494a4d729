"""A Go2 on its feet does what the vendor's sport client asks, in the states of the vendor's page."""

import pytest

BALANCE, LOCKED, POSE, SIT, LYING, GREETING = 1013, 1002, 1091, 1007, 1004, 1006
AGILE, WALK = 100, 1015  # gaits
GESTURES = ("Hello", "Stretch", "Content", "Scrape", "Heart", "Dance2", "RiseSit")


@pytest.fixture(scope="module")
def calls(rehearse):
    run = rehearse("go2", "motions.py", options=("--start", "standing", "--clock", "simulated"))
    assert run.succeeded()
    return run.report["calls"]


def test_every_motion_is_taken(calls):
    assert [code for _, code, _ in calls] == [0] * len(calls)


def test_every_motion_ends_in_its_state(calls):
    assert [(name, states[-1]) for name, _, states in calls] == [
        ("BalanceStand", BALANCE),
        ("Euler", BALANCE),
        ("Pose", POSE),
        ("Pose", BALANCE),
        ("Hello", BALANCE),
        ("Stretch", BALANCE),
        ("Content", BALANCE),
        ("Scrape", BALANCE),
        ("Heart", BALANCE),
        ("Dance2", BALANCE),
        ("Sit", SIT),
        ("RiseSit", BALANCE),
        ("StopMove", BALANCE),
        ("StandUp", LOCKED),
        ("FreeWalk", AGILE),
        ("StaticWalk", WALK),
        ("StandUp", LOCKED),
        ("StandDown", LYING),
    ]


def test_gestures_are_gone_through(calls):
    for name, _, states in calls:
        assert (GREETING in states) == (name in GESTURES), name
