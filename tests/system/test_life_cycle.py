"""Start and end of a robot, and how `ctl` finds it in between."""

import contextlib
import fcntl
import json
import os
import re
import signal
import subprocess
import time

import pytest

from robots import eventually, understudy

SOON = 2.0  # s
SOCKET = 8


def sockets(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_stop_signal_ends_a_run_in_good_order(play, runtime_dir, number):
    robot = play("go2")
    assert sockets(runtime_dir) == [f"{robot.name}.sock"]

    robot.send(number)

    assert robot.exit_code(SOON) == 0
    assert sockets(runtime_dir) == []
    robot.heard("left the network")


def test_a_stop_signal_ends_a_start_that_waits_for_the_lock_of_the_folder(play, runtime_dir):
    descriptor = os.open(runtime_dir, os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        robot = play("go2", ready=False)
        time.sleep(4)
        assert not sockets(runtime_dir)
        robot.send(signal.SIGTERM)
        assert robot.exit_code(SOON) == SOCKET
        assert "holds the lock" in robot.said()
    finally:
        os.close(descriptor)


def test_ctl_stop_ends_the_robot_that_is_named_in_good_order_and_no_other(play, runtime_dir):
    left, right = play("go2", name="left"), play("go2", "--domain", "1", name="right")

    left.ctl("stop")

    assert left.exit_code(SOON) == 0
    left.heard("left the network")
    assert sockets(runtime_dir) == ["right.sock"]
    assert right.status()["ready"]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_stop_signal_ends_a_run_that_is_as_fast_as_possible(play, number):
    robot = play("go2", "--speed", "max")

    robot.send(number)

    assert robot.exit_code(SOON) == 0


def test_a_run_under_nohup_outlives_its_terminal(play):
    robot = play("go2", here=("nohup",))

    robot.send(signal.SIGHUP)

    assert robot.status()["ready"]


def test_a_hangup_ends_exec_and_its_command(runtime_dir):
    command = [os.environ["UNDERSTUDY"], "exec", "go2", "--", "sleep", "60"]
    with subprocess.Popen(command, stderr=subprocess.PIPE) as process:
        eventually(lambda: sockets(runtime_dir))
        time.sleep(1)  # the command starts after the robot
        process.send_signal(signal.SIGHUP)

        assert process.wait(5) == 128 + signal.SIGTERM
    assert sockets(runtime_dir) == []


def test_a_run_ends_by_itself_after_its_duration(play, runtime_dir):
    robot = play("go2", "--duration", "1.5", "--speed", "3", ready=False)

    assert robot.exit_code() == 0
    assert sockets(runtime_dir) == []
    ended = robot.heard("left the network")["message"]
    assert float(re.search(r"after ([\d.]+) simulated", ended)[1]) == 1.5


def test_a_killed_run_leaves_nothing_that_list_shows(play, understudy, runtime_dir):
    robot = play("go2")
    robot.send(signal.SIGKILL)
    robot.exit_code()
    assert sockets(runtime_dir) == [f"{robot.name}.sock"]

    assert understudy("ctl", "list", "--json").stdout.strip() == "[]"
    assert sockets(runtime_dir) == []


def test_a_killed_runs_name_is_free_for_the_next(play, runtime_dir):
    robot = play("go2")
    robot.send(signal.SIGKILL)
    robot.exit_code()

    again = play("go2", name=robot.name)

    assert again.status()["pid"] == again.pid


def test_a_name_in_use_is_refused_and_its_robot_goes_on(play, understudy):
    robot = play("go2")

    second = understudy("run", "go2", "--name", robot.name, "--domain", "1")

    assert second.returncode == SOCKET
    assert f"in use by process {robot.pid}" in second.stderr
    assert "another --name" in second.stderr
    assert robot.status()["ready"]


def test_a_name_that_leads_out_of_the_folder_is_refused(understudy):
    done = understudy("run", "go2", "--name", "../robot")

    assert done.returncode == SOCKET
    assert "../robot" in done.stderr


def test_the_command_of_exec_finds_its_robot_without_a_name(play, understudy):
    play("go2")
    done = understudy("exec", "g1", "--", "sh", "-c", "$UNDERSTUDY ctl status --json")

    assert done.returncode == 0, done.stderr
    assert '"robot":"g1"' in done.stdout


def test_a_reader_of_the_log_that_goes_away_does_not_end_the_run(play):
    reading, writing = os.pipe()
    robot = play("go2", stderr=writing, stdin=subprocess.DEVNULL)
    os.close(writing)
    os.close(reading)

    robot.ctl("status")
    steps = robot.status()["steps"]
    understudy_refuses_a_bad_order(robot)

    assert robot.becomes(lambda status: status["steps"] > steps + 200)["ready"]


def understudy_refuses_a_bad_order(robot):
    """Lowering a crane that holds nothing."""
    with pytest.raises(AssertionError, match="does not hang"):
        robot.ctl("crane", "lower", "0.1")


@pytest.mark.parametrize("closed", ["0<&-", "1>&-", "2>&-", "0<&- 1>&- 2>&-"])
def test_a_run_without_standard_streams_goes_on(runtime_dir, play, closed):
    shell = ["sh", "-c", f'exec "$@" {closed}', "closed"]
    robot = play("go2", here=shell)

    assert robot.becomes(lambda status: status["steps"] > 300)["write_failures"] == 0
    targets = [os.readlink(f"/proc/{robot.pid}/fd/{number}") for number in (0, 1, 2)]
    assert not any(target.startswith("socket:") for target in targets)
    robot.send(signal.SIGTERM)
    assert robot.exit_code(SOON) == 0


def test_exec_hands_a_stop_signal_to_its_command(runtime_dir):
    with subprocess.Popen(
            [os.environ["UNDERSTUDY"], "exec", "go2", "--", "sh", "-c",
             "trap 'exit 7' TERM; touch $UNDERSTUDY_RUNTIME_DIR/on; while :; do sleep 0.05; done"],
    ) as process:
        eventually((runtime_dir / "on").exists)
        process.terminate()
        assert process.wait(5) == 7


def test_nothing_that_exec_started_outlives_a_killed_exec(runtime_dir):
    process = subprocess.Popen([os.environ["UNDERSTUDY"], "exec", "go2", "--", "sh", "-c",
                                "echo $$ > $UNDERSTUDY_RUNTIME_DIR/pid; exec sleep 60"])
    file = runtime_dir / "pid"
    pid = eventually(lambda: file.exists() and file.read_text().strip())
    process.kill()
    process.wait()

    eventually(lambda: not os.path.exists(f"/proc/{pid}") or
               "\nState:\tZ" in open(f"/proc/{pid}/status").read())


def test_a_run_that_fails_to_start_leaves_no_socket(understudy, runtime_dir):
    assert understudy("run", "go2", "--interface", "none").returncode == 5
    assert sockets(runtime_dir) == []


@pytest.fixture
def behind(monkeypatch, tmp_path):
    """Runs `understudy run go2 --detach ...`; what is left is ended."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    pids = []

    def run(*options):
        done = understudy("run", "go2", "--detach", *options)
        pids.extend(map(int, re.findall(r"process (\d+)", done.stdout)))
        return done

    yield run
    for pid in pids:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


def test_a_run_in_the_background_is_left_when_it_is_ready(behind, runtime_dir, tmp_path):
    done = behind("--name", "dog")
    assert done.returncode == 0, done.stderr
    assert sockets(runtime_dir) == ["dog.sock"]
    status = json.loads(understudy("ctl", "--name", "dog", "status", "--json").stdout)
    assert status["ready"]
    assert status["log"] == str(tmp_path / "understudy" / "dog.log")
    assert str(status["pid"]) in done.stdout and status["log"] in done.stdout
    assert os.getsid(status["pid"]) == status["pid"]  # a closed terminal is none of its business

    assert "go2 is on lo" in understudy("ctl", "log").stdout
    with subprocess.Popen([os.environ["UNDERSTUDY"], "ctl", "log", "--follow"], stdout=subprocess.PIPE,
                          text=True) as follower:
        assert follower.stdout.readline()  # it has found the robot
        assert understudy("ctl", "stop").returncode == 0
        said, _ = follower.communicate(timeout=10)
    assert follower.returncode == 0
    assert "left the network" in said.splitlines()[-1]
    assert sockets(runtime_dir) == []


def test_a_run_in_the_background_that_cannot_start_says_why(behind):
    for options, code, why in ((["--set", "network.interface=nosuch0"], 5, "nosuch0"),
                               (["--set", "gate=nosuch"], 3, "gate.mode"),
                               (["--name", "../x"], SOCKET, "../x")):
        done = behind(*options)
        assert (done.returncode, done.stdout) == (code, ""), done.stderr
        assert why in done.stderr


def test_a_run_in_the_background_leaves_the_log_of_another_of_its_name_alone(behind):
    behind("--name", "dog")
    before = understudy("ctl", "log").stdout
    done = behind("--name", "dog", "--domain", "3")
    assert done.returncode == SOCKET
    assert "another --name" in done.stderr
    assert understudy("ctl", "log").stdout == before


def test_a_run_in_the_background_removes_logs_that_nobody_has_written_for_long(behind, tmp_path):
    folder = tmp_path / "understudy"
    folder.mkdir()
    old, young, other = folder / "old.log", folder / "young.log", folder / "old.txt"
    for path, days in ((old, 15), (young, 13), (other, 15)):
        path.write_text("")
        os.utime(path, (time.time() - days * 86400,) * 2)
    behind("--name", "dog")
    assert not old.exists()
    assert young.exists() and other.exists()


def test_a_run_that_keeps_no_log_says_where_it_is(play):
    play("go2")
    done = understudy("ctl", "log")
    assert done.returncode == 1
    assert "--detach" in done.stderr
