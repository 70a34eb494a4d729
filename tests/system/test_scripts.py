"""Scripts, pushes and the remote controller from a shell."""

import os
import pathlib
import re
import signal
import sys

import pytest
from unitree_sdk2py.idl.unitree_go.msg.dds_ import WirelessController_

from peers import HgLowState, listener

DOCS = pathlib.Path(__file__).parents[2] / "docs" / "reference" / "scripts.md"


# How each script of the document is played, in its order: robot, options, and what a shell does beside it.
HOLDS = f"{sys.executable} {pathlib.Path(__file__).parent / 'holds_pose.py'}"
EXAMPLES = {
    "remote.press": ("g1", (), "sleep 60"),
    "lowcmd arrives": ("g1", ("--released",), HOLDS),
    "StandUp": ("go2", (), "sleep 60"),
    "the program prints": ("g1", (), "sleep 1; echo the policy loaded; echo policy loaded; sleep 60"),
}


def examples():
    return re.findall(r"```yaml\n(.*?)```", DOCS.read_text(), re.DOTALL)


def test_there_is_a_way_to_play_each_script_of_the_document():
    assert [[word for word in EXAMPLES if word in text][:1] for text in examples()] == [[w] for w in EXAMPLES]


def plays_to_its_end(understudy, file, robot, options, beside):
    """Ends as soon as the script is over."""
    events = len(re.findall(r"^  - ", file.read_text(), re.MULTILINE))
    shell = f"""{beside} & program=$!
for i in $(seq 600); do
  status=$({os.environ['UNDERSTUDY']} ctl status --json)
  case "$status" in *'"script":{{"done":{events},"refused":0,'*) kill $program; exit 0;; esac
  sleep 0.1
done
echo "$status" >&2; kill $program; exit 1"""
    done = understudy("exec", robot, "--script", file, *options, "--", "sh", "-c", shell, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("number", range(len(EXAMPLES)))
def test_each_script_of_the_document_is_sound_and_runs_to_its_end(understudy, tmp_path, number):
    file = tmp_path / "example.yaml"
    file.write_text(examples()[number])
    events = len(re.findall(r"^  - ", file.read_text(), re.MULTILINE))
    checked = understudy("check", file)
    assert checked.returncode == 0, checked.stderr
    assert f", {events} event" in checked.stdout

    plays_to_its_end(understudy, file, *list(EXAMPLES.values())[number])


def test_the_shipped_script_brings_a_g1_from_its_crane_to_its_feet(understudy):
    plays_to_its_end(understudy, DOCS.parents[2] / "examples" / "scripts" / "morning.yaml", "g1", (), "sleep 60")


def test_what_a_script_waits_for_is_in_the_status_and_in_the_log(play, tmp_path):
    file = tmp_path / "waits.yaml"
    file.write_text("script:\n"
                    "  - {when: crane happens, push: {force: [1, 0, 0]}}\n"
                    "  - {after: previous, when: base.height > 5, within: 0.5, clamp: on}\n"
                    "  - {after: previous, when: lowcmd arrives, clamp: on}\n")
    robot = play("go2", "--script", file, "--speed", "2")
    status = robot.becomes(lambda now: now["script"]["waiting"] == 1)
    assert status["script"]["waits_for"] == "crane happens"
    assert status["script"]["where"].endswith("waits.yaml:2")
    assert "waits.yaml:2: crane happens" in robot.ctl("status")
    robot.ctl("crane", "attach")
    robot.heard("for 'crane happens'")
    robot.heard("waits.yaml:3: timed out after 0.5 s", "warning")
    status = robot.becomes(lambda now: now["script"]["waits_for"] == "lowcmd arrives")
    assert (status["script"]["done"], status["script"]["refused"]) == (2, 1)
    robot.send(signal.SIGINT)
    robot.exit_code()
    assert "waits.yaml:4: was still waiting for 'lowcmd arrives' at the end" in robot.said()


def test_a_script_names_the_joints_of_its_robot(understudy, tmp_path):
    file = tmp_path / "joint.yaml"
    file.write_text("script:\n  - {when: q(left_knee) > 1, reset: }\n")
    assert understudy("check", file).returncode == 0
    done = understudy("run", "go2", "--script", file)
    assert done.returncode == 3
    assert "joint.yaml:2: when: no joint 'left_knee'" in done.stderr
    file.write_text('script:\n  - {when: the program prints "x", reset: }\n')
    done = understudy("run", "go2", "--script", file)
    assert done.returncode == 3
    assert "no program runs beside this robot" in done.stderr


def test_a_mistake_ends_the_program_before_it_starts(understudy, tmp_path):
    file = tmp_path / "bad.yaml"
    file.write_text("script:\n  - {at: 1, remote.pres: A}\n")
    done = understudy("run", "go2", "--script", file)
    assert done.returncode == 3
    assert "bad.yaml:2: unknown key 'remote.pres'; did you mean 'remote.press'?" in done.stderr


def test_what_the_robot_cannot_do_is_said_with_its_line(play, tmp_path):
    file = tmp_path / "lower.yaml"
    file.write_text("script:\n  - {at: 0.1, crane.lower: 1}\n")
    robot = play("go2", "--script", file)
    assert "lower.yaml:2: the robot does not hang" in robot.heard("script:", "warning")["message"]


def test_the_remote_is_heard_on_both_topics_and_acts(play):
    robot = play("g1")
    with listener("rt/lowstate", HgLowState) as states, \
            listener("rt/wirelesscontroller", WirelessController_) as remotes:
        assert all(not any(state.wireless_remote) for state in states.wait())
        robot.ctl("remote", "press", "L2+B", "--for", "0.5")
        heard = remotes.wait()
        assert {message.keys for message in heard} == {0x220}
        block = next(state.wireless_remote for state in reversed(states.wait()))
        assert list(block[:4]) == [0x55, 0x51, 0x20, 0x02]
    robot.becomes(lambda now: now["motion"]["state"] == 1)


def test_debug_by_the_remote_leaves_the_motors_to_lowcmd(play):
    robot = play("g1")
    robot.ctl("remote", "press", "L2+R2")
    status = robot.becomes(lambda now: not now["motion"]["service"])
    assert status["commands"]["state"] == "damping"


def test_a_motor_gets_a_fault_by_a_script_and_loses_it_by_hand(play, tmp_path):
    file = tmp_path / "fault.yaml"
    file.write_text("script:\n  - {at: 0.1, fault: {component: FR_calf_joint, fault: limp}}\n")
    robot = play("go2", "--script", file)
    robot.heard("FR_calf_joint is limp")
    robot.ctl("fault", "FR_calf_joint", "none")
    robot.heard("FR_calf_joint is no longer limp")
