"""What the shells complete: by the script of each, and typed into interactive ones."""

import os
import pathlib
import pty
import select
import subprocess

import pytest

from robots import eventually

ROBOTS = pathlib.Path(__file__).parents[2] / "config" / "robots"


def named(beginning):
    return sorted(file.stem for file in ROBOTS.glob(f"{beginning}*.yaml"))


COMPLETE = {  # what a shell offers for the typed words, one a line; {file}: our script
    "bash": """
        source {file}
        COMP_WORDS=({typed}); COMP_CWORD={last}; _understudy; printf '%s\\n' "${{COMPREPLY[@]}}"
    """,
    "zsh": """
        autoload -U +X compinit && compinit -D -u
        source {file}
        emulate sh  # as bashcompinit does before it calls a function
        COMP_WORDS=({typed}); COMP_CWORD={last}; _understudy; printf '%s\\n' "${{COMPREPLY[@]}}"
    """,
    "fish": "source {file}; complete -C'{typed}'",
}


@pytest.mark.parametrize("shell", COMPLETE)
@pytest.mark.parametrize(("typed", "offered"), [
    ("understudy ru", ["run"]),
    ("understudy run go", named("go")),
    ("understudy run go2 --sp", ["--speed"]),
    ("understudy run go2 --print", ["--print-config"]),
    ("understudy ctl cr", ["crane"]),
    ("understudy ctl lo", ["log"]),
    ("understudy ctl lu", []),
    ("understudy ctl crane l", ["lower"]),
    ("understudy ctl clamp o", ["off", "on"]),
    ("understudy run go2 --scene ro", ["rough", "row"]),
    ("understudy run go2 --start l", ["lying"]),
    ("understudy run g1 --revision 1", ["11", "12", "13", "14", "15", "16"]),
    ("understudy run g1_23dof --revision 1", ["1", "10"]),
    ("understudy run go2 --dynamics c", ["catalogue"]),
    ("understudy exec go2 --profile h", ["harsh"]),
    ("understudy rehearse push --profile w", ["worn"]),
    ("understudy run go2 --set gate.t", ["gate.timeout="]),
    ("understudy run go2 --set gate.mode=", ["gate.mode=lenient", "gate.mode=strict"]),
    ("understudy run go2 --set motion.fight=f", ["motion.fight=false"]),
    ("understudy rehearse push --set profile=w", ["profile=worn"]),
    ("understudy run g1 --set robot.revision=15", ["robot.revision=15"]),
    ("understudy run g1 --set motion.service=", ["motion.service=ai", "motion.service=none"]),
    ("understudy run go2 --set=start.pose=l", ["--set=start.pose=lying"]),
    ("understudy run go2 --scene=ro", ["--scene=rough", "--scene=row"]),
    ("understudy run go2 --sceen=ro", []),
    ("understudy run go2 --name go", []),
    ("understudy exec go2 -- ru", []),
    ("understudy check --robot h", named("h")),
    ("understudy rehearse sta", ["stand_up"]),
    ("understudy ctl remote press L2+S", ["L2+SELECT", "L2+START"]),
    ("understudy ctl speed m", ["max"]),
    ("understudy com", ["compare", "completions"]),
    ("understudy ctl status --w", ["--watch"]),
    ("understudy ctl reset st", ["standing"]),
    ("understudy ctl re", ["record", "remote", "reset", "resume"]),
])
def test_each_shell_completes(understudy, tmp_path, shell, typed, offered):
    file = tmp_path / f"completions.{shell}"
    file.write_text(understudy("completions", shell).stdout)
    words = typed.split()
    script = COMPLETE[shell].format(file=file, typed=typed, last=len(words) - 1)
    rc = {"bash": ["--norc"], "zsh": ["-f"], "fish": ["--no-config"]}[shell]
    checked = subprocess.run([shell, "-n", file], capture_output=True, text=True, timeout=10)
    folder = os.path.dirname(os.environ["UNDERSTUDY"])
    done = subprocess.run([shell, *rc, "-c", script], capture_output=True, text=True, timeout=10,
                          env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"})

    assert checked.returncode == 0, checked.stderr
    assert done.stderr == ""
    assert sorted(w for w in done.stdout.split() if w.startswith(words[-1])) == offered


def completed(shell, folder, first, lines):
    """Has an interactive shell complete each typed line by Tab until it shows what is told beside it."""
    path = os.path.dirname(os.environ["UNDERSTUDY"])
    process, terminal = pty.fork()
    if process == 0:
        os.environ.update(PATH=f"{path}:{os.environ['PATH']}", TERM="dumb", HOME=str(folder))
        os.execvp(shell[0], shell)
    shown = ""

    def shows(text):
        nonlocal shown
        while select.select([terminal], [], [], 0)[0]:
            shown += os.read(terminal, 4096).decode()
        return text in shown

    os.write(terminal, f"{first}; echo la''den\n".encode())
    eventually(lambda: shows("\nladen"), what="a shell")
    for typed, expected in lines:
        shown = ""
        os.write(terminal, f"understudy {typed}\t".encode())
        eventually(lambda: shows(expected), what=f"{typed}: {shown}")
        os.write(terminal, b"\x15")
    os.write(terminal, b"exit\n")
    os.waitpid(process, 0)
    os.close(terminal)


def test_zsh_completes_from_a_file_in_its_fpath_the_first_time_and_again(understudy, tmp_path):
    (tmp_path / "_understudy").write_text(understudy("completions", "zsh").stdout)
    completed(["zsh", "-f", "-i"], tmp_path,
              f"fpath=({tmp_path} $fpath); autoload -U compinit && compinit -D -u",
              [("ctl clamp of", "off"), ("run go2 --start ly", "lying"),
               ("run go2 --set gate.mode=s", "gate.mode=strict")])


def test_bash_completes_what_it_breaks_at_the_equals_sign(understudy, tmp_path):
    (tmp_path / "completions").write_text(understudy("completions", "bash").stdout)
    completed(["bash", "--norc", "-i"], tmp_path, f"source {tmp_path}/completions",
              [("run go2 --set gate.mode=s", "gate.mode=strict"), ("run go2 --set=gate.mode=l", "gate.mode=lenient"),
               ("run go2 --set profile=w", "profile=worn"), ("run go2 --dynamics=c", "--dynamics=catalogue"),
               ("ctl set gate.mode l", "lenient")])


def test_completion_knows_the_robots_that_run_and_their_bodies(play, understudy):
    robot = play("go2", name="left")
    names = robot.ctl("scene")

    assert understudy("complete", "--", "ctl", "--name", "l").stdout.split() == ["left"]
    bodies = understudy("complete", "--", "ctl", "push", "").stdout.split()
    assert "FR_calf" in bodies and "world" not in bodies
    assert all(f'"{body}"' in names for body in bodies)
    assert understudy("complete", "--", "ctl", "--name", "left", "drag", "FR_t").stdout.split() == ["FR_thigh"]
    assert understudy("complete", "--", "ctl", "joint", "FR_t").stdout.split() == ["FR_thigh_joint"]
    assert understudy("complete", "--", "ctl", "fault", "ba").stdout.split() == ["battery"]
    assert understudy("complete", "--", "ctl", "fault", "RL_calf").stdout.split() == ["RL_calf_joint"]
