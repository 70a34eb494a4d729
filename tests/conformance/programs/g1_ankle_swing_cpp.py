"""Swings the ankles of a 29-joint G1 in both control modes, through the vendor's C++ SDK.

The extension copies mode_machine from LowState into its commands and repeats the newest one at
500 Hz from a thread of its own. It shows neither mode_pr nor the robot's clock, so the plan runs on
this machine's. It has no call for motion_switcher: that one is made with the Python SDK.
"""

import sys
import time

import unitree_interface as cpp

import g1_ankle_swing_plan as plan
from sdk_session import CONTROL_PERIOD, arguments, release_motion_services


def wait_first_state(robot, seconds=10.0):
    """The first rt/lowstate; before it, the extension shows mode_machine 0."""
    deadline = time.monotonic() + seconds
    while True:
        state = robot.read_low_state()
        if state.mode_machine != 0:
            return state
        if time.monotonic() > deadline:
            sys.exit(f"no rt/lowstate with a good CRC and a mode_machine within {seconds:.0f} s")
        time.sleep(0.01)


def main():
    parsed = arguments(__doc__)
    release_motion_services()
    robot = cpp.create_robot(parsed.interface, cpp.RobotType.G1, cpp.MessageType.HG)
    first = wait_first_state(robot)
    print(f"mode_machine: {first.mode_machine}")
    first_pose = list(first.motor.q)

    witness = plan.Witness()
    command = robot.create_zero_command()
    command.kp = plan.KP
    command.kd = plan.KD
    start = time.monotonic()
    while (t := time.monotonic() - start) < plan.DONE:
        mode = cpp.ControlMode.AB if plan.mode_pr(t) == plan.AB else cpp.ControlMode.PR
        if robot.get_control_mode() != mode:
            robot.set_control_mode(mode)
        command.q_target = plan.targets(first_pose, t)
        robot.write_low_command(command)
        witness.see(t, robot.read_low_state().motor.q)
        time.sleep(CONTROL_PERIOD)
    witness.report(echoed=False)


if __name__ == "__main__":
    main()
