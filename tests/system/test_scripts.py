"""Scripts, pushes and the remote controller from a shell."""

import pathlib
import re

from unitree_sdk2py.idl.unitree_go.msg.dds_ import WirelessController_

from peers import HgLowState, listener

DOCS = pathlib.Path(__file__).parents[2] / "docs" / "scripts.md"


def example(folder):
    text = re.search(r"```yaml\n(.*?)```", DOCS.read_text(), re.DOTALL).group(1)
    file = folder / "example.yaml"
    file.write_text(text)
    return file


def test_the_documents_example_is_sound_and_runs_to_its_end(play, understudy, tmp_path):
    file = example(tmp_path)
    checked = understudy("check", file)
    assert checked.returncode == 0
    assert "9 events" in checked.stdout

    robot = play("g1", "--script", file, "--speed", "4")
    status = robot.becomes(lambda now: now["script"]["done"] == 9)
    assert status["script"]["refused"] == 0


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
