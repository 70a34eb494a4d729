"""Stands a Go2 up and lays it down again, through the vendor's Python SDK."""

import go2_stand_plan as plan
from sdk_session import (
    Commander,
    LowStateFeed,
    arguments,
    command_until,
    release_motion_services,
)

PATIENCE = 20.0  # s on this machine's clock; the plan itself runs on the robot's


def main():
    arguments(__doc__)
    witness = plan.Witness()
    start = None

    def time_of(state):
        return (state.tick - start.tick) / 1000.0

    def see(state):
        if start is not None:
            q = [state.motor_state[slot].q for slot in range(12)]
            witness.see(time_of(state), q, state.imu_state.quaternion)

    feed = LowStateFeed("go2", see)
    release_motion_services()
    commander = Commander("go2")
    start = feed.wait_first()
    first_pose = [start.motor_state[slot].q for slot in range(12)]

    def command():
        for slot, q in enumerate(plan.targets(first_pose, time_of(feed.latest))):
            commander.motor(slot, q, plan.KP, plan.KD)
        commander.send()

    command_until(plan.DONE, command, lambda: time_of(feed.latest), PATIENCE)
    witness.report()


if __name__ == "__main__":
    main()
