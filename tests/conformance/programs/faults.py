"""Causes every fault that `understudy faults` lists but those of lidar, camera and hands, one after the other, on a clamped Go2 whose feet
press on the ground and whose FR calf swings, and prints what the vendor's types show of each: while
it is there, and after it was taken away."""

import json
import math
import os
import re
import subprocess
import time

from sdk_session import Commander, LowStateFeed, arguments, release_motion_services
from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient
from unitree_sdk2py.utils.crc import CRC
from unitree_sdk2py.utils.thread import RecurrentThread

JOINT, SLOT = "FR_calf_joint", 2
STAND = [0.0, 0.67, -1.3] * 4  # the vendor's example
SWING = 0.25  # rad, of the calf
CRC_OF = CRC()
LOOK = 0.4  # s, of one swing
BOOT = 1.0  # s, more than the robot of test_faults.py takes for it
NAMES = {
    "Motor": JOINT, "Encoder": f"{JOINT}.encoder", "Inertial unit": "imu", "Foot's sensor": "foot.FL",
    "Battery": "battery", "Remote controller": "remote", "Topic": "rt/lowstate",
    "Service": "service.motion_switcher", "Bus": "bus.FR", "Fan": "fan.rear_right", "Mainboard": "mainboard",
    "Small controller of the mainboard": "mcu",
}
# A Go2's LowState does not show these: tests/emulator/lidar_test.cc, tests/run/cameras_test.cc,
# tests/emulator/hands_test.cc.
ELSEWHERE = {"Lidar", "Camera", "Hand's program"}
# In place of what is usual: so much that the leg leaves the ground, so fast or so far that it is seen at once.
BY = {(f"{JOINT}.encoder", "noisy"): "0.02", (f"{JOINT}.encoder", "offset"): "0.3",
      (f"{JOINT}.encoder", "drifting"): "1", ("imu", "drifting"): "1", ("rt/lowstate", "jittery"): "0.05",
      ("rt/lowstate", "delayed"): "0.1", ("bus.FR", "slow"): "0.1", ("bus.FR", "jittery"): "0.05", ("fan.rear_right", "weak"): "0.1"}


def understudy(*words):
    return subprocess.run([os.environ["UNDERSTUDY"], *words], check=True, capture_output=True, text=True).stdout


def rows():
    """Component and fault of each row of the table that LowState shows."""
    component = None
    for line in understudy("faults").splitlines():
        if line.startswith("## "):
            component = line[3:]
        elif component not in ELSEWHERE and (row := re.match(r"\| `(\w+)` \|", line)):
            yield NAMES[component], row[1]


def facts(state):
    crc = state.crc
    motor, imu = state.motor_state[SLOT], state.imu_state
    return {
        "at": time.monotonic(), "tick": state.tick, "q": motor.q, "tau": motor.tau_est, "temperature": motor.temperature,
        "lost": motor.lost, "errors": motor.reserve[0], "bits": state.bit_flag,
        "rate": list(imu.gyroscope), "acceleration": list(imu.accelerometer),
        "quaternion": list(imu.quaternion), "foot": state.foot_force[1], "soc": state.bms_state.soc,
        "fans": list(state.fan_frequency), "board": state.temperature_ntc1,
        "crc": CRC_OF.Crc(state) == crc, "volts": state.power_v, "remote": list(state.wireless_remote[:2]),
    }


def call(client):
    """What the service answers now, and how long that took."""
    began = time.monotonic()
    code, _ = client.CheckMode()
    return {"code": code, "seconds": time.monotonic() - began}


def main():
    arguments(__doc__)
    client = MotionSwitcherClient()
    client.SetTimeout(2.0)
    client.Init()
    seen = []
    feed = LowStateFeed("go2", lambda state: seen.append(facts(state)))
    release_motion_services()
    commander = Commander("go2")
    began = time.monotonic()
    feed.wait_first()

    def command():
        for slot, q in enumerate(STAND):
            swing = SWING * math.sin(2 * math.pi * (time.monotonic() - began) / LOOK) if slot == SLOT else 0
            commander.motor(slot, q + swing, 60.0, 2.0)
        commander.send()

    thread = RecurrentThread(interval=0.002, target=command, name="lowcmd")
    thread.Start()
    understudy("ctl", "remote", "on")

    def looked():
        time.sleep(0.1)
        seen.clear()
        time.sleep(LOOK)
        return list(seen)

    looked()
    report = [{"component": "", "fault": "", "during": looked(), "after": []}]
    for component, fault in rows():
        by = BY.get((component, fault))
        understudy("ctl", "fault", component, fault, *([] if by is None else ["--by", by]))
        is_service = component.startswith("service.")
        time.sleep(0.01)  # a fault acts from the next step on
        during = [call(client)] if is_service else looked()
        understudy("ctl", "fault", component, "none")
        time.sleep(0.2)
        if (component, fault) == ("mainboard", "off"):  # it boots, and its motion service comes up
            time.sleep(BOOT)
            release_motion_services()
            time.sleep(0.2)
        after = [call(client)] if is_service else looked()
        report.append({"component": component, "fault": fault, "during": during, "after": after})
    thread.Wait()
    print(json.dumps({"rows": report}))


if __name__ == "__main__":
    main()
