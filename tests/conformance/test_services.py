"""Every client of the vendor's Python SDK gets the robot's answer to every call."""

import concurrent.futures

import pytest

from fleet import fleet, with_api
from service_codes import codes_of

NOT_SENT = 3102
NOT_ANSWERED = 3104
ROBOTS = list(fleet())


@pytest.fixture(scope="module")
def walks(rehearse):
    """By robot, what services_walk.py reports; three robots at a time."""
    with concurrent.futures.ThreadPoolExecutor(3) as pool:
        runs = pool.map(lambda robot: rehearse(robot, "services_walk.py", ",".join(fleet()[robot]["apis"]),
                                              options=("--clock", "simulated")), ROBOTS)
        return {robot: run.report for robot, run in zip(ROBOTS, runs) if run.succeeded()}


def codes_wanted(walk, robot):
    return codes_of(fleet()[robot]["apis"], walk["motion_service"])


@pytest.mark.parametrize("robot", ROBOTS)
def test_every_method_of_every_client_is_called(walks, robot):
    called = {service: set(methods) for service, methods in walks[robot]["calls"].items()}
    assert called == {service: set(methods) for service, methods in codes_wanted(walks[robot], robot).items()}


@pytest.mark.parametrize("robot", ROBOTS)
def test_every_call_is_answered_with_the_robots_code(walks, robot):
    got = {
        (service, name): (codes["good"], codes.get("bad"))
        for service, methods in walks[robot]["calls"].items()
        for name, codes in methods.items()
    }
    expected = {
        (service, name): codes
        for service, methods in codes_wanted(walks[robot], robot).items()
        for name, codes in methods.items()
    }
    assert got == expected


@pytest.mark.parametrize("robot", ROBOTS)
def test_nobody_reads_requests_of_motion_once_its_service_is_released(walks, robot):
    assert walks[robot]["motion_service"]
    assert walks[robot]["after_release"] == NOT_SENT


@pytest.fixture(scope="module")
def of_2024(rehearse):
    """A G1 with firmware before 1.4, asked as clients of then do: its service is `loco`."""
    apis = ["motion_switcher", "robot_state", "loco_g1", "arm_g1", "voice"]
    run = rehearse("g1", "services_walk.py", ",".join(apis), options=("--set=robot.firmware='1.3'",))
    assert run.succeeded()
    return run.report, codes_of(apis, "ai")


def test_a_g1_of_2024_answers_on_loco_with_the_codes_of_then(of_2024):
    report, wanted = of_2024
    got = {name: (codes["good"], codes.get("bad")) for name, codes in report["calls"]["loco"].items()}
    assert got == wanted["loco"]
    assert report["after_release"] == NOT_SENT


@pytest.mark.parametrize("robot", with_api("vui"))
def test_a_client_reads_what_another_has_set(walks, robot):
    assert walks[robot]["volume_for_another"] == [0, 3]


@pytest.fixture(scope="module")
def load(rehearse):
    run = rehearse("go2", "services_load.py")
    assert run.succeeded()
    return run.report


def test_a_thousand_calls_a_second_for_ten_seconds_lose_no_reply(load):
    assert load["load"]["asked"] == load["load"]["answered"] == 10_000


def test_a_client_beside_that_load_is_answered_with_success(load):
    answered, calls = load["beside"].get("0", 0), sum(load["beside"].values())
    assert answered > 100
    # The SDK reads best effort: a socket that is full on a busy computer loses it an answer that was sent.
    assert load["beside"].keys() <= {"0", str(NOT_ANSWERED)} and answered >= 0.99 * calls


def test_a_client_that_is_killed_in_a_call_disturbs_no_other(load):
    assert load["after_a_killed_client"] == 0


def test_a_lease_keeps_others_from_setting_but_not_from_reading(load):
    assert load["lease"] == {"without": 3205, "with": 0, "reading": 0, "after": 0}
