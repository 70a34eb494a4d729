"""python -m understudy: checks that this installation has robots that stand."""

import sys
import time

import understudy


def check(name):
    """Returns what is wrong with a robot that its motion service holds for a second, or None."""
    robot = understudy.Robot(name, set={"start.pose": "standing"})
    height = robot.truth.position[2]
    robot.step(1)
    if abs(robot.truth.position[2] - height) > 0.1 or robot.truth.tilt > 0.3:
        return f"it does not stand: its base is {robot.truth.position[2]:.2f} m high, and was {height:.2f} m"
    return None


def main():
    wrong = 0
    for name in ("go2", "g1"):
        begin = time.monotonic()
        try:
            why = check(name)
        except understudy.Error as error:
            why = str(error)
        wrong += why is not None
        print(f"{name}: {why or f'stands; a second of it took {time.monotonic() - begin:.2f} s with its making'}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
