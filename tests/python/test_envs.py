"""The environments of Gymnasium."""

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import understudy
import understudy.envs

NAMES = ["Understudy/Go2Flat-v0", "Understudy/G1Flat-v0"]


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


def test_an_episode_that_ends_begins_anew_and_leaves_its_last_observation():
    envs = made(3)
    envs.reset(seed=1)
    wild = np.random.default_rng(1)
    for _ in range(300):
        observation, reward, fell, over, info = envs.step(10 * wild.normal(size=(3, 12)))
        if fell.any():
            break
    (i, *_) = np.flatnonzero(fell)
    assert reward[i] < -0.5 and (info["_final_obs"] == (fell | over)).all()
    last = info["final_obs"][i]
    down = 5  # of projected_gravity
    assert last[down] > -0.97 and observation[i][down] < -0.99
    assert (observation[i][-12:] == 0).all() and envs.unwrapped.batch.robots[i].time < 0.01


def test_an_episode_ends_after_its_time_without_a_fall():
    env = gymnasium.make(NAMES[0]).unwrapped
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
    text = (understudy.envs.TASKS / "go2_flat.yaml").read_text()
    file.write_text(text.replace("  last_action: {params: {}, clip: [-100, 100]}\n", ""))
    envs = made(1, definition=file, set={"terrain.friction": 0.3})
    assert envs.single_observation_space.shape == (33,) and run(envs, 3).shape == (3, 1, 36)
    assert "friction: 0.3" in envs.unwrapped.batch.robots[0].world.config()
    with pytest.raises(ValueError, match="render_mode"):
        understudy.envs.WalkEnv(render_mode="human")
