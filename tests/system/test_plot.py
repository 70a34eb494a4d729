"""`understudy plot` and `compare`: plots of a recording, and of two."""

import csv
import json
import os
import re
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
    picture = file.with_suffix(".svg")

    assert (done.returncode, done.stdout.strip()) == (0, str(picture)), done.stderr
    drawn = ElementTree.parse(picture).getroot()
    assert (drawn.tag, drawn.get("width"), drawn.get("height")) == ("{http://www.w3.org/2000/svg}svg", "1600", "1070")


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


@pytest.fixture(scope="module")
def waits(tmp_path_factory):
    """A robot that lies still for 9 s, but for the fourth, when it is put down once more."""
    folder = tmp_path_factory.mktemp("waits")
    (folder / "pushed.yaml").write_text("script:\n  - {at: 4, reset: lying}\n")
    done = understudy("exec", "go2", "--record", folder / "waits.mcap", "--duration", 9, "--speed", "max",
                      "--released", "--script", folder / "pushed.yaml", "--", "sleep", 60)
    assert (folder / "waits.mcap").exists(), done.stderr
    return folder / "waits.mcap"


def test_time_in_which_nothing_moves_is_left_out_unless_asked_for(waits, tmp_path):
    drawing = tmp_path / "a.svg"
    trimmed = understudy("plot", waits, "--out", drawing)
    assert trimmed.returncode == 0, trimmed.stderr
    assert "left out; --whole shows it" in trimmed.stderr
    left_out = re.findall(r"([0-9.]+) to ([0-9.]+) s", trimmed.stderr)
    assert (0, 3.5) == pytest.approx(tuple(map(float, left_out[0])), abs=0.1)
    for arguments in (["--whole"], ["--from", 1], ["--to", 8]):
        done = understudy("plot", waits, "--out", drawing, *arguments)
        assert (done.returncode, done.stderr) == (0, "")


def test_two_recordings_are_drawn_over_each_other(file, waits, tmp_path):
    drawing = tmp_path / "two.svg"
    done = understudy("plot", file, waits, "--out", drawing, "--shift", -3.5, "--motors", "FR_calf")
    assert done.returncode == 0, done.stderr
    words = " ".join(ElementTree.parse(drawing).getroot().itertext())
    for word in ("go2.mcap", "dashed: go2, waits.mcap", "FR_calf"):
        assert word in words, word
    assert re.search(r"waits\.mcap: \S*pushed\.yaml:2", words)
    assert "commanded" not in words


def test_a_table_has_every_number_with_its_unit(file, tmp_path):
    table = tmp_path / "go2.csv"
    done = understudy("plot", file, "--out", table, "--fields", "q,dq,tau",
                      "--signals", "rt/lowstate:imu_state.gyroscope[2]")
    assert (done.returncode, done.stdout.strip()) == (0, str(table)), done.stderr
    with table.open(newline="", encoding="utf-8") as lines:
        rows = list(csv.DictReader(lines))
    assert len(rows) >= 1000
    assert {"time [s]", "base height [m]", "base yaw [°]", "FR_calf q [rad]", "RL_hip dq [rad/s]", "FL_thigh tau [N·m]",
            "rt/lowstate:imu_state.gyroscope[2]", "events"} <= set(rows[0])
    times = [float(row["time [s]"]) for row in rows]
    assert times == sorted(times) and times[0] == 0 and times[-1] == pytest.approx(2)
    heights = [float(row["base height [m]"]) for row in rows if row["base height [m]"]]
    assert len(heights) == 1000 and all(0.2 < height < 0.5 for height in heights)
    assert any("push base_link" in row["events"] or "pushed.yaml:2" in row["events"] for row in rows)

    beside = understudy("plot", file, file, "--csv", "--motors", "FR_calf", "--from", 1, "--to", 1.1)
    assert beside.stdout.strip() == str(file.with_suffix(".csv")), beside.stderr
    with file.with_suffix(".csv").open(newline="", encoding="utf-8") as lines:
        both = list(csv.DictReader(lines))
    assert {row["recording"] for row in both} == {"go2.mcap"}
    assert [name for name in both[0] if name.startswith("F")] == ["FR_calf q [rad]", "FR_calf tau [N·m]"]
    assert both[:len(both) // 2] == both[len(both) // 2:]


def test_misuse_is_said(file, tmp_path):
    def refused(*arguments):
        done = understudy("plot", file, *arguments)
        return done.returncode, done.stderr

    for arguments, code, words in (
            (("--csv", "--out", "a.csv"), 2, ["--csv", "--out"]),
            (("--csv", "--size", "800x600"), 2, ["--size", "--csv"]),
            (("--out", tmp_path / "a.csv", "--size", "800x600"), 2, ["--size", "no pixels"]),
            (("--shift", 1), 2, ["--shift", "second"]),
            (("--whole", "--from", 1), 2, ["--whole", "--from"]),
            ((file, "--shift", "soon"), 2, ["--shift", "soon"]),
            ((file, "--shift", 60), 9, ["nothing in common"]),
            ((tmp_path / "none.mcap",), 9, ["none.mcap"]),
            (("--out", tmp_path / "none/a.csv"), 9, ["cannot be written"])):
        got, said = refused(*arguments)
        assert got == code, (arguments, said)
        for word in words:
            assert word in said, (arguments, said)

    code, said = refused("--motors", "FR_claf")
    assert code == 9 and "did you mean 'FR_calf'?" in said
    assert refused("--out", tmp_path / "a.gif")[0] == 9
    assert refused("--out", tmp_path / "none/a.svg")[0] == 9
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
