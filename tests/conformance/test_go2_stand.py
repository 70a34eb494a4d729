"""The vendor's stand example, through both SDKs."""

import pytest

PROGRAMS = ["go2_stand.py", "go2_stand_cpp.py"]


@pytest.mark.parametrize("program", PROGRAMS)
def test_a_go2_stands_up_and_lies_down_again(rehearse, program):
    run = rehearse("go2", program)

    assert run.succeeded()
    assert run.output.rstrip().endswith("Done!")


@pytest.mark.parametrize("program", PROGRAMS)
def test_no_command_of_the_stand_is_refused(rehearse, program):
    run = rehearse("go2", program)

    assert run.commands["accepted"] > 0
    assert run.refused == {}


def test_release_mode_leaves_no_motion_service_with_the_motors(rehearse):
    assert "motion service: none" in rehearse("go2", "go2_stand.py").output


def test_the_cpp_sdk_finds_no_crc_error_in_a_go2s_low_state(rehearse):
    run = rehearse("go2", "go2_stand_cpp.py")

    assert run.succeeded()
    assert "CRC Error" not in run.output + run.errors
