"""The exit code and error line of understudy for each kind of failure."""

import os
import pathlib
import shutil
import signal
import subprocess

import pytest

USAGE, CONFIG, MODEL, BUS = 2, 3, 4, 5

MODELS = pathlib.Path(__file__).parents[2] / "models"
JOINTLESS = """
<mujoco>
  <worldbody>
    <body name="base_link"><freejoint/><geom name="box" size="0.1"/><site name="imu"/></body>
  </worldbody>
</mujoco>
"""


def refused(done, code, *words):
    """Asserts a refusal in one line that holds the words."""
    assert done.returncode == code, f"exit code {done.returncode}\n{done.stdout}\n{done.stderr}"
    assert done.stderr.count("\n") == 1, done.stderr
    for word in words:
        assert word in done.stderr


@pytest.mark.parametrize(("arguments", "code", "words"), [
    (["gp2"], CONFIG, ["gp2", "go2"]),
    (["none/none.yaml"], CONFIG, ["none.yaml"]),
    (["go2", "--set", "gate.time=0.5"], CONFIG, ["--set gate.time=0.5", "timeout"]),
    *((["go2", f"--domain={domain}"], CONFIG, ["domain"]) for domain in ("-1", "233", "1.5", "one")),
    (["go2", "--speed=fast"], CONFIG, ["fast"]),
    (["go2", "--speed=nan"], CONFIG, ["nan"]),
    (["go2", "--duration=-1"], CONFIG, ["-1"]),
    (["go2", "--start=siting"], CONFIG, ["understudy: --start siting: start.pose: "]),
    (["g1", "--start=standing", "--released"], CONFIG, ["understudy: --start standing: ", "start it hanging"]),
    (["go2", "--dynamics=fited"], CONFIG, ["did you mean 'fitted'?"]),
    (["go2", "--profile=wron"], CONFIG, ["no profile 'wron'", "did you mean 'worn'?"]),
    (["h1", "--dynamics=fitted"], CONFIG, ["robot 'h1' has no fitted figures; choose catalogue"]),
    (["go2", "--set", "robot.model=/none/no.xml"], MODEL, ["no.xml"]),
    (["go2", "--look", "/none/looks"], MODEL, ["/none/looks", "no such file or folder", "unitree_mujoco"]),
    (["go2", "--scene", "flt"], MODEL, ["flt", "flat"]),
    (["go2", "--scene", "ruff"], MODEL, ["did you mean 'rough'?"]),
    (["go2", "--scene", "ground.xml"], MODEL, ["ground.xml: no such file"]),
    (["go2", "--interface", "l0"], BUS, ["l0", "lo"]),
])
def test_a_value_that_does_not_do_is_named_with_the_nearest_that_does(understudy, arguments, code, words):
    refused(understudy("run", *arguments), code, *words)


@pytest.mark.parametrize("arguments", [
    ("run", "go2", "--profile", "wron"), ("rehearse", "push", "--profile", "wron"),
    ("rehearse", "push", "--seed", "one"), ("export", "urdf", "g1", "--revision", "99"),
    ("terrain", "rough", "--out", "ground", "--difficulty", "2"),
])
def test_a_refusal_names_the_option_as_it_was_typed(understudy, arguments):
    done = understudy(*arguments)

    refused(done, CONFIG, f"understudy: {' '.join(arguments[-2:])}: ")
    assert "--set" not in done.stderr


def test_the_ground_of_a_scan_is_a_scene_and_is_not_written(understudy, tmp_path):
    done = understudy("terrain", "office.ply", "--out", tmp_path / "office")

    refused(done, MODEL, "office.ply is a scan", "--scene office.ply")
    assert not (tmp_path / "office").exists()


@pytest.mark.parametrize(("limit", "words"), [
    (["--nofile", "8"], "files that this process may open (ulimit -n)"),
    (["--nofile", "18"], ""),
    (["--as", "70000000"], "64 MB of memory, more than this process may have (ulimit -v)"),
    (["--as", "100000000"], ""),
])
def test_where_limits_leave_too_little_it_says_so_and_ends(limit, words):
    option, value = limit
    done = subprocess.run(["prlimit", f"{option}={value}", os.environ["UNDERSTUDY"], "run", "go2",
                           "--duration", "0.1"], capture_output=True, text=True, check=False)

    assert 0 < done.returncode < 10, done.stderr
    assert words in done.stderr.splitlines()[-1]
    assert done.stderr.splitlines()[-1].startswith("understudy: ")


@pytest.mark.parametrize(("text", "line", "words"), [
    ("scene: flat\ngate:\n  tiemout: 1\n", ":3", ["tiemout", "timeout"]),
    ("gate:\n  timeout: -1\n", ":2", ["gate.timeout"]),
    ("gate: [", "", []), ("gate: {timeout: 1", "", []), ("\tgate: 1", "", []),
])
def test_what_is_wrong_in_a_file_is_named_with_file_and_line(understudy, tmp_path, text, line, words):
    file = tmp_path / "extra.yaml"
    file.write_text(text)

    refused(understudy("run", "go2", "--config", file), CONFIG, f"{file}{line}", *words)


@pytest.mark.parametrize(("text", "word"), [
    (JOINTLESS, "FR_hip_joint"),
    ("<mujoco><worldbody>", "model.xml"),
])
def test_a_model_that_does_not_do_is_refused_with_its_file(understudy, tmp_path, text, word):
    model = tmp_path / "model.xml"
    model.write_text(text)

    refused(understudy("run", "go2", "--set", f"robot.model={model}"), MODEL, str(model), word)


def test_an_integrator_that_cannot_be_split_is_refused(understudy, tmp_path):
    shutil.copytree(MODELS, tmp_path / "models")
    model = tmp_path / "models" / "go2" / "go2.xml"
    model.write_text(model.read_text().replace("<worldbody>",
                                               '<option integrator="RK4"/><worldbody>', 1))

    refused(understudy("run", "go2", "--set", f"robot.model={model}"), MODEL, str(model), "RK4")


@pytest.mark.parametrize(("arguments", "text"), [
    (("go2",), "no command 'go2' of `understudy`; did you mean `understudy run go2`?"),
    (("rnu", "go2"), "no command 'rnu' of `understudy`; did you mean 'run'?"),
    (("ctl", "--name", "dog", "stauts"), "no command 'stauts' of `understudy ctl`; did you mean 'status'?"),
    (("ctl", "crane"), "a command is missing after `understudy ctl crane`"),
    ((), "Usage: understudy"),
])
def test_a_command_that_is_missing_or_none_is_answered_with_those_there_are(
        understudy, arguments, text):
    done = understudy(*arguments)

    assert done.returncode == USAGE
    assert text in done.stderr
    assert "status" in done.stderr or "run" in done.stderr or "lower" in done.stderr


@pytest.mark.parametrize(("arguments", "text"), [
    (("run", "go2", "--strat", "standing"), "no option '--strat' of `understudy run`; did you mean '--start'?"),
    (("ctl", "push", "--form=2"), "no option '--form' of `understudy ctl push`; did you mean '--for'?"),
    (("check", "go2", "--zzzzzzzzzz"), "no option '--zzzzzzzzzz' of `understudy check`\n"),
])
def test_an_option_that_is_none_is_answered_with_the_nearest(understudy, arguments, text):
    done = understudy(*arguments)

    assert done.returncode == USAGE
    assert text in done.stderr


@pytest.mark.parametrize("arguments", [
    ("go2",), ("run", "go2", "--strat"), ("run",), ("plot",), ("completions", "tcsh"), ("run", "gp2"),
    ("run", "go2", "--domain", "x"), ("plot", "none.mcap"), ("ctl", "status"), ("rehearse", "none"),
])
def test_what_is_wrong_is_said_by_name(understudy, arguments):
    said = understudy(*arguments).stderr

    assert said.startswith("understudy: "), said


@pytest.mark.parametrize(("verb", "form"), [
    (("push",), "[BODY] [FORCE(3x)]"),
    (("fault",), "COMPONENT FAULT"),
    (("crane", "lower"), "BY"),
])
def test_a_help_has_brackets_around_what_may_be_left_out(understudy, verb, form):
    usage = understudy("ctl", *verb, "--help").stdout.split("Usage: ")[1].splitlines()[0]

    assert usage == f"understudy ctl {' '.join(verb)} [OPTIONS] {form}"


def test_help_lists_no_command_that_only_writes_pages_of_the_manual(understudy):
    text = understudy("--help").stdout

    assert "\n  requests" not in text and "\n  rehearse" in text


def test_a_robot_may_be_written_as_the_vendor_writes_it(understudy):
    assert understudy("run", "Go2W", "--print-config").returncode == 0


@pytest.mark.parametrize("arguments", [
    (), ("rum", "go2"), ("run",), ("run", "go2", "--fast"), ("run", "go2", "--more"), ("check",),
    ("exec", "go2"), ("exec", "go2", "--"), ("ctl",), ("ctl", "crane"), ("ctl", "crane", "lower"),
    ("ctl", "crane", "lower", "far"), ("completions", "tcsh"), ("run", "go2", "--log-level", "all"),
    ("exec", "go2", "--network", "mine", "--", "true"), ("ctl", "status", "--robots", "go2"),
])
def test_a_command_line_that_is_not_understood_is_a_usage_error(understudy, arguments):
    done = understudy(*arguments)

    assert done.returncode == USAGE
    assert "--help" in done.stderr
    assert done.stdout == ""


def test_an_order_without_a_robot_says_how_to_start_one(understudy):
    refused(understudy("ctl", "reset"), 1, "understudy run")


@pytest.mark.parametrize("code", [0, 3, 255])
def test_exec_ends_with_the_commands_code(understudy, code):
    assert understudy("exec", "go2", "--", "sh", "-c", f"exit {code}").returncode == code


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL, signal.SIGSEGV])
def test_exec_ends_with_128_and_the_signal_that_ended_the_command(understudy, number):
    done = understudy("exec", "go2", "--", "sh", "-c", f"kill -{number.value} $$")

    assert done.returncode == 128 + number


def test_exec_ends_with_127_when_there_is_no_such_command(understudy):
    refused(understudy("exec", "go2", "--", "no-such-program"), 127, "no-such-program")


def test_exec_ends_with_126_when_the_command_is_no_program(understudy, tmp_path):
    file = tmp_path / "file"
    file.write_text("text")

    refused(understudy("exec", "go2", "--", file), 126, str(file))


def test_exec_ends_with_the_robots_code_when_there_is_no_robot(understudy):
    refused(understudy("exec", "gp2", "--", "true"), CONFIG, "go2")


def test_output_that_a_full_disk_does_not_take_is_an_error():
    with open("/dev/full", "w") as full:
        for command in (["robots"], ["version", "--json"], ["requests"], ["run", "go2", "--print-config"]):
            done = subprocess.run([os.environ["UNDERSTUDY"], *command], stdout=full,
                                  stderr=subprocess.PIPE, text=True, timeout=15)
            assert done.returncode == 1
            assert "standard output cannot be written" in done.stderr


@pytest.mark.parametrize("arguments", [
    ["recording", "PIPE"], ["play", "PIPE"], ["plot", "PIPE"], ["compare", "PIPE", "PIPE"],
    ["picture", "a.png", "--recording", "PIPE"], ["film", "a.mp4", "--recording", "PIPE"],
    ["identify", "PIPE", "--robot", "go2"], ["judge", "PIPE", "stand_up"],
    ["run", "go2", "--record", "PIPE", "--overwrite"],
])
def test_a_pipe_is_no_recording(understudy, tmp_path, arguments):
    pipe = tmp_path / "pipe.mcap"
    os.mkfifo(pipe)
    done = understudy(*[pipe if word == "PIPE" else word for word in arguments], timeout=10, cwd=tmp_path)

    assert done.returncode == 9
    assert f"{pipe}: is not a file" in done.stderr


@pytest.mark.parametrize("arguments", [
    ["run", "PIPE"], ["run", "go2", "--config", "PIPE"], ["run", "go2", "--script", "PIPE"],
    ["run", "go2", "--scene", "PIPE"], ["check", "PIPE"], ["rehearse", "PIPE"],
])
def test_a_pipe_into_which_nobody_writes_is_not_waited_for(understudy, tmp_path, arguments):
    pipe = tmp_path / "pipe.yaml"
    os.mkfifo(pipe)
    done = understudy(*[pipe if word == "PIPE" else word for word in arguments], timeout=10)

    assert 0 < done.returncode < 10
    assert str(pipe) in done.stderr + done.stdout


def test_a_layer_comes_through_a_pipe(understudy, tmp_path):
    shell = '"$UNDERSTUDY" run go2 --print-config --config <(sleep 0.2; echo "gate: {timeout: 0.75}")'
    done = subprocess.run(["bash", "-c", shell], capture_output=True, text=True, timeout=15)

    assert done.returncode == 0, done.stderr
    assert "timeout: 0.75" in done.stdout
