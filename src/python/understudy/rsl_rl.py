"""The environments of understudy.envs as rsl_rl 5 takes them.

    envs = gymnasium.make_vec("Understudy/Go2Flat-v0", num_envs=256, vectorization_mode="vector_entry_point")
    runner = rsl_rl.runners.OnPolicyRunner(understudy.rsl_rl.VecEnv(envs), config, "logs")

Takes `pip install understudy-robot[gym,rsl_rl]`.
"""

import rsl_rl.env
import torch
from tensordict import TensorDict


class VecEnv(rsl_rl.env.VecEnv):
    """A WalkVectorEnv with tensors on the processor. Its one group of observations is `policy`.

    Observations: float32, shape (robots, width). Rewards: float32, shape (robots,). `time_outs` of the extras tells
    whose episode ended because its time was over. Steps that episodes have lasted may be set, so that the first
    episodes end at different times.
    """

    device = torch.device("cpu")

    def __init__(self, envs, seed=0):
        self.envs = envs.unwrapped
        self.num_envs, (self.num_actions,) = self.envs.num_envs, self.envs.single_action_space.shape
        self.max_episode_length = round(self.envs.task.episode / self.envs.dt)
        self.cfg = {"task": self.envs.task.robot, "step_dt": self.envs.dt}
        self._observations = self._tensors(self.envs.reset(seed=seed)[0])

    @property
    def episode_length_buf(self):
        return torch.from_numpy(self.envs.age.copy())

    @episode_length_buf.setter
    def episode_length_buf(self, lengths):
        self.envs.age[:] = lengths.numpy()

    def get_observations(self):
        return self._observations

    def step(self, actions):
        observation, reward, fell, over, _ = self.envs.step(actions.numpy())
        self._observations = self._tensors(observation)
        ended = torch.from_numpy(fell | over)
        return self._observations, torch.from_numpy(reward).float(), ended, {"time_outs": torch.from_numpy(over.copy())}

    def _tensors(self, observation):
        return TensorDict({"policy": torch.from_numpy(observation)}, batch_size=[self.num_envs])
