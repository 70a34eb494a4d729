"""Inspire FTP hands: messages of a module of their own, through cyclonedds and the vendor's channels."""

import pytest

RATE = 30  # Hz
REACHED = 2


@pytest.fixture(scope="module")
def run(rehearse):
    return rehearse("g1", "ftp_hands.py",
                    options=("--start", "clamped", "--hands", "inspire_ftp", "--clock", "simulated"))  # fmt: skip


@pytest.fixture
def report(run):
    assert run.succeeded()
    return run.report


def near(values, wanted):
    return values == pytest.approx([wanted] * 6, abs=30)


def test_a_touch_message_has_1062_cells_in_17_fields(report):
    assert report["lengths"] == [9, 96, 80] * 4 + [9, 96, 9, 96, 112]


def test_angle_1000_is_open_and_0_is_closed_and_positions_run_the_other_way(report):
    assert near(report["open"]["angle_act"], 1000)
    assert report["open"]["pos_act"] == pytest.approx([0] * 6, abs=60)
    assert near(report["closed"]["angle_act"], 0)
    assert report["closed"]["pos_act"] == pytest.approx([2000] * 6, abs=60)
    assert near(report["halfway"]["angles"], 500)


def test_a_hand_that_has_arrived_says_so_and_has_no_error(report):
    assert report["halfway"]["status"] == [REACHED] * 6
    assert report["open"]["err"] == [0] * 6
    assert all(20 < one < 60 for one in report["open"]["temperature"])


def test_minus_one_leaves_a_finger_where_it_is(report):
    before, after = report["kept"]
    assert before == pytest.approx(500, abs=30) == after


def test_speed_500_takes_twice_the_600_ms_of_the_whole_way(report):
    assert 500 < report["speed"] < 1100  # 833, seen 30 times a second


def test_mode_0_does_nothing(report):
    before, after = report["ignored"]
    assert before == pytest.approx(after, abs=10)


def test_a_hand_goes_on_to_its_goal_when_commands_stop(run, report):
    assert near(report["stopped"], 300)
    assert [hand["timeouts"] for hand in run.hands] == [0, 0]


def test_the_right_hand_does_not_follow_the_left(report):
    assert near(report["right"], 1000)


def test_states_and_touches_come_at_the_rate_of_the_driver(report):
    assert report["rates"] == pytest.approx([RATE, RATE], rel=0.3)


def test_a_hand_that_meets_nothing_feels_nothing(report):
    assert report["touched"] == 0
