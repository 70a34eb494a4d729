"""How refused commands appear in status and log."""

import json
import math

import pytest
from unitree_sdk2py.idl.unitree_api.msg.dds_ import (
    Request_,
    RequestHeader_,
    RequestIdentity_,
    RequestLease_,
    RequestPolicy_,
)

from peers import GoLowCmd, HgLowCmd, go_command, hg_command, speaker
from robots import eventually

G1 = 5  # mode_machine of a G1 with 29 motors


def request(api, noreply, parameter="{}"):
    return Request_(RequestHeader_(RequestIdentity_(1, api), RequestLease_(0),
                                   RequestPolicy_(0, noreply)), parameter, [])


@pytest.mark.parametrize("noreply", [False, True])
@pytest.mark.parametrize(("api", "parameter", "reason", "words"), [
    (1008, '{"x": 1, "y": 0, "z": 0}', "state", "sport 1008 Move (state)"),
    (1008, "{", "parameter", "sport 1008 Move (parameter)"),
    (4711, "{}", "unknown_api", "sport 4711 (unknown_api)"),
])
def test_a_refused_call_is_counted_and_explained_also_if_no_reply_is_wanted(
        play, api, parameter, reason, words, noreply):
    robot = play("go2", "--start", "lying", "--set", "robot.motion.quadruped.stands_up=false")
    with speaker("rt/api/sport/request", Request_) as client:
        eventually(lambda: client.write(request(api, noreply, parameter)) or
                   robot.status()["services"]["refused"][reason])
        robot.heard(words, "warning")
        refused = robot.status()["services"]["refused"]

    assert {key for key, count in refused.items() if count} == {reason}
    assert any(event["kind"] == "call_refused" and event["detail"]["reason"] == reason
               for event in json.loads(robot.ctl("events", "--json"))["events"])


def test_a_state_that_is_answered_0_and_ignored_is_told(play):
    robot = play("g1")
    with speaker("rt/api/sport/request", Request_) as client:
        eventually(lambda: client.write(request(7101, False, '{"data": 501}')) or
                   robot.status()["services"]["refused"]["state"])
        assert "code 0" in robot.heard("sport 7101 SetFsmId (state)", "warning")["message"]


def with_motor(field, value):
    return lambda message: setattr(message.motor_cmd[0], field, value)


def with_field(field, value):
    return lambda message: setattr(message, field, value)


with_head = with_field("head", [0xFE, 0xEE])

# By robot: a cause, what has it, and a word of the log.
FAULTS = {
    "go2": (GoLowCmd, go_command, [
        ("head", with_head, "FE EF"),
        ("motor_mode", with_motor("mode", 5), "mode byte"),
        ("not_finite", with_motor("tau", math.inf), "finite"),
        ("gain", with_motor("kd", -1.0), "negative"),
        ("crc", None, "crc")]),
    "g1": (HgLowCmd, lambda: hg_command(G1), [
        ("mode_machine", with_field("mode_machine", G1 + 1), "LowState"),
        ("mode_pr", with_field("mode_pr", 2), "PR"),
        ("motor_mode", with_motor("mode", 5), "mode byte"),
        ("not_finite", with_motor("q", math.nan), "finite"),
        ("gain", with_motor("kp", -1.0), "negative"),
        ("crc", None, "crc")]),
}


@pytest.mark.parametrize("name", FAULTS)
def test_a_refused_command_is_counted_and_explained(play, name):
    kind, good, faults = FAULTS[name]
    robot = play(name, "--released")
    causes = set()
    with speaker("rt/lowcmd", kind) as client:
        for cause, spoil, words in faults:
            message = good()
            message.crc = 1
            (spoil or (lambda message: None))(message)
            send = client.write_signed if spoil else client.write
            causes.add(cause)
            refused = eventually(lambda: send(message) or (
                (now := robot.status()["commands"]["refused"])[cause] and now))
            assert {key for key, count in refused.items() if count} == causes
            assert words in robot.heard(f"LowCmd ({cause})", "warning")["message"]
        assert robot.status()["commands"]["accepted"] == 0
        eventually(lambda: client.write_signed(good()) or robot.status()["commands"]["accepted"])


def test_a_stream_of_refusals_does_not_flood_the_log(play):
    robot = play("go2", "--released")
    message = go_command()
    with_head(message)
    with speaker("rt/lowcmd", GoLowCmd) as client:
        client.write_for(1.5, message, period=0.002)

    assert 1 <= sum("refused" in line["message"] for line in robot.log()) <= 3


def test_a_lenient_gate_counts_what_is_wrong_in_form_and_takes_it(play):
    robot = play("go2", "--released", "--set", "gate=lenient")
    message = go_command()
    with_head(message)
    with speaker("rt/lowcmd", GoLowCmd) as client:
        client.write_for(0.3, message)
        status = robot.becomes(lambda now: now["commands"]["accepted"])

    assert status["commands"]["refused"]["head"] > 0


def test_commands_that_stop_are_said_and_the_motors_damp(play):
    robot = play("go2", "--released")
    with speaker("rt/lowcmd", GoLowCmd) as client:
        client.write_for(0.5, go_command())
        robot.heard("the motors follow LowCmd", "info")
        status = robot.becomes(lambda now: now["commands"]["state"] == "damping")

    assert status["commands"]["timeouts"] >= 1
    robot.heard("LowCmd stopped", "warning")


def test_two_writers_of_commands_are_counted_and_said(play):
    robot = play("go2", "--released")
    with speaker("rt/lowcmd", GoLowCmd):
        robot.becomes(lambda now: now["commands"]["writers"] == 1)
        with speaker("rt/lowcmd", GoLowCmd):
            robot.becomes(lambda now: now["commands"]["writers"] == 2)
            robot.heard("2 programs write rt/lowcmd", "warning")
        robot.becomes(lambda now: now["commands"]["writers"] == 1)


def test_a_gain_in_a_slot_without_a_motor_is_counted_and_said(play):
    robot = play("go2", "--released")
    message = go_command()
    message.motor_cmd[15].kp = 10.0
    with speaker("rt/lowcmd", GoLowCmd) as client:
        client.write_for(0.3, message)
        status = robot.becomes(lambda now: now["commands"]["unused_slots"])

    assert status["commands"]["accepted"] > 0
    robot.heard("slots without a motor", "warning")


def test_an_unset_head_is_taken_counted_and_said(play):
    robot = play("go2", "--released")
    message = go_command()
    message.head = [0, 0]
    message.level_flag = 0
    with speaker("rt/lowcmd", GoLowCmd) as client:
        client.write_for(0.3, message)
        status = robot.becomes(lambda now: now["commands"]["unset_heads"])

    assert status["commands"]["accepted"] > 0
    assert not any(status["commands"]["refused"].values())
    robot.heard("without head and level_flag", "info")


def test_a_command_beside_a_motion_service_is_counted_and_explained(play):
    robot = play("go2")
    with speaker("rt/lowcmd", GoLowCmd) as client:
        client.write_for(0.3, go_command())
        status = robot.becomes(lambda now: now["commands"]["refused"]["motion_service"])

    assert status["commands"]["accepted"] == 0
    assert status["motion"]["service"] == "mcf"
    assert "ReleaseMode" in robot.heard("LowCmd (motion_service)", "warning")["message"]
