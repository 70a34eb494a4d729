"""The commands that describe understudy and its robots, and print configurations."""

import json
import pathlib

import pytest

SUBCOMMANDS = ["run", "exec", "ctl", "remote", "view", "picture", "film", "robots", "check", "version", "completions", "doctor"]
ROBOTS = pathlib.Path(__file__).parents[2] / "config" / "robots"
MODELS = pathlib.Path(__file__).parents[2] / "models"


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


def test_robots_lists_the_hands_that_a_robot_can_bear(understudy):
    robots = {robot["name"]: robot for robot in json.loads(understudy("robots", "--json").stdout)}
    assert robots["g1"]["hand_makes"] == ["brainco", "dex1", "dex1_old", "dex3", "inspire", "inspire_ftp"]
    assert (robots["g1"]["hands"], robots["g1_29dof_dex3"]["hands"]) == ("none", "dex3")
    assert (robots["h1_2"]["hand_makes"], robots["h1_2"]["hands"]) == (["inspire"], "none")
    assert robots["go2"]["hand_makes"] == []


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


def test_a_revision_of_another_robot_names_that_robot(understudy):
    done = understudy("run", "g1", "--revision", "10")

    assert done.returncode == 3
    assert "it has 2, 3, 5, 6, 11, 12, 13, 14, 15, 16" in done.stderr
    assert "understudy run g1_23dof --revision 10" in done.stderr


def test_version_as_json_names_ours_and_mujocos(understudy):
    version = json.loads(understudy("version", "--json").stdout)

    assert version["understudy"] in understudy("version").stdout
    assert version["understudy"] in understudy("--version").stdout
    assert version["mujoco"] in understudy("version").stdout


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
