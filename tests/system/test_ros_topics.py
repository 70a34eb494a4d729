"""ROS's topics in a recording, read by what ROS users read them with: MCAP's decoder by the schemas in the file, rosbags
by ROS's own definitions, a reader of URDF; and layouts for their viewers, by Foxglove's description of them."""

import collections
import json
import math
import pathlib
import re
import signal
import time
import xml.etree.ElementTree as ElementTree

import pytest
import yaml
from foxglove import layouts
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from urdf_parser_py.urdf import URDF

from peers import GoLowCmd, go_command, speaker
from robots import understudy

LAYOUTS = pathlib.Path(__file__).parents[2] / "examples" / "layouts"
TOPICS = {"/tf": "tf2_msgs/msg/TFMessage", "/tf_static": "tf2_msgs/msg/TFMessage",
          "/joint_states": "sensor_msgs/msg/JointState", "/robot_description": "std_msgs/msg/String",
          "/clock": "rosgraph_msgs/msg/Clock", "/scene": "visualization_msgs/msg/MarkerArray"}
LATCHED = {"/tf_static", "/robot_description", "/scene"}
HZ = 50
SECONDS = 2


class Recording:
    """A file's channels, and by topic the decoded messages with their log times [ns]."""

    def __init__(self, path):
        self.channels, self.schemas = {}, {}
        self.messages, self.raw = collections.defaultdict(list), collections.defaultdict(list)
        with pathlib.Path(path).open("rb") as file:
            reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
            for schema, channel, message, decoded in reader.iter_decoded_messages():
                self.channels[channel.topic] = channel
                self.schemas[channel.topic] = schema
                self.messages[channel.topic].append((message.log_time, decoded))
                self.raw[channel.topic].append(message.data)
            self.about = next(one.metadata for one in reader.iter_metadata() if one.name == "understudy")


def made(folder, name, *arguments):
    file = folder / f"{name.replace('/', '_')}.mcap"
    done = understudy("exec", name, "--record", file, "--speed", "max", "--duration", SECONDS, *arguments,
                      "--", "sleep", 60)
    assert file.exists(), done.stderr
    return file


@pytest.fixture(scope="module", name="file")
def file_fixture(tmp_path_factory):
    return made(tmp_path_factory.mktemp("ros"), "go2")


@pytest.fixture(scope="module", name="recording")
def recording_fixture(file):
    return Recording(file)


def nanoseconds(stamp):
    return stamp.sec * 10**9 + stamp.nanosec


def test_schemas_are_those_of_ros_2(recording):
    for release in (Stores.ROS2_HUMBLE, Stores.ROS2_JAZZY):
        official = get_typestore(release)
        for topic, name in TOPICS.items():
            assert recording.schemas[topic].name == name
            assert recording.schemas[topic].encoding == "ros2msg"
            ours = get_typestore(Stores.EMPTY)
            ours.register(get_types_from_msg(recording.schemas[topic].data.decode(), name))
            assert ours.hash_rihs01(name) == official.hash_rihs01(name), topic
            for raw in recording.raw[topic]:
                message = official.deserialize_cdr(raw, name)
                assert official.serialize_cdr(message, name) == raw  # nothing is left over


def test_what_players_need_to_know_is_in_the_metadata(recording):
    for topic in TOPICS:
        metadata = recording.channels[topic].metadata
        assert metadata["from"] == "simulation"
        quality, = yaml.safe_load(metadata["offered_qos_profiles"])
        assert quality["reliability"] == 1
        assert quality["durability"] == (1 if topic in LATCHED else 2)  # transient local, volatile
        assert (len(recording.messages[topic]) == 1) == (topic in LATCHED)


def test_times_are_those_of_the_recording(recording):
    start = int(recording.about["start_time_ns"])
    for topic in ("/tf", "/joint_states", "/clock"):
        times = [log_time - start for log_time, _ in recording.messages[topic]]
        assert times == [n * 10**9 // HZ for n in range(1, SECONDS * HZ + 1)]
    for log_time, clock in recording.messages["/clock"]:
        assert nanoseconds(clock.clock) == log_time
    for log_time, joints in recording.messages["/joint_states"]:
        assert nanoseconds(joints.header.stamp) == log_time
    for log_time, moved in recording.messages["/tf"]:
        assert {nanoseconds(one.header.stamp) for one in moved.transforms} == {log_time}


def tree_of(recording):
    """By link of the robot: the link before."""
    moved, fixed = recording.messages["/tf"][0][1], recording.messages["/tf_static"][0][1]
    pairs = [(one.child_frame_id, one.header.frame_id) for one in [*moved.transforms, *fixed.transforms]]
    assert len(dict(pairs)) == len(pairs)
    return dict(pairs)


def test_every_link_of_the_description_has_a_place_in_the_world(recording):
    robot = URDF.from_xml_string(recording.messages["/robot_description"][0][1].data.encode())
    tree = tree_of(recording)
    assert robot.name == "go2" and robot.get_root() == "base_link"
    assert set(tree) == {link.name for link in robot.links}
    for joint in robot.joints:
        assert tree[joint.child] == joint.parent
    assert tree["base_link"] == "world"
    moving = {joint.name for joint in robot.joints if joint.type != "fixed"}
    assert set(recording.messages["/joint_states"][0][1].name) == moving


def test_the_base_is_where_the_simulation_has_it(recording):
    truth = dict(recording.messages["understudy/truth"])
    for log_time, moved in recording.messages["/tf"]:
        base = next(one.transform for one in moved.transforms if one.child_frame_id == "base_link")
        at, turn = base.translation, base.rotation
        assert [at.x, at.y, at.z, turn.w, turn.x, turn.y, turn.z] == pytest.approx(truth[log_time].qpos[:7], abs=1e-9)


def test_joints_are_where_the_robot_says(recording):
    states = dict(recording.messages["/lowstate"])
    slots = dict(zip(recording.about["motors"].split(), map(int, recording.about["slots"].split())))
    compared = 0
    for log_time, joints in recording.messages["/joint_states"]:
        if log_time not in states:
            continue  # of the end
        for name, q, tau in zip(joints.name, joints.position, joints.effort):
            motor = states[log_time].motor_state[slots[name]]
            assert motor.q == pytest.approx(q, abs=0.01)
            assert math.isfinite(tau)
            compared += 1
        assert any(tau != 0 for tau in joints.effort)
    assert compared == 12 * (SECONDS * HZ - 1)


def test_the_ground_is_a_marker_in_the_world(recording):
    markers = recording.messages["/scene"][0][1].markers
    floor, = markers
    assert (floor.header.frame_id, floor.ns, floor.type, floor.action) == ("world", "floor", 1, 0)
    assert floor.pose.position.z + floor.scale.z / 2 == pytest.approx(0)
    assert min(floor.scale.x, floor.scale.y) >= 50
    assert 0.4 < floor.color.r < 0.8 and floor.color.a == 1


@pytest.mark.parametrize("scene, kinds", [("stairs_up", {1}), ("rough", {11})])
def test_a_terrain_is_shown(tmp_path, scene, kinds):
    recording = Recording(made(tmp_path, "go2", "--scene", scene))
    markers = recording.messages["/scene"][0][1].markers
    assert kinds <= {one.type for one in markers}
    assert len({(one.ns, one.id) for one in markers}) == len(markers)
    for one in markers:
        assert len(one.points) % 3 == 0 and bool(one.points) == (one.type == 11)


@pytest.mark.parametrize("robot", ["g1_29dof_dex3", "h1"])
def test_a_humanoid_is_described_too(tmp_path, robot):
    recording = Recording(made(tmp_path, robot))
    urdf = URDF.from_xml_string(recording.messages["/robot_description"][0][1].data.encode())
    assert set(tree_of(recording)) == {link.name for link in urdf.links}


def test_a_recording_begun_in_the_middle_has_them_too(play, tmp_path):
    play("go2")
    file = tmp_path / "part.mcap"
    assert understudy("ctl", "record", "start", file).returncode == 0
    time.sleep(0.3)
    assert understudy("ctl", "record", "stop").returncode == 0
    recording = Recording(file)
    first = min(log_time for several in recording.messages.values() for log_time, _ in several)
    for topic in TOPICS:
        assert recording.messages[topic], topic
    for topic in LATCHED:
        assert recording.messages[topic][0][0] == first


def test_they_are_left_out_on_request(tmp_path):
    recording = Recording(made(tmp_path, "go2", "--set", "recording.ros_hz=0"))
    assert not set(recording.channels) & set(TOPICS)
    assert recording.messages["understudy/truth"]
    rare = Recording(made(tmp_path, "go2", "--set", "recording.ros_hz=10", "--overwrite"))
    assert len(rare.messages["/tf"]) == 10 * SECONDS


def test_nobody_plays_them_as_the_robots(file):
    done = understudy("play", file, "--topics", "/tf")
    assert done.returncode == 9
    assert "holds nothing that the robot said on '/tf'" in done.stderr


def test_other_commands_take_the_recording(file, tmp_path):
    told = json.loads(understudy("recording", file, "--json").stdout)
    assert set(TOPICS) <= {channel["topic"] for channel in told["channels"]}
    for command in (["plot", file, "--out", tmp_path / "a.svg"], ["compare", file, file]):
        done = understudy(*command)
        assert done.returncode == 0, done.stderr


def values(recording, name, separator):
    """All that a series of a layout has in a recording; `separator` stands between its fields."""
    for topic, messages in recording.messages.items():
        if not name.startswith(topic + separator):
            continue
        for _, value in messages:
            for step in re.findall(r"[^\[\]" + separator + r"]+", name[len(topic):]):
                value = value[int(step)] if step.isdecimal() else getattr(value, step)
            yield value


def foxglove_series(panels):
    for panel, config in panels.items():
        for path in config.get("paths", []):
            yield path["value"]


def test_foxglove_knows_every_setting_of_its_layout():
    layout = json.loads((LAYOUTS / "foxglove.json").read_text())
    for panel, settings in layout["configById"].items():
        kind = panel.split("!")[0].replace("3D", "ThreeDee")
        known = getattr(layouts, kind + "Config")()._to_dict()
        assert set(settings) - {"foxglovePanelTitle"} <= set(known), panel
        for series in settings.get("paths", []):
            assert set(series) <= set(layouts.PlotSeries(value="")._to_dict()), panel
    camera = layout["configById"]["3D!robot"]["cameraState"]
    assert set(camera) <= set(layouts.ThreeDeeCameraState()._to_dict())


def test_foxglove_finds_everything_that_its_layout_names(play, tmp_path):
    layout = json.loads((LAYOUTS / "foxglove.json").read_text())
    file = tmp_path / "go2.mcap"
    robot = play("go2", "--record", file, "--released")
    with speaker("rt/lowcmd", GoLowCmd) as client:
        robot.becomes(lambda status: status["commands"]["writers"] == 1)
        for _ in range(20):
            client.write_signed(go_command())
            time.sleep(0.002)
    robot.send(signal.SIGINT)
    assert robot.exit_code() == 0
    recording = Recording(file)

    def leaves(tree):
        return [tree] if isinstance(tree, str) else [*leaves(tree["first"]), *leaves(tree["second"])]

    panels = layout["configById"]
    assert sorted(leaves(layout["layout"])) == sorted(panels)
    series = list(foxglove_series(panels))
    assert len(series) > 10
    for name in series:
        found = list(values(recording, name, "."))
        assert found and all(map(math.isfinite, found)), name
    scene = panels["3D!robot"]
    assert scene["followTf"] in tree_of(recording).values()
    assert all(topic in recording.messages for topic in scene["topics"])
    assert panels["RawMessages!event"]["topicPath"] in recording.messages


@pytest.mark.parametrize("robot", ["go2", "g1"])
def test_plotjuggler_finds_every_curve_of_its_layout(tmp_path, robot):
    root = ElementTree.parse(LAYOUTS / "plotjuggler.xml").getroot()
    recording = Recording(made(tmp_path, robot))
    curves = [curve.get("name") for curve in root.iter("curve")]
    assert root.tag == "root" and len(curves) > 10
    for name in curves:
        found = list(values(recording, name, "/"))
        assert found and all(map(math.isfinite, found)), name
    for splitter in root.iter("DockSplitter"):
        assert len(splitter.get("sizes").split(";")) == int(splitter.get("count")) == len(splitter)
