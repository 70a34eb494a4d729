"""The `ros2 topic` that docs/recipes.md needs, without ROS 2: list, hz TOPIC, echo --once --field FIELD TOPIC [TYPE], pub --times COUNT.

It speaks as rmw_cyclonedds_cpp does: the same Cyclone DDS, CYCLONEDDS_URI, topics with rt/ before ROS 2's names, types
with msg::dds_:: in theirs.
"""

import argparse
import collections
import functools
import importlib
import json
import time

from cyclonedds.builtin import BuiltinDataReader, BuiltinTopicDcpsPublication, BuiltinTopicDcpsSubscription
from cyclonedds.domain import DomainParticipant
from cyclonedds.internal import InvalidSample
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from unitree_sdk2py.idl.unitree_api.msg import dds_ as api

DISCOVERY = 2.0  # s
WINDOW = 1.0  # s, as ros2 has it
PERIOD = 1.0  # s


def request():
    header = api.RequestHeader_(api.RequestIdentity_(0, 0), api.RequestLease_(0), api.RequestPolicy_(0, False))
    return api.Request_(header, "", [])


EXAMPLES = {"unitree_api/msg/Request": request}  # each with ROS 2's defaults


def discovered(participant):
    """{ROS 2's topic: its types on the wire, those of readers too} after a while."""
    readers = [BuiltinDataReader(participant, what) for what in (BuiltinTopicDcpsPublication, BuiltinTopicDcpsSubscription)]
    time.sleep(DISCOVERY)
    topics = collections.defaultdict(set)
    for end in [end for reader in readers for end in reader.take(N=10_000)]:
        if end.topic_name.startswith("rt/"):
            topics[end.topic_name[2:]].add(end.type_name)
    return topics


def on_the_wire(kind):
    """unitree_go/msg/LowState as Cyclone has it."""
    package, _, name = kind.split("/")
    return f"{package}::msg::dds_::{name}_"


def message_class(type_name):
    package, _, _, name = type_name.split("::")
    return getattr(importlib.import_module(f"unitree_sdk2py.idl.{package}.msg.dds_"), name)


def reader_of(participant, topic, kind=None):
    """As ros2 it wants to be told the type of a topic that has more than one."""
    types = {on_the_wire(kind)} if kind else discovered(participant)[topic]
    if len(types) != 1:
        raise SystemExit(f"Cannot echo topic '{topic}', as it contains {'no' if not types else 'more than one'} type: {types}")
    return DataReader(participant, Topic(participant, f"rt{topic}", message_class(*types)))


def fill(message, values):
    for name, value in values.items():
        if isinstance(value, dict):
            fill(getattr(message, name), value)
        else:
            setattr(message, name, value)
    return message


def hz(participant, topic):
    reader = reader_of(participant, topic)
    while True:
        reader.take(N=10_000)
        start, count = time.monotonic(), 0
        while time.monotonic() < start + WINDOW:
            count += len(reader.take(N=10_000))
            time.sleep(0.001)
        print(f"average rate: {count / WINDOW:.3f}", flush=True)


def echo(participant, field, topic, kind=None):
    reader = reader_of(participant, topic, kind)
    while not (samples := [sample for sample in reader.take() if not isinstance(sample, InvalidSample)]):
        time.sleep(0.01)
    print(functools.reduce(getattr, field.split("."), samples[0]))


def publish(participant, times, topic, kind, values):
    message = fill(EXAMPLES[kind](), json.loads(values))
    writer = DataWriter(participant, Topic(participant, f"rt{topic}", message_class(on_the_wire(kind))))
    time.sleep(DISCOVERY)
    for _ in range(times):
        writer.write(message)
        time.sleep(PERIOD)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("topic", choices=["topic"])
    parser.add_argument("verb", choices=["list", "hz", "echo", "pub"])
    parser.add_argument("--once", action="store_true")
    parser.add_argument("--times", type=int)
    parser.add_argument("--field")
    parser.add_argument("words", nargs="*")
    asked = parser.parse_intermixed_args()
    participant = DomainParticipant(0)
    if asked.verb == "list":
        print("\n".join(sorted(discovered(participant))))
    elif asked.verb == "hz":
        hz(participant, *asked.words)
    elif asked.verb == "echo":
        echo(participant, asked.field, *asked.words)
    else:
        publish(participant, asked.times, *asked.words)


main()
