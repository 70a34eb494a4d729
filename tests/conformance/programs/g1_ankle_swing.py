"""Swings the ankles of a 29-joint G1 in both control modes, through the vendor's Python SDK."""

import g1_ankle_swing_plan as plan
from sdk_session import (
    Commander,
    LowStateFeed,
    arguments,
    command_until,
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

    command_until(plan.DONE, command, lambda: time_of(feed.latest), PATIENCE)
    witness.report()


if __name__ == "__main__":
    main()
