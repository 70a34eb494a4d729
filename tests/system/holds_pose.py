"""Holds the pose in which it finds a G1 by rt/lowcmd until it is ended."""

import time

from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.idl.default import unitree_hg_msg_dds__LowCmd_
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowCmd_, LowState_
from unitree_sdk2py.utils.crc import CRC


def main():
    ChannelFactoryInitialize(0, "lo")
    states = ChannelSubscriber("rt/lowstate", LowState_)
    states.Init()
    start = states.Read()
    publisher = ChannelPublisher("rt/lowcmd", LowCmd_)
    publisher.Init()
    command = unitree_hg_msg_dds__LowCmd_()
    command.mode_pr = 0
    command.mode_machine = start.mode_machine
    for i in range(29):
        motor = command.motor_cmd[i]
        motor.mode, motor.q, motor.kp, motor.kd = 1, start.motor_state[i].q, 100.0, 3.0
    crc = CRC()
    while True:
        command.crc = crc.Crc(command)
        publisher.Write(command)
        time.sleep(0.005)


main()
