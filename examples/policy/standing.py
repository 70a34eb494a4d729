"""Writes a policy that stands, as a stand-in for one of yours: standing.py go2|g1 FILE.npz

It is no learned policy, and no good one: a single linear layer, made by hand below, which leans against a tilt. It is here
so that deploy.py has something to run, and to show what a policy's file has to have. Yours takes its place: write your
network's weights, motors and gains with the same names.
"""

import sys

import numpy as np

GYRO_SCALE, DQ_SCALE, COMMAND_SCALE, SCALE = 0.25, 0.05, [2.0, 2.0, 0.25], 0.25  # as is usual in training code
GYRO, GRAVITY = 0, 3  # where they begin in an observation


def linear(family, q0, kp, kd, lean):
    """A layer of which `lean` says, in rad: {motor: {place in the observation: rad per unit}}."""
    n = len(q0)
    w = np.zeros((n, 9 + 3 * n))
    for motor, gains in lean.items():
        for place, gain in gains.items():
            w[motor, place] = gain / SCALE / (GYRO_SCALE if place < GRAVITY else 1)
    return dict(family=family, slots=np.arange(n), q0=np.array(q0), kp=np.array(kp), kd=np.array(kd), scale=SCALE,
                gyro_scale=GYRO_SCALE, dq_scale=DQ_SCALE, command_scale=np.array(COMMAND_SCALE), w0=w, b0=np.zeros(n))


def go2():
    """The legs on the side that sinks get longer: thigh back, calf out."""
    lean = {}
    for leg, (front, right) in enumerate([(1, 1), (1, -1), (-1, 1), (-1, -1)]):  # FR FL RR RL
        for joint, longer in ((1, -1), (2, 2)):
            lean[3 * leg + joint] = {GRAVITY: 0.4 * longer * front, GRAVITY + 1: -0.25 * longer * right}
    return linear("go", [0, 0.67, -1.3] * 4, [60] * 12, [5] * 12, lean)


def g1():
    """The ankles push the body back over the feet; all else holds its angle."""
    leg = [-0.1, 0, 0, 0.3, -0.14, 0]  # hip pitch, roll, yaw, knee, ankle pitch, roll
    arms = [0.3, 0.2, 0, 0.6, 0, 0, 0, 0.3, -0.2, 0, 0.6, 0, 0, 0]
    kp = [150, 150, 100, 200, 80, 80] * 2 + [200] * 3 + [40] * 14
    kd = [3, 3, 2, 4, 4, 4] * 2 + [5] * 3 + [2] * 14
    lean = {}
    for ankle in (4, 10):
        lean[ankle] = {GRAVITY: 1.5, GYRO + 1: 0.15}
        lean[ankle + 1] = {GRAVITY + 1: -0.5, GYRO: 0.05}
    return linear("hg", leg * 2 + [0] * 3 + arms, kp, kd, lean)


def main():
    robots = {"go2": go2, "g1": g1}
    if len(sys.argv) != 3 or sys.argv[1] not in robots:
        sys.exit(__doc__)
    np.savez(sys.argv[2], **robots[sys.argv[1]]())


if __name__ == "__main__":
    main()
