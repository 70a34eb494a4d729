"""The environments as stable-baselines3 and rsl_rl take them.

torch takes gigabytes, so these libraries are played by what our side uses of them; programs/learners.py runs the libraries
themselves, by hand.
"""

import importlib
import sys
import types

import gymnasium
import numpy as np
import pytest

import understudy.envs


def module(name, **has):
    made = types.ModuleType(name)
    vars(made).update(has)
    return made


@pytest.fixture
def sb3(monkeypatch):
    """understudy.sb3 beside a base class with the fields of stable-baselines3 2.9."""

    class Base:
        def __init__(self, num_envs, observation_space, action_space):
            self.num_envs, self.observation_space, self.action_space = num_envs, observation_space, action_space
            self.render_mode = self.get_attr("render_mode")[0]
            self._reset_seeds()

        def _reset_seeds(self):
            self._seeds = [None] * self.num_envs

        def seed(self, seed):
            self._seeds = [seed + i for i in range(self.num_envs)]

        def _get_indices(self, indices):
            return range(self.num_envs) if indices is None else [indices] if isinstance(indices, int) else indices

        def step(self, actions):
            self.step_async(actions)
            return self.step_wait()

    base = module("stable_baselines3.common.vec_env", VecEnv=Base)
    common = module("stable_baselines3.common", vec_env=base)
    for name, one in (("", module("stable_baselines3", common=common)), (".common", common), (".common.vec_env", base)):
        monkeypatch.setitem(sys.modules, "stable_baselines3" + name, one)
    monkeypatch.delitem(sys.modules, "understudy.sb3", raising=False)
    yield importlib.import_module("understudy.sb3")
    sys.modules.pop("understudy.sb3")


class Tensor(np.ndarray):
    """What our side uses of one."""

    def numpy(self):
        return np.asarray(self)

    def float(self):
        return self.astype(np.float32)


@pytest.fixture
def rsl_rl(monkeypatch):
    """understudy.rsl_rl beside what rsl_rl 5, torch and tensordict have of what it uses."""
    env = module("rsl_rl.env", VecEnv=object)
    monkeypatch.setitem(sys.modules, "rsl_rl", module("rsl_rl", env=env))
    monkeypatch.setitem(sys.modules, "rsl_rl.env", env)
    torch = module("torch", device=str, from_numpy=lambda array: array.view(Tensor))
    monkeypatch.setitem(sys.modules, "torch", torch)
    monkeypatch.setitem(sys.modules, "tensordict", module("tensordict", TensorDict=lambda has, batch_size: has))
    monkeypatch.delitem(sys.modules, "understudy.rsl_rl", raising=False)
    yield importlib.import_module("understudy.rsl_rl")
    sys.modules.pop("understudy.rsl_rl")


def made(count=3, **how):
    return gymnasium.make_vec("Understudy/Go2Flat-v0", num_envs=count, vectorization_mode="vector_entry_point", **how)


def actions(count=3):
    return np.zeros((count, 12), np.float32)


def test_sb3_gets_what_the_vector_gives(sb3):
    ours, theirs = sb3.VecEnv(made()), made()
    assert ours.observation_space == theirs.single_observation_space and ours.action_space == theirs.single_action_space
    ours.seed(7)
    assert np.array_equal(ours.reset(), theirs.reset(seed=7)[0])
    for _ in range(5):
        observation, reward, done, infos = ours.step(actions())
        wanted = theirs.step(actions())
        assert np.array_equal(observation, wanted[0]) and observation.dtype == np.float32
        assert np.array_equal(reward, wanted[1].astype(np.float32))
        assert not done.any() and infos == [{}, {}, {}]


def test_sb3_is_told_how_an_episode_ended(sb3):
    vector = sb3.VecEnv(made())
    vector.reset()
    vector.envs.unwrapped.age[1] = round(20 / 0.02) - 1
    observation, _, done, infos = vector.step(actions())
    assert done.tolist() == [False, True, False] and infos[0] == infos[2] == {}
    assert infos[1]["TimeLimit.truncated"] and not np.array_equal(infos[1]["terminal_observation"], observation[1])
    vector.envs.unwrapped.batch.robots[2].request("push", impulse=[0, 60, 0])
    for _ in range(100):
        _, _, done, infos = vector.step(actions())
        if done[2]:
            break
    assert done[2] and infos[2]["TimeLimit.truncated"] is False


def test_sb3_begins_again_by_other_seeds(sb3):
    vector = sb3.VecEnv(made())
    vector.seed(7)
    first = vector.reset()
    assert not np.array_equal(vector.reset(), first), "a seed holds for one reset"
    vector.seed(7)
    assert np.array_equal(vector.reset(), first)


def test_sb3_asks_for_attributes_of_all_robots_or_some(sb3):
    vector = sb3.VecEnv(made())
    assert vector.get_attr("num_envs") == [3] * 3 and vector.get_attr("num_envs", [0, 2]) == [3] * 2
    assert vector.env_is_wrapped(gymnasium.Wrapper) == [False] * 3
    vector.set_attr("dt", 0.04)
    assert vector.get_attr("dt", 1) == [0.04]
    with pytest.raises(AttributeError):
        vector.get_attr("no_such")


def test_sb3_is_refused_a_vector_that_begins_anew_a_step_later(sb3):
    with pytest.raises(ValueError, match="same step, got autoreset_mode AutoresetMode.NEXT_STEP"):
        sb3.VecEnv(gymnasium.make_vec("CartPole-v1", num_envs=2))


def test_rsl_rl_gets_what_the_vector_gives(rsl_rl):
    ours, theirs = rsl_rl.VecEnv(made(), seed=7), made()
    wanted, _ = theirs.reset(seed=7)
    assert (ours.num_envs, ours.num_actions, ours.max_episode_length) == (3, 12, 1000)
    assert np.array_equal(ours.get_observations()["policy"], wanted)
    for _ in range(5):
        observation, reward, done, extras = ours.step(actions().view(Tensor))
        wanted = theirs.step(actions())
        assert np.array_equal(observation["policy"], wanted[0]) and ours.get_observations() is observation
        assert reward.dtype == np.float32 and np.array_equal(reward, wanted[1].astype(np.float32))
        assert not done.any() and not extras["time_outs"].any()
    assert ours.episode_length_buf.tolist() == [5, 5, 5]


def test_rsl_rl_may_spread_the_ends_of_the_first_episodes(rsl_rl):
    vector = rsl_rl.VecEnv(made())
    vector.episode_length_buf = np.array([0, 999, 500]).view(Tensor)
    _, _, done, extras = vector.step(actions().view(Tensor))
    assert done.tolist() == extras["time_outs"].tolist() == [False, True, False]
    assert vector.episode_length_buf.tolist() == [1, 0, 501]


def test_a_robot_is_pushed_also_when_its_episode_was_said_to_be_older():
    envs = made(1, set={"sensors.noise": False}).unwrapped
    envs.reset(seed=3)
    envs.age[:] = 700
    pushed = 0
    for _ in range(280):
        before = envs._push_at[0]
        envs.step(np.zeros((1, 12)))
        pushed += envs._push_at[0] != before
    assert pushed >= 1 and envs._push_at[0] > 900
