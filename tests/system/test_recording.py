"""What `--record` writes, read by others: the MCAP project's own reader and a reader of ROS bags."""

import collections
import json
import pathlib
import resource
import signal
import time

import pytest
import yaml
from mcap.exceptions import EndOfFile
from mcap.reader import make_reader
from mcap.records import Message
from mcap.stream_reader import StreamReader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader

from peers import GoLowCmd, go_command, listener, speaker
from robots import understudy

DIED_OF_KILL = -signal.SIGKILL


class Recording:
    """A finished file: all that was asked of it and what its messages decode to."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.messages = collections.defaultdict(list)  # by topic: (simulated ms, message)
        with self.path.open("rb") as file:
            reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
            self.summary = reader.get_summary()
            self.attachments = {one.name: one.data for one in reader.iter_attachments()}
            self.about = next(one.metadata for one in reader.iter_metadata()
                              if one.name == "understudy")
            start = int(self.about["start_time_ns"])
            for _, channel, message, decoded in reader.iter_decoded_messages():
                self.messages[channel.topic].append(((message.log_time - start) / 1e6, decoded))

    def ticks(self, topic="/lowstate"):
        return [state.tick for _, state in self.messages[topic]]

    def events(self, kind):
        return [event for _, event in self.messages["understudy/events"] if event.kind == kind]

    def counts(self):
        ids = self.summary.statistics.channel_message_counts
        return {(channel.topic, channel.metadata["from"]): ids[channel.id]
                for channel in self.summary.channels.values()}


def stop(robot):
    robot.send(signal.SIGINT)
    assert robot.exit_code() == 0


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("recordings")


def test_a_recording_has_all_that_was_said(play, folder):
    file = folder / "all.mcap"
    robot = play("go2", "--record", file, "--released")
    with listener() as ear, speaker("rt/lowcmd", GoLowCmd) as client:
        ear.wait()
        robot.becomes(lambda status: status["commands"]["writers"] == 1)
        for number in range(200):
            message = go_command()
            message.motor_cmd[3].q = number / 8
            client.write_signed(message)
            time.sleep(0.002)
        wrong = go_command()
        wrong.crc = 1
        client.write(wrong)
        robot.becomes(lambda status: status["commands"]["refused"]["crc"] == 1)
        heard = [state.tick for state in ear.take()]
    status = robot.status()["recording"]
    stop(robot)
    recording = Recording(file)

    assert status["state"] == "on" and status["dropped"] == 0 and status["bytes"] > 0
    ticks = recording.ticks()
    assert ticks == list(range(0, 2 * len(ticks), 2))
    assert set(heard) <= set(ticks)
    assert [ms for ms, _ in recording.messages["/lowstate"]] == ticks
    commands = [command for _, command in recording.messages["/lowcmd"]]
    assert [command.motor_cmd[3].q for command in commands[:200]] == [n / 8 for n in range(200)]
    counts = recording.counts()
    assert counts["/lowcmd", "client"] == 201
    assert counts["/lowstate", "robot"] == len(ticks)
    truths = [truth for _, truth in recording.messages["understudy/truth"]]
    assert [truth.step for truth in truths[:3]] == [2, 4, 6]
    assert len(truths[0].qpos) == 19 and len(truths[0].tau) == 12
    refused, = recording.events("refused")
    assert refused.text.startswith("refused 1 LowCmd (crc): ")
    assert b"name: go2" in recording.attachments["config.yaml"]
    assert len(recording.attachments["model.mjb"]) > 1000
    assert recording.about["robot"] == "go2"


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_a_stop_signal_finishes_the_recording(play, folder, number):
    file = folder / f"stopped_by_{number}.mcap"
    robot = play("go2", "--record", file)
    robot.send(number)
    assert robot.exit_code() == 0
    ticks = Recording(file).ticks()

    assert ticks == list(range(0, 2 * len(ticks), 2)) and ticks


def test_requests_are_events(play, folder):
    file = folder / "requests.mcap"
    robot = play("go2", "--record", file)
    for request in (["push", "base_link", "0", "30", "0"], ["reset", "standing"], ["pause"], ["step", "2"],
                  ["resume"]):
        done = understudy("ctl", *request)
        assert done.returncode == 0, done.stderr
    stop(robot)
    recording = Recording(file)

    push, = recording.events("push")
    assert push.text == "push base_link 0 30 0 N"
    detail = json.loads(push.detail)
    assert detail["body"] == "base_link" and detail["force"] == [0, 30, 0]
    assert [event.text for event in recording.events("reset")] == ["reset standing"]
    assert [event.text for event in recording.events("step")] == ["step 2"]
    assert [json.loads(event.detail) for event in recording.events("pause")] == [{"on": True}, {"on": False}]


def test_a_part_of_a_run_is_recorded_on_request(play, tmp_path):
    robot = play("go2")
    file = tmp_path / "part.mcap"

    def ctl(*words, code=0):
        done = understudy("ctl", "record", *words, cwd=tmp_path)
        assert done.returncode == code, done.stderr
        return done.stderr

    ctl("start", file.name)
    now = robot.status()
    assert now["recording"]["state"] == "on"
    assert now["recording"]["file"] == str(file)
    assert "record.stop" in ctl("start", "other.mcap", code=1)
    time.sleep(0.5)
    ctl("stop")
    recording = Recording(file)
    begun = now["time"]
    ticks = recording.ticks()
    assert begun * 1000 - 500 < ticks[0] < begun * 1000 + 500
    assert len(ticks) > 100 and set(b - a for a, b in zip(ticks, ticks[1:])) == {2}
    assert recording.messages["understudy/damage"]
    assert "record.start" in ctl("stop", code=1)

    assert "--overwrite" in ctl("start", file.name, code=1)
    ctl("start", file.name, "--overwrite")
    stop(robot)  # which finishes it
    assert Recording(file).ticks()[0] > ticks[-1]


def test_a_recording_has_the_configuration_in_effect_when_it_begins(play, tmp_path):
    robot = play("go2", "--set", "sensors.noise=true", "--set", "terrain.friction=0")
    for words in (["set", "sensors.noise", "false"], ["set", "terrain.friction", "0.2"], ["speed", "0.5"],
                  ["record", "start", "part.mcap"], ["record", "stop"]):
        done = understudy("ctl", *words, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
    recording = Recording(tmp_path / "part.mcap")
    config = yaml.safe_load(recording.attachments["config.yaml"])

    assert config["sensors"]["noise"] is False
    assert config["terrain"]["friction"] == 0.2
    assert config["time"]["speed"] == 0.5
    assert float(recording.about["speed"]) == 0.5


def test_a_recording_on_request_names_itself_and_tells_why_it_cannot_be(play, tmp_path):
    robot = play("go2")
    done = understudy("ctl", "record", "start", tmp_path / "none" / "x.mcap")
    assert done.returncode == 1
    assert "No such file" in done.stderr
    failed = [event for event in json.loads(robot.ctl("events", "--json"))["events"]
              if event["kind"] == "recording_failed"]
    assert "none/x.mcap" in failed[0]["text"]
    try:
        assert understudy("ctl", "record", "start").returncode == 0
        file = pathlib.Path(robot.status()["recording"]["file"])
        assert file.name.startswith("go2_20")
        assert understudy("ctl", "record", "stop").returncode == 0
        assert Recording(file).ticks()
    finally:
        file.unlink()


def test_what_is_decoded_is_what_was_measured(folder):
    recording = Recording(folder / "all.mcap")
    truth = {truth.step: truth for _, truth in recording.messages["understudy/truth"]}
    states = [state for _, state in recording.messages["/lowstate"] if state.tick in truth]

    # Joints stand behind position and attitude of the base, in the order of the model.
    names = recording.about["motors"].split()
    assert names[0] == "FR_hip_joint" and len(names) == 12
    for state in states[::100]:
        joints = sorted(truth[state.tick].qpos[7:])
        measured = sorted(motor.q for motor in state.motor_state[:12])
        assert measured == pytest.approx(joints, abs=0.01)
        attitudes = zip(state.imu_state.quaternion, truth[state.tick].qpos[3:7])
        assert abs(sum(a * b for a, b in attitudes)) == pytest.approx(1, abs=1e-3)


def test_it_is_a_bag_for_ros_2(folder):
    file = folder / "all.mcap"
    counted = Recording(file).summary.statistics.message_count
    with AnyReader([file]) as bag:
        types = {one.topic: one.msgtype for one in bag.connections}
        read = [bag.deserialize(raw, connection.msgtype)
                for connection, _, raw in bag.messages()]

    assert types["/lowstate"] == "unitree_go/msg/LowState"
    assert types["understudy/truth"] == "understudy_msgs/msg/Truth"
    assert len(read) == counted


@pytest.mark.parametrize("robot, speed, step, seconds", [("go2", "20", 2, 10), ("g1", "max", 1, 4)])
def test_nothing_is_lost_however_fast_time_runs(play, folder, robot, speed, step, seconds):
    file = folder / f"{robot}.mcap"
    fast = play(robot, "--record", file, "--speed", speed, "--duration", seconds, ready=False)
    assert fast.exit_code(60) == 0, fast.said()
    recording = Recording(file)

    assert recording.ticks() == list(range(0, seconds * 1000, step))
    assert [ms for ms, _ in recording.messages["/lowstate"]] == recording.ticks()
    steps = [truth.step for _, truth in recording.messages["understudy/truth"]]
    assert steps == list(range(step, seconds * 1000 + 1, step))
    assert "not in it" not in fast.said()


@pytest.mark.parametrize("speed", ["1", "max"])
def test_a_run_ends_in_the_step_of_its_duration(play, tmp_path, speed):
    file = tmp_path / "run.mcap"
    robot = play("g1", "--record", file, "--speed", speed, "--duration", "0.502", ready=False)

    assert robot.exit_code() == 0, robot.said()
    assert Recording(file).ticks() == list(range(502))


def test_a_killed_run_leaves_what_was_flushed(play, folder):
    file = folder / "killed.mcap"
    robot = play("go2", "--record", file)
    robot.becomes(lambda status: status["time"] > 2.5)
    robot.send(signal.SIGKILL)
    assert robot.exit_code() == DIED_OF_KILL

    messages = 0
    with file.open("rb") as stream, pytest.raises(EndOfFile):
        for record in StreamReader(stream, validate_crcs=True).records:
            messages += isinstance(record, Message)
    assert messages > 1000


def test_a_full_disk_is_said_and_the_robot_goes_on(play, folder):
    file = folder / "full.mcap"
    few = 3_000_000  # the model alone is half of that
    robot = play("go2", "--record", file, "--speed", "20",
                 preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (few, few)))
    robot.heard("File too large: recording has stopped; the robot continues", "error")
    before = robot.status()
    after = robot.becomes(lambda status: status["published"] > before["published"] + 100)
    robot.send(signal.SIGTERM)

    assert robot.exit_code() == 9
    assert after["recording"]["state"] == "failed"
    assert file.stat().st_size < few
    with file.open("rb") as stream, pytest.raises(EndOfFile):
        list(StreamReader(stream, validate_crcs=True).records)


def test_a_recording_is_not_replaced_unasked(folder, play, understudy):
    file = folder / "there.mcap"
    file.write_text("precious")
    done = understudy("run", "go2", "--record", file)

    assert done.returncode == 9
    assert "exists already" in done.stderr and "--overwrite" in done.stderr
    assert file.read_text() == "precious"
    assert understudy("run", "go2", "--record", folder / "none/there.mcap").returncode == 9
    # Nor by a run that is refused.
    there = play("go2", "--domain", 6)
    refused = understudy("run", "go2", "--name", there.name, "--domain", 5, "--record", file, "--overwrite")
    assert refused.returncode == 8, refused.stderr
    assert file.read_text() == "precious"
    script = folder / "program"
    script.write_text("#!/nowhere/interpreter\n")
    script.chmod(0o755)
    assert understudy("exec", "go2", "--record", file, "--overwrite", "--", script).returncode == 127
    assert file.read_text() == "precious"
    assert understudy("run", "go2", "--overwrite").returncode == 2
    done = understudy("run", "go2", "--record", file, "--overwrite", "--duration", "0.5")
    assert done.returncode == 0, done.stderr
    assert Recording(file).ticks() == list(range(0, 500, 2))
