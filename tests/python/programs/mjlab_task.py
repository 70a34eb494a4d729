"""Steps a robot as a task of mjlab, on the processor, and holds it against ours.

By hand, for torch takes gigabytes and Warp compiles for minutes: in an environment with this package and mjlab 1.6,

    understudy export mjlab go2 --out go2_lab --definition src/python/understudy/tasks/go2_flat.yaml
    PYTHONPATH=. python tests/python/programs/mjlab_task.py go2_lab 2

The robot stands for so many seconds, of a humanoid half a one, by its policy's default angles, in mjlab without draws
and noise and in ours. It ends with an error where their bases or joints are further than 2 cm or 0.1 rad from each other.
"""

import importlib
import sys

import numpy as np
import torch
from mjlab.envs import ManagerBasedRlEnv
from mjlab.tasks.registry import load_env_cfg

import understudy


def theirs(package, task, seconds):
    cfg = load_env_cfg(task.TASK)
    cfg.scene.num_envs = 1
    for name in [name for name in cfg.events if name != "reset_base"]:
        cfg.events.pop(name)
    cfg.events["reset_base"].params["pose_range"] = {}
    env = ManagerBasedRlEnv(cfg, device="cpu")
    env.reset()
    names = env.scene["robot"].joint_names
    for _ in range(round(seconds / package.DEPLOY["step_dt"])):
        env.step(torch.zeros(1, env.action_manager.total_action_dim))
    data = env.scene["robot"].data
    q = dict(zip(names, data.joint_pos[0].tolist()))
    return data.root_link_pos_w[0, 2].item(), np.array([q[motor["joint"]] for motor in package.motors()])


def ours(package, seconds):
    motors = package.motors()
    by_joint = {motor["joint"]: motor for motor in motors}
    joints = understudy.Robot(package.FIGURES["robot"]).joints
    hold = [by_joint[joint] for joint in joints]
    pose = {"q": [motor["q"] for motor in hold], "height": package.FIGURES["standing"]["height"]}
    sets = {"start.pose": "clamped", "motion.service": "none", "robot.hanging": pose}
    robot = understudy.Robot(package.FIGURES["robot"], set=sets)
    kp, kd = ([motor[key] / motor[f"{key}_share"] for motor in hold] for key in ("kp", "kd"))
    robot.request("clamp", on=False)
    for _ in range(round(seconds / package.DEPLOY["step_dt"])):
        robot.command(q=[motor["q"] for motor in hold], kp=kp, kd=kd)
        robot.step(package.DEPLOY["step_dt"])
    q = dict(zip(robot.joints, robot.truth.q))
    return robot.truth.position[2], np.array([q[motor["joint"]] for motor in motors])


if __name__ == "__main__":
    package, task = importlib.import_module(sys.argv[1]), importlib.import_module(sys.argv[1] + ".task")
    seconds = float(sys.argv[2])
    (their_height, their_q), (our_height, our_q) = theirs(package, task, seconds), ours(package, seconds)
    off = np.abs(their_q - our_q).max()
    print(f"height {their_height:.4f} m and ours {our_height:.4f} m; joints differ by {off:.4f} rad at most")
    assert abs(their_height - our_height) < 0.02 and off < 0.1
    assert their_height > 0.5 * package.FIGURES["standing"]["height"]
