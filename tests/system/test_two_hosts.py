"""A robot on one machine and a program on another, as with a real robot on its cable."""

import pathlib
import re
import subprocess
import sys

import pytest

from namespaces import cable, host_on_a_cable, ip

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
    # Those that newer ones replace before a late tick are lost, as on a busy machine.
    assert {cause for cause, count in commands["refused"].items() if count} <= {"lost"}


OFFICE = ("veth0", "10.0.0.7/24")  # not in a robot's network


def addresses_of(interface):
    return ip("-4", "-brief", "address", "show", "dev", interface)


def test_a_card_has_the_robots_address_while_the_run_lasts(play):
    with host_on_a_cable(OFFICE, PROGRAM) as there:
        robot = play("go2", "--interface", "veth0", "--as-robot")
        during = addresses_of("veth0")
        done = subprocess.run([*there, sys.executable, PROGRAMS / "go2_stand.py", "veth1"],
                              capture_output=True, text=True, timeout=40)
        robot.end()
        after = addresses_of("veth0")

    assert done.returncode == 0, f"{done.stdout}\n{done.stderr}"
    assert "10.0.0.7/24 192.168.123.161/24" in during
    assert "10.0.0.7/24" in after and "192.168" not in after


def test_the_kernel_takes_the_robots_address_back_from_a_run_that_was_killed(play):
    with host_on_a_cable(OFFICE, PROGRAM):
        robot = play("go2", "--interface", "veth0", "--as-robot")
        robot.process.kill()
        robot.process.wait()
        left = ip("address", "show", "dev", "veth0")

    seconds = re.search(r"192.168.123.161/24.*\n +valid_lft (\d+)sec", left)
    assert seconds and int(seconds[1]) <= 60, left


@pytest.mark.parametrize(("ours", "theirs", "card", "words"), [
    (OFFICE, ("veth1", ROBOT[1]), "veth0", "answers to it: take the real robot off the cable"),
    (ROBOT, PROGRAM, "veth0", "veth0 has it already"),
    (OFFICE, PROGRAM, "veth1", "did you mean 'veth0'?"),
])
def test_the_robots_address_is_not_taken_from_another(understudy, ours, theirs, card, words):
    with host_on_a_cable(ours, theirs):
        done = understudy("run", "go2", "--interface", card, "--as-robot")
        after = addresses_of("veth0")

    assert done.returncode == 5 and words in done.stderr, done.stderr
    assert ours[1] in after and after.count("/") == 1


@pytest.mark.parametrize("words", [["go2"], ["go2", "g1", "--interface", "veth0"]])
def test_lo_and_several_robots_do_not_get_the_robots_address(understudy, words):
    assert understudy("run", *words, "--as-robot").returncode == 3


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
