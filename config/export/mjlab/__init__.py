"""A robot of Understudy for MuJoCo 3, MJX and Warp, and a task of mjlab: walking by commanded velocity on flat ground.

`understudy export mjlab` wrote this folder: robot.xml is the very model that it simulates, figures.json has the rest of
the robot, deploy.yaml defines the policy. Put the folder's parent on PYTHONPATH, and

    python -m FOLDER train
    python -m FOLDER play --checkpoint-file model.pt

`spec` alone needs nothing but MuJoCo. Not here: heat, the lattices of encoders, faults.
"""

import json
import pathlib

import mujoco
import yaml

FOLDER = pathlib.Path(__file__).parent
FIGURES = json.loads((FOLDER / "figures.json").read_text())
GAINS = {"kp": "stiffness", "kd": "damping"}  # of deploy.yaml, of which a share acts
DEPLOY = yaml.safe_load((FOLDER / "deploy.yaml").read_text())


def spec():
    """The robot alone, without ground, light and motors, with the sensors and sites that mjlab's task reads."""
    model = mujoco.MjSpec.from_file(str(FOLDER / "robot.xml"))
    for one in [*model.worldbody.geoms, *model.lights, *model.actuators, *model.sensors, *model.equalities, *model.keys]:
        model.delete(one)
    for geom in model.geoms:
        if geom.contype or geom.conaffinity:  # in a contact the larger friction counts: here that of our ground
            geom.friction[0] = max(geom.friction[0], FIGURES["ground_friction"])
            geom.priority = 1
    for foot in FIGURES["feet"]:
        model.body(foot["body"]).add_site(name=foot["name"], pos=foot["pos"])
    site, body = mujoco.mjtObj.mjOBJ_SITE, mujoco.mjtObj.mjOBJ_BODY
    for name, kind, of, which in (
        ("imu_ang_vel", mujoco.mjtSensor.mjSENS_GYRO, site, FIGURES["imu"]),
        ("imu_lin_vel", mujoco.mjtSensor.mjSENS_VELOCIMETER, site, FIGURES["imu"]),
        ("root_angmom", mujoco.mjtSensor.mjSENS_SUBTREEANGMOM, body, FIGURES["base"]),
    ):
        model.add_sensor(name=name, type=kind, objtype=of, objname=which)
    return model


def motors():
    """Those of the policy in its order, with the gains [N·m/rad, N·m·s/rad] and the angle [rad] of deploy.yaml."""
    by_slot = {motor["slot"]: motor for motor in FIGURES["motors"]}
    return [
        by_slot[slot] | {"q": q, **{key: DEPLOY[of][slot] * by_slot[slot][f"{key}_share"] for key, of in GAINS.items()}}
        for slot, q in zip(DEPLOY["joint_ids_map"], DEPLOY["default_joint_pos"])
    ]
