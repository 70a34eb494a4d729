"""`understudy new`: a robot of one's own, from its URDF."""

import json
import pathlib
import re
import struct
from xml.etree import ElementTree

import pytest
from urdf_parser_py.urdf import URDF

# How others name what the Go2's file names FR_hip_joint ...
RENAMED = {"FR_": "front_right_", "FL_": "FRONT_LEFT_", "RR_": "RR", "RL_": "rl-",
           "hip_joint": "haa", "thigh_joint": "HFE", "calf_joint": "Lower_Leg"}


@pytest.fixture(autouse=True)
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def export(understudy, robot, file="my.urdf", *options):
    done = understudy("export", "urdf", robot, "--out", file, *options)
    assert done.returncode == 0, done.stderr
    return pathlib.Path(file)


def with_joints_renamed(urdf, names):
    """Only in the names of joints: links keep theirs."""
    def renamed(match):
        name = match[2]
        for ours, theirs in names.items():
            name = name.replace(ours, theirs)
        return match[1] + name

    urdf.write_text(re.sub(r'(<joint name=")([^"]*)', renamed, urdf.read_text()))


def masses(urdf):
    return {link.name: (link.inertial.mass, link.inertial.origin.xyz) for link in urdf.links if link.inertial}


def test_a_go2_comes_back_from_its_own_urdf_and_stands(understudy):
    export(understudy, "go2")
    made = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2")
    assert made.returncode == 0, made.stdout + made.stderr
    assert "MISSING" not in made.stdout

    checked = understudy("check", "mydog/mydog.yaml", "mydog/starts.yaml")
    assert checked.returncode == 0, checked.stdout
    ran = understudy("run", "mydog/mydog.yaml", "--speed", "max", "--duration", "1")
    assert ran.returncode == 0, ran.stderr
    rehearsed = understudy("rehearse", "mydog/starts.yaml", "--out", "starts")
    assert rehearsed.returncode == 0, rehearsed.stdout + rehearsed.stderr


def test_its_first_scenario_fails_where_it_does_not_stand_up(understudy):
    export(understudy, "go2")
    assert understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2").returncode == 0
    rehearsed = understudy("rehearse", "mydog/starts.yaml", "--set", "motion.service=none", "--out", "starts")
    assert rehearsed.returncode == 10, rehearsed.stdout + rehearsed.stderr
    assert "FAIL  stands" in rehearsed.stdout


def test_the_model_made_has_the_links_masses_joints_and_limits_of_the_urdf(understudy):
    before = URDF.from_xml_file(str(export(understudy, "go2")))
    assert understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2").returncode == 0
    after = URDF.from_xml_file(str(export(understudy, "mydog/mydog.yaml", "again.urdf")))

    assert [link.name for link in before.links] == [link.name for link in after.links]
    for name, (mass, com) in masses(before).items():
        assert masses(after)[name][0] == pytest.approx(mass)
        assert masses(after)[name][1] == pytest.approx(com)
    for one, other in zip(before.joints, after.joints, strict=True):
        assert (one.name, one.type, one.parent, one.child) == (other.name, other.type, other.parent, other.child)
        assert other.origin.xyz == pytest.approx(one.origin.xyz)
        if one.type == "revolute":
            assert other.axis == pytest.approx(one.axis)
            for limit in ("lower", "upper", "effort", "velocity"):
                assert getattr(other.limit, limit) == pytest.approx(getattr(one.limit, limit), rel=1e-4)


def test_inertia_is_turned_into_the_links_axes(understudy):
    before = export(understudy, "go2").read_text()
    assert understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2").returncode == 0
    after = export(understudy, "mydog/mydog.yaml", "again.urdf").read_text()

    def inertias(text):  # the principal ones, which do not depend on the frame
        return [float(n) for n in re.findall(r'i(?:xx|yy|zz)="([^"]*)"', text)]

    assert inertias(after) == pytest.approx(inertias(before), rel=1e-3)


def test_joints_by_other_usual_names_are_found(understudy):
    with_joints_renamed(export(understudy, "go2"), RENAMED)
    made = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2")
    assert made.returncode == 0, made.stdout + made.stderr
    assert re.search(r"FR_hip_joint +0 +front_right_haa\n", made.stdout)
    assert re.search(r"RL_calf_joint +11 +rl-Lower_Leg\n", made.stdout)
    assert understudy("rehearse", "mydog/starts.yaml", "--out", "starts").returncode == 0


def test_wheels_that_are_called_feet_are_found(understudy):
    with_joints_renamed(export(understudy, "go2w"), {"wheel": "foot"})
    made = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2w")
    assert made.returncode == 0, made.stdout + made.stderr
    assert re.search(r"FR_wheel_joint +12 +FR_foot_joint\n", made.stdout)


def test_a_motor_without_a_joint_is_told_with_the_nearest_names_and_the_line_to_change(understudy):
    with_joints_renamed(export(understudy, "go2"), {"FR_calf_joint": "FR_shin_joint"})
    made = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2")
    assert made.returncode == 3
    assert re.search(r"FR_calf_joint +2 +MISSING; perhaps FR_shin_joint\n", made.stdout)
    assert "no motor drives joint 'FR_shin_joint'" in made.stdout
    assert "a run leaves out those that the robot does not have" in made.stdout
    ran = understudy("run", "mydog/mydog.yaml", "--start", "clamped", "--speed", "max", "--duration", "0.5")
    assert ran.returncode == 0 and "slot 2 has no motor" in ran.stderr, ran.stderr

    yaml = pathlib.Path("mydog/mydog.yaml")
    line = next(line for line in yaml.read_text().splitlines() if "MISSING" in line)
    assert "FR_shin_joint" in line
    checked = understudy("check", yaml)
    assert checked.returncode != 0 and "FR_calf_joint" in checked.stdout
    yaml.write_text(yaml.read_text().replace(line, "    FR_calf_joint: {joint: FR_shin_joint}"))
    assert understudy("check", yaml).returncode == 0


def test_a_g1_hangs_from_its_crane_and_has_lost_the_revisions_of_the_other(understudy):
    export(understudy, "g1")
    made = understudy("new", "mine", "--urdf", "my.urdf", "--like", "g1")
    assert made.returncode == 0, made.stdout + made.stderr
    assert understudy("check", "mine/mine.yaml").returncode == 0
    rehearsed = understudy("rehearse", "mine/starts.yaml", "--out", "starts")
    assert rehearsed.returncode == 0, rehearsed.stdout + rehearsed.stderr
    config = understudy("run", "mine/mine.yaml", "--print-config").stdout
    assert "mode_machine: 5" in config
    assert understudy("run", "mine/mine.yaml", "--revision", "6", "--print-config").returncode == 3


def test_a_robot_with_the_wrists_of_a_g1_bears_its_hands(understudy):
    export(understudy, "g1")
    made = understudy("new", "mine", "--urdf", "my.urdf", "--like", "g1")
    assert made.returncode == 0, made.stdout + made.stderr
    assert "it can bear hands, as g1 can: --hands brainco, dex1" in made.stdout
    ran = understudy("run", "mine/mine.yaml", "--hands", "dex1", "--speed", "max", "--duration", "0.5")
    assert ran.returncode == 0, ran.stderr
    checked = understudy("check", "mine/mine.yaml")  # with each of them
    assert checked.returncode == 0, checked.stdout


def test_a_robot_like_one_with_hands_has_them_on(understudy):
    export(understudy, "g1")
    made = understudy("new", "mine", "--urdf", "my.urdf", "--like", "g1_29dof_dex3")
    assert made.returncode == 0, made.stdout + made.stderr
    checked = understudy("check", "mine/mine.yaml")
    assert "29 motors, 2 hands, fits its model" in checked.stdout, checked.stdout


def test_fingers_of_the_urdf_are_moved_as_those_of_the_hands_that_it_has(understudy):
    export(understudy, "g1_29dof_dex3")
    made = understudy("new", "mine", "--urdf", "my.urdf", "--like", "g1_29dof_dex3")
    assert made.returncode == 0, made.stdout + made.stderr
    assert "no motor drives" not in made.stdout
    checked = understudy("check", "mine/mine.yaml")
    assert "29 motors, 2 hands, fits its model" in checked.stdout, checked.stdout


def test_hands_are_those_made_for_the_other_robot(understudy):
    export(understudy, "h1_2")
    made = understudy("new", "mine", "--urdf", "my.urdf", "--like", "h1_2")
    assert made.returncode == 0, made.stdout + made.stderr
    printed = understudy("run", "mine/mine.yaml", "--hands", "inspire", "--print-config").stdout
    assert "h1_2/hands/left_inspire.xml" in printed


def test_a_robot_without_the_wrists_bears_no_hands(understudy):
    urdf = export(understudy, "g1")
    urdf.write_text(urdf.read_text().replace('"left_wrist_yaw_link"', '"left_stump"'))
    made = understudy("new", "mine", "--urdf", "my.urdf", "--like", "g1_29dof_dex3")
    assert made.returncode == 0, made.stdout + made.stderr
    assert "it can bear hands" not in made.stdout
    made_of_it = pathlib.Path("mine/mine.yaml").read_text()
    assert "hand_makes: []" in made_of_it and "cameras: []" in made_of_it
    assert understudy("check", "mine/mine.yaml").returncode == 0
    refused = understudy("run", "mine/mine.yaml", "--hands", "dex1")
    assert refused.returncode == 3 and "this robot bears no hands" in refused.stderr


TIED = '<link name="{0}"/><joint name="tie" type="{1}"><parent link="{0}"/><child link="{2}"/></joint></robot>'


@pytest.mark.parametrize("root", ("odom", "world"))
def test_a_base_that_floats_in_an_empty_link_is_free(understudy, root):
    urdf = export(understudy, "go2")
    urdf.write_text(urdf.read_text().replace("</robot>", TIED.format(root, "floating", "base_link")))
    made = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2")
    assert made.returncode == 0, made.stdout + made.stderr
    rehearsed = understudy("rehearse", "mydog/starts.yaml", "--out", "starts")
    assert rehearsed.returncode == 0, rehearsed.stdout + rehearsed.stderr


def test_a_base_that_is_fixed_to_the_world_stays_where_it_is(understudy):
    urdf = export(understudy, "go2")
    urdf.write_text(urdf.read_text().replace("</robot>", TIED.format("world", "fixed", "base_link")))
    made = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2")
    assert made.returncode == 0, made.stdout + made.stderr
    ran = understudy("run", "mydog/mydog.yaml", "--speed", "max", "--duration", "1")
    assert ran.returncode == 0, ran.stderr


def put_on(urdf, links):
    """Puts empty links on others, {name: what it is fixed to}, in this order."""
    text = "".join(f'<link name="{name}"/><joint name="{name}_joint" type="fixed"><parent link="{parent}"/>'
                   f'<child link="{name}"/></joint>' for name, parent in links.items())
    urdf.write_text(urdf.read_text().replace("</robot>", text + "</robot>"))


def sites(model):
    """{name of a site: its body} of a file of MJCF."""
    root = ElementTree.parse(model).getroot()
    return {site.get("name"): body.get("name") for body in root.iter("body") for site in body.findall("site")}


def test_inertial_units_are_where_links_have_their_names(understudy):
    put_on(export(understudy, "g1"), {"imu_in_torso": "torso_link", "imu_in_pelvis": "pelvis"})
    made = understudy("new", "mine", "--urdf", "my.urdf", "--like", "g1")
    assert made.returncode == 0, made.stdout + made.stderr
    assert "inertial unit at the origin of imu_in_pelvis, a second one of imu_in_torso" in made.stdout
    assert sites("mine/mine.xml") == {"imu": "imu_in_pelvis", "secondary_imu": "imu_in_torso"}
    assert 'secondary_site: secondary_imu}' in pathlib.Path("mine/mine.yaml").read_text()
    assert understudy("check", "mine/mine.yaml").returncode == 0


def test_the_only_inertial_unit_is_the_main_one_wherever_it_is(understudy):
    put_on(export(understudy, "g1"), {"IMU-link": "torso_link"})
    made = understudy("new", "mine", "--urdf", "my.urdf", "--like", "g1")
    assert made.returncode == 0, made.stdout + made.stderr
    assert sites("mine/mine.xml") == {"imu": "IMU-link"}
    assert 'secondary_site: ""}' in pathlib.Path("mine/mine.yaml").read_text()


def test_it_hangs_by_the_link_by_which_the_other_hangs(understudy):
    urdf = export(understudy, "h2")
    assert understudy("new", "mine", "--urdf", "my.urdf", "--like", "h2").returncode == 0
    assert "crane_body: torso_link" in pathlib.Path("mine/mine.yaml").read_text()
    rehearsed = understudy("rehearse", "mine/starts.yaml", "--out", "starts")
    assert rehearsed.returncode == 0, rehearsed.stdout + rehearsed.stderr
    urdf.write_text(urdf.read_text().replace("torso_link", "chest"))
    assert understudy("new", "other", "--urdf", "my.urdf", "--like", "h2").returncode == 0
    assert "crane_body: pelvis  # from which it hangs: it has no torso_link" in (
        pathlib.Path("other/other.yaml").read_text())


def test_a_link_whose_looks_are_missing_looks_as_it_collides(understudy):
    urdf = export(understudy, "go2")
    body = urdf.read_text().split('<link name="FR_calf">')[1].split("</link>")[0]
    visuals = "".join(re.findall(r"<visual>.*?</visual>", body, re.DOTALL))
    bare = re.sub(r"<visual>.*?</visual>", "", body, flags=re.DOTALL)
    absent = '<visual><geometry><mesh filename="calf.stl"/></geometry></visual>'
    assert visuals and "<collision>" in bare
    urdf.write_text(urdf.read_text().replace(body, absent + bare))
    assert understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2").returncode == 0

    def geoms(link):
        root = ElementTree.parse("mydog/mydog.xml").getroot()
        [found] = [body for body in root.iter("body") if body.get("name") == link]
        return [[{key: value for key, value in geom.items() if key not in ("name", "class")}
                 for geom in found.findall("geom") if geom.get("class") == kind] for kind in ("visual", "collision")]

    looks, collides = geoms("FR_calf")
    assert looks == collides != []
    looks, collides = geoms("FL_calf")
    assert looks != collides


def test_an_inertia_that_no_body_has_is_repaired_and_told_of_its_link(understudy):
    urdf = export(understudy, "go2")
    head, tail = urdf.read_text().split('<link name="FR_calf">')
    urdf.write_text(head + '<link name="FR_calf">' + re.sub(r'ixx="[^"]*"', 'ixx="-1"', tail, count=1))
    made = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2")
    assert made.returncode == 0, made.stdout + made.stderr
    assert made.stdout.count("note: link 'FR_calf': no body has its principal moments of inertia, -1 ") == 1
    rehearsed = understudy("rehearse", "mydog/starts.yaml", "--out", "starts")
    assert rehearsed.returncode == 0, rehearsed.stdout + rehearsed.stderr


def test_every_foot_feels_the_ground(understudy, play):
    export(understudy, "go2")
    assert understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2").returncode == 0
    robot = play("mydog/mydog.yaml", name="mydog")
    robot.becomes(lambda now: now["time"] > 2)
    force = json.loads(robot.ctl("snapshot", "--parts", "feet"))["feet"]
    assert len(force) == 4 and all(foot["force"] > 10 if isinstance(foot, dict) else foot > 10 for foot in force)


TREE = '<robot name="r"><link name="a"/><link name="b"/>{}</robot>'
JOINT = '<joint name="j" type="revolute"><parent link="a"/><child link="b"/>{}</joint>'
WRONG = {
    "is no URDF": ("<mujoco/>", "my.urdf:1: expected URDF, whose first element is <robot>, not <mujoco>"),
    "is xacro": ('<robot name="r"><xacro:include filename="x"/></robot>', "this is xacro"),
    "has two roots": (TREE.format(""), "links without a parent: a, b; expected one"),
    "has a name that is no word": (TREE.format(JOINT.format("").replace('"j"', '"a&#27;]0;x"')),
                                   "name: expected printable characters, found 'a?]0;x'"),
    "names no link": (TREE.format(JOINT.format("").replace('"b"', '"bb"')), "no link 'bb'; did you mean"),
    "is a ring": (TREE.format(JOINT.format("") + JOINT.format("").replace('"j"', '"k"').replace('"a"', '"c"')
                              .replace('"b"', '"a"').replace('"c"', '"b"')), "they form a ring"),
    "has a joint of another kind": (TREE.format(JOINT.format("").replace("revolute", "planar")), "is planar"),
    "floats in a link that weighs something": (
        TREE.format(JOINT.format("").replace("revolute", "floating")).replace(
            '<link name="a"/>', '<link name="a"><inertial><mass value="1"/></inertial></link>'),
        "stands for the world"),
    "turns about the world": (TREE.replace('"a"', '"world"').format(JOINT.format("").replace('"a"', '"world"')),
                              "a fixed or a floating joint below it, not revolute"),
    "has a number that is none": (TREE.format(JOINT.format('<axis xyz="0 1 up"/>')), "expected 3 finite numbers"),
    "has an inertia that is none": (TREE.format(JOINT.format("")).replace(
        '<link name="b"/>', '<link name="b"><inertial><mass value="1"/><inertia ixx="1" iyy="x" izz="1"/></inertial>'
        '</link>'), "iyy"),
    "lacks a mesh": (TREE.format(JOINT.format("")).replace('<link name="b"/>', '<link name="b"><collision><geometry>'
                     '<mesh filename="package://p/m.stl"/></geometry></collision></link>'), "no such file"),
}


@pytest.mark.parametrize("what", WRONG)
def test_a_file_is_refused_that(understudy, what):
    text, said = WRONG[what]
    pathlib.Path("my.urdf").write_text(text)
    done = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2")
    assert done.returncode == 4, done.stdout + done.stderr
    assert said in done.stderr
    assert not pathlib.Path("mydog").exists()


def test_nothing_that_is_there_is_written_over(understudy):
    export(understudy, "go2")
    pathlib.Path("mydog").mkdir()
    done = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2")
    assert done.returncode == 3 and "is there already" in done.stderr


def test_meshes_come_along_and_what_is_only_looked_at_may_be_missing(understudy):
    urdf = export(understudy, "go2")
    stl = bytes(80) + (4).to_bytes(4, "little")
    corners = [(0, 0, 0), (.1, 0, 0), (0, .1, 0), (0, 0, .1)]

    for face in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)):
        stl += struct.pack("<12fH", 0, 0, 0, *[x for corner in face for x in corners[corner]], 0)
    pathlib.Path("meshes").mkdir()
    pathlib.Path("meshes/wedge.STL").write_bytes(stl)
    mesh = '<{0}><geometry><mesh filename="package://my_robot/{1}"/></geometry></{0}>'
    urdf.write_text(urdf.read_text().replace('<link name="FR_calf">', '<link name="FR_calf">' + mesh.format(
        "collision", "meshes/wedge.STL") + mesh.format("visual", "meshes/calf.dae"), 1))
    made = understudy("new", "mydog", "--urdf", "my.urdf", "--like", "go2")
    assert made.returncode == 0, made.stdout + made.stderr
    assert "calf.dae: no such file" in made.stdout and "visual mesh skipped" in made.stdout
    assert pathlib.Path("mydog/meshes/wedge.STL").read_bytes() == stl
    assert understudy("check", "mydog/mydog.yaml").returncode == 0
