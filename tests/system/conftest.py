"""Does what a user does with understudy: from outside, by its command line and its network.

    tools/sdk_env
    UNDERSTUDY=<the built understudy> build/sdk-env/bin/python -m pytest tests/system

The whole session moves into a network of its own before anything speaks, so nothing here reaches the
machine's network or hears from it, and the network goes with the last process in it. That takes no
rights: where the user has none, a user namespace gives them.
"""

import os
import pathlib
import shutil
import tempfile

import pytest

import namespaces
from robots import Robot, understudy

pytest_plugins = ["desk"]


def pytest_configure(config):
    namespaces.enter_private_network()


@pytest.fixture(autouse=True)
def runtime_dir(monkeypatch):
    """The folder of the control sockets, this test's own. Its path is short: a socket's has to be."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="understudy-"))
    monkeypatch.setenv("UNDERSTUDY_RUNTIME_DIR", str(folder))
    yield folder
    shutil.rmtree(folder)


@pytest.fixture(autouse=True)
def state_dir(monkeypatch, tmp_path_factory):
    """The folder of what is kept from run to run, this test's own; beside tmp_path, whose files tests count."""
    folder = tmp_path_factory.mktemp("state")
    monkeypatch.setenv("XDG_STATE_HOME", str(folder))
    return folder


@pytest.fixture
def play():
    """play(robot, *options, ...): a Robot that is on the network; it is ended after the test."""
    robots = []

    def start(robot, *options, ready=True, **how):
        robots.append(Robot(robot, *options, **how))
        if ready:
            robots[-1].wait_ready()
        return robots[-1]

    yield start
    for robot in reversed(robots):
        robot.end()


@pytest.fixture(name="understudy")
def understudy_fixture():
    """understudy(*arguments): runs it to its end and gives the subprocess.CompletedProcess."""
    return understudy


@pytest.fixture(name="as_nobody")
def as_nobody_fixture(runtime_dir):
    """Puts in front of a command what makes an ordinary user run it; one who has no rights stays who they are."""
    if os.geteuid() != 0 or pathlib.Path("/proc/self/uid_map").read_text().split()[2] == "1":
        return []
    log = runtime_dir / "cdds.LOG"
    log.touch()
    for path in (runtime_dir, log):
        os.chown(path, 65534, 65534)
    # The vendor's SDK writes to that file, which is whose program was the first on the machine.
    own_log = 'touch /tmp/cdds.LOG && mount --bind "$0" /tmp/cdds.LOG && exec "$@"'
    return ["unshare", "--mount", "sh", "-c", own_log, str(log),
            "setpriv", "--reuid", "65534", "--regid", "65534", "--clear-groups"]
