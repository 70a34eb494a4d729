"""Commands that a robot has to refuse move nothing, and are counted under their cause."""

import pytest

OF_BOTH_FAMILIES = {"crc", "motor_mode", "not_finite", "gain"}
FAULTS = {
    "go2": {"head", *OF_BOTH_FAMILIES},
    "g1": {"mode_machine", "mode_pr", *OF_BOTH_FAMILIES},
    "g1_23dof": {"mode_machine", "mode_pr", *OF_BOTH_FAMILIES},
}


@pytest.mark.parametrize("robot", FAULTS)
def test_bad_commands_between_good_ones_move_nothing_and_are_counted_under_their_cause(rehearse, robot):
    run = rehearse(robot, "refusals.py", robot)
    report = run.report

    assert report["followed_good_at_first"] > 0.6
    assert report["followed_good_at_last"] > 0.6
    assert run.commands["accepted"] > 0
    assert set(run.refused) == set(report["refusals"]) == FAULTS[robot]
    for kind, seen in report["refusals"].items():
        assert abs(seen["followed"]) < 0.4, kind
        assert 0 < run.refused[kind] <= seen["sent"], kind
