"""`--interface-name`: program and robot on a cable, as with a real robot, in a private network."""

import glob
import json
import os
import pathlib
import signal
import socket
import subprocess
import sys

import pytest

from robots import eventually

PROGRAMS = pathlib.Path(__file__).parents[1] / "conformance" / "programs"
USAGE, CONFIG, BUS = 2, 3, 5
ON_CABLE = ("--interface-name", "eth0")

# Has the card in its source, as many have: waits for a state, then commands until the robot says that it follows.
HARD_CODED = """
import json, os, subprocess, sys, time
from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelPublisher, ChannelSubscriber
from unitree_sdk2py.idl.default import unitree_go_msg_dds__LowCmd_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowCmd_, LowState_
from unitree_sdk2py.utils.crc import CRC

ChannelFactoryInitialize(0, "eth0")
states = ChannelSubscriber("rt/lowstate", LowState_)
states.Init()
publisher = ChannelPublisher("rt/lowcmd", LowCmd_)
publisher.Init()
assert states.Read(10).tick >= 0
command, crc = unitree_go_msg_dds__LowCmd_(), CRC()
command.head, command.level_flag = [0xFE, 0xEF], 0xFF
for motor in command.motor_cmd:
    motor.mode = 1
command.crc = crc.Crc(command)
deadline = time.monotonic() + 20
while time.monotonic() < deadline:
    publisher.Write(command)
    told = subprocess.run([os.environ["UNDERSTUDY"], "ctl", "status", "--json"], capture_output=True, text=True)
    if json.loads(told.stdout)["commands"]["accepted"] > 5:
        sys.exit(0)
sys.exit("no command arrived")
"""

# Prints what a program finds of the network: its interfaces with their addresses, whether the robot answers a ping,
# where a multicast goes that names no interface, and what it says of an address elsewhere.
LOOK = """
import fcntl, json, socket, struct

def told(request, name):
    return fcntl.ioctl(probe, request, struct.pack("256s", name.encode()))

def address(name):
    return socket.inet_ntoa(told(0x8915, name)[20:24])

probe = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
names = [name for _, name in socket.if_nameindex()]
multicast = {name: bool(struct.unpack_from("H", told(0x8913, name), 16)[0] & 0x1000) for name in names}
ping = socket.socket(socket.AF_INET, socket.SOCK_DGRAM, socket.IPPROTO_ICMP)
ping.settimeout(10)
ping.sendto(b"\\x08" + bytes(7) + b"hello", ("192.168.123.161", 0))
answer, who = ping.recvfrom(100)
probe.connect(("239.255.0.1", 7400))
source = probe.getsockname()[0]
try:
    socket.create_connection(("10.9.8.1", 80), 1)
    elsewhere = "reached"
except OSError as error:
    elsewhere = error.strerror
print(json.dumps({"addresses": {name: address(name) for name in names}, "multicast": multicast,
                  "ping": [answer[0], answer[8:].decode(), who[0]], "source": source, "elsewhere": elsewhere}))
"""


def run(command, **how):
    return subprocess.run(command, capture_output=True, text=True, timeout=60, check=False, **how)


def exec_command(*options, program):
    return [os.environ["UNDERSTUDY"], "exec", "go2", *options, "--", *map(str, program)]


@pytest.mark.parametrize("user", ["as_started", "as_nobody"])
def test_a_program_that_has_eth0_in_its_source_reads_states_and_commands(request, user):
    front = request.getfixturevalue("as_nobody") if user == "as_nobody" else []
    done = run([*front, *exec_command(*ON_CABLE, "--released", program=[sys.executable, "-B", "-c", HARD_CODED])])

    assert done.returncode == 0, done.stderr


def test_a_go2_stands_up_by_a_program_that_takes_eth0_for_a_robot():
    done = run(exec_command(*ON_CABLE, program=[sys.executable, PROGRAMS / "go2_stand.py", "eth0"]))

    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    assert done.stdout.rstrip().endswith("Done!")


@pytest.mark.parametrize("user", ["as_started", "as_nobody"])
def test_the_program_finds_its_card_its_address_and_a_robot_that_answers_a_ping(request, user):
    front = request.getfixturevalue("as_nobody") if user == "as_nobody" else []
    done = run([*front, *exec_command("--interface-name", "enp3s0", "--address", "192.168.123.222/24",
                                      program=[sys.executable, "-c", LOOK])])

    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == {
        "addresses": {"lo": "127.0.0.1", "enp3s0": "192.168.123.222"},
        "multicast": {"lo": False, "enp3s0": True},
        "ping": [0, "hello", "192.168.123.161"],
        "source": "192.168.123.222",
        "elsewhere": "Network is unreachable",
    }


def test_a_cable_and_a_robot_outside_do_not_hear_each_other(play):
    outside = play("go2", "--released")
    interfaces = socket.if_nameindex()
    done = [subprocess.Popen(exec_command(*ON_CABLE, "--released", program=[sys.executable, "-B", "-c", HARD_CODED]))
            for _ in range(2)]

    assert [one.wait(60) for one in done] == [0, 0]
    assert socket.if_nameindex() == interfaces
    status = outside.status()
    assert (status["silenced"], status["commands"]["accepted"], status["commands"]["writers"]) == (False, 0, 0)
    assert not any("rt/lowstate" in line["message"] for line in outside.log())


def test_nobody_is_listened_for_where_nobody_can_be():
    done = run(exec_command(*ON_CABLE, "--set", "guard.listen_network=60", program=["true"]))

    assert done.returncode == 0, done.stderr


def networks_of_processes():
    found = set()
    for path in glob.glob("/proc/[0-9]*/ns/net"):
        try:
            found.add(os.readlink(path))
        except OSError:
            pass  # it has ended
    return found


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_cable_is_asked_by_ctl_from_outside_and_leaves_nothing_when_it_is_stopped(understudy, runtime_dir, number):
    told = runtime_dir / "network"
    process = subprocess.Popen(
        exec_command(*ON_CABLE, "--name", "dog",
                     program=["sh", "-c", f"readlink /proc/self/ns/net > {told}; exec sleep 600"]),
        start_new_session=True)
    try:
        program = eventually(lambda: told.exists() and told.read_text().strip())
        robot = os.readlink(f"/proc/{process.pid}/ns/net")
        status = understudy("ctl", "--name", "dog", "status", "--json")
        assert json.loads(status.stdout)["ready"]
        assert len({program, robot, os.readlink("/proc/self/ns/net")}) == 3
        assert {program, robot} <= networks_of_processes()
        told.unlink()
        os.killpg(process.pid, number)
        assert process.wait(30) == 128 + number
        eventually(lambda: not {program, robot} & networks_of_processes())
    finally:
        process.kill()
        process.wait()
    assert list(runtime_dir.rglob("*")) == []


def test_a_rehearsal_has_a_cable_too_and_says_so_in_the_line_that_repeats_it(understudy, tmp_path):
    scenario = tmp_path / "reads.yaml"
    scenario.write_text("scenario: It reads\nrobot: go2\nsettings: {motion: {service: none}}\n"
                        "expect:\n  - eventually: program.exit_code is 0\n")
    done = understudy("rehearse", scenario, "--out", tmp_path / "told", *ON_CABLE, "--address", "192.168.123.7",
                      "--json", "--", sys.executable, "-B", "-c", HARD_CODED)

    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    assert f"{scenario} --interface-name eth0 --address 192.168.123.7 " in json.loads(done.stdout)["repeat"]


@pytest.mark.parametrize("command", [("exec", "go2"), ("rehearse", "stand_up")])
@pytest.mark.parametrize(("arguments", "code", "words"), [
    (["--interface-name", ""], USAGE, ["--interface-name", "''", "as in eth0"]),
    (["--interface-name", "lo"], USAGE, ["--interface-name", "'lo'", "as in eth0"]),
    (["--interface-name", "a/b"], USAGE, ["--interface-name", "'a/b'", "letters, digits"]),
    (["--interface-name", "a_name_too_long_"], USAGE, ["--interface-name", "'a_name_too_long_'", "up to 14"]),
    ([*ON_CABLE, "--address", "192.168.123.161"], USAGE, ["--address", "is the robot's", "192.168.123.99/24"]),
    ([*ON_CABLE, "--address", "10.0.0.1/24"], USAGE, ["--address", "'10.0.0.1/24'", "192.168.123.99/24"]),
    ([*ON_CABLE, "--address", "eth0"], USAGE, ["--address", "'eth0'", "192.168.123.99/24"]),
    (["--address", "192.168.123.99"], USAGE, ["--address", "--interface-name"]),
    ([*ON_CABLE, "--network", "host"], USAGE, ["--interface-name", "--network host"]),
    ([*ON_CABLE, "--set", "network.interface=eth1"], CONFIG, ["network.interface", "'eth1'", "'eth0'"]),
])
def test_an_end_of_a_cable_that_cannot_be_is_refused_with_what_can(understudy, tmp_path, command, arguments, code,
                                                                   words):
    done = understudy(*command, *arguments, "--", "true", cwd=tmp_path)

    assert done.returncode == code, done.stderr
    assert done.stdout == ""
    for word in words:
        assert word in done.stderr


def test_an_interface_beside_that_of_the_cable_is_refused(understudy):
    done = understudy("exec", "go2", *ON_CABLE, "--interface", "eth1", "--", "true")

    assert done.returncode == USAGE
    assert "--interface" in done.stderr


def test_where_the_machine_allows_no_network_the_line_names_the_setting_and_the_way_out():
    """In a user namespace that may have no further network."""
    done = run(["unshare", "--user", "--map-root-user", "sh", "-c",
                'echo 0 > /proc/sys/user/max_net_namespaces && exec "$@"', "sh",
                *exec_command(*ON_CABLE, program=["true"])])

    assert done.returncode == BUS, done.stderr
    assert "user.max_net_namespaces" in done.stderr
    assert "--network host" in done.stderr
