"""The examples at the head of the helps of tools/, in their own words where a test can."""

import os
import re
import subprocess

import pytest

from desk import ROOT
from robots import understudy

TOOLS = sorted(file.name for file in (ROOT / "tools").iterdir() if file.is_file() and os.access(file, os.X_OK))

# What a test cannot do, by how the line begins: why, and what stands for it.
ELSEWHERE = {
    "tools/sdk_env": "made the environment in which this runs",
    "tools/run_examples (python|cpp) SDK": "needs the vendor's SDKs: test_run_examples.py has it run programs of theirs",
    "tools/identify_go2 CHECKOUT": "needs recordings of others, which nothing here fetches: docs/identify.md says what it told",
}


def run(*words, **how):
    return subprocess.run(words, capture_output=True, text=True, timeout=120, **how)


def help_of(tool):
    done = run(ROOT / "tools" / tool, "--help")
    assert done.returncode == 0, done.stderr
    return done.stdout


def examples_of(tool):
    return re.findall(r"^ +(tools/\S+.*)$", help_of(tool), re.MULTILINE)


def of_tool(name):
    return [line for line in examples_of(name) if not any(re.match(begin, line) for begin in ELSEWHERE)]


@pytest.mark.parametrize("tool", [tool for tool in TOOLS if tool != "bench"])  # whose help is the program's
def test_a_tool_tells_what_it_is_for(tool):
    assert re.search(rf"^[Uu]sage: (tools/)?{tool}\b", help_of(tool), re.MULTILINE)


@pytest.mark.parametrize("line", of_tool("soak"))
def test_a_soak_of_seconds_in_place_of_minutes_goes_as_the_help_says(line, tmp_path):
    command, _, *rest = line.replace("/tmp/night.mcap", str(tmp_path / "night.mcap")).split()
    done = run(ROOT / command, "0.15", *rest)
    assert done.returncode == 0, done.stdout + done.stderr
    assert len(done.stdout.splitlines()) > 10, done.stdout
    assert "--record" not in rest or (tmp_path / "night.mcap").stat().st_size > 0


@pytest.mark.parametrize("line", of_tool("up"))
def test_what_up_starts_after_it_has_built_goes_as_the_help_says(line):
    _, robot, *options = line.split()
    done = understudy("run", robot, *options, "--duration", "0.1", "--no-panel")
    assert done.returncode == 0, done.stderr


def test_no_other_help_of_a_tool_has_an_example():
    there = {line for tool in TOOLS if tool != "bench" for line in examples_of(tool)}
    assert {line for line in there if not any(re.match(begin, line) for begin in ELSEWHERE)} \
        == set(of_tool("soak")) | set(of_tool("up"))
    assert all(any(re.match(begin, line) for line in there) for begin in ELSEWHERE)
