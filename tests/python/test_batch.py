"""Many robots side by side."""

import resource
import subprocess
import sys

import numpy as np
import pytest

import understudy

SETS = {
    "start.pose": "standing", "motion.service": "none",
    "randomization.mass": [0.8, 1.2], "randomization.friction": [0.5, 1.2], "randomization.delay": [0.001, 0.004],
}  # fmt: skip


def run(batch, steps=20):
    rng = np.random.default_rng(5)
    standing = batch.robots[0].standing
    for _ in range(steps):
        batch.command(q=standing + rng.uniform(-0.1, 0.1, (len(batch), 12)), kp=60, kd=3)
        batch.step(0.02)
    return {name: values.copy() for name, values in (batch.state | batch.truth).items()}


def same(one, other):
    return all((one[name].view(np.uint32) == other[name].view(np.uint32)).all() for name in one)


def test_the_number_of_threads_changes_no_bit():
    states = [run(understudy.Batch("go2", 5, threads=threads, set=SETS, seed=3)) for threads in (1, 2, 7)]
    assert same(states[0], states[1]) and same(states[0], states[2])


def test_each_robot_is_the_one_of_its_seed():
    batch = understudy.Batch("go2", 3, set=SETS, seed=3)
    targets = np.random.default_rng(1).uniform(-0.1, 0.1, (10, 3, 12)) + batch.robots[0].standing
    for target in targets:
        batch.command(q=target, kp=60, kd=3)
        batch.step(0.02)
    for i in range(3):
        robot = understudy.Robot("go2", set=SETS, seed=3 + i)
        robot.step()
        for target in targets:
            robot.command(q=target[i], kp=60, kd=3)
            robot.step(0.02)
        assert (batch.state["q"][i] == robot.state.q.astype(np.float32)).all()
        assert (batch.state["accelerometer"][i] == robot.state.accelerometer.astype(np.float32)).all()
        assert (batch.truth["position"][i] == robot.truth.position.astype(np.float32)).all()
        assert (batch.truth["attitude"][i] == robot.truth.quaternion.astype(np.float32)).all()
        assert (batch.truth["contact_force"][i] == robot.truth.foot_force.astype(np.float32)).all()


def test_an_episode_begins_as_the_first_of_that_seed_did():
    batch = understudy.Batch("go2", 4, threads=2, set=SETS, seed=10)
    first = run(batch)
    batch.begin([0, 1, 2, 3], [10, 11, 12, 13])
    assert (batch.truth["tilt"] < 0.1).all()
    assert same(run(batch), first)
    batch.begin([2], [12])
    assert batch.robots[2].time == pytest.approx(0.001) and batch.robots[1].time == pytest.approx(0.401)


def test_an_episode_begins_where_it_is_asked_to():
    batch = understudy.Batch("go2", 3, set=SETS)
    batch.begin([0, 2], [1, 2], at=np.array([[4, -1, 0], [-3, 2, 1.5]]))
    assert batch.truth["position"][:, :2] == pytest.approx(np.array([[4, -1], [0, 0], [-3, 2]]), abs=0.01)
    assert 2 * np.arctan2(batch.truth["attitude"][2, 3], batch.truth["attitude"][2, 0]) == pytest.approx(1.5, abs=0.01)
    with pytest.raises(ValueError, match="as many places as robots, got 1 and 2"):
        batch.begin([0, 1], [1, 2], at=[[0, 0, 0]])
    with pytest.raises(ValueError, match="within 1000"):
        batch.begin([0], [1], at=[[2000, 0, 0]])
    batch.step(0.02)


def test_episodes_of_other_seeds_have_other_draws():
    batch = understudy.Batch("go2", 2, set=SETS, seed=1)
    run(batch)
    assert (batch.state["q"][0] != batch.state["q"][1]).any()


def test_states_are_views_with_a_row_for_each_robot():
    batch = understudy.Batch("g1", 3)
    q, position = batch.state["q"], batch.truth["position"]
    assert q.shape == (3, 29) and q.dtype == np.float32 and position.shape == (3, 3)
    assert np.shares_memory(q, batch.state["q"]) and not q.flags.writeable
    before = batch.state["gyroscope"].copy()
    batch.step(0.1)
    assert (batch.state["gyroscope"] != before).any()
    del batch
    assert np.isfinite(q).all(), "arrays keep the batch"


def test_commands_are_for_all_or_for_each():
    batch = understudy.Batch("go2", 2, set={"start.pose": "clamped", "motion.service": "none"})
    for _ in range(30):
        batch.command(q=np.array([[0.3] * 12, [-0.3] * 12]), kp=np.full(12, 60.0), kd=3)
        batch.step(0.02)
    hips = batch.truth["torque"].shape, batch.state["q"][:, 0]
    assert hips[0] == (2, 12) and hips[1] == pytest.approx([0.3, -0.3], abs=0.1)
    with pytest.raises(ValueError, match=r"shape \(12,\) or \(2, 12\), got 36 numbers"):
        batch.command(q=np.zeros((3, 12)))


def test_mistakes_are_named():
    with pytest.raises(understudy.Error, match="did you mean 'go2'"):
        understudy.Batch("go3", 2)
    with pytest.raises(ValueError, match="at least one robot"):
        understudy.Batch("go2", 0)
    for count, seed in ((2, 2**31 - 1), (10**12, 1), (2, -1)):
        with pytest.raises(ValueError, match="seeds of 0 to 2147483647"):
            understudy.Batch("go2", count, seed=seed)
    batch = understudy.Batch("go2", 2)
    with pytest.raises(ValueError, match="there is no robot 2"):
        batch.begin([2], [1])
    with pytest.raises(ValueError, match="as many seeds"):
        batch.begin([0, 1], [1])
    with pytest.raises(ValueError, match="seed of 0 or more"):
        batch.begin([0], [-1])
    with pytest.raises(ValueError, match="whole number of steps"):
        batch.step(0.0005)


SIZE = """
import sys, understudy
count = int(sys.argv[1])
batch = understudy.Batch("go2", count, set={"start.pose": "standing"})
for seed in range(20):
    batch.begin(range(count), [seed] * count)
print(open("/proc/self/statm").read().split()[1])
"""


def test_a_further_robot_takes_less_than_12_mb_however_often_it_begins():
    def pages(count):
        return int(subprocess.run([sys.executable, "-c", SIZE, str(count)], check=True, capture_output=True, text=True).stdout)

    megabytes = (pages(21) - pages(1)) * resource.getpagesize() / 1e6
    assert megabytes < 20 * 12
