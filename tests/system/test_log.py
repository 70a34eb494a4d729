"""The log of a run."""

import fcntl
import json
import os
import pty
import re
import select
import signal
import subprocess
import time

import pytest

import namespaces
from peers import GoLowState as GoState
from peers import GoLowCmd, go_command, listener, speaker


@pytest.fixture(name="stuck")
def stuck_fixture():
    """A pipe that is full and that nobody reads: (reading end, writing end)."""
    reading, writing = os.pipe()
    room = fcntl.fcntl(writing, fcntl.F_SETPIPE_SZ, 4096)
    os.write(writing, b"x" * room)
    yield reading, writing
    os.close(reading)
    os.close(writing)


def test_a_log_that_nobody_reads_does_not_hold_up_the_end(play, stuck):
    robot = play("go2", stderr=stuck[1])
    robot.ctl("pause")

    robot.send(signal.SIGTERM)

    assert robot.exit_code(2) == 0


def test_exec_returns_the_commands_code_at_once_although_nobody_reads_its_log(stuck, tmp_path):
    ended = tmp_path / "ended"
    done = subprocess.run([os.environ["UNDERSTUDY"], "exec", "go2", "--log-level", "info", "--",
                           "sh", "-c", f"touch {ended}; exit 7"], stderr=stuck[1], timeout=10)

    assert time.time() - ended.stat().st_mtime < 1
    assert done.returncode == 7


def test_states_commands_and_calls_go_on_although_nobody_reads_the_log(play, stuck):
    robot = play("go2", "--released", stderr=stuck[1])
    good, bad = go_command(), go_command()
    with listener() as ear, speaker("rt/lowcmd", GoLowCmd) as client:
        ear.wait()
        for _ in range(100):  # each of the second a line for the log
            client.write_signed(good)
            client.write(bad)
            time.sleep(0.01)
        counts = robot.becomes(lambda now: now["commands"]["accepted"] > 50)["commands"]
        heard = len(ear.take())

    assert counts["refused"]["crc"] > 50
    assert heard > 200
    robot.ctl("service", "call", "motion_switcher", "1001")


def test_a_full_pipe_that_cannot_be_opened_anew_does_not_hold_up_the_end_either(stuck):
    os.fchmod(stuck[1], 0)  # as another user's, after `su`
    command = [os.environ["UNDERSTUDY"], "run", "go2", "--duration", "0.3"]
    if os.geteuid() == 0:  # whom modes do not hold back
        command = ["setpriv", "--bounding-set", "-dac_override,-dac_read_search", *command]

    assert subprocess.run(command, stderr=stuck[1], timeout=10, check=False).returncode == 0


def test_lines_that_nobody_read_are_counted_and_told_once_somebody_reads(play, stuck):
    robot = play("go2", stderr=stuck[1])
    robot.ctl("pause")
    time.sleep(0.5)
    assert set(os.read(stuck[0], 4096)) == {ord("x")}

    robot.ctl("resume")
    time.sleep(0.5)

    said = os.read(stuck[0], 65536).decode()
    assert re.search(r"[1-9]\d* lines of the log could not be written", said)
    assert "resumed at" in said


def screen_of(play, *options, seconds):
    """What a run whose stderr is a terminal has drawn there after some seconds."""
    ours, theirs = pty.openpty()
    robot = play("go2", *options, json_log=False, stderr=theirs)
    os.close(theirs)
    drawn = b""
    deadline = time.monotonic() + seconds
    while (left := deadline - time.monotonic()) > 0:
        if select.select([ours], [], [], left)[0]:
            drawn += os.read(ours, 65536)
    robot.end()
    os.close(ours)
    return drawn.decode()


def test_with_json_every_line_of_the_log_is_an_object(play):
    robot = play("go2", "--duration", "0.3", ready=False)
    robot.exit_code()
    lines = robot.said().splitlines()

    assert len(robot.log()) == len(lines) > 0
    for line in robot.log():
        assert line["level"] in ("info", "warning", "error", "critical")
        assert line["message"]
        assert abs(line["time"] - time.time()) < 60


@pytest.mark.parametrize("arguments", [
    ["run"],
    ["run", "gp2"],
    ["run", "go2", "--strat", "lying"],
    ["run", "go2", "--domain", "233"],
    ["run", "go2", "--set", "gate.tiemout=1"],
    ["run", "go2", "--scene", "flt"],
    ["run", "go2", "--interface", "l0"],
    ["run", "go2", "--name", "../x"],
    ["run", "go2", "--set", "robot.model=/none/no.xml"],
    ["exec", "go2", "--", "/none/such"],
    ["exec", "go2"],
    ["play", "/none.mcap"],
    ["ctl", "stauts"],
    ["ctl", "status"],
])
def test_with_json_what_goes_wrong_before_the_log_begins_is_an_object_too(understudy, arguments):
    command, *rest = arguments
    done = understudy(command, *([] if command == "ctl" else ["--json"]), *rest,
                      *(["--json"] if command == "ctl" else []))

    assert done.returncode != 0
    lines = [json.loads(line) for line in done.stderr.splitlines()]
    assert lines and all(line["message"] and line["level"] for line in lines)


def test_with_json_a_window_that_does_not_open_says_so_in_an_object(play):
    robot = play("go2", "--view", "--duration", "1", ready=False,
                 env={key: value for key, value in os.environ.items()
                      if key not in ("DISPLAY", "WAYLAND_DISPLAY")})
    robot.exit_code()

    assert len(robot.log()) == len(robot.said().splitlines())


def test_with_json_names_from_the_network_stay_in_their_line(play):
    robot = play("go2")
    with speaker("rt/api/sport/request", GoState):
        said = robot.heard("nothing arrives on rt/api/sport/request", "warning")["message"]

    assert "type unitree_go::msg::dds_::LowState_" in said
    assert robot.becomes(lambda status: status["services"]["refused"]["unmatched"] == 1)
    assert len(robot.log()) == len(robot.said().splitlines())


def test_the_log_says_where_the_robot_is(play):
    said = play("go2").heard("is on", "info")["message"]

    assert "go2 is on lo, domain 0" in said
    assert ".sock" in said


def test_a_log_level_holds_back_what_is_below_it(play):
    robot = play("go2", "--log-level", "error", "--duration", "0.2", ready=False)
    robot.exit_code()

    assert robot.log() == []


def test_a_terminal_gets_a_status_line(play):
    drawn = screen_of(play, seconds=1.6)

    assert re.search(r"\r\x1b\[K[\d.]+ s  x[\d.]+  LowState \d+/s of \d+", drawn)


def test_a_file_gets_no_status_line(play):
    robot = play("go2", "--duration", "1.2", "--speed", "1", json_log=False, ready=False)
    robot.exit_code()

    assert "\r" not in robot.said()
    assert "\x1b" not in robot.said()
    assert "LowState" not in robot.said()


@pytest.fixture(name="without_multicast")
def without_multicast_fixture():
    """Two interfaces that have none: lo, and eth0 on a cable."""
    with namespaces.cable(("eth0", "192.168.123.1/24"), ("far", "192.168.123.222/24")):
        for name in ("lo", "eth0"):
            namespaces.ip("link", "set", name, "multicast", "off")
        yield
        namespaces.ip("link", "set", "lo", "multicast", "on")


def test_it_tells_of_missing_multicast_where_nobody_would_find_the_robot_and_not_on_lo(play, understudy,
                                                                                      without_multicast):
    on_a_cable = play("go2", "--interface", "eth0")
    on_a_cable.heard("eth0 has no multicast, so programs on other machines do not find this robot", "warning")
    assert "multicast" not in play("go2", "--interface", "lo", "--domain", 1).said()
    assert "multicast" not in understudy("run", "go3").stderr
