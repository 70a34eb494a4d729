"""The commands that describe understudy, its robots and the files of users."""

import json
import os
import pathlib
import pty
import select
import subprocess

import pytest

from robots import eventually

SUBCOMMANDS = ["run", "exec", "ctl", "remote", "view", "picture", "film", "robots", "check", "version", "completions", "doctor"]
ROBOTS = pathlib.Path(__file__).parents[2] / "config" / "robots"
MODELS = pathlib.Path(__file__).parents[2] / "models"


def named(beginning):
    return sorted(file.stem for file in ROBOTS.glob(f"{beginning}*.yaml"))


@pytest.mark.parametrize("subcommand", SUBCOMMANDS)
def test_every_subcommand_has_help_with_an_example_on_standard_output(understudy, subcommand):
    done = understudy(subcommand, "--help")

    assert done.returncode == 0
    assert "--help" in done.stdout
    assert f"understudy {subcommand}" in done.stdout.split("Example")[1]
    assert done.stderr == ""


def test_help_names_every_subcommand_and_exit_code(understudy):
    help_text = understudy("--help").stdout

    for subcommand in SUBCOMMANDS:
        assert subcommand in help_text
    for code in range(9):
        assert f"{code} " in help_text.split("Exit codes:")[1]


def test_robots_as_json_lists_every_robot_file(understudy):
    robots = json.loads(understudy("robots", "--json").stdout)

    assert [robot["name"] for robot in robots] == sorted(file.stem for file in ROBOTS.iterdir())
    for robot in robots:
        assert robot["wire"] in ("go", "hg")
        assert robot["motors"] > 0
        assert robot["lowstate_hz"] > 0
        assert robot["description"]


def test_robots_lists_one_robot_a_line(understudy):
    lines = understudy("robots").stdout.splitlines()

    assert [line.split()[0] for line in lines] == sorted(file.stem for file in ROBOTS.iterdir())


def test_robots_lists_the_hardware_revisions_and_which_is_played(understudy):
    robots = {robot["name"]: robot for robot in json.loads(understudy("robots", "--json").stdout)}

    assert robots["g1"]["revisions"] == ["2", "3", "5", "6", "11", "12", "13", "14", "15", "16"]
    assert robots["g1"]["revision"] == "5"
    assert robots["g1_23dof"]["revisions"] == ["1", "4", "10"]
    assert robots["go2"]["revisions"] == []


def test_robots_lists_the_firmwares_that_differ_and_which_is_played(understudy):
    robots = {robot["name"]: robot for robot in json.loads(understudy("robots", "--json").stdout)}

    assert robots["g1"]["firmwares"] == ["1.0", "1.4", "1.5.1"]
    assert robots["g1"]["firmware"] == "1.5.3"
    assert robots["go2"]["firmwares"] == ["1.0", "1.1.6"]
    assert robots["b2"]["firmwares"] == []
    assert "firmware from 1.0, 1.4, [1.5.1]" in understudy("robots").stdout


def test_robots_lists_what_answers_on_each(understudy):
    robots = {robot["name"]: robot for robot in json.loads(understudy("robots", "--json").stdout)}

    assert robots["go2"]["kind"] == "quadruped"
    assert robots["b2w"]["kind"] == "wheeled"
    assert "sport_go2" in robots["go2"]["apis"]


def test_check_reads_every_firmware_strictly(understudy, tmp_path):
    robot = tmp_path / "mine.yaml"
    robot.write_text("extends: go2\nrobot:\n  firmwares:\n    '0.5': {moters: 3}\n")
    done = understudy("check", robot)

    assert done.returncode == 3
    assert "mine.yaml:4: key 'robot.moters': unknown" in done.stdout


def test_a_revision_of_another_robot_names_that_robot(understudy):
    done = understudy("run", "g1", "--revision", "10")

    assert done.returncode == 3
    assert "it has 2, 3, 5, 6, 11, 12, 13, 14, 15, 16" in done.stderr
    assert "understudy run g1_23dof --revision 10" in done.stderr


def test_check_reads_every_revision_strictly(understudy, tmp_path):
    robot = tmp_path / "mine.yaml"
    robot.write_text("extends: go2\nrobot:\n  revisions:\n    x: {moters: 3}\n")
    done = understudy("check", robot)

    assert done.returncode == 3
    assert "mine.yaml:4: key 'robot.moters': unknown" in done.stdout


def test_check_reads_every_revision_against_the_model(understudy, tmp_path):
    robot = tmp_path / "heavy.yaml"
    robot.write_text("extends: g1\nrobot:\n  revisions:\n    x: {bodies: [{name: torso, mass: 9}]}\n")
    done = understudy("check", robot)

    assert done.returncode == 4
    assert "revision x: " in done.stdout
    assert "no body 'torso'" in done.stdout


def test_version_as_json_names_ours_and_mujocos(understudy):
    version = json.loads(understudy("version", "--json").stdout)

    assert version["understudy"] in understudy("version").stdout
    assert version["understudy"] in understudy("--version").stdout
    assert version["mujoco"] in understudy("version").stdout


def test_check_finds_our_own_files_sound(understudy):
    files = [*ROBOTS.glob("*.yaml"), *MODELS.glob("*/*.xml")]
    done = understudy("check", "--json", *files, timeout=60)

    assert done.returncode == 0, done.stdout
    assert [entry["file"] for entry in json.loads(done.stdout)] == [str(file) for file in files]
    assert all(entry["ok"] for entry in json.loads(done.stdout))


def test_check_reads_a_layer_over_a_robot_and_a_scene_as_ground(understudy, tmp_path):
    layer, scene, wrong = tmp_path / "layer.yaml", tmp_path / "course.yaml", tmp_path / "wrong.yaml"
    layer.write_text("gate: {timeout: 0.5}\n")
    scene.write_text("terrain: {patches: [{kind: rough}]}\n")
    wrong.write_text("gate:\n  timeuot: 0.5\n")

    done = understudy("check", "--robot", "g1", layer, scene, wrong)

    assert done.returncode == 3
    assert done.stdout.splitlines()[:2] == [f"ok   {layer}: layer for --config, fits g1",
                                            f"ok   {scene}: scene for --scene, fits g1"]
    assert f"{wrong}:2" in done.stdout and "did you mean 'timeout'?" in done.stdout


def test_check_asks_over_which_robot_a_file_is_to_be_read_and_lists_them(understudy, tmp_path):
    layer, expect = tmp_path / "layer.yaml", tmp_path / "expect.yaml"
    layer.write_text("gate: {timeout: 0.5}\n")
    expect.write_text("expect: [{always: gap(lowstate) < 3 ms}]\n")

    done = understudy("check", layer, expect)

    assert done.returncode == 3
    robots = [robot["name"] for robot in json.loads(understudy("robots", "--json").stdout)]
    for line, wrong in zip(done.stdout.splitlines(), (f"{layer}: ", f"{expect}: robot: missing"), strict=True):
        assert wrong in line and "--robot: " + ", ".join(robots) in line
    assert understudy("check", "--robot", "h1", layer, expect).returncode == 0
    expect.write_text("robot: g1\n" + expect.read_text())
    assert understudy("check", expect).returncode == 0


def test_check_tells_the_unsound_from_the_sound(understudy, tmp_path):
    bad = tmp_path / "bad.yaml"
    bad.write_text("robot:\n  nmae: go3\n")
    good = ROBOTS / "go2.yaml"
    done = understudy("check", "--robot", "go2", "--json", bad, good)
    entries = json.loads(done.stdout)

    assert done.returncode == 3
    assert [entry["ok"] for entry in entries] == [False, True]
    assert f"{bad}:2" in entries[0]["text"]
    assert "name" in entries[0]["text"]


def test_check_of_a_bad_model_ends_with_4(understudy, tmp_path):
    bad = tmp_path / "bad.xml"
    bad.write_text("<mujoco><wordbody/></mujoco>")
    done = understudy("check", bad)

    assert done.returncode == 4
    assert done.stdout.startswith("FAIL")
    assert "wordbody" in done.stdout


MUJOCO_3 = """<mujoco>
  <worldbody>
    <body><joint name="knee" range="-1 1" actuatorfrcrange="-5 5"/><geom size="0.1"/></body>
  </worldbody>
  <actuator><motor name="knee" joint="knee"/></actuator>
  <sensor><jointactuatorfrc joint="knee"/></sensor>
</mujoco>
"""


def test_check_lists_what_was_rewritten_each_with_its_line(understudy, tmp_path):
    model = tmp_path / "leg.xml"
    model.write_text(MUJOCO_3)
    entry = json.loads(understudy("check", "--json", model).stdout)[0]
    lines = understudy("check", model).stdout.splitlines()

    assert entry["ok"]
    assert sorted(rewrite["line"] for rewrite in entry["rewrites"]) == [3, 3, 6]
    assert "3 places rewritten" in lines[0]
    assert f"{model}:6: sensor jointactuatorfrc" in "\n".join(lines[1:])


def test_check_names_everything_that_cannot_be_carried_over(understudy, tmp_path):
    model = tmp_path / "leg.xml"
    model.write_text("<mujoco>\n<worldbody>\n<body gravcomp='1'><geom size='1'/>\n<frame/></body>"
                     "\n</worldbody></mujoco>")
    done = understudy("check", model)
    lines = done.stdout.splitlines()

    assert done.returncode == 4
    assert len(lines) == 2
    assert f"{model}:3" in lines[0] and "gravcomp" in lines[0]
    assert f"{model}:4" in lines[1] and "frame" in lines[1]


def test_check_of_what_is_no_description_names_the_kinds_there_are(understudy, tmp_path):
    done = understudy("check", tmp_path / "robot.txt")

    assert done.returncode == 3
    assert ".yaml" in done.stdout


@pytest.mark.parametrize("robot", ["go2", "g1"])
def test_a_printed_configuration_read_again_is_the_same(understudy, tmp_path, robot):
    first = understudy("run", robot, "--print-config", "--set", "gate.timeout=0.5",
                       "--speed", "max", "--start", "clamped")
    assert first.returncode == 0, first.stderr
    printed = tmp_path / "printed.yaml"
    printed.write_text(first.stdout)

    again = understudy("run", robot, "--config", printed, "--print-config")

    assert again.stdout == first.stdout
    assert "timeout: 0.5" in first.stdout


def test_a_printed_configuration_is_a_robot_by_itself(understudy, tmp_path):
    printed = tmp_path / "mine.yaml"
    printed.write_text(understudy("run", "go2", "--print-config").stdout)

    assert understudy("run", printed, "--print-config").stdout == printed.read_text()
    assert understudy("check", printed).returncode == 0


def test_what_is_set_has_the_last_word(understudy, tmp_path):
    extra = tmp_path / "extra.yaml"
    extra.write_text("gate:\n  timeout: 0.5\ntime:\n  speed: 3\n")
    printed = understudy("run", "go2", "--config", extra, "--print-config", "--set",
                         "gate.timeout=0.7", "--set", "time.speed=4", "--speed", "2").stdout

    assert "timeout: 0.7" in printed
    assert "speed: 4" in printed


def test_options_stand_for_settings_in_whatever_order(understudy):
    model = ("--model", MODELS / "go2w" / "go2w.xml")
    for options, use in (((), "fitted"), (("--dynamics", "catalogue"), "catalogue"), (model, "catalogue"),
                         ((*model, "--dynamics", "fitted"), "fitted"), (("--dynamics", "fitted", *model), "fitted")):
        assert f"use: {use}" in understudy("run", "go2", *options, "--print-config").stdout, options


def test_help_config_lists_the_keys_with_what_they_mean(understudy):
    reference = understudy("run", "go2", "--help-config").stdout

    for key in ("network.domain", "gate.timeout", "robot.motors[].torque_limit"):
        row = [line for line in reference.splitlines() if f"`{key}`" in line]
        assert len(row) == 1
        assert row[0].count("|") == 6


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


def test_help_is_a_command_too(understudy):
    assert understudy("help").stdout == understudy("--help").stdout
    assert understudy("help", "run").stdout == understudy("run", "--help").stdout
    assert understudy("help", "ctl", "crane", "lower").stdout == understudy("ctl", "crane", "lower", "--help").stdout
    assert understudy("help", "run").returncode == 0
    assert "did you mean 'run'?" in understudy("help", "rum").stderr


def test_speed_0_is_refused_for_standing_still_is_pause(understudy):
    asked = understudy("ctl", "speed", "0")
    started = understudy("run", "go2", "--speed", "0")

    assert asked.returncode == started.returncode == 2
    assert "to stand still use pause" in asked.stderr
    assert "0.001 to 1000, or max" in started.stderr
