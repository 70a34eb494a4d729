"""Runs robot programs that use the vendor's unmodified SDKs against the real understudy.

    tools/sdk_env
    UNDERSTUDY=<the built understudy> build/sdk-env/bin/python -m pytest tests/conformance

Each run has a robot and a private network of its own, which `understudy exec` makes and removes.
"""

import dataclasses
import functools
import json
import os
import pathlib
import subprocess
import sys

import pytest

PROGRAMS = pathlib.Path(__file__).parent / "programs"
PATIENCE = 60.0  # s; few programs run longer than 30 s, and say so

# Runs a command, then leaves the robot's status in the file named first; keeps the exit code.
THEN_STATUS = 'file=$1; shift; "$@"; code=$?; "$UNDERSTUDY" ctl status --json > "$file"; exit $code'


def refusals(counts):
    """Refused commands by cause, without the causes that never occurred.

    Lost ones are left out: newer ones replaced them before a late tick, as on a busy machine.
    """
    return {cause: count for cause, count in counts["refused"].items() if count and cause != "lost"}


@dataclasses.dataclass(frozen=True)
class Run:
    """What one program did, and the robot's own count of commands after it, to body and hands."""

    code: int
    output: str
    errors: str
    commands: dict
    hands: list
    hand_sdk: dict

    @property
    def refused(self):
        """Commands to the body that the robot refused, by cause, as `refusals` has them."""
        return refusals(self.commands)

    @property
    def refused_by_hands(self):
        """The same of each hand."""
        return [refusals(hand) for hand in self.hands]

    @property
    def report(self):
        """The JSON object that the program printed on a line of its own."""
        lines = [line for line in self.output.splitlines() if line.startswith("{")]
        assert lines, f"no report\n{self.output}\n{self.errors}"
        return json.loads(lines[-1])

    def succeeded(self):
        """True, or a failed assertion that shows what the program said."""
        assert self.code == 0, f"exit code {self.code}\n{self.output}\n{self.errors}"
        return True


def command_of(program):
    return [sys.executable, PROGRAMS / program] if str(program).endswith(".py") else [program]


@pytest.fixture(scope="session")
def rehearse(tmp_path_factory):
    """rehearse(robot, program, *arguments, options=(), patience=PATIENCE): starts that robot, runs the
    program on it: the name of one in programs/, or the path of one that is no Python.

    The same rehearsal is run once per session: tests that ask for it again get the same Run.
    """

    tmp_path_factory.getbasetemp()  # its first caller makes it; callers may be threads

    @functools.cache
    def run(robot, program, *arguments, options=(), patience=PATIENCE):
        status = tmp_path_factory.mktemp("status") / "status.json"
        command = [
            os.environ["UNDERSTUDY"], "exec", robot, *options, "--",
            "sh", "-c", THEN_STATUS, "then-status", str(status),
            *command_of(program), *arguments,
        ]  # fmt: skip
        done = subprocess.run(command, capture_output=True, text=True, timeout=patience)
        said = f"{done.stdout}\n{done.stderr}"
        assert status.exists() and status.stat().st_size, f"no status from the robot\n{said}"
        told = json.loads(status.read_text())
        return Run(done.returncode, done.stdout, done.stderr, told["commands"], told["hands"], told["hand_sdk"])

    return run
