"""The package as it is installed: its command, its check of itself and its types."""

import importlib.metadata
import pathlib
import subprocess
import sys

import understudy

HERE = pathlib.Path(understudy.__file__).parent


def test_needs_numpy_alone():
    assert [line for line in importlib.metadata.requires("understudy-robot") if "extra" not in line] == ["numpy>=1.24"]


def test_checks_itself():
    done = subprocess.run([sys.executable, "-m", "understudy"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "go2: stands" in done.stdout and "g1: stands" in done.stdout


def test_brings_the_program():
    program = pathlib.Path(sys.executable).parent / "understudy"
    done = subprocess.run([program, "version"], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0 and importlib.metadata.version("understudy-robot") in done.stdout
    robots = subprocess.run([program, "robots"], capture_output=True, text=True, timeout=60).stdout
    assert all(name in robots for name in understudy.robot_names())


def test_tells_types_and_units():
    assert (HERE / "py.typed").exists()
    stub = (HERE / "_understudy.pyi").read_text()
    assert "def command(self" in stub and "rad/s, shape (motors,)" in stub


def test_takes_its_models_from_nowhere_else():
    assert any(str(HERE) in note for note in understudy.Robot("go2").world.notes)
