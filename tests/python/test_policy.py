"""One definition: what a network gets and what its action does, in training, in a program and in the motion service."""

import pathlib
import types

import numpy as np
import pytest

import understudy

TASKS = pathlib.Path(understudy.__file__).parent / "tasks"
STANDS = {"start.pose": "standing", "motion.service": "none"}


def written(folder, change=lambda text: text, layers=None, robot="go2"):
    """A policy in a folder: the environment's definition and a small random network."""
    file = folder / "deploy.yaml"
    file.write_text(change((TASKS / f"{robot}_flat.yaml").read_text()))
    if layers is None:
        random = np.random.default_rng(2)
        layers = [(random.normal(0, 0.1, (16, 45)), random.normal(0, 0.1, 16)), (random.normal(0, 0.1, (12, 16)), np.zeros(12))]
    understudy.save_weights(folder / "deploy.safetensors", layers)
    return file


def lowstate(state):
    """A state as the vendor's SDK has it."""
    motors = [types.SimpleNamespace(q=float(q), dq=float(dq)) for q, dq in zip(state.q, state.dq)]
    imu = types.SimpleNamespace(quaternion=list(state.quaternion), gyroscope=list(state.gyroscope))
    return types.SimpleNamespace(motor_state=motors, imu_state=imu)


def test_an_observation_is_term_by_term_what_the_definition_says():
    robot = understudy.Robot("go2", set=STANDS)
    robot.step(0.02)
    definition = understudy.Definition(TASKS / "go2_flat.yaml", robot)
    assert definition.terms == [
        ("base_ang_vel", 3), ("projected_gravity", 3), ("velocity_commands", 3), ("joint_pos_rel", 12),
        ("joint_vel_rel", 12), ("last_action", 12),
    ]  # fmt: skip
    assert (definition.observations, definition.actions, definition.step_dt) == (45, 12, pytest.approx(0.02))
    s = robot.state
    state = {"q": [s.q], "dq": [s.dq], "quaternion": [s.quaternion], "gyroscope": [s.gyroscope]}
    definition.begin([0], state)
    definition.act(np.full((1, 12), 0.5))
    seen = definition.observe(state, [[2, -0.1, 0.2]])[0]
    w, x, y, z = s.quaternion
    gravity = [2 * (w * y - x * z), -2 * (y * z + w * x), 2 * (x * x + y * y) - 1]
    rest = np.tile([0, 0.8, -1.5], 4)
    expected = [*(0.2 * s.gyroscope), *gravity, 1, -0.1, 0.2, *(s.q - rest), *(0.05 * s.dq), *[0.5] * 12]
    assert seen.dtype == np.float32 and seen == pytest.approx(np.array(expected), abs=1e-6)


def test_an_action_moves_joints_by_scale_and_offset_with_the_definitions_gains():
    definition = understudy.Definition(TASKS / "go2_flat.yaml", "go2", 2)
    q = definition.act([np.zeros(12), np.arange(12)])
    rest = np.tile([0, 0.8, -1.5], 4)
    assert q == pytest.approx(np.array([rest, rest + 0.25 * np.arange(12)]), abs=1e-6)
    assert list(definition.kp[:3]) == [20, 20, 40] and list(definition.kd[:3]) == [1, 1, 2]


def test_motors_without_an_action_hold_the_standing_pose(tmp_path):
    def legs_alone(text):
        lines = text.splitlines()
        keep = {"joint_ids_map": 12, "default_joint_pos": 12}
        for number, line in enumerate(lines):
            key = line.split(":")[0].strip()
            if key in keep or key == "offset":
                lines[number] = line.split("[")[0] + "[" + ", ".join(line.split("[")[1].rstrip("]").split(", ")[:12]) + "]"
        return "\n".join(lines)

    file = tmp_path / "legs.yaml"
    file.write_text(legs_alone((TASKS / "g1_flat.yaml").read_text()))
    robot = understudy.Robot("g1")
    definition = understudy.Definition(file, robot)
    q = definition.act(np.ones((1, 12)))[0]
    assert q[12:] == pytest.approx(robot.standing[12:]) and definition.kp[18] == 40 and definition.actions == 12


def test_robots_side_by_side_have_histories_of_their_own(tmp_path):
    file = written(tmp_path, lambda text: text.replace("{params: {}, clip: [-100, 100]}", "{params: {}, history_length: 3}"))
    both, one = understudy.Definition(file, "go2", 2), understudy.Definition(file, "go2")
    random = np.random.default_rng(1)

    def state(count):
        return {"q": random.normal(size=(count, 12)), "dq": random.normal(size=(count, 12)),
                "quaternion": np.tile([1, 0, 0, 0], (count, 1)), "gyroscope": random.normal(size=(count, 3))}  # fmt: skip

    def second(states):
        return {name: values[1:] for name, values in states.items()}

    now = state(2)
    both.begin([0, 1], now)
    one.begin([0], second(now))
    for step in range(5):
        now = state(2)
        if step == 2:
            both.begin([0], now)
        seen = both.observe(now, np.zeros((2, 3)))
        assert (seen[1] == one.observe(second(now), np.zeros((1, 3)))[0]).all()
    assert both.observe(now, np.zeros((2, 3)), [1]).shape == (1, both.observations)


def test_a_policy_commands_by_the_sdks_lowstate_as_by_this_processs_state(tmp_path):
    file = written(tmp_path)
    robot = understudy.Robot("go2", set=STANDS, seed=3)
    robot.step(0.02)
    ours, theirs = understudy.Policy(file, robot), understudy.Policy(file, "go2")
    for _ in range(50):
        command = ours.step(robot.state, velocity=(0.5, 0, 0))
        assert (command["q"] == theirs.step(lowstate(robot.state), velocity=(0.5, 0, 0))["q"]).all()
        robot.command(**command)
        robot.step(ours.step_dt)
    assert robot.truth.tilt < 0.5 and not [e for e in robot.take_events() if e["kind"] == "refused"]


def test_a_network_is_numpys_to_rounding(tmp_path):
    random = np.random.default_rng(4)
    layers = [(random.normal(size=(32, 45)), random.normal(size=32)), (random.normal(size=(12, 32)), random.normal(size=12))]
    definition = understudy.Definition(written(tmp_path, layers=layers), "go2")
    x = random.normal(size=(5, 45)).astype(np.float32)
    hidden = x @ layers[0][0].T + layers[0][1]
    hidden = np.where(hidden > 0, hidden, np.expm1(np.minimum(hidden, 0)))
    network = understudy.Network(definition.weights, definition)
    assert network(x) == pytest.approx(hidden @ layers[1][0].T + layers[1][1], abs=1e-3)


def test_what_does_not_fit_is_refused_with_the_nearest_word(tmp_path):
    with pytest.raises(understudy.Error, match="base_angvel: unknown observation; did you mean 'base_ang_vel'"):
        understudy.Policy(written(tmp_path, lambda text: text.replace("base_ang_vel", "base_angvel")), "go2")
    with pytest.raises(understudy.Error, match="takes 44 numbers; the observations .* are 45"):
        understudy.Policy(written(tmp_path, layers=[(np.zeros((12, 44)), np.zeros(12))]), "go2")
    with pytest.raises(understudy.Error, match="gives 11 actions"):
        understudy.Policy(written(tmp_path, layers=[(np.zeros((11, 45)), np.zeros(11))]), "go2")
    with pytest.raises(understudy.Error, match="no motor of go2 is in slot 12"):
        understudy.Definition(TASKS / "g1_flat.yaml", "go2")
    definition = understudy.Definition(TASKS / "go2_flat.yaml", "go2")
    with pytest.raises(ValueError, match=r"actions of shape \(1, 12\), got 11"):
        definition.act(np.zeros((1, 11)))
    with pytest.raises(ValueError, match="there is no 'dq'"):
        definition.begin([0], {"q": np.zeros((1, 12))})
    with pytest.raises(ValueError, match="activation: expected one of none, elu"):
        understudy.save_weights(tmp_path / "x", [], "gelu")
