"""`understudy excite` moves a robot on a stand; `understudy identify` fits its joints to the recording."""

import json
import os
import signal
import subprocess


from peers import GoLowState, go_state, speaker

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
