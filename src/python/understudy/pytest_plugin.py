"""The fixture of pytest: def test_it(understudy_robot): robot = understudy_robot("go2"); ..."""

import contextlib

import pytest


@pytest.fixture
def understudy_robot():
    """Starts robots, as understudy.robot; they end with the test."""
    from .testing import robot

    with contextlib.ExitStack() as stack:
        yield lambda *arguments, **how: stack.enter_context(robot(*arguments, **how))
