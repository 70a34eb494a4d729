"""A robot on one machine and a program on another, as with a real robot on its cable."""

import pathlib
import subprocess
import sys

from namespaces import cable, host_on_a_cable

PROGRAMS = pathlib.Path(__file__).parents[1] / "conformance" / "programs"
ROBOT = ("veth0", "192.168.123.161/24")  # the addresses that the vendor's manuals give
PROGRAM = ("veth1", "192.168.123.222/24")


def test_a_program_on_another_machine_stands_a_go2_up(play):
    with host_on_a_cable(ROBOT, PROGRAM) as there:
        robot = play("go2", "--interface", "veth0")
        done = subprocess.run([*there, sys.executable, PROGRAMS / "go2_stand.py", "veth1"],
                              capture_output=True, text=True, timeout=40)
        commands = robot.status()["commands"]
        robot.end()

    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}\n{robot.command}"
    assert done.stdout.rstrip().endswith("Done!")
    assert commands["accepted"] > 1000
    assert not any(commands["refused"].values())


def test_a_robot_on_another_machine_is_named_with_its_address(play, understudy):
    with host_on_a_cable(ROBOT, PROGRAM) as there:
        play("go2", "--interface", "veth1", here=there)
        done = understudy("run", "go2", "--interface", "veth0")

    assert done.returncode == 6
    assert "192.168.123.222" in done.stderr


def test_an_interface_that_is_down_or_has_no_address_is_refused(understudy):
    with cable(("veth0", "10.9.8.1/24"), ("veth1", "10.9.8.2/24")):
        subprocess.run(["ip", "address", "flush", "dev", "veth0"], check=True)
        addressless = understudy("run", "go2", "--interface", "veth0")
        subprocess.run(["ip", "link", "set", "veth0", "down"], check=True)
        down = understudy("run", "go2", "--interface", "veth0")

    assert (addressless.returncode, down.returncode) == (5, 5)
    assert "no IPv4 address" in addressless.stderr
    assert "down" in down.stderr
