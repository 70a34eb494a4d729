"""The movement of go2_stand*.py: crouch, stand, hold, crouch; poses and gains of the vendor's
go2_stand_example. Knows no SDK: targets as a function of time, and the verdict on what was seen.
"""

import sys

from sdk_session import blend, tilt

KP = 60.0  # N·m/rad
KD = 5.0  # N·m·s/rad

# rad; hip, thigh, calf of FR, FL, RR, RL
CROUCH = [0.0, 1.36, -2.65, 0.0, 1.36, -2.65, -0.2, 1.36, -2.65, 0.2, 1.36, -2.65]
STAND = [0.0, 0.67, -1.3] * 4
REST = [-0.35, 1.36, -2.65, 0.35, 1.36, -2.65, -0.5, 1.36, -2.65, 0.5, 1.36, -2.65]

CROUCHED = 1.5  # s, when each stage ends
RISEN = 3.0
HELD = 5.0
DONE = 7.0

# rad. A motor under load stays behind by torque / kp: with 37 N on each foot, a quarter of the
# robot, the knee carries some 4.6 N·m in this stand.
STAND_TOLERANCE = 0.12
FALLEN_TILT = 0.5


def targets(start, t):
    """Where the 12 joints should be [rad], t [s] after they were at `start`."""
    if t < CROUCHED:
        return blend(start, CROUCH, t / CROUCHED)
    if t < RISEN:
        return blend(CROUCH, STAND, (t - CROUCHED) / (RISEN - CROUCHED))
    if t < HELD:
        return STAND
    return blend(STAND, REST, (t - HELD) / (DONE - HELD - 0.2))


class Witness:
    """Watches the movement: `see` each state, then `report`."""

    def __init__(self):
        self._standing = None
        self._last = None
        self._max_tilt = 0.0

    def see(self, t, q, quaternion):
        """One state, t [s] after the start: 12 joint angles [rad] and the attitude."""
        self._max_tilt = max(self._max_tilt, tilt(quaternion))
        self._last = list(q)
        if RISEN < t < HELD:
            self._standing = list(q)

    def report(self):
        """Prints what was seen; ends the program with a reason if the robot did not do it."""
        if self._standing is None:
            sys.exit("no state arrived while the robot should have stood")
        off = max(abs(q - wanted) for q, wanted in zip(self._standing, STAND))
        print("standing at: " + " ".join(f"{q:+.3f}" for q in self._standing))
        print(f"furthest joint off the stand: {off:.3f} rad")
        print(f"largest tilt: {self._max_tilt:.3f} rad")
        if off > STAND_TOLERANCE:
            sys.exit(f"did not stand: a joint is {off:.3f} rad off")
        if self._max_tilt > FALLEN_TILT:
            sys.exit(f"fell: tilted by {self._max_tilt:.3f} rad")
        if max(self._last[2::3]) > -2.3:
            sys.exit(f"did not crouch again: calves at {self._last[2::3]}")
        print("Done!")
