"""Commands that a robot has to refuse move nothing, and are counted under their cause."""

import pytest

ROBOTS = ["go2", "g1", "g1_23dof"]
FAULTS = [
    *[("go2", kind) for kind in ("crc", "head", "motor_mode", "not_finite", "gain")],
    *[("g1", kind)
      for kind in ("crc", "mode_machine", "mode_pr", "motor_mode", "not_finite", "gain")],
    ("g1_23dof", "mode_machine"),
]


@pytest.fixture
def refusals(rehearse):
    """refusals(robot): that robot's run of refusals.py, and its report."""

    def of(robot):
        run = rehearse(robot, "refusals.py", robot)
        return run, run.report

    return of


@pytest.mark.parametrize("robot", ROBOTS)
def test_good_commands_move_the_motor_before_and_after_the_bad_ones(refusals, robot):
    run, report = refusals(robot)

    assert report["followed_good_at_first"] > 0.6
    assert report["followed_good_at_last"] > 0.6
    assert run.commands["accepted"] > 0


@pytest.mark.parametrize(("robot", "kind"), FAULTS)
def test_a_bad_command_moves_nothing(refusals, robot, kind):
    _, report = refusals(robot)

    assert report["refusals"][kind]["sent"] > 0
    assert abs(report["refusals"][kind]["followed"]) < 0.4


@pytest.mark.parametrize(("robot", "kind"), FAULTS)
def test_a_bad_command_is_counted_under_its_cause(refusals, robot, kind):
    run, report = refusals(robot)

    assert 0 < run.refused.get(kind, 0) <= report["refusals"][kind]["sent"]


@pytest.mark.parametrize("robot", ROBOTS)
def test_no_command_is_counted_under_a_cause_that_it_does_not_have(refusals, robot):
    run, report = refusals(robot)

    assert set(run.refused) == set(report["refusals"])
