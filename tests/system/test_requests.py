"""Requests from a shell: pause, step, speed, reset, drag."""

import json
import os
import pty
import re
import signal
import subprocess
import time

from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient

from peers import join, listener
from robots import eventually, understudy


def paused(robot):
    robot.ctl("pause")
    return robot.becomes(lambda now: now["paused"])


def test_a_paused_robot_stands_still_and_sends_nothing(play):
    robot = play("go2")
    with listener() as ear:
        ear.wait()
        before = paused(robot)
        ear.take_for(0.2)
        assert ear.take_for(0.5) == []
        after = robot.status()
    assert after["steps"] == before["steps"]
    assert after["time"] == before["time"]
    robot.heard("paused at")


def test_a_paused_robot_answers_requests_and_services(play):
    robot = play("go2")
    paused(robot)
    robot.ctl("crane", "attach")
    assert robot.becomes(lambda now: now["crane"]["attached"])["paused"]
    join(0)
    client = MotionSwitcherClient()
    client.SetTimeout(5)
    client.Init()
    code, answer = eventually(lambda: (reply := client.CheckMode())[0] == 0 and reply)
    assert code == 0
    assert answer["name"] == "mcf"


def test_the_list_of_settings_tells_the_friction_that_the_ground_has(play, tmp_path):
    scene = tmp_path / "icy.yaml"
    scene.write_text("terrain: {patches: [{kind: flat}, {kind: flat, friction: 0.25}]}\n")
    robot = play("go2", "--scene", scene)

    def shown():
        listed = understudy("ctl", "set").stdout.splitlines()
        return next(re.split("  +", line)[1] for line in listed if line.startswith("terrain.friction "))

    assert shown() == "0: 0.25 to 0.8"
    robot.ctl("set", "terrain.friction", "0.5")
    assert shown() == "0.5"
    robot.ctl("set", "terrain.friction", "0")
    assert shown() == "0: 0.25 to 0.8"


def test_a_resumed_robot_neither_races_nor_counts_the_pause_as_late(play):
    robot = play("go2")
    before = paused(robot)
    time.sleep(1)
    started = time.monotonic()
    robot.ctl("resume")
    after = robot.becomes(lambda now: now["steps"] >= before["steps"] + 500)
    assert time.monotonic() - started > 0.45
    assert after["pace"]["shifts"] == before["pace"]["shifts"]
    assert after["pace"]["worst_lateness"] < 0.9


def test_steps_are_made_one_by_one_and_each_is_told(play):
    robot = play("go2")
    with listener() as ear:
        ear.wait()
        before = paused(robot)
        ear.take_for(0.2)
        robot.ctl("step", 10)
        assert robot.status()["steps"] == before["steps"] + 10
        ticks = [state.tick for state in ear.take_for(0.2)]
    assert len(ticks) == 5
    robot.ctl("step")
    assert robot.status()["steps"] == before["steps"] + 11


def test_the_speed_can_be_changed_while_it_runs(play):
    robot = play("go2")
    robot.ctl("speed", "max")
    first = robot.becomes(lambda now: now["speed"] == 0)
    robot.becomes(lambda now: now["steps"] > first["steps"] + 5000)
    robot.ctl("speed", "0.01")
    slow = robot.becomes(lambda now: now["speed"] == 0.01)
    time.sleep(0.5)
    assert robot.status()["steps"] - slow["steps"] < 200
    # A request is answered long before the next of its ticks, which are 100 ms apart.
    robot.ctl("speed", "1")
    robot.becomes(lambda now: now["steps"] > slow["steps"] + 500)


def test_ctrl_c_ends_a_paused_robot_and_a_slow_one_at_once(play):
    for request in (("pause",), ("speed", "0.001")):
        robot = play("go2")
        robot.ctl(*request)
        started = time.monotonic()
        robot.send(signal.SIGINT)
        assert robot.exit_code() == 0
        assert time.monotonic() - started < 5


def test_a_duration_counts_simulated_time_through_a_pause(play):
    robot = play("go2", "--duration", "8")
    paused(robot)
    robot.ctl("speed", "max")
    time.sleep(0.5)
    assert robot.process.poll() is None
    robot.ctl("resume")
    assert robot.exit_code() == 0
    assert "after 8.0 simulated seconds" in robot.said()


def test_a_drag_lifts_the_robot_until_its_time_is_over(play):
    robot = play("go2")
    robot.ctl("drag", "base_link", 0, 0, 0.8, "--for", 1.5)
    robot.becomes(lambda now: now["base"]["height"] > 0.5)
    robot.becomes(lambda now: now["base"]["height"] < 0.3)


def test_the_status_is_watched_as_plain_text_in_a_pipe_and_over_itself_on_a_terminal(play):
    robot = play("go2")
    command = [os.environ["UNDERSTUDY"], "ctl", "--name", robot.name, "status", "--watch",
               "--every", "0.1"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as watching:
        text = "".join(watching.stdout.readline() for _ in range(40))
        watching.send_signal(signal.SIGINT)
    assert "\033" not in text
    assert re.search(r"steps +\d{3,4} +\d+", text)

    controller, terminal = pty.openpty()
    with subprocess.Popen(command, stdout=terminal) as watching:
        screen = eventually(lambda: b"motion service" in (text := os.read(controller, 4096)) and text)
        watching.send_signal(signal.SIGINT)
    os.close(terminal)
    os.close(controller)
    assert b"\033[H" in screen or b"\033[K" in screen


def test_where_several_run_it_asks_on_a_terminal(play):
    first, second = play("go2"), play("go2", "--domain", "1")
    controller, terminal = pty.openpty()
    command = [os.environ["UNDERSTUDY"], "ctl", "pause"]
    program = subprocess.run([*command, "--json"], stdin=terminal, stderr=subprocess.PIPE, text=True, timeout=60)
    assert program.returncode != 0, "a program that wants JSON is not asked"
    assert second.name in json.loads(program.stderr)["message"]
    asking = subprocess.Popen(command, stdin=terminal, stderr=terminal, stdout=subprocess.DEVNULL)
    os.write(controller, f"{second.name}\n".encode())
    assert asking.wait(60) == 0
    os.close(terminal)
    os.close(controller)
    assert not first.status()["paused"]
    assert second.status()["paused"]
