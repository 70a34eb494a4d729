"""Every example of every help does its work, typed as it stands there, at a desk where the files that it names lie."""

import json
import os
import pty
import re
import shlex
import shutil
import signal
import subprocess

import pytest

from namespaces import host_on_a_cable
from robots import understudy
from screens import Screen
from test_examples import PAGES, PLACEHOLDER, ROOT, commands_of, lines_of_help, lines_of_page, verbs

# What runs these needs a gamepad or a keyboard that is played.
ELSEWHERE = {"remote": "test_remote.py and test_gamepad.py", "run": "test_examples.py, test_view.py, test_gamepad.py"}
# They go on until somebody ends them.
ENDLESS = re.compile(r"--watch|--follow|--loop|--echo|^understudy view")
BESIDE_A_ROBOT = ("view", "picture", "film", "excite")
# Of which robot, and what was done before.
START = {"excite": ("--start", "clamped", "--released"), "ctl": ("--start", "hanging")}
BEFORE = {"step": "pause", "raise": "crane attach", "lower": "crane attach", "joint": "clamp on"}
PROGRAM = "import sys, time; time.sleep(1)"
ETH0, FAR = ("eth0", "192.168.123.1/24"), ("eth0", "192.168.123.222/24")
# What is no mistake of the line: the machine has something wrong; some shoves of a campaign are too hard.
VERDICTS = {"doctor": 12, "rehearse": 10}

SCENARIO = """
scenario: Stays up
robot: go2
duration: 2
expect:
  - {always: base.tilt < 60 deg, name: stays up}
"""


@pytest.fixture(scope="session", name="files")
def files_fixture(tmp_path_factory):
    """What somebody has who has read as far as the examples."""
    folder = tmp_path_factory.mktemp("files")
    # Somebody moves the joints of a robot on a stand, for short.
    done = understudy("exec", "go2", *START["excite"], "--record", folder / "run.mcap", "--", os.environ["UNDERSTUDY"],
                      "excite", "--robot", "go2", "--seconds", "10", timeout=120)
    assert done.returncode == 0, done.stderr
    for name in ("walk", "sim", "real", "before", "after", "real_robot", "chirp", "a", "b", "c"):
        (folder / f"{name}.mcap").symlink_to("run.mcap")
    (folder / "rehearsals" / "push").mkdir(parents=True)
    (folder / "rehearsals" / "push" / "recording.mcap").symlink_to("../../run.mcap")
    for name in ("walk.yaml", "expect.yaml"):
        (folder / name).write_text(SCENARIO)
    shutil.copy(ROOT / "config" / "scenarios" / "push.yaml", folder)
    for name in ("walk.py", "go2_stand_example.py"):
        (folder / name).write_text(PROGRAM)
    program = folder / "g1_ankle_swing_example"
    program.write_text(f"#!/usr/bin/env python3\n{PROGRAM}\n")
    program.chmod(0o755)
    (folder / "my_program").symlink_to("g1_ankle_swing_example")
    for file in [*(ROOT / "examples").glob("*/*.yaml"), ROOT / "examples" / "randomization.yaml"]:
        (folder / file.name).symlink_to(file)
    arm = ROOT / "examples" / "two_joint_arm"
    (folder / "my_robot.yaml").write_text((arm / "arm.yaml").read_text().replace("arm.xml", "my_robot.xml"))
    shutil.copy(arm / "arm.xml", folder / "my_robot.xml")
    assert understudy("export", "urdf", "go2", "--out", folder / "my.urdf").returncode == 0
    return folder


@pytest.fixture(name="desk")
def desk_fixture(files, tmp_path, monkeypatch):
    """A folder with those files, in which every line of a shell finds understudy."""
    desk = tmp_path / "desk"
    shutil.copytree(files, desk, symlinks=True)
    for folder in ("bin", "completions", "docs"):
        (desk / folder).mkdir()
    (desk / "bin" / "understudy").write_text('#!/bin/sh\nexec "$UNDERSTUDY" "$@"\n')
    (desk / "bin" / "xdg-open").write_text('#!/bin/sh\ncase $1 in http*) ;; *) exit 1 ;; esac\n')
    for program in (desk / "bin").iterdir():
        program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{desk / 'bin'}:{os.environ['PATH']}")
    monkeypatch.setenv("HOME", str(desk))
    for shell in (".local/share/bash-completion/completions", ".config/fish/completions"):
        (desk / shell).mkdir(parents=True)
    return desk


def bash(line, desk, **how):
    shell = ["bash", "-o", "pipefail", "-c", line]
    if "zsh" in line:
        shell = ["zsh", "-c", f"autoload -U compinit && compinit -D\n{line}"]
    done = subprocess.run(shell, cwd=desk, capture_output=True, text=True, timeout=480, **how)
    return done.returncode, f"{line}: {done.returncode}\n{done.stdout[-800:]}\n{done.stderr[-1500:]}"


def watched(line, desk, **how):
    """It goes on, shows something in a terminal, and ends by Ctrl-C."""
    ours, theirs = pty.openpty()
    with subprocess.Popen(["bash", "-o", "pipefail", "-c", line], cwd=desk, stdin=theirs, stdout=theirs, stderr=theirs,
                          start_new_session=True, **how) as process:
        os.close(theirs)
        shown = os.read(ours, 4096) if not line.startswith("understudy view") else b"a window"
        try:
            process.wait(1.5)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGINT)
        code = process.wait(20)
        os.close(ours)
    assert shown
    assert code in (0, 128 + signal.SIGINT, -signal.SIGINT), f"{line}: {code} {shown!r}"


def examples_of(*verb):
    """The lines, without what a person would say about them."""
    return [line.split("; `")[0].split(" # ")[0].strip() for line in lines_of_help(*verb)]


def works(line, desk, **how):
    if ENDLESS.search(line):
        watched(line, desk, **how)
        return
    code, told = bash(line, desk, **how)
    assert code in (0, VERDICTS.get(line.split()[1])), told


COMMANDS = [verb[0] for verb in verbs() if len(verb) == 1 and verb[0] not in ("ctl", "doctor", *ELSEWHERE)]


@pytest.mark.parametrize("command", COMMANDS)
def test_every_example_of_a_help_works(command, desk, play):
    if command == "judge":
        assert understudy("rehearse", "stand_up", cwd=desk, timeout=120).returncode == 0
    if command == "rehearse":  # those that are to be merged
        for part in (1, 3, 4):
            assert understudy("rehearse", "shoves.yaml", "--shard", f"{part}/4", "--out", f"part{part}", cwd=desk,
                              timeout=120).returncode in (0, 10)
    robot = None
    screen = Screen() if command == "view" else None
    how = {"env": screen.environment} if screen else {}
    if command in BESIDE_A_ROBOT:
        robot = play("go2", *START.get(command, ()), name="left")
    for line in examples_of(command):
        if line.startswith("understudy run"):  # test_examples.py starts these
            continue
        if "--network-interface eth0" in line:
            robot.end()
            with host_on_a_cable(ETH0, FAR):
                play("go2", *START[command], "--interface", "eth0")
                works(line, desk)
            continue
        if "--commands" in line:  # to a robot of today
            robot = play("go2", *START["excite"])
        if command == "film" and "--size" not in line:
            line += " --size 160x90"  # the processor draws it
        works(line, desk, **how)
    if screen:
        screen.end()


def test_every_example_of_the_doctor_works(desk):
    with host_on_a_cable(ETH0, FAR) as there:
        lines = examples_of("doctor")
        echo, = (line for line in lines if "--echo" in line)
        with subprocess.Popen([*there, "bash", "-c", f"exec {echo}"], cwd=desk, stdout=subprocess.PIPE,
                              text=True) as far:
            assert far.stdout.readline().startswith("far answers on eth0")
            for line in lines:
                if line != echo:
                    works(line, desk)
            far.send_signal(signal.SIGINT)
            assert far.wait(20) == 0


def ctl_examples():
    return [line for verb in verbs() if verb[0] == "ctl" and verb != ("ctl", "stop") for line in examples_of(*verb)]


def ctl(*words):
    done = understudy("ctl", *words)
    assert done.returncode == 0, f"ctl {words}: {done.stderr}"
    return done.stdout


@pytest.fixture(name="left")
def left_fixture(desk):
    """A robot in the background, which the last example of all stops."""
    started = understudy("run", "go2", *START["ctl"], "--name", "left", "--detach")
    assert started.returncode == 0, started.stderr
    yield
    stop, = examples_of("ctl", "stop")
    works(stop, desk)


def works_after_what_it_needs(line, desk):
    for word, before in BEFORE.items():
        if f" {word}" in line:
            ctl(*before.split())
    works(line, desk)
    if json.loads(ctl("status", "--json"))["paused"]:
        ctl("resume")


def test_every_example_of_ctl_works(desk, left):
    for line in ctl_examples():
        if not line.startswith("understudy run"):
            works_after_what_it_needs(line, desk)


def test_every_ctl_of_a_page_works(desk, left):
    for recording in desk.glob("*.mcap"):  # some lines make them
        recording.unlink()
    # Those of recipes.md are typed by test_recipes.py.
    commands = [words for page in PAGES if page.name != "recipes.md" for line in lines_of_page(page)[0]
                for words in commands_of(line) if words[0] == "ctl" and words[-1] != "stop"]
    assert len(commands) > 15
    for words in commands:
        if not PLACEHOLDER.search(" ".join(words)):
            line = re.sub(r"--name \w+", "--name left", shlex.join(["understudy", *words]))
            works_after_what_it_needs(line, desk)


def test_a_robot_in_the_background_is_waited_for(desk):
    line, = (line for line in ctl_examples() if line.startswith("understudy run"))
    code, told = bash(f"{line}; code=$?; kill %1; wait %1; exit $code", desk)
    assert code == 0, told
