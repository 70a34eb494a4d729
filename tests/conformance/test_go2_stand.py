"""The vendor's stand example, through both SDKs."""


def stands_up_and_lies_down(run):
    """Asserts that it did and that no command was refused."""
    assert run.succeeded()
    assert run.output.rstrip().endswith("Done!")
    assert run.commands["accepted"] > 0
    assert run.refused == {}


def test_a_go2_stands_up_and_lies_down_again_for_the_python_sdk_once_it_has_released_the_motors(rehearse):
    run = rehearse("go2", "go2_stand.py", options=("--clock", "simulated"))

    stands_up_and_lies_down(run)
    assert "motion service: none" in run.output


def test_a_go2_stands_up_and_lies_down_again_for_the_cpp_sdk_which_leaves_heads_unset(rehearse):
    # The extension that carries the C++ SDK leaves head and level_flag of its Go2 commands 0.
    run = rehearse("go2", "go2_stand_cpp.py", options=("--clock", "simulated"))

    stands_up_and_lies_down(run)
    assert run.commands["unset_heads"] > 0
    assert "CRC Error" not in run.output + run.errors
