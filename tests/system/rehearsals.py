"""Rehearsals from a shell, and what they leave. A file that imports the fixture from here has it as its own."""

import json

import pytest

FAILED, OPEN = 10, 11  # exit codes


def verdicts(folder):
    return json.loads((folder / "verdict.json").read_text())


def outcomes(folder):
    return {one["name"]: one["outcome"] for one in verdicts(folder)["verdicts"]}


@pytest.fixture(name="rehearse")
def rehearse_fixture(understudy, tmp_path):
    """rehearse(scenario, *options, out=...): plays it into a folder of this test."""
    def play(scenario, *options, out="out", program=()):
        command = ("--", *program) if program else ()
        return understudy("rehearse", scenario, "--out", tmp_path / out, *options, *command, timeout=240)
    return play
