"""`understudy plot` and `compare`: plots of a recording, and of two."""

import json
import os
import struct
import xml.etree.ElementTree as ElementTree

import pytest

from robots import understudy

PUSHED = "script:\n  - {at: 0.5, push: {force: [0, 60, 0], for: 0.1}}\n"


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    folder = tmp_path_factory.mktemp("plot")
    os.chmod(folder, 0o700)
    (folder / "pushed.yaml").write_text(PUSHED)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("UNDERSTUDY_RUNTIME_DIR", str(folder))
        done = understudy("run", "go2", "--record", folder / "go2.mcap", "--duration", 2,
                          "--speed", "max", "--script", folder / "pushed.yaml")
    assert done.returncode == 0, done.stderr
    return folder / "go2.mcap"


def test_a_picture_lies_beside_its_recording(file):
    done = understudy("plot", file)
    picture = file.with_suffix(".png")

    assert (done.returncode, done.stdout.strip()) == (0, str(picture)), done.stderr
    head = picture.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    assert struct.unpack(">2I", head[16:]) == (1600, 1070)


def test_a_drawing_has_the_words_of_the_run(file, tmp_path):
    drawing = tmp_path / "go2.svg"
    done = understudy("plot", file, "--out", drawing, "--motors", "FR_calf,3", "--fields", "tau",
                      "--signals", "rt/lowstate:imu_state.gyroscope[2]", "--size", "800x1000")

    assert done.returncode == 0, done.stderr
    words = " ".join(ElementTree.parse(drawing).getroot().itertext())
    for word in ("FR_calf", "FL_hip", "tau [N·m]", "gyroscope[2]", "motion service mcf",
                 "pushed.yaml:2", "time [s]", "height [m]"):
        assert word in words, word
    assert "q [rad]" not in words


def test_without_gnuplot_the_package_is_named(file, tmp_path):
    done = understudy("plot", file, "--out", tmp_path / "a.png",
                      env={**os.environ, "PATH": str(tmp_path)})

    assert done.returncode == 9
    assert "apt-get install gnuplot-nox" in done.stderr


def test_misuse_is_said(file, tmp_path):
    def refused(*arguments):
        done = understudy("plot", file, *arguments)
        return done.returncode, done.stderr

    code, said = refused("--motors", "FR_claf")
    assert code == 9 and "did you mean 'FR_calf'?" in said
    assert refused("--out", tmp_path / "a.gif")[0] == 9
    assert refused("--out", tmp_path / "none/a.png")[0] == 9
    assert refused("--size", "10x10")[0] == 2
    assert refused("--from", "30")[0] == 9


def test_a_recording_is_compared_with_itself_and_drawn(file, tmp_path):
    page = tmp_path / "compare.html"
    done = understudy("compare", file, file, "--out", page, "--json")

    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert (told["robot"], told["shift"]) == ("go2", 0)
    assert len(told["motors"]) == 12
    assert all(motor["q"]["rms"] == 0 for motor in told["motors"])
    assert "FR_calf [rad]" in page.read_text()


def test_a_shift_that_leaves_nothing_in_common_is_refused(file):
    done = understudy("compare", file, file, "--shift", 60)

    assert done.returncode == 9
    assert "less than a second in common" in done.stderr


def test_the_damage_sheet_is_recorded_once_a_second_and_at_the_end(tmp_path):
    for seconds, sheets in (("2", 2), ("1.5", 2)):
        file = tmp_path / f"{seconds}.mcap"
        assert understudy("run", "go2", "--record", file, "--duration", seconds, "--speed", "max",
                          "--domain", 9).returncode == 0
        channels = json.loads(understudy("recording", file, "--json").stdout)["channels"]
        assert [channel["messages"] for channel in channels
                if channel["topic"] == "understudy/damage"] == [sheets]
