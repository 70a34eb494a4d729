"""examples/training: a policy is trained, goes on after an interruption, and is deployed."""

import dataclasses
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import understudy.envs

ROOT = pathlib.Path(__file__).parents[2]
TRAIN = ROOT / "examples" / "training" / "go2_flat" / "train.py"


def train(folder, *options):
    words = [sys.executable, TRAIN, folder, "--robots", "16", *options]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def progress(folder):
    return np.genfromtxt(folder / "progress.csv", delimiter=",", names=True)


class Crouch(understudy.envs.WalkVectorEnv):
    """What is learned in seconds: to lower the base to 0.22 m."""

    TASK = dataclasses.replace(
        understudy.envs.TASKS["go2_flat"], weights={"low": 1.0, "fall": -5.0}, episode=2.0, lowest=0.1
    )  # fmt: skip

    def reward_terms(self):
        return {"low": np.exp(-np.square((self.batch.truth["position"][:, 2] - 0.22) / 0.05))}


def test_a_robot_that_walks_is_pushed_harder(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(TRAIN.parent)
    import train as program

    monkeypatch.setattr(program, "HARDER", 500)
    envs, learner = Crouch(Crouch.TASK, 16), program.Learner(45, 12, seed=2)
    program.train(tmp_path, envs, learner, lambda: learner.iteration == 1)
    assert envs.task.push == 15
    program.train(tmp_path, envs, learner, lambda: learner.iteration == 3)
    assert learner.samples > 500 and envs.task.push == 20


def test_the_reward_rises_and_the_policy_is_deployed_by_the_same_definition(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(TRAIN.parent)
    from train import Learner, train as train_in_process

    learner = Learner(45, 12, seed=2)
    train_in_process(tmp_path, Crouch(Crouch.TASK, 16), learner, lambda: learner.iteration == 48)
    reward = progress(tmp_path)["reward_per_s"]
    assert reward[-8:].mean() > 1.5 * reward[:8].mean(), reward
    checked = subprocess.run(
        [os.environ["UNDERSTUDY"], "policy", "check", tmp_path / "deploy.yaml", "--robot", "go2"], capture_output=True, text=True
    )  # fmt: skip
    assert checked.returncode == 0, checked.stdout + checked.stderr
    robot = understudy.Robot("go2", set={"start.pose": "standing", "motion.service": "none"})
    robot.step(0.02)
    policy = understudy.Policy(tmp_path / "deploy.yaml", robot)
    for _ in range(50):
        robot.command(**policy.step(robot.state))
        robot.step(policy.step_dt)
    assert robot.truth.tilt < 0.5 and not [event for event in robot.take_events() if event["kind"] == "refused"]


def test_weights_that_are_no_numbers_are_not_saved(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(TRAIN.parent)
    from train import Learner, train as train_in_process

    learner = Learner(45, 12, seed=2)
    envs = Crouch(Crouch.TASK, 4)
    train_in_process(tmp_path, envs, learner, lambda: learner.iteration == 1)
    before = (tmp_path / "checkpoint.pickle").read_bytes()
    monkeypatch.setattr(learner, "learn", lambda seen: learner.actor.parameters[-1].fill(np.nan))
    with pytest.raises(SystemExit, match="the last checkpoint of .* is whole"):
        train_in_process(tmp_path, envs, learner, lambda: False)
    assert (tmp_path / "checkpoint.pickle").read_bytes() == before


def test_the_same_seed_gives_the_same_policy_and_another_does_not(tmp_path):
    for name, seed in (("a", 1), ("b", 1), ("c", 2)):
        train(tmp_path / name, "--iterations", "2", "--seed", seed)
    a, b, c = ((tmp_path / name / "deploy.safetensors").read_bytes() for name in "abc")
    assert a == b != c


def test_tensorboard_shows_what_progress_has(tmp_path):
    from tensorboardX.proto.event_pb2 import Event

    train(tmp_path, "--iterations", "2", "--tensorboard")
    (file,) = tmp_path.glob("events.out.tfevents.*")
    data, shown = file.read_bytes(), {}
    while data:  # a record: its length, a checksum, the event, another checksum
        length = int.from_bytes(data[:8], "little")
        event, data = Event.FromString(data[12 : 12 + length]), data[16 + length :]
        for value in event.summary.value:
            shown.setdefault(value.tag, []).append((event.step, value.simple_value))
    told = progress(tmp_path)
    assert set(shown) == set(told.dtype.names) - {"iteration", "samples", "seconds"}
    for tag, values in shown.items():
        assert [step for step, _ in values] == list(told["samples"])
        assert [value for _, value in values] == [pytest.approx(one, rel=1e-4) for one in told[tag]]


def test_ctrl_c_loses_nothing_and_the_next_run_goes_on(tmp_path):
    with subprocess.Popen([sys.executable, TRAIN, tmp_path, "--robots", "16"], stdout=subprocess.PIPE, text=True) as training:
        end = time.monotonic() + 60
        while not (tmp_path / "progress.csv").exists() or len((tmp_path / "progress.csv").read_text().splitlines()) < 4:
            assert time.monotonic() < end and training.poll() is None
            time.sleep(0.05)
        training.send_signal(signal.SIGINT)
        assert training.wait(60) == 0 and "run it again to go on" in training.stdout.read()
    before = len(progress(tmp_path))
    told = train(tmp_path, "--iterations", before + 2)
    assert f"goes on after iteration {before}" in told
    assert list(progress(tmp_path)["iteration"]) == list(range(1, before + 3))


def test_a_damaged_checkpoint_is_named_and_not_replaced(tmp_path):
    checkpoint = tmp_path / "checkpoint.pickle"
    checkpoint.write_bytes(b"garbage")
    done = subprocess.run([sys.executable, TRAIN, tmp_path, "--iterations", "1"], capture_output=True, text=True, timeout=300)
    assert done.returncode == 2 and f"{checkpoint}: expected a checkpoint" in done.stderr
    assert checkpoint.read_bytes() == b"garbage"
