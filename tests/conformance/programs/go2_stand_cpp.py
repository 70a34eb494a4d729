"""Stands a Go2 up and lays it down again, through the vendor's C++ SDK.

The extension repeats the newest command at 500 Hz from a thread of its own and offers no clock of
the robot, so the plan runs on this machine's, and waits where the machine stalls. It has no call
for motion_switcher: that one is made with the Python SDK.
"""

import sys
import time

import unitree_interface as cpp

import go2_stand_plan as plan
from sdk_session import CONTROL_PERIOD, arguments, release_motion_services


def wait_first_state(robot, seconds=10.0):
    """The first rt/lowstate; before it, the extension shows joints at 0, where a Go2 cannot be."""
    deadline = time.monotonic() + seconds
    while True:
        state = robot.read_low_state()
        if any(state.motor.q):
            return state
        if time.monotonic() > deadline:
            sys.exit(f"no rt/lowstate with a good CRC within {seconds:.0f} s")
        time.sleep(0.01)


def main():
    parsed = arguments(__doc__)
    release_motion_services()
    robot = cpp.create_robot(parsed.interface, cpp.RobotType.GO2, cpp.MessageType.GO2)
    first_pose = list(wait_first_state(robot).motor.q)

    witness = plan.Witness()
    command = robot.create_zero_command()
    command.kp = [plan.KP] * 12
    command.kd = [plan.KD] * 12
    t, last = 0.0, time.monotonic()
    while t < plan.DONE:
        now = time.monotonic()
        t += min(now - last, 5 * CONTROL_PERIOD)
        last = now
        command.q_target = plan.targets(first_pose, t)
        robot.write_low_command(command)
        state = robot.read_low_state()
        witness.see(t, state.motor.q, state.imu.quat)
        time.sleep(CONTROL_PERIOD)
    witness.report()


if __name__ == "__main__":
    main()
