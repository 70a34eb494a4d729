"""Settings of the process itself have an effect; those of what it plays: tests/run/settings_test.cc."""

import os
import pathlib
import re
import resource
import shutil
import time

import pytest

import namespaces
from robots import understudy

ROBOTS = pathlib.Path(__file__).parents[2] / "config" / "robots"
DIVERGING = ("--speed", "max", "--duration", 3, "--set", "start.pose=hanging", "--set", "crane.stiffness=1000000",
             "--set", "crane.damping=100000", "--set", "physics.timestep=0.01", "--set", "robot.rates.lowstate_hz=100",
             "--set", "robot.rates.motion_hz=100", "--set", "robot.rates.service_hz=100")


@pytest.mark.parametrize(("setting", "before", "after"), [
    ("control.panel=false", "panel: http", ""),
    ("control.address=127.0.0.2", "panel: http://127.0.0.1:", "panel: http://127.0.0.2:"),
    ("control.port=17707", "", "panel: http://127.0.0.1:17707/"),
    ("time.realtime=false", "SCHED_FIFO", ""),
    ("robot.name=rex", "go2 is on lo", "rex is on lo"),
])
def test_what_the_log_says_follows_the_setting(setting, before, after):
    """One text is in the log before only, the other after only; one that is empty does not matter."""
    usual, changed = (understudy("run", "go2", "--duration", 0.01, "--set", one).stderr
                      for one in ("time.speed=1", setting))
    assert before in usual
    assert after in changed
    assert not before or before not in changed
    assert not after or after not in usual


@pytest.mark.parametrize(("key", "interface"), [("listen_loopback", "lo"), ("listen_network", "veth0")])
def test_listening_takes_its_time(key, interface):
    walls = []
    with namespaces.cable(("veth0", "10.9.8.1/24"), ("veth1", "10.9.8.2/24")):
        for listen in (0, 1.5):
            started = time.monotonic()
            done = understudy("run", "go2", "--duration", 0.01, "--set", f"network.interface={interface}",
                              "--set", f"guard.{key}={listen}")
            assert done.returncode == 0, done.stderr
            assert f"on {interface}" in done.stderr
            walls.append(time.monotonic() - started)
    assert walls[1] > walls[0] + 0.7, walls


def test_too_few_processes_are_said(tmp_path):
    """Root may start any number, so nobody does it; Cyclone would end the process without a word."""
    def few():
        if os.geteuid() == 0:
            os.setgroups([])
            os.setgid(65534)
            os.setuid(65534)
        resource.setrlimit(resource.RLIMIT_NPROC, (4, 4))
    tmp_path.chmod(0o777)
    for folder in tmp_path.parents:
        if folder.is_relative_to("/tmp") and folder != pathlib.Path("/tmp"):
            folder.chmod(0o755)
    private = tmp_path / "control"
    done = understudy("run", "go2", "--duration", "0.1", "--domain", "57", preexec_fn=few,
                      env={**os.environ, "UNDERSTUDY_RUNTIME_DIR": str(private), "HOME": str(tmp_path),
                           "TMPDIR": str(tmp_path)})
    assert done.returncode == 5, done.stderr
    assert "threads" in done.stderr and "ulimit -u" in done.stderr


@pytest.mark.parametrize(("action", "code"), [("stop", 7), ("reset", 0)])
def test_a_divergence_is_answered_as_is_set(action, code):
    assert understudy("run", "go2", *DIVERGING, "--set", f"physics.on_divergence={action}").returncode == code


def test_a_robots_description_is_listed(monkeypatch, tmp_path):
    robots = tmp_path / "config" / "robots"
    robots.mkdir(parents=True)
    text, changed = re.subn(r"(?m)^  description: .*$", "  description: a dog", (ROBOTS / "go2.yaml").read_text())
    assert changed == 1
    (robots / "rex.yaml").write_text(text)
    shutil.copy(ROBOTS.parent / "motors.yaml", robots.parent)
    monkeypatch.setenv("UNDERSTUDY_DATA_DIR", str(tmp_path))
    assert "a dog" in understudy("robots").stdout
