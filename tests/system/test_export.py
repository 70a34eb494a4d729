"""`understudy export urdf`, read by what ROS reads it with in Python."""

import pathlib

import pytest
from urdf_parser_py.urdf import URDF

ROOT = pathlib.Path(__file__).parents[2]


@pytest.mark.parametrize("name", sorted(file.stem for file in (ROOT / "config" / "robots").glob("*.yaml")))
def test_ros_reads_every_robot(understudy, capfd, name):
    done = understudy("export", "urdf", name)
    assert done.returncode == 0, done.stderr
    robot = URDF.from_xml_string(done.stdout.encode())
    assert "Unknown" not in capfd.readouterr().err  # elements and attributes that it does not know
    assert robot.name == name
    assert robot.get_root()
    assert len(robot.links) == len(robot.joints) + 1
    for joint in robot.joints:
        if joint.type == "revolute":
            assert joint.limit.lower < joint.limit.upper
            assert joint.limit.effort > 0 and joint.limit.velocity > 0


def test_a_robot_with_meshes_is_written_with_their_files(understudy, tmp_path):
    arm = ROOT / "examples" / "two_joint_arm"
    model = (arm / "arm.xml").read_text()
    model = model.replace("<worldbody>", """<asset><mesh name="wedge"
        vertex="0 0 0 .1 0 0 0 .1 0 0 0 .1"/></asset><worldbody>""")
    model = model.replace('<site name="imu"', '<geom type="mesh" mesh="wedge" mass="0"/><site name="imu"')
    (tmp_path / "arm.xml").write_text(model)
    (tmp_path / "one.yaml").write_text((arm / "arm.yaml").read_text())
    done = understudy("export", "urdf", tmp_path / "one.yaml", "--out", tmp_path / "one.urdf")
    assert done.returncode == 0, done.stderr
    robot = URDF.from_xml_file(str(tmp_path / "one.urdf"))
    mesh = robot.link_map["column"].visuals[-1].geometry.filename
    assert (tmp_path / mesh).stat().st_size == 84 + 4 * 50
    assert robot.joint_map["elbow"].limit.effort == 10
    assert "--out" in understudy("export", "urdf", tmp_path / "one.yaml").stderr


@pytest.mark.parametrize("name", ["go2", "g1", "b2w"])
def test_mjcf_is_one_file_with_what_the_robot_has(understudy, tmp_path, name):
    done = understudy("export", "mjcf", name, "--out", tmp_path / "robot.xml")
    assert done.returncode == 0, done.stderr
    checked = understudy("check", tmp_path / "robot.xml")
    assert checked.returncode == 0, checked.stdout + checked.stderr
    text = (tmp_path / "robot.xml").read_text()
    assert "understudy_clamp" not in text and "file=" not in text
    assert understudy("export", "mjcf", name).stdout == text


def test_a_ground_of_heights_is_a_file_beside_the_mjcf(understudy, tmp_path):
    done = understudy("export", "mjcf", "go2", "--scene", "rough", "--out", tmp_path / "go2.xml")
    assert done.returncode == 0, done.stderr
    assert understudy("check", tmp_path / "go2.xml").returncode == 0
    assert [file.suffix for file in sorted(tmp_path.iterdir())].count(".hf") >= 1
    alone = understudy("export", "mjcf", "go2", "--scene", "rough")
    assert alone.returncode == 4 and "--out" in alone.stderr


@pytest.mark.parametrize("robot, folder, said", [
    ("go2", "my-lab", "expected the name of a Python package"),
    ("go2w", "my_lab", "expected a robot.kind of quadruped or humanoid"),
    ("two_joint_arm", "my_lab", "expected a robot.kind of quadruped or humanoid"),
])
def test_a_package_for_mjlab_is_refused_where_nothing_could_walk(understudy, tmp_path, robot, folder, said):
    if robot == "two_joint_arm":
        robot = ROOT / "examples" / "two_joint_arm" / "arm.yaml"
    done = understudy("export", "mjlab", robot, "--out", tmp_path / folder)
    assert done.returncode == 3 and said in done.stderr, done.stderr
    assert not (tmp_path / folder).exists()


def test_a_package_for_mjlab_replaces_only_one_of_its_own(understudy, tmp_path):
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "__init__.py").write_text("mine = True\n")
    done = understudy("export", "mjlab", "go2", "--out", mine)
    assert done.returncode == 9 and "expected a new folder" in done.stderr, done.stderr
    assert (mine / "__init__.py").read_text() == "mine = True\n" and len(list(mine.iterdir())) == 1
    for _ in range(2):
        assert understudy("export", "mjlab", "go2", "--out", tmp_path / "lab").returncode == 0


def test_a_package_for_mjlab_takes_only_a_definition_that_fits(understudy, tmp_path):
    g1 = ROOT / "src" / "python" / "understudy" / "tasks" / "g1_flat.yaml"
    done = understudy("export", "mjlab", "go2", "--out", tmp_path / "lab", "--definition", g1)
    assert done.returncode == 3 and "g1_flat.yaml" in done.stderr, done.stderr
    assert not (tmp_path / "lab").exists()
