"""`understudy excite` moves a robot on a stand; `understudy identify` fits its joints to the recording."""

import json
import os
import signal
import subprocess
import time

import pytest
from unitree_sdk2py.utils.crc import CRC

from peers import KEEP_NEWEST, GoLowCmd, GoLowState, go_state, listener, speaker

ON_A_STAND = ("--start", "clamped")


def test_what_was_excited_tells_the_joints(play, understudy, tmp_path):
    recording, fitted = tmp_path / "chirp.mcap", tmp_path / "fitted.yaml"
    robot = play("go2", *ON_A_STAND, "--released", "--record", recording,
                 "--set", "robot.dynamics.delay=0.003")
    excited = understudy("excite", "--robot", "go2", "--seconds", 5, "--amplitude", 0.4)
    assert excited.returncode == 0, excited.stderr
    robot.end()
    found = understudy("identify", recording, "--robot", "go2", "--json", "--out", fitted,
                       "--parameters", "delay,frictionloss")
    assert found.returncode == 0, found.stderr
    told = json.loads(found.stdout)
    figures = {one["name"]: one for one in told["figures"]}
    # A recording knows when a command came to a step or so.
    assert abs(figures["delay"]["value"] - 0.003) < 0.0015
    assert abs(figures["frictionloss calf"]["value"] - 0.645) < 0.1
    assert told["held_out"]["rms_after"] < 0.5 * told["held_out"]["rms_before"]
    assert understudy("run", "go2", "--config", fitted, "--duration", 0.1).returncode == 0


def test_a_motion_service_that_has_the_motors_is_named(play, understudy):
    play("go2", *ON_A_STAND)
    refused = understudy("excite", "--robot", "go2", "--seconds", 2)
    assert refused.returncode == 1
    assert "'mcf' has the motors" in refused.stderr and "ReleaseMode" in refused.stderr


def test_a_robot_that_stands_on_its_feet_is_refused(play, understudy):
    play("go2", "--start", "standing", "--released")
    refused = understudy("excite", "--robot", "go2", "--seconds", 2)
    assert refused.returncode == 1
    assert "of its weight" in refused.stderr


def test_a_stranger_is_not_moved_unless_that_is_meant(understudy):
    with speaker("rt/lowstate", GoLowState) as robot:
        excite = subprocess.Popen([os.environ["UNDERSTUDY"], "excite", "--robot", "go2"],
                                  stderr=subprocess.PIPE, text=True)
        robot.speak_until(lambda: excite.poll() is not None, go_state())
    assert excite.returncode == 6
    assert "--on-a-real-robot" in excite.stderr.read()


def test_a_robot_that_is_not_understudys_is_moved_where_that_is_meant():
    """It stands for a real one on a stand: no announcement, no services, joints that go where they are told."""
    state, begin = go_state(), [0.1, 1.2, -2.4] * 4
    for motor, q in zip(state.motor_state, begin):
        motor.mode, motor.q = 1, q
    commands, crc = [], CRC()
    with speaker("rt/lowstate", GoLowState) as robot, listener("rt/lowcmd", GoLowCmd, qos=KEEP_NEWEST) as heard:
        excite = subprocess.Popen([os.environ["UNDERSTUDY"], "excite", "--robot", "go2", "--seconds", "3", "--amplitude",
                                   "0.3", "--on-a-real-robot"], stderr=subprocess.PIPE, text=True)
        while excite.poll() is None:
            new = heard.take()
            commands += new
            if new:
                for motor, command in zip(state.motor_state[:12], new[-1].motor_cmd):
                    motor.q, motor.dq = command.q, 0
            state.tick += 5
            robot.write(state)
            time.sleep(0.005)
        commands += heard.take()
    said = excite.stderr.read()
    assert excite.returncode == 0, said
    assert "motion_switcher does not answer" in said
    assert len(commands) > 50
    for command in commands:
        assert command.crc == crc.Crc(command) and list(command.head) == [0xFE, 0xEF]
        assert [motor.mode for motor in command.motor_cmd[:13]] == [1] * 12 + [0]
    angles = [[motor.q for motor in command.motor_cmd[:12]] for command in commands]
    assert angles[0] == pytest.approx(begin, abs=0.1)
    chirp = angles[len(angles) // 2:]
    assert all(max(row[i] for row in chirp) - min(row[i] for row in chirp) > 0.1 for i in range(12))
    last = commands[-1].motor_cmd[:12]
    assert all(motor.kp < 0.1 and motor.kd > 0 for motor in last)


def test_ctrl_c_ends_in_damping(play):
    robot = play("go2", *ON_A_STAND, "--released")
    excite = subprocess.Popen([os.environ["UNDERSTUDY"], "excite", "--robot", "go2"],
                              stderr=subprocess.PIPE, text=True)
    for line in excite.stderr:
        if "Ctrl-C ends it softly" in line:
            break
    excite.send_signal(signal.SIGINT)
    assert excite.wait(10) == 128 + signal.SIGINT
    assert "damped" in excite.stderr.read()
    assert robot.process.poll() is None


def test_without_a_robot_there_is_nothing_to_move(understudy):
    nobody = understudy("excite", "--robot", "go2")
    assert nobody.returncode == 5
    assert "no rt/lowstate on lo" in nobody.stderr
