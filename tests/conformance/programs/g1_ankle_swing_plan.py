"""The movement of g1_ankle_swing*.py: all joints to zero, ankles swing as pitch and roll (PR), then
as motors A and B (AB); the stages, amplitudes and gains of the vendor's g1_low_level_example.
Knows no SDK: targets as a function of time, and the verdict on what was seen.
"""

import math
import sys

from sdk_session import blend

MOTORS = 29
LEG_KP, LEG_KD = [60.0, 60.0, 60.0, 100.0, 40.0, 40.0], [1.0, 1.0, 1.0, 2.0, 1.0, 1.0]
KP = LEG_KP * 2 + [60.0, 40.0, 40.0] + [40.0] * 14  # N·m/rad
KD = LEG_KD * 2 + [1.0] * 17  # N·m·s/rad

PR, AB = 0, 1  # mode_pr
ZEROED = 3.0  # s, when each stage ends
PR_DONE = 6.0
DONE = 9.0
FREQUENCY = 1.0  # Hz

# Amplitudes [rad] by motor slot. In AB the slot of pitch is motor B, the slot of roll motor A.
PITCH, ROLL = math.radians(30.0), math.radians(10.0)
PR_SWING = {4: PITCH, 5: ROLL, 10: PITCH, 11: -ROLL}
AB_SWING = {4: ROLL, 5: PITCH, 10: -ROLL, 11: -PITCH}
AB_PHASE = {4: math.pi, 5: 0.0, 10: math.pi, 11: 0.0}

# Share of the wanted amplitude. At 1 Hz the damping term and the joint's inertia change it by a few
# percent; a foot on the ground by more.
PR_AMPLITUDES = (0.75, 1.25)


def mode_pr(t):
    """The control mode at t [s]."""
    return AB if t >= PR_DONE else PR


def targets(start, t):
    """Where the 29 joints should be [rad], t [s] after they were at `start`."""
    q = blend(start, [0.0] * MOTORS, t / ZEROED)
    angle = 2.0 * math.pi * FREQUENCY * t
    for slot in PR_SWING:
        if ZEROED <= t < PR_DONE:
            q[slot] = PR_SWING[slot] * math.sin(angle)
        elif t >= PR_DONE:
            q[slot] = AB_SWING[slot] * math.sin(angle + AB_PHASE[slot])
    return q


class Witness:
    """Watches the movement: `see` each state, then `report`."""

    def __init__(self):
        # Each swing is judged over its last two seconds, two whole periods.
        self._pr = {slot: [] for slot in PR_SWING}
        self._ab = {slot: [] for slot in PR_SWING}
        self._echoes = {"PR": set(), "AB": set()}

    def see(self, t, q, echo=None):
        """One state, t [s] after the start: joint angles [rad] and its mode_pr, where known."""
        if PR_DONE - 2.0 <= t < PR_DONE:
            stage, swing = "PR", self._pr
        elif DONE - 2.0 <= t < DONE:
            stage, swing = "AB", self._ab
        else:
            return
        if echo is not None:
            self._echoes[stage].add(echo)
        for slot, seen in swing.items():
            seen.append(q[slot])

    def report(self, echoed=True):
        """Prints what was seen; ends the program with a reason if the robot did not do it."""
        if not (self._pr[4] and self._ab[4]):
            sys.exit("no state arrived during a swing")
        for slot in PR_SWING:
            share = _amplitude(self._pr[slot]) / abs(PR_SWING[slot])
            print(f"motor {slot:2}: PR swing {_amplitude(self._pr[slot]):.3f} rad, {share:.0%} of "
                  f"the command; AB swing {_amplitude(self._ab[slot]):.3f} rad")
            if not PR_AMPLITUDES[0] < share < PR_AMPLITUDES[1]:
                sys.exit(f"motor {slot} swung {share:.0%} of its command")
            if _amplitude(self._ab[slot]) < 0.03:
                sys.exit(f"motor {slot} hardly moved in AB")
        if echoed:
            print(f"mode_pr in LowState: {self._echoes['PR']}, then {self._echoes['AB']}")
            if self._echoes != {"PR": {PR}, "AB": {AB}}:
                sys.exit("LowState did not echo mode_pr 0 in PR and 1 in AB")
        print("Done!")


def _amplitude(values):
    return (max(values) - min(values)) / 2.0
