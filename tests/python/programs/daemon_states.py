"""What a daemon's robot tells when it is stepped: daemon_states.py ROBOT TARGETS.npy STATES.npz

Pauses the robot of `understudy exec`, sends a LowCmd for each row of targets [rad] by the vendor's types, makes
20 steps after each one and keeps the newest LowState. STATES.npz has `before`, the steps before the first
command, and `rows`: tick, quaternion, gyroscope, accelerometer, q, dq and tau_est of each LowState, float32.
"""

import json
import os
import subprocess
import sys
import time

import numpy as np
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from unitree_sdk2py.idl.default import unitree_go_msg_dds__LowCmd_, unitree_hg_msg_dds__LowCmd_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowCmd_ as GoLowCmd, LowState_ as GoLowState
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import LowCmd_ as HgLowCmd, LowState_ as HgLowState
from unitree_sdk2py.utils.crc import CRC

STEPS = 20
PATIENCE = 20.0  # s


def ctl(*words):
    done = subprocess.run([os.environ["UNDERSTUDY"], "ctl", *words], capture_output=True, text=True, check=True)
    return done.stdout


def status():
    return json.loads(ctl("status", "--json"))


def until(done, what):
    end = time.monotonic() + PATIENCE
    while not done():
        if time.monotonic() > end:
            sys.exit(f"waited {PATIENCE:g} s in vain for {what}")
        time.sleep(0.002)


def main(robot, targets_file, states_file):
    targets = np.load(targets_file)
    go = robot.startswith("go2")
    participant = DomainParticipant(0)
    state_type, command_type = (GoLowState, GoLowCmd) if go else (HgLowState, HgLowCmd)
    states = DataReader(participant, Topic(participant, "rt/lowstate", state_type))
    commands = DataWriter(participant, Topic(participant, "rt/lowcmd", command_type))
    newest = []

    def told():
        newest.extend(states.take(64))
        del newest[:-1]
        return newest

    until(told, "the first LowState")
    ctl("pause")
    until(lambda: status()["commands"]["writers"] > 0, "the robot to meet this program")
    before = now = status()["steps"]
    command = unitree_go_msg_dds__LowCmd_() if go else unitree_hg_msg_dds__LowCmd_()
    if go:
        command.head, command.level_flag = [0xFE, 0xEF], 0xFF
    else:
        command.mode_machine = newest[0].mode_machine
    crc, rows = CRC(), []
    for number, target in enumerate(targets):
        for motor, q in zip(command.motor_cmd, target):
            motor.mode, motor.q, motor.kp, motor.kd = 1, float(q), 60.0, 2.0
        command.crc = crc.Crc(command)
        commands.write(command)
        if not commands.wait_for_acks(duration(seconds=PATIENCE)):
            sys.exit("the robot did not acknowledge a command")
        ctl("step", str(STEPS))
        now += STEPS
        if status()["commands"]["accepted"] != number + 1:
            sys.exit(f"command {number} was not taken in its step: {status()['commands']}")
        last = (now - 1) // 2 * 2  # ms of its last LowState: one every 2 ms
        until(lambda: told()[0].tick >= last, f"the LowState of {last} ms")
        state = newest[0]
        motors = state.motor_state[: len(target)]
        rows.append([
            state.tick, *state.imu_state.quaternion, *state.imu_state.gyroscope, *state.imu_state.accelerometer,
            *(motor.q for motor in motors), *(motor.dq for motor in motors), *(motor.tau_est for motor in motors),
        ])  # fmt: skip
    np.savez(states_file, before=before, rows=np.array(rows, np.float32))


main(*sys.argv[1:])
