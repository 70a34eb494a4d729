"""The vendor's stand example, through both SDKs."""

PYTHON = ("go2", "go2_stand.py")
CPP = ("go2", "go2_stand_cpp.py")
# The extension that carries the C++ SDK leaves head and level_flag of its Go2 commands 0. Only a
# lenient gate takes them, and counts them as it does in a strict one.
LENIENT = ("--set", "gate=lenient")


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


def test_a_lenient_go2_stands_up_and_lies_down_again_for_the_cpp_sdk(rehearse):
    run = rehearse(*CPP, options=LENIENT)

    assert run.succeeded()
    assert run.output.rstrip().endswith("Done!")


def test_only_the_missing_head_of_the_cpp_extensions_commands_is_objected_to(rehearse):
    run = rehearse(*CPP, options=LENIENT)

    assert run.commands["accepted"] > 0
    assert list(run.refused) == ["head"]


def test_the_cpp_sdk_finds_no_crc_error_in_a_go2s_low_state(rehearse):
    run = rehearse(*CPP, options=LENIENT)

    assert run.succeeded()
    assert "CRC Error" not in run.output + run.errors
