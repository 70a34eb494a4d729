"""Environments of Gymnasium: robots that learn to walk as commanded, on flat and on rough ground.

    import gymnasium
    import understudy.envs

    env = gymnasium.make("Understudy/Go2Flat-v0")
    envs = gymnasium.make_vec("Understudy/Go2Flat-v0", num_envs=256, vectorization_mode="vector_entry_point")

Robots are those of Batch, with motors, sensors, noise and delay. What is observed and what an action does is said by a
deploy.yaml, in the same code that a deployed policy runs. Once released, a version of an environment does not
change: another task has another version.
"""

import dataclasses
import os
import pathlib

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, VectorEnv

from ._understudy import Batch, Definition

DEFINITIONS = pathlib.Path(__file__).parent / "tasks"
LONGEST_ACTION = 10.0  # of each joint, before its scale; actions beyond are cut off


@dataclasses.dataclass(frozen=True)
class Course:
    """Ground that gets harder with the level: patches in a row, one of each kind a level. The numbers are assumed."""

    kinds: tuple = ("rough", "waves", "slopes")  # robot i has kind i modulo these
    levels: int = 6
    hardest: float = 0.9  # difficulty of the last level
    length: float = 8.0  # m, of a patch
    width: float = 16.0  # m

    def settings(self):
        patches = [
            {"kind": kind, "difficulty": self.hardest * (level + 1) / self.levels}
            for level in range(self.levels) for kind in self.kinds
        ]  # fmt: skip
        return {"scene": "row", "terrain.patches": patches, "terrain.size": [self.length, self.width]}

    def place(self, level, robot):
        """x [m] in the middle of the patch of a robot at a level. The row begins at 1.5 m."""
        patch = level * len(self.kinds) + robot % len(self.kinds)
        return 1.5 + (patch + 0.5) * self.length


@dataclasses.dataclass(frozen=True)
class Task:
    """What an environment asks of a robot. The numbers are assumed.

    Weights are of reward per second. The sum of a step's terms counts as 0 where it is below, so that to go on is never
    worse than to fall; a fall comes on top.
    """

    robot: str
    definition: pathlib.Path
    settings: dict  # of each robot's world, as `set`
    clamped: bool  # whether a clamp holds it until the first command: a humanoid with slack motors falls
    lowest: float  # m in the world: an episode ends with its base below
    steepest: float = 1.0  # rad: and when it tilts more
    episode: float = 20.0  # s
    command_time: float = 6.0  # s, after which another velocity is commanded
    standing: float = 0.1  # share of commands that are zero
    course: Course | None = None  # else flat ground
    push: float = 0.0  # N·s: at most so much, in any level direction, within 0.1 s
    push_time: float = 8.0  # s, at most, between two pushes
    weights: dict = dataclasses.field(
        default_factory=lambda: {
            "velocity": 1.5, "turn": 0.75, "stride": 2.0, "bounce": -2.0, "sway": -0.05, "tilt": -2.5, "effort": -1e-4,
            "change": -0.01, "pose": -0.05, "fall": -50.0,
        }  # fmt: skip
    )


DRAWN = {
    "randomization.mass": [0.8, 1.2], "randomization.friction": [0.4, 1.2], "randomization.kp": [0.9, 1.1],
    "randomization.delay": [0.0, 0.012],
}  # fmt: skip


_LEG = [-0.1, 0, 0, 0.3, -0.2, 0]
_ARMS = [0, 0.25, 0, 0.97, 0.15, 0, 0, 0, -0.25, 0, 0.97, -0.15, 0, 0]
G1_STANDING = {"q": [*_LEG, *_LEG, 0, 0, 0, *_ARMS], "height": 0.785}  # as config/robots/g1.yaml

_GO2 = Task(
    robot="go2", definition=DEFINITIONS / "go2_flat.yaml", clamped=False, lowest=0.15, push=15.0,  # its mass is 15 kg
    settings=DRAWN | {"start.pose": "standing", "motion.service": "none", "physics.timestep": 0.002,
                      "physics.contacts": "pyramid"},
)  # fmt: skip

TASKS = {
    "go2_flat": _GO2,
    "go2_rough": dataclasses.replace(_GO2, course=Course(), lowest=-np.inf),
    "g1_flat": Task(
        robot="g1", definition=DEFINITIONS / "g1_flat.yaml", clamped=True, lowest=0.5,
        settings=DRAWN | {"start.pose": "clamped", "motion.service": "none", "robot.hanging": G1_STANDING},
    ),
}  # fmt: skip


def in_base(attitude, vectors):
    """Turns vectors of the world, shape (n, 3), into the axes of bases with attitudes w, x, y, z, shape (n, 4)."""
    w, u = attitude[:, :1], -attitude[:, 1:]
    cross = 2 * np.cross(u, vectors)
    return vectors + w * cross + np.cross(u, cross)


class WalkVectorEnv(VectorEnv):
    """Robots side by side over threads; an episode that ends begins anew in the same step.

    Robot i has the seed `seed + i` of reset, and does not depend on how many others there are. On a course it begins at
    level 0 with each reset by a seed, and goes up and down with what it does. threads: those of this
    process unless given. definition: another deploy.yaml of the same robot. config, set: as of Batch, over the task's.
    """

    metadata = {"autoreset_mode": AutoresetMode.SAME_STEP, "render_modes": []}

    def __init__(self, task="go2_flat", num_envs=1, threads=None, definition=None, config=(), set=None, render_mode=None):
        if render_mode is not None:
            raise ValueError(f"render_mode: there is none, got {render_mode!r}")
        self.task = TASKS[task] if isinstance(task, str) else task
        self.num_envs, self.render_mode = num_envs, None
        self.batch = Batch(
            self.task.robot, num_envs, threads=threads or len(os.sched_getaffinity(0)), config=config,
            set=self.task.settings | (self.task.course.settings() if self.task.course else {}) | (set or {}),
        )  # fmt: skip
        self.definition = Definition(definition or self.task.definition, self.batch.robots[0], num_envs)
        bound = np.inf if definition else 100.0
        self.single_observation_space = gymnasium.spaces.Box(-bound, bound, (self.definition.observations,), np.float32)
        self.single_action_space = gymnasium.spaces.Box(
            -LONGEST_ACTION, LONGEST_ACTION, (self.definition.actions,), np.float32
        )
        self.observation_space = gymnasium.vector.utils.batch_space(self.single_observation_space, num_envs)
        self.action_space = gymnasium.vector.utils.batch_space(self.single_action_space, num_envs)
        self.dt = self.definition.step_dt
        self.velocity = np.zeros((num_envs, 3), np.float32)  # commanded: forward, left m/s, turn rad/s
        self.action = np.zeros((num_envs, self.definition.actions), np.float32)
        self.last_action = self.action.copy()
        feet = self.batch.truth["contact_force"].shape
        self.air = np.zeros(feet, np.float32)  # s that a foot has been in the air, or was before it landed
        self.landed, self._touched = np.zeros(feet, bool), np.ones(feet, bool)
        self.level = np.zeros(num_envs, int)  # of the course
        self._begun = np.zeros((num_envs, 2), np.float32)  # where the episode began
        self._asked = np.zeros(num_envs, np.float32)  # m that it was asked to go
        self.age = np.zeros(num_envs, int)  # steps of the episode; may be set, so that not all end at once
        self._push_at = np.zeros(num_envs, int)  # the step in which it is pushed next
        self._limits = np.array(self.definition.velocity, np.float32)
        self._rest = self.definition.act(self.action)[0].astype(np.float32)  # where an action of 0 leads
        self._random = []

    def reset(self, *, seed=None, options=None):
        if seed is not None or not self._random:
            if np.ndim(seed) == 0:
                super().reset(seed=seed)
                first = self.np_random_seed if seed is None else seed
                seed = [first + i for i in range(self.num_envs)]
            if len(seed) != self.num_envs:
                raise ValueError(f"seed: expected one number, or {self.num_envs}, got {len(seed)}")
            self._random = [np.random.default_rng(one) for one in seed]
            self.level[:] = 0
        everyone = np.arange(self.num_envs)
        self._begin(everyone)
        return self.definition.observe(self.batch.state, self.velocity), {}

    def step(self, actions):
        self.last_action, self.action = self.action, np.clip(actions, -LONGEST_ACTION, LONGEST_ACTION, dtype=np.float32)
        q = self.definition.act(self.action)
        self._push()
        self.batch.command(q=q, kp=self.definition.kp, kd=self.definition.kd)
        self.batch.step(self.dt)
        self.age += 1
        truth = self.batch.truth
        fell = (truth["tilt"][:, 0] > self.task.steepest) | (truth["position"][:, 2] < self.task.lowest)
        over = (self.age >= round(self.task.episode / self.dt)) & ~fell
        self._asked += self.dt * np.hypot(self.velocity[:, 0], self.velocity[:, 1])
        self._note_landings()
        terms = {name: self.task.weights[name] * values for name, values in self.reward_terms().items()}
        reward = self.dt * (np.maximum(sum(terms.values()), 0) + self.task.weights["fall"] * fell)
        # A command counts from the next observation on.
        for i in np.flatnonzero(self.age % round(self.task.command_time / self.dt) == 0):
            self._command(i)
        observation = self.definition.observe(self.batch.state, self.velocity)
        info, ended = {}, np.flatnonzero(fell | over)
        if len(ended):
            final = np.full(self.num_envs, None, dtype=object)
            for i in ended:
                final[i] = observation[i].copy()
            info = {"final_obs": final, "_final_obs": fell | over, "final_info": {}}
            self._promote(ended, fell)
            self._begin(ended)
            observation[ended] = self.definition.observe(self.batch.state, self.velocity, ended.tolist())
        return observation, reward.astype(np.float64), fell, over, info

    def reward_terms(self):
        """Arrays by name, one number a robot, of the last step; task.weights weighs them. Yours to override."""
        truth = self.batch.truth
        v, w = in_base(truth["attitude"], truth["velocity"]), truth["turning_rate"]
        up = in_base(truth["attitude"], np.tile(np.float32([0, 0, 1]), (self.num_envs, 1)))
        # A stride: s that a foot that lands was in the air, over the 0.2 s that a step should take at least.
        return {
            "velocity": np.exp(-np.square(v[:, :2] - self.velocity[:, :2]).sum(1) / 0.25),
            "turn": np.exp(-np.square(w[:, 2] - self.velocity[:, 2]) / 0.25),
            "stride": (self.landed * np.minimum(self.air - 0.2, 0.2)).sum(1) * (np.abs(self.velocity).sum(1) > 0.1),
            "bounce": np.square(v[:, 2]),
            "sway": np.square(w[:, :2]).sum(1),
            "tilt": np.square(up[:, :2]).sum(1),
            "effort": np.square(truth["torque"]).sum(1),
            "change": np.square(self.action - self.last_action).sum(1),
            "pose": np.square(self.batch.state["q"] - self._rest).sum(1),
        }

    def _note_landings(self):
        """Notes which feet have landed, after how long in the air."""
        touches = self.batch.truth["contact_force"] > 1  # N
        self.air = np.where(self._touched, 0, self.air) + self.dt * ~(touches & self._touched)
        self.landed, self._touched = touches & ~self._touched, touches

    def _push(self):
        for i in np.flatnonzero(self.age >= self._push_at) if self.task.push > 0 else ():
            random = self._random[i]
            size, way = random.uniform(0, self.task.push), random.uniform(0, 2 * np.pi)
            if self.age[i] > 0:
                self.batch.robots[i].request("push", impulse=[size * np.cos(way), size * np.sin(way), 0])
            self._push_at[i] = self.age[i] + 1 + round(random.uniform(0, self.task.push_time) / self.dt)

    def _command(self, i):
        random = self._random[i]
        drawn = random.uniform(self._limits[:, 0], self._limits[:, 1])
        self.velocity[i] = 0 if random.uniform() < self.task.standing else drawn

    def _promote(self, robots, fell):
        """Half of the way that was asked for is worth a level; less than a quarter, or a fall, costs one."""
        if self.task.course is None:
            return
        made = np.linalg.norm(self.batch.truth["position"][:, :2] - self._begun, axis=1)
        up = (made > 0.5 * self._asked) & (made > 1) & ~fell
        down = (made < 0.25 * self._asked) | fell
        level = self.level + up - down
        self.level[robots] = np.clip(level, 0, self.task.course.levels - 1)[robots]

    def _begin(self, robots):
        seeds, at = [int(self._random[i].integers(1 << 31)) for i in robots], []
        if self.task.course:
            at = [(self.task.course.place(self.level[i], i), 0, self._random[i].uniform(-np.pi, np.pi)) for i in robots]
        self.batch.begin(robots.tolist(), seeds, at)
        self._begun[robots], self._asked[robots] = self.batch.truth["position"][robots, :2], 0
        for i in robots:
            self._command(i)
            if self.task.clamped:
                self.batch.robots[i].request("clamp", on=False)
        self.action[robots] = self.last_action[robots] = 0
        self.air[robots], self._touched[robots] = 0, True
        self.age[robots] = self._push_at[robots] = 0
        self.definition.begin(robots.tolist(), self.batch.state)


class WalkEnv(gymnasium.Env):
    """One robot of WalkVectorEnv, with the same arguments; an episode ends until reset."""

    metadata = {"render_modes": []}

    def __init__(self, task="go2_flat", definition=None, config=(), set=None, render_mode=None):
        self._all = WalkVectorEnv(task, 1, 1, definition, config, set, render_mode)
        self.observation_space, self.action_space = self._all.single_observation_space, self._all.single_action_space
        self.render_mode = None

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        observation, info = self._all.reset(seed=seed, options=options)
        return observation[0], info

    def step(self, action):
        observation, reward, fell, over, info = self._all.step(np.reshape(action, (1, -1)))
        last = info["final_obs"][0] if fell[0] or over[0] else observation[0]
        return last, float(reward[0]), bool(fell[0]), bool(over[0]), {}


for _name, _task in (("Go2Flat", "go2_flat"), ("Go2Rough", "go2_rough"), ("G1Flat", "g1_flat")):
    gymnasium.register(
        f"Understudy/{_name}-v0", entry_point="understudy.envs:WalkEnv",
        vector_entry_point="understudy.envs:WalkVectorEnv", kwargs={"task": _task},
    )  # fmt: skip
