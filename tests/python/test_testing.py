"""understudy.robot: a real daemon in a private network for tests of pytest."""

import pathlib
import subprocess
import sys
import textwrap

import pytest

import understudy


def test_claims_are_judged_in_the_words_of_rehearse(understudy_robot):
    robot = understudy_robot("go2")
    assert robot.wait("base.height > 0.3", within=5).margin > 0
    verdict = robot.always("base.tilt < 10 deg", during=1)
    assert verdict and verdict.outcome == "passed" and "base.tilt was" in verdict.why
    assert not robot.always("base.height > 2", during=0.5)
    assert robot.never("push happens", during=0.5)
    robot.ctl("push", "base_link", 0, 60, 0, "--for", 0.1)
    assert [event["kind"] for event in robot.events].count("push") == 1 and not robot.refused
    with pytest.raises(AssertionError, match="eventually base.height > 2"):
        robot.wait("base.height > 2", within=0.5)
    with pytest.raises(understudy.Error, match="base.hieght.*did you mean 'base.height'"):
        robot.wait("base.hieght > 2")


def test_a_program_runs_in_the_robots_network_and_its_output_is_waited_for(understudy_robot):
    robot = understudy_robot("go2", released=True, start="standing")
    program = robot.run([sys.executable, "-uc", "import os,time; print(os.environ['WHO'], os.listdir('/sys/class/net')); time.sleep(60)"],
                        env={"WHO": "me"})  # fmt: skip
    robot.wait('the program prints "me"', within=20)
    assert program.exit_code is None
    program.stop()
    assert program.wait(within=20) == -15
    assert robot.run(["sh", "-c", "exit 3"]).wait(within=20) == 3
    with pytest.raises(understudy.Error, match="no-such-program"):
        robot.run(["no-such-program"])


def test_networks_are_private_so_that_two_robots_do_not_meet(understudy_robot):
    one, other = understudy_robot("go2"), understudy_robot("go2")
    namespaces = [robot.run(["readlink", "/proc/self/ns/net"]) for robot in (one, other)]
    assert [program.wait(within=20) for program in namespaces] == [0, 0]
    assert len({program.output for program in namespaces}) == 2


def test_a_robot_that_does_not_start_tells_why():
    with pytest.raises(understudy.Error, match="did you mean 'go2'"):
        understudy.robot("go3")


def test_nothing_is_left_when_the_block_ends():
    with understudy.robot("go2") as robot:
        folder, pid = robot.folder, robot._process.pid
        robot.run(["sleep", "600"])
    assert not folder.exists() and not pathlib.Path(f"/proc/{pid}").exists()


def test_the_tests_of_a_user_run_side_by_side(tmp_path):
    (tmp_path / "test_mine.py").write_text(
        textwrap.dedent("""
            import pytest

            @pytest.mark.parametrize("number", range(2))
            def test_it_stands(understudy_robot, number):
                robot = understudy_robot("go2")
                assert robot.always("base.tilt < 10 deg", during=0.5)
        """)
    )
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-n", "2", "-p", "no:cacheprovider", "test_mine.py"], cwd=tmp_path,
        capture_output=True, text=True, timeout=120,
    )  # fmt: skip
    assert done.returncode == 0 and "2 passed" in done.stdout, done.stdout + done.stderr
