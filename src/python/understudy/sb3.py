"""The environments of understudy.envs as stable-baselines3 takes them: many robots, one vector.

    envs = gymnasium.make_vec("Understudy/Go2Flat-v0", num_envs=256, vectorization_mode="vector_entry_point")
    model = stable_baselines3.PPO("MlpPolicy", understudy.sb3.VecEnv(envs))

Takes `pip install understudy-robot[gym,sb3]`. For returns and lengths of episodes in its log, put
stable_baselines3.common.vec_env.VecMonitor around it.
"""

import numpy as np
from gymnasium.vector import AutoresetMode
from stable_baselines3.common import vec_env


class VecEnv(vec_env.VecEnv):
    """Any Gymnasium vector whose episodes begin anew in the step in which they end, as WalkVectorEnv's do.

    Observations: float32, shape (robots, width). Rewards: float32, shape (robots,). An episode that ends has its last
    observation in its info as `terminal_observation`, and whether its time was over as `TimeLimit.truncated`.
    Attributes and methods are those of the vector: they are one for all robots, and `indices` has no effect.
    """

    def __init__(self, envs):
        mode = envs.metadata.get("autoreset_mode")
        if mode is not AutoresetMode.SAME_STEP:
            raise ValueError(f"envs: expected a vector that begins anew in the same step, got autoreset_mode {mode}")
        self.envs = envs
        super().__init__(envs.num_envs, envs.single_observation_space, envs.single_action_space)

    def reset(self):
        """Begins all episodes anew, by the seeds that `seed` has given; returns the observations."""
        seeds = None if self._seeds[0] is None else self._seeds
        observation, _ = self.envs.reset(seed=seeds)
        self._reset_seeds()
        self.reset_infos = [{} for _ in range(self.num_envs)]
        return observation

    def step_async(self, actions):
        self._actions = actions

    def step_wait(self):
        observation, reward, fell, over, info = self.envs.step(self._actions)
        infos = [{} for _ in range(self.num_envs)]
        for i in np.flatnonzero(fell | over):
            infos[i] = {
                "terminal_observation": info["final_obs"][i],
                "TimeLimit.truncated": bool(over[i] and not fell[i]),
            }
        return observation, reward.astype(np.float32), fell | over, infos

    def close(self):
        self.envs.close()

    def get_attr(self, attr_name, indices=None):
        return [getattr(self.envs.unwrapped, attr_name)] * len(list(self._get_indices(indices)))

    def set_attr(self, attr_name, value, indices=None):
        setattr(self.envs.unwrapped, attr_name, value)

    def env_method(self, method_name, *method_args, indices=None, **method_kwargs):
        value = getattr(self.envs.unwrapped, method_name)(*method_args, **method_kwargs)
        return [value] * len(list(self._get_indices(indices)))

    def env_is_wrapped(self, wrapper_class, indices=None):
        return [False] * len(list(self._get_indices(indices)))
