"""A Go2 before a wall, moved by the vendor's unmodified ObstaclesAvoidClient on the simulated clock."""

import json
import os
import subprocess
import sys

import pytest

from conftest import PATIENCE, PROGRAMS

SCENE = """<mujoco><worldbody>
  <geom type="plane" size="0 0 1"/>
  <geom type="box" size="0.1 4 0.5" pos="2.1 0 0.5"/>
</worldbody></mujoco>"""
SCENARIO = """
scenario: A wall ahead
robot: go2
start: standing
scene: wall.xml
clock: simulated
program: {at: 0.5, limit: 30}
expect:
  - {name: the program ends well, final: program.exit_code is 0}
"""
STOPS = """
  - {name: comes near, eventually: nearest_obstacle < 0.7}
  - {name: stops, always: nearest_obstacle > 0.2}
"""
TOUCHES = """
  - {name: touches, eventually: nearest_obstacle < 0.05}
"""


@pytest.fixture(scope="module")
def walk(tmp_path_factory):
    """walk(switch, expect): rehearses with the switch "on" or "off"; what the program reports."""

    def report(switch, expect):
        folder = tmp_path_factory.mktemp(switch)
        (folder / "wall.xml").write_text(SCENE)
        (folder / "wall.yaml").write_text(SCENARIO + expect.lstrip("\n"))
        done = subprocess.run(
            [os.environ["UNDERSTUDY"], "rehearse", "wall.yaml", "--", sys.executable,
             PROGRAMS / "obstacles_walk.py", switch, folder / "report.json"],
            cwd=folder, capture_output=True, text=True, timeout=2 * PATIENCE)  # fmt: skip
        assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
        return json.loads((folder / "report.json").read_text())

    return report


def test_a_robot_whose_switch_is_on_stops_before_the_wall(walk):
    report = walk("on", STOPS)
    assert report["at_first"] == [0, False], "off after boot"
    assert report["codes"] == [0, 0]
    assert report["switched"] == [0, True]


def test_a_robot_whose_switch_is_off_walks_into_it(walk):
    report = walk("off", TOUCHES)
    assert report["switched"] == [0, False]
