"""ROS 2 bags, as rosbags writes them, are read as the MCAP recording of the same messages is."""

import functools
import json
import pathlib
import shutil
import sys

import pytest
from mcap.writer import Writer as McapWriter
from rosbags.rosbag2 import CompressionMode, StoragePlugin

from bags import TOPICS, bag_of, messages_of
from peers import listener
from robots import understudy

ROOT = pathlib.Path(__file__).parents[2]
OPEN, WRONG = 11, 9

# All but the last need nothing of the simulation's.
EXPECT = """
  - {always: rate(lowstate) between 490 and 510, name: states come}
  - {eventually: rate(lowcmd) > 50, name: commands come}
  - {always: first_jump < 0.1, name: begins where it is}
  - {always: tau_est_share(FR_calf) <= 1, name: within its torque}
  - {always: temperature(FR_calf) < 90, name: stays cool}
  - {always: base.height > 0, name: truth}
"""


@pytest.fixture(scope="module", name="made")
def made_fixture(tmp_path_factory):
    """The same messages as MCAP, as a folder of a bag in SQLite, its file alone, a folder with MCAP, and compressed
    as `ros2 bag record --compression-format zstd` does: message by message, and each file."""
    folder = tmp_path_factory.mktemp("bags")
    (folder / "stands.yaml").write_text((ROOT / "config" / "scenarios" / "sdk_stand.yaml").read_text() + EXPECT)
    done = understudy("rehearse", folder / "stands.yaml", "--out", folder / "out", "--clock", "simulated", "--", sys.executable,
                      ROOT / "examples" / "python" / "stand.py", "lo", timeout=240)
    # It compares what it judged in the run with what it judges from the recording, bit for bit.
    assert done.returncode == 0, done.stdout + done.stderr
    recording = folder / "out" / "recording.mcap"
    plain = folder / "plain.mcap"
    with plain.open("wb") as target:
        writer = McapWriter(target)
        writer.start()
        ids = {}
        for schema, channel, message in messages_of(recording, TOPICS):
            if channel.topic not in ids:
                ids[channel.topic] = writer.register_channel(
                    channel.topic, "cdr", writer.register_schema(schema.name, schema.encoding, schema.data))
            writer.add_message(ids[channel.topic], message.log_time, message.data, message.log_time)
        writer.finish()
    sqlite = bag_of(recording, folder / "sqlite")
    file = next(sqlite.glob("*.db3"))
    shutil.copy(file, folder / "alone.db3")
    mcap = bag_of(recording, folder / "mcap", StoragePlugin.MCAP)
    bags = {"recording": recording, "plain": plain, "sqlite": sqlite, "file": folder / "alone.db3", "mcap": mcap}
    for name, storage in (("sqlite", StoragePlugin.SQLITE3), ("mcap", StoragePlugin.MCAP)):
        for mode in (CompressionMode.MESSAGE, CompressionMode.FILE):
            kind = f"{name} by {mode.name.lower()}"
            bags[kind] = bag_of(recording, folder / kind, storage, mode)
    shutil.copy(next(bags["sqlite by file"].glob("*.db3.zstd")), folder / "alone.db3.zstd")
    return bags | {"file by file": folder / "alone.db3.zstd"}


PACKED = ("sqlite by message", "sqlite by file", "mcap by message", "mcap by file", "file by file")
BAGS = ("sqlite", "file", "mcap", *PACKED)


@pytest.mark.parametrize("form", BAGS)
def test_a_bag_holds_what_the_recording_does(made, form):
    plain, bag = (json.loads(understudy("recording", made[one], "--json").stdout) for one in ("plain", form))
    assert bag["messages"] == plain["messages"] and bag["seconds"] == plain["seconds"]
    assert ([(one["topic"], one["type"], one["messages"]) for one in sorted(bag["channels"], key=str)]
            == [(one["topic"], one["type"], one["messages"]) for one in sorted(plain["channels"], key=str)])
    assert {one["topic"] for one in bag["channels"]} == {"rt/lowstate", "rt/lowcmd"}


@pytest.mark.parametrize("form", BAGS)
def test_a_bag_is_judged_as_the_recording_is_bit_for_bit(made, form, tmp_path):
    (tmp_path / "expect.yaml").write_text("robot: go2\nexpect:" + EXPECT)
    told = {}
    for one in ("plain", form):
        done = understudy("judge", made[one], tmp_path / "expect.yaml", "--out", tmp_path / one)
        assert done.returncode == OPEN, done.stdout + done.stderr
        told[one] = json.loads((tmp_path / one / "verdict.json").read_text())["verdicts"]
    assert told[form] == told["plain"]
    outcomes = {one["name"]: one["outcome"] for one in told[form]}
    assert outcomes.pop("truth") == "not judged"
    assert set(outcomes.values()) == {"passed"}, outcomes
    # In the run it came from the event, here from the messages.
    run = {one["name"]: one["margin"] for one in
           json.loads((made["recording"].parent / "verdict.json").read_text())["verdicts"]}
    bag = {one["name"]: one["margin"] for one in told[form]}
    assert abs(run["begins where it is"] - bag["begins where it is"]) < 0.01


@functools.cache
def delay_of(recording):
    done = understudy("identify", recording, "--robot", "go2", "--json", "--parameters", "delay", timeout=240)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)["figures"]


@pytest.mark.parametrize("form", ("sqlite", "mcap", "sqlite by file", "mcap by message"))
def test_a_bag_is_compared_plotted_and_fitted_as_the_recording_is(made, form, tmp_path):
    apart = [json.loads(understudy("compare", made["recording"], made[one], "--json").stdout)
             for one in ("plain", form)]
    assert apart[0]["motors"] == apart[1]["motors"] and apart[1]["motors"]
    tables = []
    for one in ("plain", form):
        table = tmp_path / f"{one}.csv"
        done = understudy("plot", made[one], "--out", table)
        assert done.returncode == 0, done.stderr
        tables.append(table.read_text())
    assert tables[0] == tables[1] and len(tables[0].splitlines()) > 1000
    assert delay_of(made["plain"]) == delay_of(made[form])


@pytest.mark.parametrize("form", ("sqlite", *PACKED))
def test_a_bag_is_played_and_its_commands_reach_a_robot(made, play, form):
    with listener() as ear:
        done = understudy("play", made[form], "--topics", "rt/lowstate", "--from", 1, "--to", 2)
        ticks = [state.tick for state in ear.take()]
    assert done.returncode == 0, done.stderr
    # A reader that learns of the writer late misses the beginning.
    assert len(ticks) > 200 and ticks == list(range(ticks[0], ticks[-1] + 1, 2)), done.stderr
    recorded = {one["topic"]: one["messages"]
                for one in json.loads(understudy("recording", made[form], "--json").stdout)["channels"]}
    robot = play("go2", "--released")
    done = understudy("play", made[form], "--commands", "--speed", 4)
    assert done.returncode == 0, done.stderr
    counts = robot.status()["commands"]
    assert recorded["rt/lowcmd"] > 50
    assert counts["accepted"] + sum(counts["refused"].values()) == recorded["rt/lowcmd"]


def test_a_bag_of_a_g1_is_judged_and_compared(tmp_path):
    out = tmp_path / "out"
    done = understudy("rehearse", "crane", "--no-pictures", "--out", out, timeout=240)
    assert done.returncode == 0, done.stdout + done.stderr
    bag = bag_of(out / "recording.mcap", tmp_path / "bag", topics=("/lowstate", "/lf/bmsstate"))
    (tmp_path / "expect.yaml").write_text("robot: g1\nexpect:\n  - {always: gap(lowstate) < 3 ms, name: wire}\n"
                                          "  - {always: temperature(left_knee) < 90, name: heat}\n"
                                          "  - {always: base.height > 0, name: truth}\n")
    done = understudy("judge", bag, tmp_path / "expect.yaml", "--out", tmp_path / "judged")
    assert done.returncode == OPEN, done.stdout + done.stderr
    told = json.loads((tmp_path / "judged" / "verdict.json").read_text())["verdicts"]
    assert [one["outcome"] for one in told] == ["passed", "passed", "not judged"]

    done = understudy("compare", out / "recording.mcap", bag, "--json", "--out", tmp_path / "compare.html")
    assert done.returncode == 0, done.stderr
    quantities = {one["name"]: one for one in json.loads(done.stdout)["rest"]}
    battery = [quantities[f"battery.{name}"] for name in ("voltage", "current", "soc")]
    assert all(one["rms"] == 0 for one in battery)
    assert 40 < battery[0]["rms_first"] < 60 and 0 < battery[1]["rms_first"] < 40 and 0 < battery[2]["rms_first"] <= 100


def test_what_cannot_be_read_is_told(made, tmp_path, monkeypatch):
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setenv("TMPDIR", str(temporary))
    bag = shutil.copytree(made["sqlite by file"], tmp_path / "bag")
    metadata = (bag / "metadata.yaml").read_text()
    (bag / "metadata.yaml").write_text(metadata.replace("compression_format: zstd", "compression_format: lz4"))
    refused = understudy("recording", bag)
    assert refused.returncode == WRONG and "compressed by lz4, expected zstd" in refused.stderr, refused.stderr
    (bag / "metadata.yaml").write_text(metadata)
    file = next(bag.glob("*.zstd"))
    whole = file.read_bytes()
    for bytes_of, why in ((whole[:100_000], "does not unpack: it ends early"),
                          (whole[:100_000] + bytes(1000), "does not unpack: ")):
        file.write_bytes(bytes_of)
        refused = understudy("recording", bag)
        assert refused.returncode == WRONG and f"{file}: {why}" in refused.stderr, refused.stderr
    assert not list(temporary.iterdir())
    torn = tmp_path / "torn.db3"
    torn.write_bytes(made["file"].read_bytes()[:200_000])
    refused = understudy("judge", torn, "stand_up", "--out", tmp_path / "out")
    assert refused.returncode != 0 and "torn.db3: " in refused.stderr, refused.stderr
