"""Runs a policy on a robot, simulated or real, with the vendor's Python SDK and numpy: deploy.py POLICY.npz [INTERFACE]

  1. asks motion_switcher to release the motors, where a motion service holds them
  2. moves from the pose that the robot has to the policy's own, and holds it until A on the remote controller
     (--at-once: goes on by itself)
  3. runs the policy at 50 Hz, for --seconds or until SELECT or Ctrl-C
  4. leaves the motors damped

POLICY.npz has, n motors long and in the policy's order:

  family        "go" or "hg", the messages that the robot speaks
  slots         place of each motor in motor_cmd and motor_state
  q0, kp, kd    its default angle, rad, and its gains, N·m/rad and N·m·s/rad
  scale         action to rad: a motor is sent to q0 + scale * action
  gyro_scale, dq_scale, command_scale (3)      of the observation
  w0, b0, w1, b1 ...                           layers, with ELU between them: y = w x + b

and is given, once in 20 ms, 9 + 3 n numbers: angular velocity (3, body), gravity's direction (3, body), --command (3), q - q0,
dq, and its last action. It answers with n actions. Exit code 1: no robot was heard, it kept its motors, or it fell.
"""

import argparse
import sys
import time

import numpy as np
from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient
from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.idl.default import unitree_go_msg_dds__LowCmd_, unitree_hg_msg_dds__LowCmd_
from unitree_sdk2py.idl.unitree_go.msg import dds_ as go
from unitree_sdk2py.idl.unitree_hg.msg import dds_ as hg
from unitree_sdk2py.utils.crc import CRC

PERIOD = 0.02  # s
RAMP = 2.0  # s
DAMPING = 3.0  # N·m·s/rad
FALLEN = 1.0  # rad off the vertical
SELECT, A = 1 << 3, 1 << 8  # of the keys in wireless_remote


class Policy:
    """A network of dense layers, and what it needs to know of its robot."""

    def __init__(self, file):
        data = np.load(file)
        for name in ("slots", "q0", "kp", "kd", "scale", "gyro_scale", "dq_scale", "command_scale"):
            setattr(self, name, data[name])
        self.family = str(data["family"])
        count = sum(name.startswith("w") for name in data.files)
        self._layers = [(data[f"w{i}"], data[f"b{i}"]) for i in range(count)]
        self._action = np.zeros(len(self.slots))
        if self._layers[0][0].shape[1] != 9 + 3 * len(self.slots):
            sys.exit(f"{file}: w0 takes {self._layers[0][0].shape[1]} numbers, not 9 + 3 * {len(self.slots)}")

    def targets(self, gyro, gravity, command, q, dq):
        """The angles to send the motors to, rad."""
        x = np.concatenate([gyro * self.gyro_scale, gravity, command * self.command_scale, q - self.q0,
                            dq * self.dq_scale, self._action])
        for i, (w, b) in enumerate(self._layers):
            if i > 0:
                x = np.where(x > 0, x, np.expm1(np.minimum(x, 0)))
            x = w @ x + b
        self._action = x
        return self.q0 + self.scale * x


class Robot:
    """rt/lowstate and rt/lowcmd, for the motors of a policy and in its order."""

    def __init__(self, policy):
        family, self._command = ((go, unitree_go_msg_dds__LowCmd_()) if policy.family == "go" else
                                 (hg, unitree_hg_msg_dds__LowCmd_()))
        self._slots, self._kp, self._kd = policy.slots, policy.kp, policy.kd
        self._crc = CRC()
        self._states = ChannelSubscriber("rt/lowstate", family.LowState_)
        self._states.Init()
        self._commands = ChannelPublisher("rt/lowcmd", family.LowCmd_)
        self._commands.Init()
        self.read()
        if policy.family == "go":
            self._command.head, self._command.level_flag = [0xFE, 0xEF], 0xFF
        else:
            self._command.mode_machine = self.state.mode_machine  # else all of it is refused

    def read(self):
        """Takes the newest state."""
        self.state = self._states.Read(5)
        if self.state is None:
            sys.exit("no rt/lowstate in 5 s: is a robot there, of this policy's family?")
        motors = [self.state.motor_state[slot] for slot in self._slots]
        self.q, self.dq = np.array([m.q for m in motors]), np.array([m.dq for m in motors])
        self.gyro = np.array(self.state.imu_state.gyroscope)
        w, x, y, z = self.state.imu_state.quaternion
        self.gravity = np.array([2 * (w * y - x * z), -2 * (y * z + w * x), 2 * (x * x + y * y) - 1])

    def pressed(self, key):
        return int.from_bytes(bytes(self.state.wireless_remote[2:4]), "little") & key != 0

    def send(self, targets, damped=False):
        for slot, q, kp, kd in zip(self._slots, targets, self._kp, self._kd):
            motor = self._command.motor_cmd[slot]
            motor.mode, motor.q, motor.dq, motor.tau = 1, float(q), 0.0, 0.0
            motor.kp, motor.kd = (0.0, DAMPING) if damped else (float(kp), float(kd))
        self._command.crc = self._crc.Crc(self._command)
        self._commands.Write(self._command)


def ticks():
    """The seconds since the first of them, each PERIOD after the one before."""
    start = time.monotonic()
    step = 0
    while True:
        yield step * PERIOD
        step += 1
        time.sleep(max(0, start + step * PERIOD - time.monotonic()))


def release_motors():
    client = MotionSwitcherClient()
    client.SetTimeout(5.0)
    client.Init()
    for _ in range(5):
        code, mode = client.CheckMode()
        if code != 0:
            sys.exit(f"motion_switcher answers {code}: is a robot there?")
        if not mode["name"]:
            return
        client.ReleaseMode()
        time.sleep(1)
    sys.exit(f"{mode['name']} still holds the motors")


def say(text):
    print(text, flush=True)


def run(robot, policy, asked):
    """Returns whether it stayed on its feet."""
    begin = robot.q
    for t in ticks():
        robot.read()
        robot.send(begin + min(1, t / RAMP) * (policy.q0 - begin))
        if t >= RAMP and (asked.at_once or robot.pressed(A)):
            break
        if abs(t - RAMP) < PERIOD / 2 and not asked.at_once:
            say("in its default pose; A on the remote controller starts the policy")
    say("the policy runs")
    for t in ticks():
        robot.read()
        if robot.gravity[2] > -np.cos(FALLEN):
            say("it fell")
            return False
        if t >= asked.seconds or robot.pressed(SELECT):
            return True
        robot.send(policy.targets(robot.gyro, robot.gravity, np.array(asked.command), robot.q, robot.dq))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("policy")
    parser.add_argument("interface", nargs="?", default="lo")
    parser.add_argument("--at-once", action="store_true", help="do not wait for A")
    parser.add_argument("--seconds", type=float, default=float("inf"), help="how long the policy runs")
    parser.add_argument("--command", type=float, nargs=3, default=[0, 0, 0], metavar=("VX", "VY", "WZ"))
    asked = parser.parse_args()

    policy = Policy(asked.policy)
    ChannelFactoryInitialize(0, asked.interface)
    robot = Robot(policy)
    release_motors()
    robot.read()
    stands = True
    try:
        stands = run(robot, policy, asked)
    except KeyboardInterrupt:
        pass
    say("damping")
    for t in ticks():
        robot.send(policy.q0, damped=True)
        if t > 1:
            sys.exit(0 if stands else 1)


if __name__ == "__main__":
    main()
