"""Every client of the vendor's Python SDK gets an answer to every call."""

import pytest

ROBOTS = ["go2", "b2", "g1", "h1"]
TIMED_OUT = 3104
# What is answered to bad arguments.
BAD = {"sport": 3204, "loco": 3204, "arm": 7402, "voice": 100, "vui": 100, "robot_state": 3204,
       "obstacles_avoid": 3204, "motion_switcher": 7001}
# What nothing here plays, and what the arguments of the walk make a failure.
FAILS = {
    ("videohub", "GetImageSample"): 100,
    ("front_videohub", "GetImageSample"): 100,
    ("back_videohub", "GetImageSample"): 100,
    ("motion_switcher", "SelectMode"): 7004,
}
# Sent without a wish for a reply, or without a return value for it; ShakeHand sends a good one in
# place of a bad one.
UNANSWERED = {"Move", "MoveToAbsolutePosition", "MoveToIncrementPosition", "PlayStop", "ShakeHand"}
MOTION_CODES = {None, 0, 4201, 4205, 4206, 7301, 8301, 7402, 7404}
WRONG_POINTS = 4101  # the client's own answer to a path of another length than 30


@pytest.fixture(params=ROBOTS)
def walk(request, rehearse):
    run = rehearse(request.param, "services_walk.py", request.param)
    assert run.succeeded()
    return run.report


def calls(report, motion):
    for service, methods in report["calls"].items():
        if (service in ("sport", "loco", "arm")) == motion:
            for name, codes in methods.items():
                yield service, name, codes


def test_every_good_call_is_answered(walk):
    for service, name, codes in calls(walk, motion=False):
        assert codes["good"] in (FAILS.get((service, name), 0), None), (service, name)


def test_every_bad_call_is_refused_with_the_services_code(walk):
    for service, name, codes in calls(walk, motion=False):
        if "bad" in codes and name not in UNANSWERED:
            assert codes["bad"] == BAD[service], (service, name)


def test_motion_is_answered_while_a_motion_service_is_on_and_times_out_otherwise(walk):
    for service, name, codes in calls(walk, motion=True):
        if not walk["motion_service"]:
            assert codes["good"] == TIMED_OUT, (service, name)
            continue
        assert codes["good"] in MOTION_CODES, (service, name)
        if name not in UNANSWERED and codes.get("bad") is not None:
            wrong = WRONG_POINTS if name == "TrajectoryFollow" else BAD[service]
            assert codes["bad"] == wrong, (service, name)


def test_a_client_reads_what_another_has_set(rehearse):
    for robot in ("go2", "b2"):
        report = rehearse(robot, "services_walk.py", robot).report
        assert report["volume_for_another"] == [0, 3]


@pytest.fixture
def load(rehearse):
    run = rehearse("go2", "services_load.py")
    assert run.succeeded()
    return run.report


def test_a_thousand_calls_a_second_lose_no_reply(load):
    assert load["load"]["asked"] == load["load"]["answered"] == 3000


def test_a_client_that_is_killed_in_a_call_disturbs_no_other(load):
    assert load["after_a_killed_client"] == 0


def test_a_lease_keeps_others_from_setting_but_not_from_reading(load):
    assert load["lease"] == {"without": 3205, "with": 0, "reading": 0, "after": 0}
