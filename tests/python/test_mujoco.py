"""The very model in the package mujoco, which has another version of MuJoCo."""

import importlib
import os
import subprocess
import sys

import mujoco
import numpy as np
import pytest

import understudy
import understudy.envs


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


def mjlab_package(monkeypatch, tmp_path, robot, *options):
    """What `export mjlab` writes, imported: its `spec` and `motors` need MuJoCo alone."""
    name = f"{robot}_lab"
    done = subprocess.run([os.environ["UNDERSTUDY"], "export", "mjlab", robot, "--out", tmp_path / name, *options],
                          capture_output=True, text=True)  # fmt: skip
    assert done.returncode == 0, done.stderr
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, name, raising=False)
    return importlib.import_module(name), done.stderr


@pytest.mark.parametrize("name", ["go2", "g1"])
def test_a_package_for_mjlab_stands_by_its_motors_and_gains(monkeypatch, tmp_path, name):
    package, _ = mjlab_package(monkeypatch, tmp_path, name)
    spec, motors = package.spec(), package.motors()
    assert len(spec.worldbody.geoms) == 0 and len(spec.actuators) == 0
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[0, 0, 1])
    model = spec.compile()
    own = understudy.Robot(name).mujoco_model()
    assert np.array_equal(model.body_mass, own.body_mass)
    data = mujoco.MjData(model)
    standing = package.FIGURES["standing"]
    places = [model.joint(motor["joint"]).qposadr[0] for motor in motors]
    rates = [model.joint(motor["joint"]).dofadr[0] for motor in motors]
    q = np.array([motor["q"] for motor in motors])
    kp, kd, limit = (np.array([motor[key] for motor in motors]) for key in ("kp", "kd", "torque_limit"))
    data.qpos[2], data.qpos[places] = standing["height"], q
    mujoco.mj_forward(model, data)
    for foot in package.FIGURES["feet"]:
        assert -0.01 < data.site(foot["name"]).xpos[2] < 0.06, "at the ground"
    for _ in range(500):
        data.qfrc_applied[rates] = np.clip(kp * (q - data.qpos[places]) - kd * data.qvel[rates], -limit, limit)
        mujoco.mj_step(model, data)
    assert abs(data.qpos[2] - standing["height"]) < 0.02
    assert data.sensor("imu_ang_vel").data.shape == (3,)


def test_a_package_for_mjlab_has_what_is_drawn_and_not_what_one_draw_gave(monkeypatch, tmp_path):
    file = tmp_path / "randomization.yaml"
    file.write_text("randomization: {mass: [0.5, 0.6], delay: [0.002, 0.012], gravity_tilt: [0, 0.1]}")
    package, said = mjlab_package(monkeypatch, tmp_path, "go2", "--config", file)
    assert package.FIGURES["randomization"]["mass"] == [0.5, 0.6]
    assert "randomization.gravity_tilt is not drawn by mjlab" in said and "mass" not in said
    robot = understudy.Robot("go2")
    assert np.array_equal(package.spec().compile().body_mass, robot.mujoco_model().body_mass)
    least, most = package.FIGURES["delay"]
    assert most - least == pytest.approx(0.01) and least >= 0.002
    assert [motor["joint"] for motor in package.motors()] == list(robot.joints)


def test_a_package_for_mjlab_has_the_definition_of_ones_policy(monkeypatch, tmp_path):
    definition = understudy.envs.TASKS["go2_flat"].definition
    package, _ = mjlab_package(monkeypatch, tmp_path, "go2", "--definition", definition)
    assert (tmp_path / "go2_lab" / "deploy.yaml").read_text() == definition.read_text()
    assert package.motors()[2]["kp"] == 40 and package.motors()[2]["q"] == -1.5
    share = package.FIGURES["motors"][2]["kd_share"]
    weak, _ = mjlab_package(monkeypatch, tmp_path, "go2", "--definition", definition, "--set", "robot.motors.2.kp_scale=0.5")
    assert weak.motors()[2]["kp"] == 20 and weak.motors()[1]["kp"] == 20
    assert package.motors()[2]["kd"] == pytest.approx(2 * share)
