"""Holds a standing Go2 by rt/lowcmd until it is ended."""

import time

from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.idl.default import unitree_go_msg_dds__LowCmd_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowCmd_, LowState_
from unitree_sdk2py.utils.crc import CRC


def main():
    ChannelFactoryInitialize(0, "lo")
    states = ChannelSubscriber("rt/lowstate", LowState_)
    states.Init()
    start = states.Read()
    publisher = ChannelPublisher("rt/lowcmd", LowCmd_)
    publisher.Init()
    command = unitree_go_msg_dds__LowCmd_()
    command.head = [0xFE, 0xEF]
    command.level_flag = 0xFF
    for i in range(12):
        motor = command.motor_cmd[i]
        motor.mode, motor.q, motor.kp, motor.kd = 1, start.motor_state[i].q, 60.0, 3.0
    crc = CRC()
    while True:
        command.crc = crc.Crc(command)
        publisher.Write(command)
        time.sleep(0.005)


main()
