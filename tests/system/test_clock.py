"""Programs on a simulated clock: what they send repeats, and what cannot take the clock is refused."""

import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import time

import pytest
from mcap.reader import make_reader

ROOT = pathlib.Path(__file__).resolve().parents[2]
STAND = [sys.executable, ROOT / "examples/python/stand.py", "lo"]
CLOCK = ["--clock", "simulated"]
# Without real-time priority, as on a computer that does not grant it.
LOOKING = ["--set", "time.realtime=false"]


def holds_pose(seconds):
    """a program in C on Cyclone's own interface, which commands a released Go2 at 500 Hz"""
    return [pathlib.Path(os.environ["UNDERSTUDY"]).resolve().parents[1] / "tests/bin/holds_pose", str(seconds)]


def messages(recording):
    """{topic: (number of messages, digest of their times and bytes)} of commands, and of states up to the last"""
    heard = {"/lowcmd": [], "/lowstate": []}
    with open(recording, "rb") as file:
        for _, channel, message in make_reader(file).iter_messages(list(heard), log_time_order=False):
            heard[channel.topic].append((message.log_time, message.data))
    last = heard["/lowcmd"][-1][0]
    found = {}
    for topic, all_of_it in heard.items():
        digest = hashlib.sha256()
        until = [one for one in all_of_it if one[0] <= last]
        for when, data in until:
            digest.update(when.to_bytes(8, "little") + data)
        found[topic] = (len(until), digest.hexdigest())
    return found


def run_on_clock(understudy, folder, name, *options):
    recording = folder / f"{name}.mcap"
    done = understudy("exec", "go2", *CLOCK, "--released", *options, "--record", recording, "--", *holds_pose(2),
                      timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    return messages(recording)


def rehearsed(understudy, folder, program, *options, more=""):
    scenario = folder / "plays.yaml"
    scenario.write_text(f"scenario: a program\nrobot: go2\nclock: simulated\n{more}"
                        "program: {limit: 120}\nexpect:\n  - eventually: program.exit_code is 0\n")
    return understudy("rehearse", scenario, "--no-pictures", *options, "--", *program, cwd=folder, timeout=240)


def test_two_runs_of_a_program_of_the_python_sdk_say_the_same(understudy, tmp_path):
    done = rehearsed(understudy, tmp_path, STAND, "--twice")

    assert done.returncode == 0, done.stdout + done.stderr
    assert "clock: simulated, repeatable: yes" in done.stdout
    assert messages(tmp_path / "rehearsals/plays/recording.mcap")["/lowcmd"][0] > 1000


def test_a_program_in_c_and_its_robot_say_the_same_twice_without_priority_too(understudy, tmp_path):
    done = rehearsed(understudy, tmp_path, holds_pose(2), "--twice", *LOOKING,
                     more="settings: {motion: {service: none}}\n")

    # The kernel takes real time to end a program: what is compared here ends with its last command.
    assert done.returncode in (0, 10), done.stdout + done.stderr
    told = json.loads((tmp_path / "rehearsals/plays/verdict.json").read_text())
    assert told["repeatable"] is (done.returncode == 0)
    first, second = (messages(tmp_path / "rehearsals/plays" / name) for name in ("first/recording.mcap", "recording.mcap"))
    assert first == second and first["/lowcmd"][0] == 1000


def test_a_program_that_draws_real_chance_is_not_repeatable(understudy, tmp_path):
    draws = [sys.executable, "-c", "import random, time; time.sleep(random.uniform(1, 2))"]
    done = rehearsed(understudy, tmp_path, draws, "--twice")

    assert done.returncode == 10
    assert "clock: simulated, repeatable: no; cause: the program itself: it draws chance" in done.stdout
    assert "the second run differs from the first: message" in done.stdout
    assert "understudy/events" in done.stdout


def test_a_robot_alone_says_the_same_twice(understudy, tmp_path):
    scenario = tmp_path / "alone.yaml"
    scenario.write_text("scenario: a robot alone\nrobot: go2\nduration: 2\nexpect: [safe]\n")
    done = understudy("rehearse", scenario, "--no-pictures", "--twice", cwd=tmp_path, timeout=120)

    assert done.returncode == 0, done.stdout + done.stderr
    assert "repeatable: yes" in done.stdout


def test_one_run_says_nothing_of_another(understudy, tmp_path):
    done = rehearsed(understudy, tmp_path, ["sleep", "20"])

    assert done.returncode == 0, done.stdout + done.stderr
    assert "clock: simulated\n" in done.stdout
    assert "repeatable" not in done.stdout


def test_a_pace_and_priority_change_nothing(understudy, tmp_path):
    fast = run_on_clock(understudy, tmp_path, "fast")

    assert fast["/lowcmd"][0] == 1000
    assert fast == run_on_clock(understudy, tmp_path, "paced", "--speed", "2")
    assert fast == run_on_clock(understudy, tmp_path, "looking", *LOOKING)


def test_who_starts_it_changes_nothing(understudy, request, runtime_dir, tmp_path):
    owner = run_on_clock(understudy, tmp_path, "owner")
    as_nobody = request.getfixturevalue("as_nobody")  # who has the folder of control sockets from now on
    recording = runtime_dir / "nobodys.mcap"
    words = ["exec", "go2", *CLOCK, "--released", "--record", recording, "--", *holds_pose(2)]
    done = subprocess.run([*as_nobody, os.environ["UNDERSTUDY"], *map(str, words)], capture_output=True, text=True,
                          timeout=120, check=False)

    assert done.returncode == 0, done.stdout + done.stderr
    assert messages(recording) == owner


def test_a_childs_sleep_of_a_minute_takes_seconds(understudy):
    starts = "import subprocess, time; begun = time.time(); subprocess.run(['sleep', '60']); print(time.time() - begun)"
    began = time.monotonic()
    done = understudy("exec", "go2", *CLOCK, "--", sys.executable, "-c", starts)

    assert done.returncode == 0, done.stderr
    assert float(done.stdout) == pytest.approx(60, abs=0.01)
    assert time.monotonic() - began < 50


def test_kill_9_leaves_nothing_behind(understudy, tmp_path):
    before = set(os.listdir("/dev/shm"))
    robot = subprocess.Popen([os.environ["UNDERSTUDY"], "exec", "go2", *CLOCK, "--speed", "1", "--",
                              "sh", "-c", f"touch {tmp_path}/begun; sleep 1000"])
    while not (tmp_path / "begun").exists():
        assert robot.poll() is None
        time.sleep(0.05)
    robot.kill()
    robot.wait()

    assert {one for one in set(os.listdir("/dev/shm")) - before if "understudy" in one} == set()


def test_a_trace_says_who_waits_for_what_until_when(understudy):
    waits = "import threading, time; threading.Thread(target=time.sleep, args=[30], name='sleeper').start(); time.sleep(60)"
    done = understudy("exec", "go2", *CLOCK, "--speed", "20", "--clock-trace", "--", sys.executable, "-c", waits)

    assert done.returncode == 0, done.stderr
    assert re.search(r"^clock: [\d.]+ s$", done.stderr, re.MULTILINE)
    assert re.search(r"^  thread \d+ of python\S* \(\d+\): waits in sleep until 60\.\d+ s$", done.stderr, re.MULTILINE)
    assert re.search(r"^  thread \d+, \S+, of understudy \(\d+\): waits in \w+", done.stderr, re.MULTILINE)


def test_the_exit_code_is_the_programs(understudy):
    assert understudy("exec", "go2", *CLOCK, "--", "sh", "-c", "sleep 1; exit 7").returncode == 7


def test_pausing_the_robot_stops_the_programs_time(understudy):
    script = 'sleep 1; "$UNDERSTUDY" ctl pause; date +%s.%N; "$UNDERSTUDY" ctl step 500; "$UNDERSTUDY" ctl resume'
    done = understudy("exec", "go2", *CLOCK, "--name", "pausing", "--", "sh", "-c", script)

    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("options", [(), LOOKING])
def test_what_a_program_asks_takes_the_same_time_always_and_none_in_a_pause(understudy, options):
    script = """
now() { date +%s.%N; }; ctl() { "$UNDERSTUDY" ctl "$@" >&2; }
now; ctl status && ctl damage && ctl push base_link 0 20 0; now; ctl pause && ctl snapshot; now; ctl step 250; now; ctl resume
"""
    done = understudy("exec", "go2", *CLOCK, *options, "--", "sh", "-c", script)

    assert done.returncode == 0, done.stdout + done.stderr
    begun, asked, paused, stepped = map(float, done.stdout.split())
    assert asked - begun == pytest.approx(0.03, abs=1e-6)
    assert paused - asked == pytest.approx(0.01, abs=0.003)
    assert stepped - paused == pytest.approx(0.25, abs=0.002)  # of 1 ms


@pytest.mark.parametrize("options", [(), LOOKING])
def test_a_picture_that_a_program_asks_for_takes_the_same_time_always(understudy, tmp_path, options):
    script = 'date +%s.%N; "$UNDERSTUDY" camera front --out front.jpg; date +%s.%N'
    done = understudy("exec", "go2", *CLOCK, *options, "--", "sh", "-c", script, cwd=tmp_path)

    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "front.jpg").read_bytes().startswith(b"\xff\xd8")
    begun, seen = map(float, done.stdout.split())
    assert seen - begun == pytest.approx(0.02, abs=0.003)  # it asks for the list, and for the picture


def test_a_program_that_asks_and_requests_says_the_same_twice(understudy, tmp_path):
    asks = "for i in 1 2 3; do sleep 0.33; $UNDERSTUDY ctl snapshot --parts qpos; $UNDERSTUDY ctl push base_link 0 30 0; done; sleep 0.5"
    done = rehearsed(understudy, tmp_path, ["sh", "-c", asks], "--twice")

    assert done.returncode == 0, done.stdout + done.stderr
    assert "repeatable: yes" in done.stdout


def test_what_cannot_take_the_clock_is_refused(understudy, tmp_path):
    static = tmp_path / "static"
    source = tmp_path / "static.c"
    source.write_text("int main(void) { return 0; }\n")
    subprocess.run(["cc", "-static", "-o", static, source], check=True)

    def refused(*command):
        done = understudy("exec", "go2", "--clock", "simulated", "--", *command)
        assert done.returncode in (125, 127)
        assert done.stderr.count("\n") == 1, done.stderr
        return done.stderr

    assert "is linked statically" in refused(static)
    assert "starts the program elsewhere" in refused(make_program(tmp_path / "docker"))
    assert "no-such-program" in refused("no-such-program")


def make_program(path):
    path.write_text("#!/bin/sh\n")
    path.chmod(0o755)
    return path


@pytest.mark.parametrize("words, says", [
    (["--think", "3"], "--think"),
    (["--clock-trace"], "--clock-trace"),
    (["--clock", "simulated", "--network", "host"], "--network private"),
])
def test_options_that_contradict_each_other_are_refused(understudy, words, says):
    done = understudy("exec", "go2", *words, "--", "true")

    assert done.returncode == 2
    assert says in done.stderr


def test_a_scenario_that_thinks_needs_the_simulated_clock(understudy, tmp_path):
    scenario = tmp_path / "thinks.yaml"
    scenario.write_text("scenario: one that thinks\nrobot: go2\nprogram: {command: [sleep, '1'], think: 0.002}\n"
                        "expect:\n  - safe\n")
    done = understudy("check", scenario, cwd=tmp_path)

    assert done.returncode == 3
    assert "program.think: needs clock: simulated" in done.stdout


def test_thinking_makes_a_program_slower(understudy, tmp_path):
    usual = run_on_clock(understudy, tmp_path, "usual")
    slow = run_on_clock(understudy, tmp_path, "slow", "--think", "2.5")

    assert slow["/lowstate"][0] > 1.2 * usual["/lowstate"][0]


def test_what_a_program_computes_is_measured_and_taken(understudy, tmp_path):
    done = understudy("exec", "go2", *CLOCK, "--think", "auto", "--released", "--", *holds_pose(1), timeout=120)

    assert done.returncode == 0, done.stdout + done.stderr
    assert re.search(r"^think: \S+ ms, measured on this computer$", done.stderr, re.MULTILINE)

    done = rehearsed(understudy, tmp_path, holds_pose(1), *CLOCK, "--think", "auto",
                     more="settings: {motion: {service: none}}\n")
    assert done.returncode == 0, done.stdout + done.stderr
    measured = float(re.search(r"think: (\S+) ms, measured", done.stderr).group(1))
    told = json.loads((tmp_path / "rehearsals/plays/verdict.json").read_text())
    assert told["think_ms"] == pytest.approx(measured, rel=1e-3) and told["computed_ms"] > 0
    assert f"clock: simulated, think: {measured:g} ms" in done.stdout
    assert f"--think {measured:g}" in told["repeat"]


@pytest.mark.parametrize("think", ["slow", "-1", "2000", "3x"])
def test_a_think_is_auto_or_a_time(understudy, think):
    done = understudy("exec", "go2", *CLOCK, "--think", think, "--", "true")

    assert done.returncode == 2
    assert "expected auto, or ms from 0 to 1000" in done.stderr


def test_a_program_that_thinks_says_the_same_twice(understudy, tmp_path):
    done = rehearsed(understudy, tmp_path, STAND, "--twice", *CLOCK, "--think", "0.7")

    assert done.returncode == 0, done.stdout + done.stderr
    assert "clock: simulated, think: 0.7 ms, repeatable: yes" in done.stdout


def test_twice_is_of_one_run(understudy, tmp_path):
    scenario = tmp_path / "varied.yaml"
    scenario.write_text("scenario: many\nrobot: go2\nduration: 1\nvary: {grid: {terrain.friction: [0.3, 0.6]}}\nexpect:\n  - safe\n")
    done = understudy("rehearse", scenario, "--twice", cwd=tmp_path)

    assert done.returncode == 3
    assert "--run" in done.stderr
