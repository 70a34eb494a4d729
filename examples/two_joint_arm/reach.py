"""Has the arm reach out, and prints where its joints are then: reach.py INTERFACE"""

import sys
import time

from unitree_sdk2py.core.channel import (
    ChannelFactoryInitialize, ChannelPublisher, ChannelSubscriber)
from unitree_sdk2py.idl.default import unitree_go_msg_dds__LowCmd_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowCmd_, LowState_
from unitree_sdk2py.utils.crc import CRC

ChannelFactoryInitialize(0, sys.argv[1])
states = ChannelSubscriber("rt/lowstate", LowState_)
states.Init()
commands = ChannelPublisher("rt/lowcmd", LowCmd_)
commands.Init()

command = unitree_go_msg_dds__LowCmd_()
command.head = [0xFE, 0xEF]
command.level_flag = 0xFF
for motor, q in zip(command.motor_cmd, [1.0, -1.0]):  # slots 0 and 1
    motor.mode, motor.q, motor.kp, motor.kd = 1, q, 100, 5
command.crc = CRC().Crc(command)

for _ in range(1000):  # 2 s
    commands.Write(command)
    time.sleep(0.002)
print("shoulder %.2f, elbow %.2f" % tuple(motor.q for motor in states.Read().motor_state[:2]))
