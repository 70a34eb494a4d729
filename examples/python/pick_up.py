"""Has a G1 that stands pick a cube up from a table with its left Dex1-1: pick_up.py [INTERFACE [DOMAIN]]

    understudy rehearse pick_up -- python3 examples/python/pick_up.py lo

The arm is led over rt/arm_sdk, the gripper over rt/dex1/left/cmd; legs and balance stay with the robot's motion service.
The angles come from the arm's inverse kinematics for a cube at (0.34, 0.2) m on a table 0.75 m high, the torques from
its weight in them. Exit code 1: the robot sends no LowState.
"""

import sys
import time

from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.idl.default import unitree_go_msg_dds__MotorCmd_, unitree_hg_msg_dds__LowCmd_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import MotorCmds_
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowCmd_, LowState_
from unitree_sdk2py.utils.crc import CRC

PERIOD = 0.02  # s
WAIST_AND_ARMS = range(12, 29)
LEFT_ARM = range(15, 22)
WEIGHT = 29  # the slot whose q says how much of the command counts
KP, KD = 60.0, 1.5  # N m/rad, N m s/rad: those of the vendor's arm example
OPEN, SHUT = 5.4, 0.0  # rad of the gripper's motor
GRIP_KP, GRIP_KD = 5.0, 0.05

# Seconds to get there, gripper, angles [rad] and torques [N m] of the left arm from the shoulder to the wrist.
WAY = (
    (1.0, SHUT, (0.6, 0.3, 0.0, 0.2, 0.0, 0.0, 0.0), (1.0, 1.7, 0.8, -1.5, 0.0, -0.5, 0.1)),  # back, off the table
    (1.2, OPEN, (0.5, 0.4, 0.0, -0.7, 0.0, 0.0, 0.0), (-0.3, 1.3, 0.9, -2.2, 0.0, -0.6, 0.1)),  # up
    (1.2, OPEN, (0.1, 0.5, 0.0, -0.8, -0.5, 0.5, 0.3), (-1.9, 1.7, 1.1, -1.9, 0.1, -0.7, 0.0)),  # ahead
    (1.5, OPEN, (0.097, 1.266, 0.143, -0.435, -1.24, 1.037, -0.095), (-2.1, 3.8, 2.3, -0.6, 0.0, -0.4, 0.0)),  # over it
    (0.5, OPEN, (-0.092, 1.127, -0.092, -0.307, -1.07, 1.005, -0.102), (-2.6, 3.7, 2.2, -0.9, 0.0, -0.4, 0.0)),  # down
    (0.5, OPEN, (-0.23, 0.994, -0.273, -0.126, -0.915, 0.924, -0.136), (-3.2, 3.4, 2.1, -1.2, 0.0, -0.4, 0.0)),
    (0.5, OPEN, (-0.32, 0.889, -0.377, 0.048, -0.805, 0.842, -0.176), (-3.6, 3.2, 2.0, -1.3, 0.0, -0.4, 0.0)),
    (0.5, OPEN, (-0.408, 0.774, -0.456, 0.263, -0.699, 0.739, -0.229), (-4.0, 3.0, 1.8, -1.4, 0.0, -0.4, 0.0)),
    (1.2, SHUT, (-0.408, 0.774, -0.456, 0.263, -0.699, 0.739, -0.229), (-4.0, 3.0, 1.8, -1.4, 0.0, -0.4, 0.0)),  # close
    (0.6, SHUT, (-0.398, 0.917, -0.351, -0.018, -0.902, 0.972, -0.114), (-3.8, 3.2, 2.1, -1.2, 0.0, -0.4, 0.0)),  # lift
    (0.6, SHUT, (-0.433, 1.016, -0.199, -0.185, -1.127, 1.199, 0.004), (-3.7, 3.3, 2.2, -1.0, 0.0, -0.4, 0.0)),
    (0.6, SHUT, (-0.532, 1.059, -0.019, -0.236, -1.398, 1.456, 0.176), (-3.7, 3.3, 2.0, -0.7, 0.0, -0.4, 0.0)),
    (1.5, SHUT, (-0.532, 1.059, -0.019, -0.236, -1.398, 1.456, 0.176), (-3.7, 3.3, 2.0, -0.7, 0.0, -0.4, 0.0)),  # hold
)


class Arms:
    """Waist, arms and left gripper. Where they are at first is where they are held."""

    def __init__(self, state):
        self.q = [state.motor_state[slot].q for slot in WAIST_AND_ARMS]
        self.tau = [0.0] * len(self.q)
        self.grip = SHUT
        self._body = ChannelPublisher("rt/arm_sdk", LowCmd_)
        self._body.Init()
        self._gripper = ChannelPublisher("rt/dex1/left/cmd", MotorCmds_)
        self._gripper.Init()
        self._crc = CRC()

    def send(self, weight=1.0):
        command = unitree_hg_msg_dds__LowCmd_()
        command.motor_cmd[WEIGHT].q = weight
        for slot, q, tau in zip(WAIST_AND_ARMS, self.q, self.tau):
            motor = command.motor_cmd[slot]
            motor.mode, motor.q, motor.tau, motor.kp, motor.kd = 1, q, tau, KP, KD
        command.crc = self._crc.Crc(command)
        self._body.Write(command)
        motor = unitree_go_msg_dds__MotorCmd_()
        motor.mode, motor.q, motor.kp, motor.kd = 1, self.grip, GRIP_KP, GRIP_KD
        self._gripper.Write(MotorCmds_(cmds=[motor]))
        time.sleep(PERIOD)

    def go(self, seconds, grip, q, tau):
        """Leads the left arm there, slowly at either end."""
        first, goal = LEFT_ARM[0] - WAIST_AND_ARMS[0], (*q, *tau, grip)
        begin = (*self.q[first:first + 7], *self.tau[first:first + 7], self.grip)
        steps = round(seconds / PERIOD)
        for step in range(1, steps + 1):
            share = step / steps
            share *= share * (3 - 2 * share)
            now = [a + (b - a) * share for a, b in zip(begin, goal)]
            self.q[first:first + 7], self.tau[first:first + 7], self.grip = now[:7], now[7:14], now[14]
            self.send()


def main():
    ChannelFactoryInitialize(int(sys.argv[2]) if len(sys.argv) > 2 else 0, sys.argv[1] if len(sys.argv) > 1 else "lo")
    states = ChannelSubscriber("rt/lowstate", LowState_)
    states.Init()
    if (state := states.Read(5)) is None:
        sys.exit("no LowState within 5 s")
    arms = Arms(state)
    for step in range(50):
        arms.send(step / 50)
    for seconds, grip, q, tau in WAY:
        arms.go(seconds, grip, q, tau)
    print("holds it", flush=True)


if __name__ == "__main__":
    main()
