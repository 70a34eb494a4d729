"""The environments of Gymnasium."""

import dataclasses
import types

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import understudy
import understudy.envs

NAMES = ["Understudy/Go2Flat-v0", "Understudy/G1Flat-v0", "Understudy/Go2Rough-v0"]


def made(count, name="Understudy/Go2Flat-v0", **how):
    return gymnasium.make_vec(name, num_envs=count, vectorization_mode="vector_entry_point", **how)


def run(envs, steps=30, first=0, scale=0.3):
    """Observations, rewards and ends of the first steps of robots `first`, `first` + 1, ..., each with its own seed and actions."""
    envs.reset(seed=3 + first)
    rows = []
    for step in range(steps):
        randoms = [np.random.default_rng([step, first + i]) for i in range(envs.num_envs)]
        actions = np.stack([scale * random.normal(size=envs.single_action_space.shape) for random in randoms])
        observation, reward, fell, over, _ = envs.step(actions)
        rows.append(np.hstack([observation, reward[:, None], fell[:, None], over[:, None]]))
    return np.stack(rows)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.filterwarnings("error::UserWarning", "ignore:.*symmetric and normalized space")  # actions are in units of their scale
def test_the_checker_of_gymnasium_finds_nothing(name):
    check_env(gymnasium.make(name).unwrapped)


def test_robots_do_not_depend_on_their_number_nor_on_threads():
    all_of_them = run(made(4, threads=1))
    assert (run(made(4, threads=2)) == all_of_them).all()
    assert (run(made(2)) == all_of_them[:, :2]).all()
    assert (run(made(1), first=2)[:, 0] == all_of_them[:, 2]).all()


def test_each_robot_may_have_a_seed_of_its_own():
    envs = made(2)
    first, _ = envs.reset(seed=[7, 3])
    second, _ = envs.reset(seed=3)
    assert (first[1] == second[0]).all() and (first[0] != second[0]).any()
    with pytest.raises(ValueError, match="expected one number, or 2, got 3"):
        envs.reset(seed=[1, 2, 3])


def test_an_episode_that_ends_begins_anew_and_leaves_its_last_observation():
    envs = made(3)
    envs.reset(seed=1)
    wild = np.random.default_rng(1)
    for _ in range(300):
        observation, reward, fell, over, info = envs.step(10 * wild.normal(size=(3, 12)))
        assert (reward[~fell] >= 0).all(), "nothing but a fall is worse than no reward"
        if fell.any():
            break
    (i, *_) = np.flatnonzero(fell)
    assert reward[i] < -0.5 and (info["_final_obs"] == (fell | over)).all()
    last = info["final_obs"][i]
    down = 5  # of projected_gravity
    assert last[down] > -0.97 and observation[i][down] < -0.99
    assert (observation[i][-12:] == 0).all() and envs.unwrapped.batch.robots[i].time < 0.01


def test_an_episode_ends_after_its_time_without_a_fall():
    env = understudy.envs.WalkEnv(dataclasses.replace(understudy.envs.TASKS["go2_flat"], push=0))
    env.reset(seed=1)
    steps = round(env._all.task.episode / env._all.dt)
    for step in range(steps):
        _, reward, fell, over, _ = env.step(np.zeros(12))
        assert not fell and over == (step == steps - 1)


def test_what_is_rewarded_is_the_commanded_velocity():
    envs = made(2).unwrapped
    envs.reset(seed=1)
    envs.velocity[:] = [[0, 0, 0], [1, 0, 0]]
    for _ in range(25):
        _, reward, *_ = envs.step(np.zeros((2, 12)))
    assert reward[0] > reward[1] + 0.02  # both stand; 1.5 a second for the velocity
    terms = envs.reward_terms()
    assert terms["velocity"][0] > 0.95 and terms["velocity"][1] < 0.1 and set(terms) | {"fall"} == set(envs.task.weights)


def test_a_landing_counts_by_its_time_in_the_air_while_the_robot_is_to_walk():
    envs = made(1).unwrapped
    envs.reset(seed=1)
    truth, strides = dict(envs.batch.truth), []
    envs.batch = types.SimpleNamespace(truth=truth, state=envs.batch.state)
    envs.velocity[:] = [0.5, 0, 0]
    for step in range(20):
        in_air = [step < 16, step < 6 or 8 <= step < 12, False, True]  # 0.32 s; 0.12 and 0.08 s; never; still
        truth["contact_force"] = np.where(in_air, 0, 30)[None]
        envs._note_landings()
        strides.append(envs.reward_terms()["stride"][0])
    landings = {step: stride for step, stride in enumerate(strides) if stride != 0}
    assert landings == {6: pytest.approx(0.14 - 0.2), 12: pytest.approx(0.1 - 0.2), 16: pytest.approx(min(0.34 - 0.2, 0.2))}
    envs.velocity[:] = 0
    envs._touched[:], truth["contact_force"] = False, np.full((1, 4), 30.0)
    envs._note_landings()
    assert envs.landed.all() and envs.reward_terms()["stride"][0] == 0


def test_pushes_come_within_their_time_and_follow_from_the_seed():
    def pushes(seed, count=1):
        task = dataclasses.replace(understudy.envs.TASKS["go2_flat"], push_time=1.0)
        envs = understudy.envs.WalkVectorEnv(task, count)
        envs.reset(seed=seed)
        for _ in range(160):  # 3.2 s
            envs.step(np.zeros((count, 12)))
        robot = envs.batch.robots[count - 1]
        return [(event["time"], event["text"]) for event in robot.take_events() if event["kind"] == "push"]

    found = pushes(3)
    times = np.array([time for time, _ in found])
    assert len(found) >= 3 and (np.diff(times) < 1.05).all() and times[0] < 1.05
    assert pushes(2, count=2) == found != pushes(4)


def test_a_course_has_harder_ground_for_those_that_go_on():
    envs = made(6, NAMES[2]).unwrapped
    envs.reset(seed=1)
    course, position = envs.task.course, envs.batch.truth["position"]
    assert position[:, 0] == pytest.approx([course.place(0, i) for i in range(6)], abs=0.01)
    assert (envs.batch.truth["tilt"] < 0.3).all(), "they stand on what is there"
    envs.level[:] = [0, 0, 3, 3, 5, 5]
    envs._asked[:] = [4, 4, 0, 4, 4, 4]
    envs._begun[:] = position[:, :2]
    envs._begun[[0, 4]] += [2.5, 0]  # so far have they come
    envs._begun[5] += [1.5, 0]
    envs._promote(np.arange(6), np.array([False, False, True, False, False, False]))
    assert envs.level.tolist() == [1, 0, 2, 2, 5, 5]
    envs._begin(np.arange(6))
    assert position[:, 0] == pytest.approx([course.place(level, i) for i, level in enumerate(envs.level)], abs=0.01)
    patches = course.settings()["terrain.patches"]
    assert patches[-1]["difficulty"] == course.hardest > patches[0]["difficulty"]
    envs.reset(seed=1)
    assert (envs.level == 0).all()


def test_a_humanoid_begins_on_its_feet_and_is_let_go():
    envs = made(2, NAMES[1]).unwrapped
    envs.reset(seed=1)
    for _ in range(10):
        envs.step(np.zeros((2, 29)))
    assert (envs.batch.truth["position"][:, 2] > 0.7).all() and (envs.batch.truth["tilt"] < 0.3).all()
    events = [event["kind"] for event in envs.batch.robots[0].take_events()]
    assert "refused" not in events and events.count("clamp") == 2


def test_the_attitude_turns_vectors_of_the_world_into_the_bases_axes():
    half = np.sqrt(0.5)
    attitude = np.array([[half, 0, 0, half], [1, 0, 0, 0]], np.float32)  # a quarter turn to the left, none
    assert understudy.envs.in_base(attitude, np.array([[0, 2, 1], [0, 2, 1]], np.float32)) == pytest.approx(
        np.array([[2, 0, 1], [0, 2, 1]]), abs=1e-6
    )


def test_another_definition_and_other_settings_are_taken(tmp_path):
    file = tmp_path / "deploy.yaml"
    text = (understudy.envs.DEFINITIONS / "go2_flat.yaml").read_text()
    file.write_text(text.replace("  last_action: {params: {}, clip: [-100, 100]}\n", ""))
    envs = made(1, definition=file, set={"terrain.friction": 0.3})
    assert envs.single_observation_space.shape == (33,) and run(envs, 3).shape == (3, 1, 36)
    assert "friction: 0.3" in envs.unwrapped.batch.robots[0].world.config()
    with pytest.raises(ValueError, match="render_mode"):
        understudy.envs.WalkEnv(render_mode="human")
