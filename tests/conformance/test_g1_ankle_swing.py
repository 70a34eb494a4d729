"""The vendor's ankle swing example, through both SDKs, on a G1 whose feet are off the ground."""

import pytest

PROGRAMS = ["g1_ankle_swing.py", "g1_ankle_swing_cpp.py"]


@pytest.fixture
def swing(rehearse):
    """swing(program): its run on a G1 whose pelvis is held in the air."""
    return lambda program: rehearse("g1", program, options=("--start", "clamped", "--clock", "simulated"))


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_g1_swings_its_ankles_as_far_as_commanded(swing, program):
    run = swing(program)

    assert run.succeeded()
    assert run.output.rstrip().endswith("Done!")


@pytest.mark.parametrize("program", PROGRAMS)
def test_no_command_of_the_swing_is_refused(swing, program):
    run = swing(program)

    assert run.commands["accepted"] > 0
    assert run.refused == {}


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_g1_with_29_joints_is_machine_type_5(swing, program):
    assert "mode_machine: 5" in swing(program).output


def test_a_g1_echoes_the_control_mode(swing):
    assert "mode_pr in LowState: {0}, then {1}" in swing("g1_ankle_swing.py").output


def test_the_cpp_sdk_finds_no_crc_error_in_a_g1s_low_state(swing):
    run = swing("g1_ankle_swing_cpp.py")

    assert run.succeeded()
    assert "CRC Error" not in run.output + run.errors
