"""Listens to rt/lowstate for a while and prints what it carries as one JSON object.

Hears it as a ROS 2 program does, with a RELIABLE reader, and keeps every sample: a gap between two
ticks is the robot's doing, not this program's. Types and CRC are those of the vendor's Python SDK.
"""

import collections
import json
import math
import sys
import time

from cyclonedds.domain import DomainParticipant
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from unitree_sdk2py.utils.crc import CRC

from sdk_session import ROBOTS, GoLowState, HgLowState, arguments, is_go, slots_of


def collect(robot, seconds):
    """Every rt/lowstate of `seconds` s, counted from the first."""
    qos = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepAll)
    participant = DomainParticipant(0)
    topic = Topic(participant, "rt/lowstate", GoLowState if is_go(robot) else HgLowState)
    reader = DataReader(participant, topic, qos=qos)
    try:
        first = reader.take_one(timeout=duration(seconds=10))
    except StopIteration:
        sys.exit("no rt/lowstate within 10 s")
    time.sleep(seconds)
    return [first, *reader.take(N=100_000)]


def stream_facts(samples):
    """What the succession of samples shows."""
    crc = CRC()
    steps = collections.Counter(b.tick - a.tick for a, b in zip(samples, samples[1:]))
    return {
        "samples": len(samples),
        "tick_steps_ms": {str(step): count for step, count in sorted(steps.items())},
        "crc_errors": sum(crc.Crc(sample) != sample.crc for sample in samples),
    }


def motor_facts(samples, slots):
    """Motors in use, over all samples, and whether all other slots are empty."""
    last = samples[-1].motor_state
    used = [sample.motor_state[slot] for sample in samples for slot in slots]
    unused = [motor for slot, motor in enumerate(last) if slot not in slots]
    facts = {
        "q": {str(slot): round(last[slot].q, 6) for slot in slots},
        "finite": all(math.isfinite(m.q + m.dq + m.ddq + m.tau_est) for m in used),
        "modes": sorted({motor.mode for motor in used}),
        "max_abs_ddq": max(abs(motor.ddq) for motor in used),
        "unused_slots": len(unused),
        "unused_slots_empty": all(is_empty(motor) for motor in unused),
    }
    if hasattr(last[0], "vol"):
        facts["vol"] = last[slots[0]].vol
    return facts


def imu_facts(samples):
    """The attitude over all samples."""
    norms = [math.hypot(*sample.imu_state.quaternion) for sample in samples]
    return {"quaternion_norm": [min(norms), max(norms)],
            "rpy_off_quaternion": max(rpy_error(sample.imu_state) for sample in samples)}


def rpy_error(imu):
    """The largest difference [rad] between rpy and the z-y-x angles of the quaternion."""
    w, x, y, z = imu.quaternion
    angles = [
        math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
        math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x)))),
        math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    ]
    return max(abs(math.remainder(a - b, 2 * math.pi)) for a, b in zip(angles, imu.rpy))


def message_facts(robot, last):
    """The rest of the newest message, as it stands."""
    go = "head level_flag version power_v power_a bit_flag foot_force foot_force_est " \
         "temperature_ntc1 temperature_ntc2 fan_frequency wireless_remote"
    hg = "version mode_pr mode_machine wireless_remote reserve"
    facts = {name: plain(getattr(last, name)) for name in (go if is_go(robot) else hg).split()}
    if is_go(robot):
        facts["bms_state"] = {name: plain(value) for name, value in vars(last.bms_state).items()}
    return facts


def plain(value):
    """The value as JSON knows it: bytes and arrays become lists."""
    return value if isinstance(value, (int, float)) else list(value)


def is_empty(motor):
    """Whether every field of a motor slot is 0."""
    return not any(any(v) if hasattr(v, "__iter__") else v for v in vars(motor).values())


def add_arguments(parser):
    parser.add_argument("robot", choices=ROBOTS)
    parser.add_argument("seconds", type=float, help="how long to listen, up to 15")


def main():
    parsed = arguments(__doc__.splitlines()[0], add_arguments)
    robot = parsed.robot
    samples = collect(robot, min(parsed.seconds, 15.0))
    facts = {
        "robot": robot,
        **stream_facts(samples),
        "motors": motor_facts(samples, slots_of(robot)),
        "imu": imu_facts(samples),
        "message": message_facts(robot, samples[-1]),
    }
    print(json.dumps(facts))
    if facts["crc_errors"]:
        sys.exit(f"{facts['crc_errors']} of {len(samples)} samples have a wrong CRC")


if __name__ == "__main__":
    main()
