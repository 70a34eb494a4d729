"""The vendor's stand example, through both SDKs."""

PYTHON = ("go2", "go2_stand.py")
CPP = ("go2", "go2_stand_cpp.py")


def test_a_go2_stands_up_and_lies_down_again_for_the_python_sdk(rehearse):
    run = rehearse(*PYTHON)

    assert run.succeeded()
    assert run.output.rstrip().endswith("Done!")


def test_no_command_of_the_python_sdk_is_refused(rehearse):
    run = rehearse(*PYTHON)

    assert run.commands["accepted"] > 0
    assert run.refused == {}


def test_release_mode_leaves_no_motion_service_with_the_motors(rehearse):
    assert "motion service: none" in rehearse(*PYTHON).output


def test_a_go2_stands_up_and_lies_down_again_for_the_cpp_sdk(rehearse):
    run = rehearse(*CPP)

    assert run.succeeded()
    assert run.output.rstrip().endswith("Done!")


def test_no_command_of_the_cpp_sdk_is_refused_though_its_head_is_unset(rehearse):
    # The extension that carries the C++ SDK leaves head and level_flag of its Go2 commands 0.
    run = rehearse(*CPP)

    assert run.commands["accepted"] > 0
    assert run.refused == {}
    assert run.commands["unset_heads"] > 0


def test_the_cpp_sdk_finds_no_crc_error_in_a_go2s_low_state(rehearse):
    run = rehearse(*CPP)

    assert run.succeeded()
    assert "CRC Error" not in run.output + run.errors
