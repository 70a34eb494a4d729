"""Trains for a moment with the libraries themselves: stable-baselines3, rsl_rl and skrl.

By hand, for torch takes gigabytes: in an environment with this package and its extras sb3 and rsl_rl, and with skrl,

    python tests/python/programs/learners.py

It ends with an error where a library does not take the environments, its policy does not change, or understudy.Policy
does not act as it does.
"""

import pathlib
import shutil
import tempfile

import gymnasium
import numpy as np
import torch

import understudy.envs
import understudy.rsl_rl
import understudy.sb3

ROBOTS, STEPS = 16, 24


def envs():
    return gymnasium.make_vec("Understudy/Go2Flat-v0", num_envs=ROBOTS, vectorization_mode="vector_entry_point")


def moves(module, learn):
    """Learns, and returns by how much the parameters have changed, at most."""
    before = [parameter.detach().clone() for parameter in module.parameters()]
    learn()
    return max(float((was - now).abs().max()) for was, now in zip(before, module.parameters()))


def runs_here(modules, activation):
    """Whether understudy.Policy acts as these modules of torch, one after the other."""
    dense = [module for module in modules if isinstance(module, torch.nn.Linear)]
    layers = [(module.weight.detach().numpy(), module.bias.detach().numpy()) for module in dense]
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "deploy.yaml"
        shutil.copy(understudy.envs.TASKS["go2_flat"].definition, file)
        understudy.save_weights(file.with_suffix(".safetensors"), layers, activation)
        network = understudy.Policy(file, understudy.Robot("go2"))._network
        seen = np.random.default_rng(1).normal(size=(3, layers[0][0].shape[1])).astype(np.float32)
        ours = [network(row[None]).copy() for row in seen]
    with torch.no_grad():
        theirs = torch.nn.Sequential(*modules)(torch.from_numpy(seen)).numpy()
    return np.allclose(np.concatenate(ours), theirs, atol=1e-5)


def by_sb3():
    import stable_baselines3
    from stable_baselines3.common.vec_env import VecMonitor

    vector = VecMonitor(understudy.sb3.VecEnv(envs()))
    model = stable_baselines3.PPO("MlpPolicy", vector, n_steps=STEPS, batch_size=96, n_epochs=2, seed=1, device="cpu")
    moved = moves(model.policy, lambda: model.learn(4 * STEPS * ROBOTS))
    assert runs_here([*model.policy.mlp_extractor.policy_net, model.policy.action_net], "tanh")
    return moved


def by_rsl_rl():
    from rsl_rl.runners import OnPolicyRunner

    network = {"class_name": "MLPModel", "hidden_dims": [64, 64], "activation": "elu"}
    config = {
        "num_steps_per_env": STEPS, "save_interval": 2, "obs_groups": {"actor": ["policy"], "critic": ["policy"]},
        "algorithm": {"class_name": "PPO", "num_learning_epochs": 2},
        "actor": network | {"distribution_cfg": {"class_name": "GaussianDistribution", "init_std": 0.8}},
        "critic": network,
    }  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        runner = OnPolicyRunner(understudy.rsl_rl.VecEnv(envs()), config, folder)
        moved = moves(runner.alg.actor, lambda: runner.learn(4, init_at_random_ep_len=True))
        assert list(pathlib.Path(folder).glob("model_*.pt"))
        assert runs_here(list(runner.alg.actor.mlp), "elu")
    return moved


def by_skrl():
    from skrl.agents.torch.ppo import PPO, PPO_CFG
    from skrl.envs.wrappers.torch import wrap_env
    from skrl.memories.torch import RandomMemory
    from skrl.models.torch import DeterministicMixin, GaussianMixin, Model
    from skrl.trainers.torch import SequentialTrainer

    class Actor(GaussianMixin, Model):
        def __init__(self, *spaces):
            Model.__init__(self, observation_space=spaces[0], action_space=spaces[1], device="cpu")
            GaussianMixin.__init__(self)
            self.net = torch.nn.Sequential(torch.nn.Linear(self.num_observations, 64), torch.nn.ELU(), torch.nn.Linear(64, self.num_actions))
            self.log_std = torch.nn.Parameter(torch.zeros(self.num_actions))

        def compute(self, inputs, role):
            return self.net(inputs["observations"]), {"log_std": self.log_std}

    class Critic(DeterministicMixin, Model):
        def __init__(self, *spaces):
            Model.__init__(self, observation_space=spaces[0], action_space=spaces[1], device="cpu")
            DeterministicMixin.__init__(self)
            self.net = torch.nn.Sequential(torch.nn.Linear(self.num_observations, 64), torch.nn.ELU(), torch.nn.Linear(64, 1))

        def compute(self, inputs, role):
            return self.net(inputs["observations"]), {}

    vector = wrap_env(envs(), wrapper="gymnasium")
    spaces = vector.observation_space, vector.action_space
    models = {"policy": Actor(*spaces), "value": Critic(*spaces)}
    memory = RandomMemory(memory_size=STEPS, num_envs=ROBOTS, device="cpu")
    agent = PPO(models=models, memory=memory, cfg=PPO_CFG(rollouts=STEPS), observation_space=spaces[0], action_space=spaces[1], device="cpu")
    trainer = SequentialTrainer(env=vector, agents=agent, cfg={"timesteps": 4 * STEPS, "headless": True, "close_environment_at_exit": False})
    moved = moves(models["policy"], trainer.train)
    assert runs_here(list(models["policy"].net), "elu")
    return moved


if __name__ == "__main__":
    for name, learn in (("stable-baselines3", by_sb3), ("rsl_rl", by_rsl_rl), ("skrl", by_skrl)):
        moved = learn()
        assert np.isfinite(moved) and moved > 1e-6, f"{name}: its policy has changed by {moved}"
        print(f"{name}: learns")
