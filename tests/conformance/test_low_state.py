"""The content of rt/lowstate, read with the vendor's types and CRC.

Field values that hold on real robots: public captures of a Go2 (2024-09 and 2026-03) and an audit
of 35,998 messages of a 29-joint G1. The Go2's 500 Hz is the vendor's control loop rate; the G1's
1000 Hz and the tick of 1 ms were measured on G1s.
"""

import pytest

TICK_STEP_MS = {"go2": "2", "g1": "1", "g1_23dof": "1"}


@pytest.fixture(scope="module", params=sorted(TICK_STEP_MS))
def low_state(request, rehearse):
    """Some seconds of rt/lowstate of an idle robot, as lowstate_watch.py tells them."""
    run = rehearse(request.param, "lowstate_watch.py", request.param, "3")
    assert run.succeeded()
    return run.report


def test_every_sample_has_the_crc_that_the_sdk_computes(low_state):
    assert low_state["samples"] > 1
    assert low_state["crc_errors"] == 0


def test_every_sample_is_one_publish_period_after_the_one_before(low_state):
    assert list(low_state["tick_steps_ms"]) == [TICK_STEP_MS[low_state["robot"]]]


def test_used_motors_are_in_mode_1_and_finite(low_state):
    assert low_state["motors"]["modes"] == [1]
    assert low_state["motors"]["finite"]


def test_joint_acceleration_stays_0_as_on_real_robots(low_state):
    assert low_state["motors"]["max_abs_ddq"] == 0


def test_slots_without_a_motor_are_empty(low_state):
    assert low_state["motors"]["unused_slots"] == {"go2": 8, "g1": 6, "g1_23dof": 12}[low_state["robot"]]
    assert low_state["motors"]["unused_slots_empty"]


def test_attitude_is_a_unit_quaternion_that_agrees_with_rpy(low_state):
    smallest, largest = low_state["imu"]["quaternion_norm"]
    assert smallest == pytest.approx(1.0, abs=1e-3)
    assert largest == pytest.approx(1.0, abs=1e-3)
    assert low_state["imu"]["rpy_off_quaternion"] < 0.01


def test_the_remote_block_is_empty_without_a_remote(low_state):
    assert low_state["message"]["wireless_remote"] == [0] * 40


@pytest.mark.parametrize("low_state", ["go2"], indirect=True)
def test_a_go2_fills_its_header_and_board_as_a_real_one_does(low_state):
    message = low_state["message"]
    assert message["head"] == [0xFE, 0xEF]
    assert message["level_flag"] == 0
    assert message["version"] == [0, 0]
    assert message["bit_flag"] == 0x24  # no remote, not charging
    assert message["foot_force_est"] == [0, 0, 0, 0]
    assert 24.0 < message["power_v"] < 33.6  # 8 cells; 29.5 and 31.2 V were seen
    assert message["bms_state"]["status"] == 8  # discharging
    assert [cell > 0 for cell in message["bms_state"]["cell_vol"]] == [True] * 8 + [False] * 7


@pytest.mark.parametrize("low_state", ["g1"], indirect=True)
def test_a_g1_fills_its_header_and_motors_as_a_real_one_does(low_state):
    assert low_state["message"]["mode_machine"] == 5  # 29 joints
    assert low_state["message"]["mode_pr"] == 0
    assert low_state["message"]["version"] == [0, 0]
    assert 40.0 < low_state["motors"]["vol"] < 55.0  # 45.5 to 49.5 V were seen


@pytest.mark.parametrize(("robot", "revision", "mode_machine"), [
    ("g1_23dof", None, 4), ("g1_23dof", "1", 1), ("g1_23dof", "10", 10), ("g1", "2", 2), ("g1", "6", 6),
    ("g1", "13", 13), ("g1", "16", 16),
])
def test_a_g1_announces_the_mode_machine_of_its_revision(rehearse, robot, revision, mode_machine):
    options = ("--revision", revision) if revision else ()
    run = rehearse(robot, "lowstate_watch.py", robot, "0.5", options=options)

    assert run.report["message"]["mode_machine"] == mode_machine
    assert run.report["crc_errors"] == 0


def test_a_locked_waist_leaves_its_two_slots_empty(rehearse):
    free = rehearse("g1", "lowstate_watch.py", "g1", "0.5")
    locked = rehearse("g1", "lowstate_watch.py", "g1", "0.5", options=("--revision", "6"))

    assert free.report["motors"]["modes"] == [1]
    assert locked.report["motors"]["modes"] == [0, 1]
    assert locked.report["motors"]["q"]["13"] == locked.report["motors"]["q"]["14"] == 0
