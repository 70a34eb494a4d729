"""What strangers say of their types does no harm, and does not keep others from the robot."""

import dataclasses
import json
import resource
import time
import urllib.request

import pytest
from cyclonedds import idl
from cyclonedds.idl import types
from cyclonedds.idl._typesupport.DDS import XTypes

import rtps
from peers import GoLowCmd, go_command, speaker
from robots import eventually

TYPE = "unitree_go::msg::dds_::LowCmd_"
MAKERS = pytest.mark.parametrize("maker", [rtps.CYCLONE, rtps.FAST_DDS], ids=["Cyclone", "Fast DDS"])


# Asked of the robot by HTTP: a Cyclone of this process would crash, too.
def plays_on(robot):
    assert robot.process.poll() is None, robot.said()
    before = robot.status()["time"]
    return robot.becomes(lambda status: status["time"] > before)


def mismatches(robot, topic):
    """What the panel's tab of DDS shows as keeping apart who writes and who reads the topic."""
    url = json.loads(robot.ctl("panel", "--json"))["url"].split("/#")[0]
    with urllib.request.urlopen(f"{url}/bus", timeout=10) as reply:
        found, = (one for one in json.load(reply)["topics"] if one["topic"] == topic)
    return found["mismatches"]


@MAKERS
def test_a_description_at_which_cyclone_crashes_does_not_end_the_robot(play, maker):
    robot = play("go2")
    # Of an array of a kind that Cyclone DDS 0.10.2 does not have, as Fast DDS 3 describes one.
    description, digest = rtps.structure(rtps.array_of(rtps.UINT8))
    minimal, complete = (rtps.hashed(kind, digest) for kind in (rtps.MINIMAL, rtps.COMPLETE))
    with rtps.Stranger(maker) as stranger:
        stranger.insists("rt/lowcmd", TYPE, rtps.information(minimal, complete), [(minimal, description)], seconds=0.6)

    plays_on(robot)


@MAKERS
def test_nor_does_one_in_place_of_the_hash_of_a_type(play, maker):
    robot = play("go2")
    minimal, complete = (rtps.map_from(rtps.UINT8, rtps.hashed(kind, bytes(14)), kind)
                         for kind in (rtps.MINIMAL, rtps.COMPLETE))
    with rtps.Stranger(maker) as stranger:
        stranger.insists("rt/lowcmd", TYPE, rtps.information(minimal, complete), [], seconds=0.6)

    plays_on(robot)


@MAKERS
def test_nor_does_a_question_about_a_type_that_is_nested_deeper_than_a_stack(play, maker):
    robot = play("go2")
    with rtps.Stranger(maker) as stranger:
        for _ in range(3):
            stranger.joins()
            time.sleep(0.1)
            stranger.asks(rtps.sequences(30_000))
            time.sleep(0.1)

    plays_on(robot)


def test_nor_does_one_that_says_so_of_its_own_type(play):
    robot = play("go2", preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_STACK, (2 << 20, 2 << 20)))
    with rtps.Stranger(rtps.CYCLONE) as stranger:
        hashes = rtps.sequences(10_000), rtps.hashed(rtps.COMPLETE, bytes(14))
        stranger.insists("rt/else", "else", rtps.information(*hashes), [], seconds=0.6)

    plays_on(robot)


def test_what_a_stranger_says_that_the_robots_types_are_made_of_keeps_nobody_from_it(play):
    robot = play("go2", "--released")
    told = GoLowCmd.__idl__.get_type_info()
    unknown = XTypes.TypeIdentifier(discriminator=rtps.MINIMAL, value=list(range(14)))
    told.minimal.dependent_typeids.append(XTypes.TypeIdentifierWithSize(unknown, 100))
    told.minimal.dependent_typeid_count += 1
    with rtps.Stranger(rtps.CYCLONE) as stranger:
        stranger.insists("rt/else", "else", told.serialize(use_version_2=True)[4:], [], seconds=0.6)
        with speaker("rt/lowcmd", GoLowCmd) as program:
            eventually(lambda: program.write_signed(go_command()) or robot.status()["commands"]["accepted"])


@pytest.mark.parametrize(("maker", "writers"), [(rtps.CYCLONE, 0), (rtps.FAST_DDS, 1)], ids=["Cyclone", "Fast DDS"])
def test_a_hash_that_is_not_ours_keeps_out_a_cyclones_writer_but_no_other_makers(play, maker, writers):
    robot = play("go2")
    with rtps.Stranger(maker) as stranger:
        hashes = (rtps.hashed(kind, bytes(14)) for kind in (rtps.MINIMAL, rtps.COMPLETE))
        stranger.insists("rt/lowcmd", TYPE, rtps.information(*hashes), [], seconds=0.6)
        if not writers:
            robot.heard(f"another definition of {TYPE}", "warning")
        robot.becomes(lambda status: status["commands"]["writers"] == writers)
        assert bool(mismatches(robot, "rt/lowcmd")) == (not writers)


@dataclasses.dataclass
class Other(idl.IdlStruct, typename="unitree_go.msg.dds_.LowCmd_"):
    less: types.uint32


def test_a_writer_with_another_definition_of_a_type_is_named(play):
    robot = play("go2")
    with speaker("rt/lowcmd", Other):
        robot.heard(f"another definition of {TYPE}", "warning")
