"""The task of mjlab.

Motors have their makes' torque over speed and a delay; observations are those of deploy.yaml, with the sensors' noise;
what the configuration draws at random is drawn anew by mjlab's events. Rewards, pushes and the learner's figures are
mjlab's for its own quadruped and humanoid.
"""

import functools
import math

from mjlab.actuator import DcMotorActuatorCfg
from mjlab.entity import EntityArticulationInfoCfg, EntityCfg
from mjlab.envs.mdp import dr
from mjlab.managers.event_manager import EventTermCfg
from mjlab.managers.observation_manager import ObservationGroupCfg, ObservationTermCfg
from mjlab.managers.scene_entity_config import SceneEntityCfg
from mjlab.rl import RslRlModelCfg, RslRlOnPolicyRunnerCfg, RslRlPpoAlgorithmCfg
from mjlab.sensor import ContactMatch, ContactSensorCfg, ObjRef, RingPatternCfg
from mjlab.tasks.registry import register_mjlab_task
from mjlab.tasks.velocity import mdp
from mjlab.tasks.velocity.velocity_env_cfg import make_velocity_env_cfg
from mjlab.utils.noise import GaussianNoiseCfg

from . import DEPLOY, FIGURES, motors, spec

TASK = f"Understudy-Velocity-Flat-{FIGURES['robot']}"
TIMESTEP = 0.005  # s, of mjlab's own tasks
FEET = [foot["name"] for foot in FIGURES["feet"]]


def actuators():
    """All motors of one make and gain are one actuator. Torque falls from the knee of its curve to no load."""
    low, high = (round(delay / TIMESTEP) for delay in FIGURES["delay"])
    groups = {}
    for motor in motors():
        curve = tuple(motor[key] for key in ("torque_limit", "knee_speed", "no_load_speed", "kp", "kd"))
        groups.setdefault(curve, []).append(motor["joint"])
    for (limit, knee, no_load, kp, kd), joints in groups.items():
        yield DcMotorActuatorCfg(
            target_names_expr=tuple(f"^{joint}$" for joint in joints), stiffness=kp, damping=kd, effort_limit=limit,
            saturation_effort=limit / max(1 - knee / no_load, 1e-3), velocity_limit=no_load, delay_min_lag=low, delay_max_lag=high,
        )  # fmt: skip


def entity():
    standing = FIGURES["standing"]
    joints = standing["joints"] | {motor["joint"]: motor["q"] for motor in motors()}
    return EntityCfg(
        spec_fn=spec,
        init_state=EntityCfg.InitialStateCfg(
            pos=(0, 0, standing["height"]), joint_pos={f"^{joint}$": q for joint, q in joints.items()}
        ),
        articulation=EntityArticulationInfoCfg(actuators=tuple(actuators()), soft_joint_pos_limit_factor=0.9),
        sort_actuators=True,
    )


def observations():
    """Those of deploy.yaml in its order, for the actor; mjlab's own for the critic."""
    noise, joints = FIGURES["noise"], tuple(f"^{motor['joint']}$" for motor in motors())
    asset = SceneEntityCfg("robot", joint_names=joints, preserve_order=True)
    terms = {
        "base_ang_vel": (mdp.builtin_sensor, {"sensor_name": "robot/imu_ang_vel"}, noise["gyroscope"]),
        "projected_gravity": (mdp.projected_gravity, {}, 0),
        "velocity_commands": (mdp.generated_commands, {"command_name": "twist"}, 0),
        "joint_pos_rel": (mdp.joint_pos_rel, {"asset_cfg": asset}, noise["q"]),
        "joint_vel_rel": (mdp.joint_vel_rel, {"asset_cfg": asset}, noise["dq"]),
        "last_action": (mdp.last_action, {}, 0),
    }
    said_of_all = {"scale_first", "use_gym_history"} & DEPLOY["observations"].keys()
    if said_of_all:
        raise ValueError(f"deploy.yaml: mjlab clips before it scales and keeps histories by term, so not {said_of_all.pop()}")
    for name, said in DEPLOY["observations"].items():
        if name not in terms:
            raise ValueError(f"deploy.yaml: mjlab's task has {', '.join(terms)}, not '{name}'")
        function, params, deviation = terms[name]
        scale, clip = said.get("scale"), said.get("clip")
        yield name, ObservationTermCfg(
            func=function, params=params, noise=GaussianNoiseCfg(std=deviation) if deviation else None,
            scale=tuple(scale) if isinstance(scale, list) else scale, clip=tuple(clip) if clip else None,
            history_length=said["history_length"] if said.get("history_length", 1) > 1 else 0,
        )  # fmt: skip


def event(function, **params):
    return EventTermCfg(mode="startup", func=function, params=params)


def draws():
    """What the configuration draws at random. Keys and meanings are those of `randomization`."""
    joints, bodies = SceneEntityCfg("robot", joint_names=(".*",)), SceneEntityCfg("robot", body_names=(".*",))
    base, geoms = SceneEntityCfg("robot", body_names=(FIGURES["base"],)), SceneEntityCfg("robot", geom_names=(".*",))
    rows = {
        "friction": lambda r: event(dr.geom_friction, asset_cfg=geoms, operation="scale", axes=[0], ranges=r, shared_random=True),
        # alpha of the pseudo inertia: mass and inertia go with exp(2 alpha), as another density.
        "mass": lambda r: event(dr.pseudo_inertia, asset_cfg=bodies, alpha_range=tuple(math.log(one) / 2 for one in r)),
        "base_com": lambda r: event(dr.body_com_offset, asset_cfg=base, operation="add", ranges={0: r, 1: r, 2: r}),
        "motor_strength": lambda r: event(dr.effort_limits, effort_limit_range=r, operation="scale"),
        "damping": lambda r: event(dr.joint_damping, asset_cfg=joints, operation="scale", ranges=r),
        "armature": lambda r: event(dr.joint_armature, asset_cfg=joints, operation="scale", ranges=r),
        "frictionloss": lambda r: event(dr.joint_friction, asset_cfg=joints, operation="scale", ranges=r),
    }
    drawn = {key: tuple(limits) for key, limits in FIGURES["randomization"].items()}
    for key in drawn.keys() & rows.keys():
        yield key, rows[key](drawn[key])
    if drawn.keys() & {"kp", "kd"}:
        yield "gains", event(dr.pd_gains, kp_range=drawn.get("kp", (1, 1)), kd_range=drawn.get("kd", (1, 1)), operation="scale")


def by_joint(values):
    """A number for all, or one for each joint of the action, by the joints' names."""
    (said,) = DEPLOY["actions"].values()
    joints = said.get("joint_ids") or range(len(motors()))
    names = [f"^{motors()[joint]['joint']}$" for joint in joints]
    return dict(zip(names, values)) if isinstance(values, list) else {name: values for name in names}


def env_cfg(play=False):
    cfg = make_velocity_env_cfg()
    cfg.scene.entities = {"robot": entity()}
    cfg.scene.terrain.terrain_type, cfg.scene.terrain.terrain_generator = "plane", None
    cfg.sim.mujoco.timestep, cfg.decimation = TIMESTEP, round(DEPLOY["step_dt"] / TIMESTEP)
    cfg.sim.mujoco.cone, cfg.sim.mujoco.impratio = "elliptic", 10
    cfg.sim.njmax, cfg.sim.nconmax = 300, None
    scan = next(one for one in cfg.scene.sensors if one.name == "foot_height_scan")
    scan.frame = tuple(ObjRef(type="site", name=foot, entity="robot") for foot in FEET)
    scan.pattern = RingPatternCfg.single_ring(radius=0.03, num_samples=6)
    feet = "|".join(foot["body"] for foot in FIGURES["feet"])
    ground = ContactSensorCfg(
        name="feet_ground_contact", primary=ContactMatch(mode="subtree", pattern=f"^({feet})$", entity="robot"),
        secondary=ContactMatch(mode="body", pattern="terrain"), fields=("found", "force"), reduce="netforce", num_slots=1,
        track_air_time=True,
    )  # fmt: skip
    cfg.scene.sensors = (scan, ground)

    critic = cfg.observations["critic"].terms
    critic.pop("height_scan")
    cfg.observations["actor"] = ObservationGroupCfg(terms=dict(observations()), concatenate_terms=True, enable_corruption=not play)
    action = cfg.actions["joint_pos"]
    (said,) = DEPLOY["actions"].values()
    scale, offset, clip = (said.get(key) for key in ("scale", "offset", "clip"))
    action.scale = by_joint(1.0 if scale is None else scale)
    action.offset, action.use_default_offset = by_joint(0.0 if offset is None else offset), False
    if clip:
        action.clip = {name: tuple(limits) for name, limits in by_joint(clip).items()}
    action.actuator_names, action.preserve_order = tuple(action.scale), True

    commands = DEPLOY.get("commands") or {}
    ranges, twist = commands.get("base_velocity", {}).get("ranges", {}), cfg.commands["twist"].ranges
    for axis in ranges.keys() & {"lin_vel_x", "lin_vel_y", "ang_vel_z"}:
        setattr(twist, axis, tuple(ranges[axis]))
    cfg.curriculum = {}
    cfg.terminations.pop("out_of_terrain_bounds")
    for name in ("foot_friction", "base_com", "encoder_bias"):
        cfg.events.pop(name)
    if play:
        cfg.events.pop("push_robot")
        cfg.episode_length_s = int(1e9)
    else:
        cfg.events |= dict(draws())

    for reward in ("upright", "body_ang_vel"):
        cfg.rewards[reward].params["asset_cfg"].body_names = (FIGURES["base"],)
    for reward in ("foot_clearance", "foot_slip"):
        cfg.rewards[reward].params["asset_cfg"].site_names = tuple(FEET)
    for how, deviation in (("std_standing", 0.05), ("std_walking", 0.3), ("std_running", 0.5)):
        cfg.rewards["pose"].params[how] = {".*": deviation}
    cfg.viewer.body_name = FIGURES["base"]
    return cfg


def rl_cfg():
    network = functools.partial(RslRlModelCfg, hidden_dims=(512, 256, 128), activation="elu", obs_normalization=False)
    return RslRlOnPolicyRunnerCfg(
        actor=network(distribution_cfg={"class_name": "GaussianDistribution", "init_std": 1.0, "std_type": "scalar"}),
        critic=network(),
        algorithm=RslRlPpoAlgorithmCfg(entropy_coef=0.01, num_learning_epochs=5, num_mini_batches=4, learning_rate=1e-3),
        experiment_name=FIGURES["robot"], save_interval=50, num_steps_per_env=24, max_iterations=3000,
    )  # fmt: skip


register_mjlab_task(task_id=TASK, env_cfg=env_cfg(), play_env_cfg=env_cfg(play=True), rl_cfg=rl_cfg())
