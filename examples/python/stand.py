"""Stands a Go2 up and lays it down again by rt/lowcmd: stand.py [INTERFACE]

As every program that moves motors itself it first asks motion_switcher to release them, begins at the pose that the
robot has, and leaves the motors damped. Exit code 1: no robot was heard, or it kept its motors.
"""

import sys
import time

from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient
from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.idl.default import unitree_go_msg_dds__LowCmd_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowCmd_, LowState_
from unitree_sdk2py.utils.crc import CRC

PERIOD = 0.005  # s
STAND = [0.0, 0.67, -1.3] * 4  # rad: hip, thigh, calf of FR, FL, RR, RL
LIE = [0.0, 1.2, -2.7] * 4
KP, KD = 60.0, 5.0  # N·m/rad, N·m·s/rad


def release_motors():
    """Until no motion service holds them any more."""
    client = MotionSwitcherClient()
    client.SetTimeout(5.0)
    client.Init()
    for _ in range(5):
        code, mode = client.CheckMode()
        if code != 0:
            sys.exit(f"motion_switcher answers {code}: is a robot there?")
        if not mode["name"]:
            return
        print(f"{mode['name']} holds the motors: asking for ReleaseMode", flush=True)
        client.ReleaseMode()
        time.sleep(1)
    sys.exit(f"{mode['name']} still holds the motors")


def main():
    ChannelFactoryInitialize(0, sys.argv[1] if len(sys.argv) > 1 else "lo")
    states = ChannelSubscriber("rt/lowstate", LowState_)
    states.Init()
    commands = ChannelPublisher("rt/lowcmd", LowCmd_)
    commands.Init()
    release_motors()
    command, crc = unitree_go_msg_dds__LowCmd_(), CRC()
    command.head, command.level_flag = [0xFE, 0xEF], 0xFF

    def send(targets, kp, kd):
        for motor, q in zip(command.motor_cmd, targets):
            motor.mode, motor.q, motor.kp, motor.kd = 1, q, kp, kd
        command.crc = crc.Crc(command)  # last, over everything before it
        commands.Write(command)
        time.sleep(PERIOD)

    def move(target, seconds):
        start = [motor.q for motor in states.Read().motor_state[:12]]
        steps = round(seconds / PERIOD)
        for step in range(1, steps + 1):
            send([a + step / steps * (b - a) for a, b in zip(start, target)], KP, KD)
        for _ in range(round(1 / PERIOD)):
            send(target, KP, KD)
        print("calf of the front right leg at %.2f rad" % states.Read().motor_state[2].q, flush=True)

    move(STAND, 2)
    move(LIE, 2)
    for _ in range(round(0.5 / PERIOD)):
        send(LIE, 0, KD)
    print("done", flush=True)


if __name__ == "__main__":
    main()
