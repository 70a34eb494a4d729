"""`understudy doctor`: each fault is made, and told with what to do about it."""

import contextlib
import json
import os
import subprocess
import sys
import threading

import pytest
from cyclonedds.domain import DomainParticipant
from cyclonedds.qos import Policy, Qos
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

from desk import ROOT
from namespaces import cable, host_on_a_bad_cable, host_on_a_cable, ip
from peers import GoLowCmd, GoLowState, HgLowCmd, go_state, join, listener, speaker, stranger
from robots import understudy

UNFIT = 12
HERE = ("veth0", "192.168.123.99/24")
THERE = ("veth1", "192.168.123.222/24")


def examine(*options, seconds=0.3):
    """Runs the doctor; gives its rows by name. Its exit code is that of its rows."""
    done = understudy("doctor", "--json", "--seconds", seconds, *options)
    report = json.loads(done.stdout)
    wrong = [row for row in report["checks"] if row["verdict"] == "wrong"]
    assert done.returncode == (UNFIT if wrong else 0), done.stdout
    assert all(row["remedy"] for row in wrong)
    return {row["name"]: row for row in report["checks"]}


def verdicts(rows, *names):
    return [rows[name]["verdict"] for name in names]


ECHO = [os.environ["UNDERSTUDY"], "doctor", "--echo"]
ECHO_OF_ONE_FILE = [sys.executable, ROOT / "examples" / "python" / "doctor_echo.py"]


@contextlib.contextmanager
def echo(there, program=ECHO):
    """An echo on the other host, by the name of far; gives the process."""
    with subprocess.Popen([*there, *program, "--interface", THERE[0], "--as", "far"], stdout=subprocess.PIPE,
                          text=True) as process:
        try:
            assert process.stdout.readline().startswith("far answers on veth1, domain 0")
            yield process
        finally:
            if process.poll() is None:
                process.terminate()
                process.communicate()


def test_where_nothing_is_wrong_it_says_so_in_a_line_for_each_check():
    rows = examine()
    assert "wrong" not in [row["verdict"] for row in rows.values()]
    assert verdicts(rows, "interface", "address", "multicast", "multicast route", "multicast here", "domain", "robots",
                    "types", "quality") == ["ok"] * 9

    lines = understudy("doctor", "--seconds", 0.2).stdout.splitlines()
    assert len(lines) == len(rows) + 1
    column = lines[0].index("interface")
    assert [line[column:].startswith(name) for line, name in zip(lines, rows)] == [True] * len(rows)


def test_an_interface_that_is_missing_down_or_without_address_or_carrier_is_wrong():
    rows = examine("--interface", "veth00")
    assert rows["interface"]["verdict"] == "wrong"
    with cable(("veth0", "10.9.8.1/24"), ("veth1", "10.9.7.2/24")):
        assert "did you mean 'veth0'?" in examine("--interface", "veth00")["interface"]["remedy"]
        rows = examine("--interface", "veth0")
        assert verdicts(rows, "interface", "address", "domain") == ["ok", "warning", "ok"]
        assert "multicast route" in rows and rows["multicast route"]["verdict"] == "warning"  # it leads to lo
        ip("link", "set", "veth0", "multicast", "off")
        assert examine("--interface", "veth0")["multicast"]["verdict"] == "wrong"
        ip("address", "add", "10.9.8.3/24", "dev", "veth1")
        assert "veth1 (10.9.8.3/24)" in examine("--interface", "veth0")["address"]["finding"]
        ip("address", "flush", "dev", "veth0")
        assert verdicts(examine("--interface", "veth0"), "address", "domain") == ["wrong", "wrong"]
        ip("link", "set", "veth1", "down")
        assert "no carrier" in examine("--interface", "veth0")["interface"]["finding"]
        ip("link", "set", "veth0", "down")
        assert "is down" in examine("--interface", "veth0")["interface"]["finding"]


@pytest.mark.parametrize("program", [ECHO, ECHO_OF_ONE_FILE], ids=["the program", "one file of Python"])
@pytest.mark.parametrize(("peer", "messages"), [("far", "go"), ("192.168.123.222", "hg")])
def test_a_peer_on_a_good_cable_answers_each_way(peer, messages, program):
    with host_on_a_cable(HERE, THERE) as there, echo(there, program):
        rows = examine("--interface", "veth0", "--peer", peer, "--messages", messages)

    assert verdicts(rows, "interface", "address", "peer", "peer unicast", "peer multicast", "from peer",
                    "firewall") == ["ok"] * 7
    figures = rows["round trip"]["figures"]
    assert figures["sent"] > 10
    assert figures["lost"] < figures["sent"] / 10
    assert 0 < figures["p50"] <= figures["p99"] <= figures["worst"]
    assert messages in rows["round trip"]["finding"]
    offset = rows["clock offset"]["figures"]  # both have one clock
    assert abs(offset["ahead"]) <= offset["error"] + 1e-3


def test_a_delay_is_measured():
    with host_on_a_bad_cable(HERE, THERE, delay=0.03) as there, echo(there):
        rows = examine("--interface", "veth0", "--peer", "far")

    assert verdicts(rows, "peer", "peer unicast", "round trip") == ["ok", "ok", "wrong"]
    assert rows["round trip"]["figures"]["p50"] >= 0.06


def test_a_loss_is_measured_in_what_is_as_large_as_commands():
    with host_on_a_bad_cable(HERE, THERE, loss=0.1) as there, echo(there):
        rows = examine("--interface", "veth0", "--peer", "far", seconds=1)

    assert verdicts(rows, "peer unicast", "peer multicast", "round trip") == ["ok", "ok", "wrong"]
    figures = rows["round trip"]["figures"]
    assert 0.1 < figures["lost"] / figures["sent"] < 0.7  # 0.19 there and back, and more: docs/reference/doctor.md


def test_a_network_without_multicast_is_told_from_a_firewall_and_from_a_peer_that_is_not_there():
    with host_on_a_bad_cable(HERE, THERE, multicast=False) as there, echo(there):
        rows = examine("--interface", "veth0", "--peer", "192.168.123.222")

    assert verdicts(rows, "multicast here", "peer", "peer unicast", "peer multicast", "from peer") == [
        "ok", "wrong", "ok", "wrong", "wrong"]
    assert "IGMP" in rows["peer multicast"]["remedy"]


@contextlib.contextmanager
def firewall(*rule, there=()):
    """Packets of that rule are dropped, here or on the other host."""
    def change(verb):
        subprocess.run([*there, "iptables", verb, *rule, "-j", "DROP"], check=True, timeout=10)

    change("-A")
    try:
        yield
    finally:
        change("-D")


def test_a_firewall_that_forbids_to_send_is_told_and_holds_nobody_up(play):
    with host_on_a_cable(HERE, THERE) as there, echo(there), firewall("OUTPUT", "-p", "udp"):
        rows = examine("--interface", "veth0", "--peer", "192.168.123.222")
        robot = play("go2", "--duration", "0.1", ready=False)
        assert robot.exit_code() == 0

    assert verdicts(rows, "peer unicast", "peer multicast", "firewall") == ["wrong"] * 3
    assert "forbids it to send" in rows["firewall"]["finding"]


def test_a_firewall_of_the_peer_is_told(play):
    with host_on_a_cable(HERE, THERE) as there, echo(there), \
            firewall("INPUT", "-p", "udp", "--dport", "7530", there=there):
        rows = examine("--interface", "veth0", "--peer", "far")

    assert verdicts(rows, "peer", "peer unicast", "firewall") == ["ok", "wrong", "wrong"]


def test_a_host_without_an_echo_is_told_with_the_command_to_run_there():
    with host_on_a_cable(HERE, THERE):
        rows = examine("--interface", "veth0", "--peer", "192.168.123.222")

    assert verdicts(rows, "peer", "peer unicast", "round trip") == ["wrong", "wrong", "not seen"]
    assert "no echo runs on it" in rows["peer unicast"]["finding"]
    assert "understudy doctor --echo --domain 0" in rows["peer unicast"]["remedy"]


def test_one_robot_is_wanted_or_not_and_is_not_disturbed(play):
    robot = play("go2")
    with listener("rt/lowcmd", GoLowCmd) as commands:
        wanted = examine("--robots", 1)
        assert commands.take() == []
    unwanted = examine("--robots", 0)
    undecided = examine()

    assert [rows["robots"]["verdict"] for rows in (wanted, unwanted, undecided)] == ["ok", "wrong", "warning"]
    assert f"process {robot.pid} (understudy)" in wanted["robots"]["finding"]
    assert wanted["types"]["verdict"] == "ok"
    assert wanted["quality"]["verdict"] == "ok"
    assert wanted["states"]["figures"]["rate"] > 50
    status = robot.status()
    assert not status["silenced"]
    assert status["commands"]["accepted"] == 0 and not any(status["commands"]["refused"].values())
    assert not [line for line in robot.log() if line["level"] != "info" and "process" in line["message"]]


def test_two_robots_are_wrong():
    with stranger() as one, stranger() as other:
        stop = threading.Event()

        def speak():
            while not stop.wait(0.01):
                one.write(go_state())
                other.write(go_state())

        thread = threading.Thread(target=speak)
        thread.start()
        try:
            rows = examine()
        finally:
            stop.set()
            thread.join()

    assert rows["robots"]["verdict"] == "wrong"
    assert rows["robots"]["figures"]["speaking"] == 2


def test_types_and_quality_that_are_not_the_vendors_are_told_with_their_process():
    join(0)
    participant = DomainParticipant(0)
    keeps = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.Durability.TransientLocal)
    reader = DataReader(participant, Topic(participant, "rt/lowstate", GoLowState), qos=keeps)
    with speaker("rt/lowcmd", GoLowState), speaker("lowcmd", HgLowCmd):
        rows = examine()
    del reader, participant

    assert verdicts(rows, "types", "quality") == ["wrong", "wrong"]
    assert f"rt/lowcmd: process {os.getpid()}" in rows["types"]["finding"]
    assert "instead of unitree_go::msg::dds_::LowCmd_ or unitree_hg" in rows["types"]["finding"]
    assert "is rt/lowcmd meant?" in rows["types"]["finding"]
    assert "durability above volatile" in rows["quality"]["finding"]


@pytest.mark.parametrize("options", [["--seconds", "nan"], ["--seconds", "0"], ["--domain", "233"], ["--robots", "-1"],
                                     ["--messages", "go"], ["--as", "far"], ["--echo", "--peer", "far"]])
def test_a_command_line_that_is_none_is_refused(understudy, options):
    assert understudy("doctor", *options).returncode == 2


@pytest.mark.parametrize("program", [ECHO, ECHO_OF_ONE_FILE], ids=["the program", "one file of Python"])
def test_an_echo_without_a_network_ends_as_every_command_does(program):
    done = subprocess.run([*program, "--interface", "none"], capture_output=True, text=True, timeout=20)

    assert done.returncode == 5
    assert "none" in done.stderr


@pytest.mark.parametrize("program", [ECHO, ECHO_OF_ONE_FILE], ids=["the program", "one file of Python"])
def test_an_echo_ends_when_it_is_told_to_and_says_how_much_it_answered(program):
    with host_on_a_cable(HERE, THERE) as there, echo(there, program) as process:
        sent = examine("--interface", "veth0", "--peer", "far")["round trip"]["figures"]["sent"]
        process.terminate()
        rest, _ = process.communicate()

    assert process.wait() == 0
    words = rest.split()
    assert words[0] == "answered" and int(words[1]) > sent / 2
