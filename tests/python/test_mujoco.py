"""The very model in the package mujoco, which has another version of MuJoCo."""

import os
import subprocess

import mujoco
import numpy as np
import pytest

import understudy


@pytest.mark.parametrize("name", understudy.robot_names())
def test_an_exported_robot_has_our_joints_ranges_and_mass(name, tmp_path):
    file = tmp_path / "robot.xml"
    done = subprocess.run([os.environ["UNDERSTUDY"], "export", "mjcf", name, "--out", file], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    model = mujoco.MjModel.from_xml_path(str(file))
    robot = understudy.Robot(name)
    joints = {model.joint(i).name for i in range(model.njnt)}
    assert set(robot.joints) <= joints
    own = robot.mujoco_model()
    for key in ("body_mass", "body_inertia", "dof_armature", "dof_damping", "dof_frictionloss", "jnt_range", "geom_friction"):
        assert np.array_equal(getattr(own, key), getattr(model, key)), key
    assert not model.opt.disableflags & (mujoco.mjtDisableBit.mjDSBL_ACTUATION | mujoco.mjtDisableBit.mjDSBL_SENSOR)


def test_what_was_drawn_for_a_robot_is_in_its_model():
    sets = {"randomization.mass": [0.8, 1.2], "randomization.friction": [0.5, 1.2]}
    masses = [understudy.Robot("go2", set=sets, seed=seed).mujoco_model().body_mass.sum() for seed in (1, 1, 2)]
    assert masses[0] == masses[1] != masses[2]


def test_ground_of_heights_comes_with_the_model(tmp_path):
    file = tmp_path / "go2.xml"
    done = subprocess.run([os.environ["UNDERSTUDY"], "export", "mjcf", "go2", "--scene", "rough", "--out", file],
                          capture_output=True, text=True)  # fmt: skip
    assert done.returncode == 0, done.stderr
    heights = mujoco.MjModel.from_xml_path(str(file)).hfield_data
    assert len(heights) > 1000 and np.ptp(heights) > 0.5
    in_process = understudy.Robot("go2", set={"scene": "rough"}).mujoco_model().hfield_data
    assert np.array_equal(heights, in_process)
    without = subprocess.run([os.environ["UNDERSTUDY"], "export", "mjcf", "go2", "--scene", "rough"], capture_output=True, text=True)
    assert without.returncode == 4 and "--out FILE" in without.stderr


def test_a_robot_in_the_air_moves_as_ours_does():
    """A fifth of a second of equal torques without contacts: the models agree, of two versions of MuJoCo."""
    sets = {"start.pose": "clamped", "motion.service": "none", "physics.timestep": 0.001, "robot.dynamics.backlash": 0}
    robot = understudy.Robot("go2", set=sets)
    model = robot.mujoco_model()
    data = mujoco.MjData(model)
    robot.request("clamp", on=False)
    q, dq = robot.truth.q, robot.truth.dq
    data.qpos[:3], data.qpos[3:7] = robot.truth.position, robot.truth.quaternion
    places = [model.joint(name).qposadr[0] for name in robot.joints]
    rates = [model.joint(name).dofadr[0] for name in robot.joints]
    data.qpos[places], data.qvel[rates] = q, dq
    for step in range(200):
        robot.command(tau=3 * np.sin(0.05 * step + np.arange(12)))
        robot.step(0.001)
        data.qfrc_applied[rates] = robot.truth.torque
        qpos = data.qpos.copy()  # of the instant that the truth is of
        mujoco.mj_step(model, data)
    assert np.abs(qpos[places] - robot.truth.q).max() < 1e-6
    assert np.abs(qpos[:3] - robot.truth.position).max() < 1e-6
    assert np.abs(robot.truth.q - q).max() > 0.02, "the joints were to move"
