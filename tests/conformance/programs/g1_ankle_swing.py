"""Swings the ankles of a 29-joint G1 in both control modes, through the vendor's Python SDK."""

import sys
import time

from unitree_sdk2py.utils.thread import RecurrentThread

import g1_ankle_swing_plan as plan
from sdk_session import (
    CONTROL_PERIOD,
    Commander,
    LowStateFeed,
    arguments,
    release_motion_services,
)

PATIENCE = 22.0  # s on this machine's clock; the plan itself runs on the robot's


def main():
    arguments(__doc__)
    witness = plan.Witness()
    start = None

    def time_of(state):
        return (state.tick - start.tick) / 1000.0

    def joints(state):
        return [motor.q for motor in state.motor_state[: plan.MOTORS]]

    def see(state):
        if start is not None:
            witness.see(time_of(state), joints(state), state.mode_pr)

    feed = LowStateFeed("g1", see)
    release_motion_services()
    start = feed.wait_first()
    print(f"mode_machine: {start.mode_machine}")
    commander = Commander("g1", start.mode_machine)
    first_pose = joints(start)

    def command():
        t = time_of(feed.latest)
        commander.message.mode_pr = plan.mode_pr(t)
        for slot, q in enumerate(plan.targets(first_pose, t)):
            commander.motor(slot, q, plan.KP[slot], plan.KD[slot])
        commander.send()

    thread = RecurrentThread(interval=CONTROL_PERIOD, target=command, name="lowcmd")
    thread.Start()
    deadline = time.monotonic() + PATIENCE
    while time_of(feed.latest) < plan.DONE:
        if time.monotonic() > deadline:
            sys.exit(f"the robot's clock made {time_of(feed.latest):.1f} s in {PATIENCE:.0f} s")
        time.sleep(0.05)
    thread.Wait()
    witness.report()


if __name__ == "__main__":
    main()
