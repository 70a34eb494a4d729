"""A desk where somebody works who has read as far as the examples: the files that they name lie there, every shell finds
understudy, and a line is typed as it stands."""

import json
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import sys

import pytest

from bags import bag_of
from policies import write_policy
from robots import understudy
from screens import Screen

ROOT = pathlib.Path(__file__).parents[2]
# They go on until somebody ends them.
ENDLESS = re.compile(r"--watch|--follow|--loop|--echo|image_server|^understudy view|^understudy remote(?!.*--list)")
# What is done before a request.
BEFORE = {"step": "pause", "raise": "crane attach", "lower": "crane attach", "joint": "clamp on"}
ON_A_STAND = ("--start", "clamped", "--released")  # as one moves the joints of a robot
PROGRAM = "import sys, time; time.sleep(1)"
ETH0, FAR = ("eth0", "192.168.123.1/24"), ("eth0", "192.168.123.222/24")
# What is no mistake of the line: the machine has something wrong; some shoves of a campaign are too hard.
VERDICTS = {r"^understudy doctor": 12, r"^understudy rehearse .*(shoves|--merge|friction)": 10}

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
    excite = (os.environ["UNDERSTUDY"], "excite", "--robot", "go2", "--seconds", "2.5")
    for done in (understudy("exec", "go2", *ON_A_STAND, "--record", folder / "excited.mcap", "--", *excite),
                 understudy("run", "go2", "--speed", "max", "--duration", "13", "--record", folder / "run.mcap")):
        assert done.returncode == 0, done.stderr
    shutil.copy(folder / "excited.mcap", folder / "walk.mcap")  # which an example overwrites; a link it would not
    for name in ("sim", "real", "before", "after", "real_robot", "chirp", "a", "b", "c"):
        (folder / f"{name}.mcap").symlink_to("excited.mcap")
    (folder / "rehearsals" / "push").mkdir(parents=True)
    (folder / "rehearsals" / "push" / "recording.mcap").symlink_to("../../run.mcap")
    (folder / "scenarios").mkdir()
    for name in ("walk.yaml", "scenarios/walk.yaml"):
        (folder / name).write_text(SCENARIO)
    (folder / "expect.yaml").write_text("robot: go2\nexpect:\n  - always: rate(lowstate) between 400 and 600\n")
    bag_of(folder / "excited.mcap", folder / "real_robot")
    (folder / "pushes.yaml").write_text("script:\n  - {at: 0.5, push: {force: [0, 60, 0], for: 0.2}}\n")
    shutil.copy(ROOT / "config" / "scenarios" / "push.yaml", folder)
    for name in ("walk.py", "deploy.py", "my_policy.py", "go2_stand_example.py"):
        (folder / name).write_text(PROGRAM)
    program = folder / "g1_ankle_swing_example"
    program.write_text(f"#!/usr/bin/env python3\n{PROGRAM}\n")
    program.chmod(0o755)
    for name in ("my_program", "deploy", "as_on_the_robots_second_computer"):
        (folder / name).symlink_to("g1_ankle_swing_example")
    arm = ROOT / "examples" / "two_joint_arm"
    for file in [*(ROOT / "examples").glob("*/*.yaml"), ROOT / "examples" / "randomization.yaml", *arm.iterdir()]:
        if not (folder / file.name).exists():
            (folder / file.name).symlink_to(file)
    (folder / "my_robot.yaml").write_text((arm / "arm.yaml").read_text().replace("arm.xml", "my_robot.xml"))
    shutil.copy(arm / "arm.xml", folder / "my_robot.xml")
    assert understudy("export", "urdf", "go2", "--out", folder / "my.urdf").returncode == 0
    write_policy(folder / "walk")
    return folder


@pytest.fixture(name="desk")
def desk_fixture(files, tmp_path, monkeypatch, runtime_dir):
    """A folder with those files, in which every line of a shell finds understudy."""
    desk = tmp_path / "desk"
    shutil.copytree(files, desk, symlinks=True)
    for folder in ("bin", "completions", "docs/reference"):
        (desk / folder).mkdir(parents=True)
    put_program(desk, "bin/understudy", 'exec "$UNDERSTUDY" "$@"')
    put_program(desk, "bin/xdg-open", "case $1 in http*) ;; *) exit 1 ;; esac")
    monkeypatch.setenv("PATH", f"{desk / 'bin'}:{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}")
    monkeypatch.setenv("HOME", str(desk))
    # A user's own: the folder that the tests have is named as that of a session is.
    monkeypatch.delenv("UNDERSTUDY_RUNTIME_DIR")
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(runtime_dir))
    for shell in (".local/share/bash-completion/completions", ".config/fish/completions"):
        (desk / shell).mkdir(parents=True)
    return desk


@pytest.fixture(scope="session", name="screen")
def screen_fixture():
    screen = Screen()
    yield screen
    screen.end()


def put_program(desk, name, does):
    """A program of a shell that stands in for another."""
    program = desk / name
    program.parent.mkdir(parents=True, exist_ok=True)
    program.write_text(f"#!/bin/sh\n{does}\n")
    program.chmod(0o755)


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


def verdict_of(line):
    """The exit code, besides 0, of a line that works."""
    return next((code for pattern, code in VERDICTS.items() if re.search(pattern, line)), 0)


def drawn_quickly(line):
    """A film with few and small pictures: the processor draws them."""
    if not line.startswith("understudy film"):
        return line
    return re.sub(r" --(fps|size) \S+", "", line) + " --fps 2 --size 160x90"


def works(line, desk, **how):
    line = drawn_quickly(line)
    if ENDLESS.search(line):
        watched(line, desk, **how)
        return
    code, told = bash(line, desk, **how)
    assert code in (0, verdict_of(line)), told


def ctl(*words):
    done = understudy("ctl", *words)
    assert done.returncode == 0, f"ctl {words}: {done.stderr}"
    return done.stdout


def prepare(line):
    """Does what a request needs done before it."""
    for word, before in BEFORE.items():
        if f" {word} " in f"{line} ":
            ctl(*before.split())


def go_on():
    """After a request that paused the robot."""
    if json.loads(ctl("status", "--json"))["paused"]:
        ctl("resume")
