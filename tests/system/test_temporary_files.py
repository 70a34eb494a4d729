"""Nothing stays in the temporary folder after the end of a command, whatever ends it."""

import os
import pathlib
import signal
import subprocess
import time

import pytest

ENDS = (signal.SIGTERM, signal.SIGHUP, signal.SIGINT)


@pytest.fixture(name="tmp")
def tmp_fixture(tmp_path, monkeypatch):
    """The temporary folder of what is run in the test."""
    folder = tmp_path / "tmp"
    folder.mkdir()
    monkeypatch.setenv("TMPDIR", str(folder))
    return folder


@pytest.mark.parametrize("arguments", [
    ["run", "go2", "--scene", "rough", "--duration", "0.1"],
    ["run", "go2", "--scene", "rough", "--duration", "0.1", "--record", "OUT/a.mcap"],
    ["run", "go2", "--scene", "rough", "--interface", "l0"],
    ["run", "go2", "--scene", "rough", "--set", "terrain.difficulty=7"],
    ["exec", "go2", "--scene", "rough", "--network", "host", "--", "true"],
    ["exec", "go2", "--scene", "rough", "--interface-name", "eth0", "--", "true"],
    ["rehearse", "stand_up", "--out", "OUT/rehearsal"],
    ["doctor"],
    ["terrain", "rough", "OUT/ground"],
    ["completions", "bash"],
    ["robots"],
])
def test_a_command_that_ends_leaves_nothing(understudy, tmp, tmp_path, arguments):
    understudy(*[word.replace("OUT", str(tmp_path)) for word in arguments])

    assert os.listdir(tmp) == []


def test_a_recording_that_is_played_plotted_and_drawn_leaves_nothing(play, understudy, tmp, tmp_path):
    file = tmp_path / "a.mcap"
    assert understudy("run", "go2", "--scene", "rough", "--duration", "0.5", "--record",
                      file).returncode == 0
    understudy("play", file)
    understudy("recording", file)
    understudy("compare", file, file)
    understudy("judge", file, "stand_up", "--out", tmp_path / "judged")
    understudy("plot", file)
    understudy("picture", tmp_path / "a.png", "--recording", file)
    understudy("film", tmp_path / "a.mp4", "--recording", file, "--size", "64x64")
    robot = play("go2", "--scene", "rough")
    understudy("picture", tmp_path / "b.png", "--name", robot.name)
    robot.send(signal.SIGTERM)
    robot.exit_code()

    assert [name for name in os.listdir(tmp) if "understudy" in name] == []
    assert (tmp_path / "judged").is_dir()


@pytest.mark.parametrize("number", ENDS)
@pytest.mark.parametrize("delay", [0.05, 0.2, 0.4])
def test_a_command_that_a_signal_ends_while_it_starts_leaves_nothing(play, tmp, number, delay):
    robot = play("go2", "--scene", "rough", ready=False)
    time.sleep(delay)
    robot.send(number)
    time.sleep(0.01)
    robot.send(number)
    robot.exit_code()

    assert os.listdir(tmp) == []


# In a /tmp and a /run of its own: other robots of this user may be in the machine's. What is run stays where it is, even
# in /tmp.
ALONE = """
set -e
mount --rbind "$ROOT" /mnt
mount -t tmpfs none /tmp
mount -t tmpfs none /run
if [[ $ROOT == /tmp/* ]]; then
  mkdir -p "$ROOT"
  mount --rbind /mnt "$ROOT"
fi
"$UNDERSTUDY" run go2 --duration 0.5 --log-level error &
"$UNDERSTUDY" run go2 --domain 1 --duration 0.3 --log-level error
wait $!
find /tmp -mindepth 1 -name 'understudy-*' -not -path "$ROOT*"
"""
ROOT = str(pathlib.Path(__file__).parents[2])


def test_the_control_folder_in_tmp_goes_with_the_last_robot(monkeypatch):
    for name in ("UNDERSTUDY_RUNTIME_DIR", "XDG_RUNTIME_DIR"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("ROOT", ROOT)
    done = subprocess.run(["unshare", "--user", "--map-root-user", "--mount", "bash", "-c", ALONE],
                          capture_output=True, text=True, timeout=60, check=False)

    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
