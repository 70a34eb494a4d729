"""The sheet of damage, as a shell and a recording have it; tests/system/test_panel.py has the page's."""

import json
import math
import signal

import pytest

from robots import understudy
from test_recording import Recording

FIGURES = ["energy", "peak_current", "shock", "worst_tilt", "falls", "at_torque_limit", "at_speed_limit", "tripped",
           "hottest", "hardest_stop", "largest_jump"]
BY_MOTOR = {"at_torque_limit": "torque_limit", "at_speed_limit": "speed_limit", "largest_jump": "jump_limit"}


def test_the_sheet_has_of_each_figure_the_limit_and_its_source(play, tmp_path):
    file = tmp_path / "damage.mcap"
    robot = play("go2", "--record", file)
    robot.ctl("push", "base_link", "0", "200", "0", "--for", "0.1")
    told = json.loads(robot.ctl("damage", "--json"))["damage"]
    text = robot.ctl("damage", "--all")
    short = robot.ctl("damage")
    checked = understudy("ctl", "damage", "--check")
    robot.send(signal.SIGINT)
    assert robot.exit_code() == 0

    assert [one["figure"] for one in told["limits"]] == FIGURES
    for one in told["limits"]:
        figure = one["figure"]
        assert figure in told or all(figure in motor for motor in told["motors"]), figure
        assert one["source"].split(": ")[0] in ("vendor", "derived", "assumed") and len(one["source"]) > 12, figure
        if figure in BY_MOTOR:
            assert one["limit"] is None and all(motor[BY_MOTOR[figure]] > 0 for motor in told["motors"]), figure
        else:
            assert one["limit"] > 0 or figure == "falls"
        line = next(line for line in text.splitlines() if line.startswith(figure))
        assert line.endswith(one["source"]) and (one["unit"] in line or "each motor's limit" in line)
        for table in (text, short):  # each of another instant
            row = next(line for line in table.splitlines() if line.startswith(figure)).split()
            assert {"ok", "near", "BEYOND"} & set(row), row
    assert all(motor["joint"] in text for motor in told["motors"])
    assert checked.returncode == (10 if "BEYOND" in checked.stdout else 0), checked.stdout

    _, sheet = Recording(file).messages["understudy/damage"][-1]
    assert list(sheet.figures) == FIGURES
    assert list(sheet.sources) == [one["source"] for one in told["limits"]]
    assert list(sheet.units) == [one["unit"] for one in told["limits"]]
    for limit, one in zip(sheet.limits, told["limits"], strict=True):
        assert math.isnan(limit) if one["limit"] is None else limit == pytest.approx(one["limit"], rel=1e-6)
    assert len(sheet.jump_limit) == len(sheet.largest_jump) == len(sheet.joints) == 12
