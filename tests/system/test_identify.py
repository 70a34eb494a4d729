"""`understudy excite` moves a robot on a stand; `understudy identify` fits its joints to the recording."""

import array
import collections
import importlib.machinery
import importlib.util
import json
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import time
import types
import zipfile

import numpy
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


@pytest.mark.parametrize(("joint", "told"), [
    ("FR_hop", "; did you mean 'FR_hip'? (valid: FR_hip, FR_thigh, "),
    ("elbow", "; valid: FR_hip, FR_thigh, "),
])
def test_a_joint_that_is_not_there_is_told_with_those_that_are(understudy, joint, told):
    refused = understudy("excite", "--robot", "go2", "--joints", f"FL_calf,{joint}")
    assert refused.returncode == 3
    assert f"no joint '{joint}'{told}" in refused.stderr


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


TOOL = pathlib.Path(__file__).parents[2] / "tools" / "identify_go2"


class Tensor:
    """Is pickled as torch pickles its own: where its numbers are, and how they lie."""

    def __init__(self, key, *shape):
        self.key, self.shape = key, shape

    def __reduce__(self):
        rebuild = sys.modules["torch._utils"]._rebuild_tensor_v2
        return rebuild, (Storage(self.key), 0, self.shape, (1,), False, collections.OrderedDict())


class Storage(str):
    pass


class Saver(pickle.Pickler):
    def persistent_id(self, one):
        return ("storage", sys.modules["torch"].FloatStorage, str(one), "cpu", 0) if isinstance(one, Storage) else None


def trajectory(path, monkeypatch, rows, **others):
    """A file as torch.save makes it, of `rows` of a Go2: q counts from 0, what is commanded is 1 more."""
    torch, utils = types.ModuleType("torch"), types.ModuleType("torch._utils")
    torch.FloatStorage = type("FloatStorage", (), {"__module__": "torch"})
    exec("def _rebuild_tensor_v2(*_): pass", vars(utils))
    monkeypatch.setitem(sys.modules, "torch", torch)
    monkeypatch.setitem(sys.modules, "torch._utils", utils)
    said = {"time": Tensor("0", rows), "dof_pos": Tensor("1", rows, 12), "des_dof_pos": Tensor("2", rows, 12),
            "des_dof_vel": Tensor("3", rows, 12), "kp": numpy.full(12, 20.0), "kd": numpy.full(12, 1.5)} | others
    q = list(range(rows * 12))
    numbers = [[0.25 * row for row in range(rows)], q, [one + 1 for one in q], [0.5] * len(q)]
    with zipfile.ZipFile(path, "w") as file:
        with file.open("traj/data.pkl", "w") as pickled:
            Saver(pickled, protocol=2).dump(said)
        for key, values in enumerate(numbers):
            file.writestr(f"traj/data/{key}", array.array("f", values).tobytes())


def test_trajectories_of_the_public_go2_are_read_without_torch(tmp_path, monkeypatch):
    loader = importlib.machinery.SourceFileLoader("identify_go2", str(TOOL))
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    tool = importlib.util.module_from_spec(importlib.util.spec_from_loader("identify_go2", loader))
    loader.exec_module(tool)
    trajectory(tmp_path / "a.pt", monkeypatch, 3)
    tool.write_csv(tmp_path / "a.pt", tmp_path / "a.csv")
    heads, *rows = [line.split(",") for line in (tmp_path / "a.csv").read_text().splitlines()]
    assert len(rows) == 3 and heads[:6] == ["time", "FL_hip.q", "FL_hip.q_des", "FL_hip.dq_des", "FL_hip.kp", "FL_hip.kd"]
    last = dict(zip(heads, map(float, rows[2])))
    assert last["time"] == 0.5 and last["RR_calf.q"] == 35 and last["RR_calf.q_des"] == 36
    assert (last["FL_thigh.q"], last["FR_hip.dq_des"], last["FR_hip.kp"], last["RL_hip.kd"]) == (25, 0.5, 20, 1.5)

    trajectory(tmp_path / "harm.pt", monkeypatch, 3, harm=os.system)
    with pytest.raises(pickle.UnpicklingError, match="did not expect posix.system"):
        tool.write_csv(tmp_path / "harm.pt", tmp_path / "harm.csv")
