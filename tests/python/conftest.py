"""Runs the package that `pip install .` makes, in the environment of tools/python_env.

    tools/sdk_env && tools/python_env
    UNDERSTUDY=<the built understudy> build/python-env/bin/python -m pytest tests/python
"""

import os
import pathlib

import pytest


@pytest.fixture
def programs():
    return pathlib.Path(__file__).parent / "programs"


@pytest.fixture
def sdk_python():
    """The Python with the vendor's SDK."""
    python = pathlib.Path(os.environ.get("UNDERSTUDY_SDK_ENV", "build/sdk-env")).absolute() / "bin" / "python"
    assert python.exists(), f"{python}: no such Python; make it with tools/sdk_env"
    return python
