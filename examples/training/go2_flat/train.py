"""Trains a Go2 to walk as commanded, by PPO in numpy: train.py FOLDER [--minutes 60]

Run it again with the same FOLDER to go on. Ctrl-C ends it after the iteration that it is in. FOLDER gets

  progress.csv        a row for each iteration
  checkpoint.pickle   all that is needed to go on; take none from others, since unpickling runs what it says
  deploy.yaml, deploy.safetensors     the policy, for `understudy policy check`, understudy.Policy and the motion service
  walk.npz            the same policy for examples/policy/deploy.py

With --tensorboard also event files for TensorBoard, by the package tensorboardX.

It needs the package `understudy-robot` with its extra `gym`. The method is that of J. Schulman et al., "Proximal policy
optimization algorithms", 2017; its numbers are usual ones of legged robots: assumed.
"""

import argparse
import csv
import dataclasses
import os
import pathlib
import pickle
import shutil
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # more would only wait for each other

import gymnasium  # noqa: E402
import numpy as np  # noqa: E402

import understudy  # noqa: E402
import understudy.envs  # noqa: E402

HIDDEN = (128, 128)
HARDER = 8_400_000  # samples, from which on pushes are of up to HARDEST N·s; harder ones at once slow it down by half
HARDEST = 20.0
COLUMNS = ("iteration", "samples", "seconds", "reward_per_s", "ends_per_s", "deviation", "rate")  # of progress.csv
STEPS, EPOCHS, PARTS = 24, 4, 4  # of an iteration: steps of each robot, passes over them, parts of a pass
DISCOUNT, TRACE, CLIP = 0.99, 0.95, 0.2
WANTED_KL, ENTROPY, LARGEST_GRADIENT, CRITIC_RATE = 0.01, 0.003, 1.0, 1e-3


class Network:
    """Dense layers with ELU between them."""

    def __init__(self, sizes, gain, random):
        self.parameters = []
        for number, (inputs, outputs) in enumerate(zip(sizes, sizes[1:])):
            q, _ = np.linalg.qr(random.normal(size=(max(inputs, outputs), min(inputs, outputs))))
            weight = q if outputs >= inputs else q.T
            scale = gain if number == len(sizes) - 2 else 2**0.5
            self.parameters += [(scale * weight).astype(np.float32), np.zeros(outputs, np.float32)]

    def layers(self):
        return list(zip(self.parameters[::2], self.parameters[1::2]))

    def __call__(self, x):
        """Returns the outputs, and remembers what backward needs."""
        self._inputs, self._sums = [], []
        layers = self.layers()
        for number, (weight, bias) in enumerate(layers):
            self._inputs.append(x)
            x = x @ weight.T + bias
            if number < len(layers) - 1:
                self._sums.append(x)
                x = np.where(x > 0, x, np.expm1(np.minimum(x, 0)))
        return x

    def backward(self, gradient):
        """Returns the gradients of the parameters of the last call, from that of its outputs."""
        gradients = []
        for number, (weight, _) in reversed(list(enumerate(self.layers()))):
            gradients = [gradient.T @ self._inputs[number], gradient.sum(0), *gradients]
            if number > 0:
                sums = self._sums[number - 1]
                gradient = (gradient @ weight) * np.where(sums > 0, 1, np.exp(np.minimum(sums, 0)))
        return gradients


class Adam:
    def __init__(self, parameters):
        self._means = [np.zeros_like(p) for p in parameters]
        self._squares = [np.zeros_like(p) for p in parameters]
        self._steps = 0

    def step(self, parameters, gradients, rate):
        """Changes the parameters in place."""
        length = np.sqrt(sum(float(np.square(g).sum()) for g in gradients))
        shrink = min(1.0, LARGEST_GRADIENT / (length + 1e-8))
        self._steps += 1
        fade = np.sqrt(1 - 0.999**self._steps) / (1 - 0.9**self._steps)
        for parameter, gradient, mean, square in zip(parameters, gradients, self._means, self._squares):
            mean += 0.1 * (shrink * gradient - mean)
            square += 0.001 * (np.square(shrink * gradient) - square)
            parameter -= (rate * fade * mean / (np.sqrt(square) + 1e-8)).astype(np.float32)


class Scaler:
    """The running mean and deviation of observations."""

    def __init__(self, width):
        self.mean, self.square, self.count = np.zeros(width), np.ones(width), 1e-4

    def learn(self, x):
        total = self.count + len(x)
        delta = x.mean(0) - self.mean
        self.square = (self.square * self.count + x.var(0) * len(x) + delta**2 * self.count * len(x) / total) / total
        self.mean = self.mean + delta * len(x) / total
        self.count = total

    def deviation(self):
        return np.sqrt(self.square + 1e-4)

    def __call__(self, x):
        return ((x - self.mean) / self.deviation()).astype(np.float32)


class Learner:
    """Actor, critic and all else that a checkpoint keeps."""

    def __init__(self, inputs, actions, seed):
        self.random = np.random.default_rng(seed)
        self.actor = Network((inputs, *HIDDEN, actions), 0.01, self.random)
        self.critic = Network((inputs, *HIDDEN, 1), 1.0, self.random)
        self.log_std = np.full(actions, np.log(0.8), np.float32)
        self.scaler = Scaler(inputs)
        self.adams = [Adam([*self.actor.parameters, self.log_std]), Adam(self.critic.parameters)]
        self.rate, self.iteration, self.samples, self.seconds = 1e-3, 0, 0, 0.0

    def log_probability(self, mean, action):
        z = (action - mean) / np.exp(self.log_std)
        return -0.5 * np.square(z).sum(1) - self.log_std.sum() - 0.5 * len(self.log_std) * np.log(2 * np.pi)

    def act(self, x):
        mean = self.actor(x)
        action = mean + np.exp(self.log_std) * self.random.normal(size=mean.shape).astype(np.float32)
        return mean, action

    def collect(self, envs, observation):
        """Makes STEPS steps; returns what happened, the last observation and the mean reward per second."""
        n = envs.num_envs
        seen = {name: [] for name in ("x", "action", "mean", "log", "value")}
        rewards, ends = np.zeros((STEPS, n), np.float32), np.zeros((STEPS, n), np.float32)
        received = 0.0
        for step in range(STEPS):
            self.scaler.learn(observation)
            x = self.scaler(observation)
            mean, action = self.act(x)
            for name, value in (("x", x), ("action", action), ("mean", mean), ("log", self.log_probability(mean, action)),
                                ("value", self.critic(x)[:, 0])):  # fmt: skip
                seen[name].append(value)
            observation, reward, fell, over, info = envs.step(action)
            received += reward.mean() / envs.unwrapped.dt / STEPS
            rewards[step], ends[step] = reward, fell | over
            for i in np.flatnonzero(over):  # that its time is over is no end of what could be had
                rewards[step, i] += DISCOUNT * self.critic(self.scaler(info["final_obs"][i][None]))[0, 0]
        values = np.stack([*seen["value"], self.critic(self.scaler(observation))[:, 0]])
        advantages, advantage = np.zeros_like(rewards), np.zeros(n, np.float32)
        for step in reversed(range(STEPS)):
            goes_on = 1 - ends[step]
            delta = rewards[step] + DISCOUNT * goes_on * values[step + 1] - values[step]
            advantage = advantages[step] = delta + DISCOUNT * TRACE * goes_on * advantage
        seen = {name: np.concatenate(values) for name, values in seen.items()}
        seen["target"] = (advantages + values[:-1]).ravel()
        seen["gain"] = advantages.ravel()
        seen["gain"] = (seen["gain"] - seen["gain"].mean()) / (seen["gain"].std() + 1e-8)
        self.samples += STEPS * n
        return seen, observation, received, ends.mean() / envs.unwrapped.dt

    def learn(self, seen):
        old_log_std = self.log_std.copy()
        for _ in range(EPOCHS):
            for part in np.array_split(self.random.permutation(len(seen["gain"])), PARTS):
                self._learn_from({name: values[part] for name, values in seen.items()}, old_log_std)
        self.iteration += 1

    def _learn_from(self, seen, old_log_std):
        n, mean = len(seen["gain"]), self.actor(seen["x"])
        std, old_std = np.exp(self.log_std), np.exp(old_log_std)
        kl = self.log_std - old_log_std + (old_std**2 + np.square(seen["mean"] - mean)) / (2 * std**2) - 0.5
        kl = float(kl.sum(1).mean())
        if kl > 2 * WANTED_KL:
            self.rate = max(1e-5, self.rate / 1.5)
        elif kl < WANTED_KL / 2:
            self.rate = min(1e-2, self.rate * 1.5)
        ratio, gain = np.exp(self.log_probability(mean, seen["action"]) - seen["log"]), seen["gain"]
        counts = ~(((gain > 0) & (ratio > 1 + CLIP)) | ((gain < 0) & (ratio < 1 - CLIP)))
        by_log = (-(gain * ratio * counts) / n)[:, None]
        z = (seen["action"] - mean) / std
        actor = self.actor.backward((by_log * z / std).astype(np.float32))
        log_std = (by_log * (np.square(z) - 1)).sum(0) - ENTROPY
        value = self.critic(seen["x"])
        critic = self.critic.backward(2 * (value - seen["target"][:, None]) / n)
        self.adams[0].step([*self.actor.parameters, self.log_std], [*actor, log_std], self.rate)
        self.adams[1].step(self.critic.parameters, critic, CRITIC_RATE)

    def policy_layers(self):
        """The actor's, with what scales observations in the first."""
        layers = [(w.astype(np.float64), b.astype(np.float64)) for w, b in self.actor.layers()]
        weight, bias = layers[0]
        weight = weight / self.scaler.deviation()
        layers[0] = (weight, bias - weight @ self.scaler.mean)
        return layers


def save(folder, learner, envs):
    """Writes checkpoint and policy; a file is whole or the previous one."""
    task, definition = envs.unwrapped.task, envs.unwrapped.definition
    new = folder / "checkpoint.new"
    new.write_bytes(pickle.dumps(learner))
    new.replace(folder / "checkpoint.pickle")
    layers = learner.policy_layers()
    shutil.copy(task.definition, folder / "deploy.yaml")
    understudy.save_weights(folder / "deploy.safetensors", layers, "elu")
    arrays = {f"{name}{i}": values for i, layer in enumerate(layers) for name, values in zip("wb", layer)}
    # The scales of tasks/go2_flat.yaml.
    np.savez(folder / "walk.npz", family="go", slots=definition.slots, q0=np.tile([0, 0.8, -1.5], 4), kp=definition.kp,
             kd=definition.kd, scale=0.25, gyro_scale=0.2, dq_scale=0.05, command_scale=np.ones(3), **arrays)  # fmt: skip


def train(folder, envs, learner, until, board=None):
    """Trains until until() says so, or Ctrl-C. board: a tensorboardX.SummaryWriter."""
    file = folder / "progress.csv"
    if not file.exists():
        file.write_text(",".join(COLUMNS) + "\n")
    observation, _ = envs.reset(seed=int(learner.random.integers(1 << 30)))
    saved = learner.iteration
    try:
        while not until():
            if learner.samples >= HARDER:
                envs.unwrapped.task = dataclasses.replace(envs.unwrapped.task, push=HARDEST)
            begin = time.monotonic()
            seen, observation, reward, ends = learner.collect(envs, observation)
            learner.learn(seen)
            if not np.isfinite(learner.actor.parameters[-1]).all():
                raise SystemExit(f"train.py: the weights are no numbers any more; the last checkpoint of {folder} is whole")
            learner.seconds += time.monotonic() - begin
            row = [learner.iteration, learner.samples, learner.seconds, reward, ends, np.exp(learner.log_std).mean(), learner.rate]
            with file.open("a") as progress:
                csv.writer(progress).writerow([f"{value:.5g}" for value in row])
            for name, value in zip(COLUMNS[3:], row[3:]) if board else ():
                board.add_scalar(name, value, learner.samples)
            if learner.iteration % 10 == 0:
                print(f"{learner.seconds:6.0f} s  {learner.samples / 1e6:6.2f} M samples  reward {reward:6.2f}/s  "
                      f"episodes {1 / max(ends, 0.05):4.1f} s", flush=True)  # fmt: skip
            if learner.iteration >= saved + 20:
                save(folder, learner, envs)
                saved = learner.iteration
    except KeyboardInterrupt:
        print("ends; run it again to go on", flush=True)
    save(folder, learner, envs)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--robots", type=int, default=256, help="side by side [256]")
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--iterations", type=int, default=10**9, help="at most, in all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tensorboard", action="store_true")
    asked = parser.parse_args()
    asked.folder.mkdir(parents=True, exist_ok=True)
    board = None
    if asked.tensorboard:
        try:
            import tensorboardX
        except ImportError:
            parser.error("--tensorboard: expected the package tensorboardX: pip install tensorboardX")
        board = tensorboardX.SummaryWriter(str(asked.folder))
    checkpoint, learner = asked.folder / "checkpoint.pickle", None
    if checkpoint.exists():
        try:
            learner = pickle.loads(checkpoint.read_bytes())
        except Exception as error:  # pickle has no one kind for what is damaged
            parser.error(f"{checkpoint}: expected a checkpoint of this program: {error}; remove it to begin anew")
        print(f"goes on after iteration {learner.iteration}", flush=True)
    envs = gymnasium.make_vec("Understudy/Go2Flat-v0", num_envs=asked.robots, vectorization_mode="vector_entry_point")
    if learner is None:
        learner = Learner(envs.single_observation_space.shape[0], envs.single_action_space.shape[0], asked.seed)
    end = learner.seconds + 60 * asked.minutes
    train(asked.folder, envs, learner, lambda: learner.seconds >= end or learner.iteration >= asked.iterations, board)
    if board:
        board.close()


if __name__ == "__main__":
    main()
