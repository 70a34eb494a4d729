"""`understudy play` puts a recording on the bus; `understudy recording` lists its contents."""

import json
import os
import signal
import subprocess

import pytest
from mcap.writer import Writer

from peers import GoLowCmd, go_command, listener, speaker
from robots import Robot, eventually, understudy


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    """Two seconds of a Go2, and a client that sends it a hundred commands."""
    file = tmp_path_factory.mktemp("play") / "go2.mcap"
    folder = tmp_path_factory.mktemp("run")
    os.chmod(folder, 0o700)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("UNDERSTUDY_RUNTIME_DIR", str(folder))
        robot = Robot("go2", "--record", file, "--released", "--duration", 2)
        with speaker("rt/lowcmd", GoLowCmd) as client:
            client.speak_until(lambda: robot.process.poll() is not None, go_command())
        assert robot.exit_code() == 0, robot.said()
        robot.end()
    return file


def played(*arguments):
    return subprocess.Popen([os.environ["UNDERSTUDY"], "play", *map(str, arguments)],
                            stderr=subprocess.PIPE, text=True)


def test_the_robot_of_a_recording_speaks_again(file):
    with listener() as ear:
        player = played(file, "--topics", "rt/lowstate", "--from", "0.5", "--to", "1.5")
        said = player.communicate(timeout=20)[1]
        ticks = [state.tick for state in ear.take()]

    assert player.returncode == 0, said
    # Volatile as on a robot: a reader that learns of the writer late misses the beginning, no more.
    assert ticks == list(range(ticks[0], 1501, 2))
    assert 500 <= ticks[0] < 1000
    assert "501 messages were played" in said


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_stop_signal_ends_it(file, number):
    with listener() as ear:
        player = played(file, "--loop", "--speed", "4")
        eventually(lambda: [state for state in ear.take() if state.tick > 1500])
        eventually(lambda: [state for state in ear.take() if state.tick < 500])
        player.send_signal(number)
        said = player.communicate(timeout=20)[1]

    assert player.returncode == 0, said
    assert "messages were played" in said


def test_it_does_not_speak_beside_a_robot(play, file):
    play("go2")
    done = understudy("play", file)

    assert done.returncode == 6
    assert "a robot is already on lo" in done.stderr


def test_recorded_commands_reach_a_robot_of_today(play, file):
    robot = play("go2", "--released")
    recorded = json.loads(understudy("recording", file, "--json").stdout)
    commands = next(one["messages"] for one in recorded["channels"] if one["from"] == "client")
    assert commands > 50
    done = understudy("play", file, "--commands", "--speed", "4")

    assert done.returncode == 0, done.stderr
    counts = robot.status()["commands"]
    # They were recorded unsigned: each is refused as it was then.
    assert counts["accepted"] + sum(counts["refused"].values()) == commands


def test_commands_want_a_robot(file):
    done = understudy("play", file, "--commands")

    assert done.returncode == 5
    assert "no robot publishes on lo" in done.stderr


def test_misuse_is_said(file, tmp_path):
    def refused(*arguments):
        done = understudy("play", *arguments)
        return done.returncode, done.stderr

    code, said = refused(file, "--topics", "rt/lowstat")
    assert code == 9 and "did you mean 'rt/lowstate'?" in said
    assert refused(file, "--from", "100")[0] == 9
    assert refused(file, "--speed", "0")[0] == 2
    assert refused(tmp_path / "none.mcap")[0] == 9
    (tmp_path / "text.mcap").write_text("words")
    code, said = refused(tmp_path / "text.mcap")
    assert code == 9 and "is not an MCAP file" in said


def test_a_recording_says_what_it_holds(file):
    said = understudy("recording", file).stdout
    told = json.loads(understudy("recording", file, "--json").stdout)

    assert "go2, 2.000 s" in said
    assert told["about"]["robot"] == "go2" and told["cut_short"] == ""
    counts = {one["topic"]: one["messages"] for one in told["channels"]}
    assert counts["rt/lowstate"] == 1000 and counts["understudy/truth"] == 1000
    assert {one["name"] for one in told["attachments"]} == {"config.yaml", "model.mjb"}


def test_a_recording_of_somebody_elses_does_nothing_to_a_terminal(tmp_path):
    file = tmp_path / "other.mcap"
    with file.open("wb") as out:
        writer = Writer(out, repeat_channels=False)
        writer.start(library="\x1b]0;title\x07")
        schema = writer.register_schema("a_msgs/msg/A", "ros2msg", b"int32 a\n")
        channel = writer.register_channel("/\x1b[2J", "cdr", schema)
        writer.add_message(channel, log_time=7, data=b"1234", publish_time=7)
        writer.finish()
    done = understudy("recording", file)

    assert done.returncode == 0, done.stderr
    assert "\x1b" not in done.stdout and "rt/?[2J" in done.stdout
    assert "1 messages" in done.stdout
