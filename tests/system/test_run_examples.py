"""tools/run_examples and what it is told of the vendor's examples."""

import importlib.machinery
import importlib.util
import os
import pathlib
import re
import subprocess
import sys
import tomllib

import pytest

REPO = pathlib.Path(__file__).parents[2]
ROWS = tomllib.loads((REPO / "tools" / "run_examples.toml").read_text())


@pytest.fixture(scope="module")
def tool():
    loader = importlib.machinery.SourceFileLoader("run_examples", str(REPO / "tools/run_examples"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("run_examples", loader))
    loader.exec_module(module)
    return module


def test_all_49_and_41_examples_are_known_and_in_the_document():
    documented = re.findall(r"^\| (\S+\.(?:py|cpp)) \|", (REPO / "docs/reference/examples.md").read_text(),
                            re.MULTILINE)
    assert [len(ROWS["cpp"]), len(ROWS["python"])] == [49, 41]
    assert sorted(documented) == sorted(row["path"] for rows in ROWS.values() for row in rows)


def test_every_row_says_only_what_the_tool_knows(tool):
    for sdk, rows in ROWS.items():
        known = {*tool.DEFAULTS, "path", "level", "needs", *(["program"] if sdk == "cpp" else [])}
        for row in rows:
            assert set(row) <= known, row["path"]


@pytest.mark.parametrize(
    ("row", "code", "said", "highest", "reason"),
    [
        ({}, 3, "", 0.0, "exit code 3"),
        ({}, 124, "", 0.0, "still ran"),
        ({"ends": "on Ctrl-C"}, 0, "", 0.0, "exit code 0"),
        ({"says": ["Done!"]}, 0, "Don", 0.0, "did not say `Done!`"),
        ({}, 0, "x\nTraceback (most recent call last):\n  a\nValueError", 0.0, "said `Traceback"),
        ({}, 0, "[1] warning: refused 1 call of sport 1005 StandDown (state): not now\n", 0.0, "said `[1] warning"),
        ({"rises": 0.3}, 0, "", 0.1, "rose to 0.10 m only"),
        ({"commands": True}, 0, "", 0.0, "no command was taken"),
        ({"arms": True}, 0, "", 0.0, "moved the arms with weight 0.00 only"),
        ({"hands": True}, 0, "", 0.0, "moved the hands with weight 0.00 only"),
    ],
)
def test_what_is_not_an_end_is_said(tool, row, code, said, highest, reason):
    watch = tool.Watch("understudy", "nobody")
    watch.highest = highest
    found = list(tool.faults({**tool.DEFAULTS, **row}, code, said, watch))
    assert len(found) == 1 and found[0].startswith(reason)


def test_a_program_that_runs_until_ctrl_c_has_run_to_its_end(tool):
    said = 'Traceback (most recent call last):\n  File "a", line 1\nKeyboardInterrupt\n'
    row = {**tool.DEFAULTS, "ends": "on Ctrl-C"}
    assert list(tool.faults(row, 124, said, tool.Watch("understudy", "nobody"))) == []


def test_a_call_for_what_is_not_simulated_is_no_fault_of_the_program(tool):
    said = "[1] warning: refused 2 calls of sport 1020 FrontFlip (not_simulated): it is not simulated; code 4205\n"
    assert list(tool.faults(tool.DEFAULTS, 0, said, tool.Watch("understudy", "nobody"))) == []


@pytest.mark.parametrize(("code", "exit_code", "result"), [(0, 0, "yes"), (42, 1, "no: exit code 42")])
def test_a_program_runs_beside_its_robot(tmp_path, code, exit_code, result):
    program = tmp_path / "test_jsonize"
    program.write_text(f'#!/bin/sh\n"$UNDERSTUDY" ctl status > /dev/null && exit {code}\n')
    program.chmod(0o755)
    done = subprocess.run([sys.executable, REPO / "tools/run_examples", "cpp", tmp_path, "jsonize"],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == exit_code
    assert result in done.stdout


def test_without_an_understudy_it_says_how_to_get_one(tmp_path):
    done = subprocess.run([sys.executable, REPO / "tools/run_examples", "cpp", tmp_path],
                          capture_output=True, text=True, timeout=60,
                          env={**os.environ, "UNDERSTUDY": str(tmp_path / "none")})
    assert done.returncode == 1
    assert done.stderr == (f"{tmp_path}/none: not there; build it with tools/up, or name another in "
                           "UNDERSTUDY\n")


def test_a_program_that_is_not_there_is_named(tmp_path):
    done = subprocess.run([sys.executable, REPO / "tools/run_examples", "cpp", tmp_path, "jsonize"],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    assert f"{tmp_path}/test_jsonize: no such program" in done.stderr
