"""Fixtures of both suites of Python tests: the understudy under test."""

import os
import pathlib

import pytest


def pytest_configure(config):
    binary = os.environ.get("UNDERSTUDY", "")
    if not os.access(binary, os.X_OK):
        raise pytest.UsageError(
            f"UNDERSTUDY is '{binary}': set it to the understudy binary that is to be tested")
    # Programs run where pytest was started from, not where the binary was named from.
    os.environ["UNDERSTUDY"] = str(pathlib.Path(binary).absolute())
