"""The vendor's own models: taken as vendor_models.py has it, or refused with the reason.

They are not part of this repository. Clone unitree_ros, unitree_mujoco and mujoco_menagerie into a folder and name that
folder in UNDERSTUDY_VENDOR_MODELS; without it, only the table itself is tested, and the rest is reported as skipped.
"""

import os
import pathlib

import pytest
import vendor_models as vendor

FOLDER = os.environ.get("UNDERSTUDY_VENDOR_MODELS")  # made absolute, since each test has its own folder
FOLDER = None if FOLDER is None else pathlib.Path(FOLDER).absolute()
needs_models = pytest.mark.skipif(FOLDER is None, reason="UNDERSTUDY_VENDOR_MODELS names no folder with clones of "
                                                         "unitree_ros, unitree_mujoco and mujoco_menagerie")
SCENARIO = """
scenario: stands
robot: {robot}
start: standing
duration: 4
expect:
  - {{never: base.tilt > 30 deg, name: stays upright}}
  - {{settles: base.speed < 0.1, within: 4, name: comes to rest}}
"""
ENDS = (vendor.STANDS, vendor.HANGS, vendor.FALLS)


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_the_table_names_each_file_once_and_robots_that_are_here(understudy):
    for table in (vendor.URDFS, vendor.MJCFS):
        assert len({file for file, *_ in table}) == len(table)
        for robot in {robot for _, robot, _ in table}:
            assert understudy("run", robot, "--print-config").returncode == 0, robot


@needs_models
@pytest.mark.parametrize("file, like, ends", vendor.URDFS)
def test_a_urdf_of_the_vendor(understudy, file, like, ends):
    made = understudy("new", "robot", "--urdf", pathlib.Path(FOLDER, vendor.ROS, file), "--like", like)
    said = made.stdout + made.stderr
    fault, ends = (None, ends) if ends in ENDS else ends if isinstance(ends, tuple) else (ends, None)
    assert (made.returncode == 0) if fault is None else (made.returncode in (3, 4) and fault in said), said
    if ends is None:
        return
    rehearsed = understudy("rehearse", "robot/starts.yaml", "--no-pictures", "--out", "out")
    assert rehearsed.returncode == (10 if ends == vendor.FALLS else 0), rehearsed.stdout + rehearsed.stderr


@needs_models
@pytest.mark.parametrize("file, robot, ends", vendor.MJCFS)
def test_a_model_of_the_vendor_keeps_its_motion_service(understudy, file, robot, ends):
    pathlib.Path("stands.yaml").write_text(SCENARIO.format(robot=robot))
    done = understudy("rehearse", "stands.yaml", "--set", f"robot.model={pathlib.Path(FOLDER, file)}", "--no-pictures",
                      "--out", "out")
    said = done.stdout + done.stderr
    assert "it only damps" not in said
    if ends in ENDS:
        assert done.returncode == (10 if ends == vendor.FALLS else 0), said
    else:
        assert done.returncode == 4 and ends in said, said
