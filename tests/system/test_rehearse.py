"""Rehearsals and judgements from a shell: shipped scenarios, exit codes, the files that are left, CI's view."""

import base64
import os
import pathlib
import re
import signal
import subprocess
import sys
import time
from xml.etree import ElementTree

import pytest
import xmlschema
from mcap.reader import make_reader
from mcap.writer import Writer

from rehearsals import FAILED, OPEN, outcomes, rehearse_fixture, verdicts
from robots import eventually

ROOT = pathlib.Path(__file__).parents[2]
SCENARIOS = sorted(file.stem for file in (ROOT / "config" / "scenarios").glob("*.yaml"))
PROGRAMMED = ("lost_lowcmd", "pick_up", "sdk_stand")  # need a program

# Falls when its motors go limp, so that an expectation fails early.
FALLS = """
scenario: It goes limp
robot: go2
start: standing
duration: 20
settings: {motion: {service: none}}
script:
  - {at: 1, remote.press: {keys: L2+B}}
  - {at: 1, fault: {component: FR_calf_joint, fault: limp}}
  - {at: 1, fault: {component: RR_calf_joint, fault: limp}}
  - {at: 1, fault: {component: FL_calf_joint, fault: limp}}
  - {at: 1, fault: {component: RL_calf_joint, fault: limp}}
expect:
  - {always: base.height > 0.2, name: stands}
  - {eventually: count(fault) > 3, name: four knees are limp}
  - {final: base.tilt < 90 deg, to: 19, name: late}
"""


@pytest.mark.parametrize("scenario", [name for name in SCENARIOS if name not in PROGRAMMED])
def test_a_shipped_scenario_holds_faster_than_the_clock(rehearse, tmp_path, scenario):
    done = rehearse(scenario)
    assert done.returncode == 0, done.stdout + done.stderr
    told = verdicts(tmp_path / "out")
    assert told["failed"] == told["not_judged"] == 0 and told["passed"] >= 3
    assert "passed, 0 failed, 0 not judged" in done.stdout


def test_the_same_rehearsal_has_the_same_verdicts_bit_for_bit(rehearse, tmp_path):
    for out in "ab":
        assert rehearse("push", out=out).returncode == 0
    told = [verdicts(tmp_path / out)["verdicts"] for out in "ab"]
    assert told[0] == told[1]
    truths = []
    for out in "ab":
        with open(tmp_path / out / "recording.mcap", "rb") as file:
            messages = make_reader(file).iter_messages(topics=["understudy/truth"])
            truths.append([message.data for _, _, message in messages])
    assert len(truths[0]) > 1000 and truths[0] == truths[1]


def test_a_failure_ends_the_rehearsal_and_what_is_open_is_not_judged(rehearse, understudy, tmp_path):
    file = tmp_path / "falls.yaml"
    file.write_text(FALLS)
    done = rehearse(file)
    assert done.returncode == FAILED, done.stdout + done.stderr
    told = verdicts(tmp_path / "out")
    assert outcomes(tmp_path / "out") == {"stands": "failed", "four knees are limp": "passed",
                                          "late": "not judged"}
    assert told["verdicts"][0]["margin"] < 0 and told["verdicts"][0]["unit"] == "m"
    assert 1 < told["verdicts"][0]["at"] <= told["seconds"] < 6
    assert told["stopped"] == "ended as an expectation had failed"
    again = understudy("judge", tmp_path / "out" / "recording.mcap", file, "--out", tmp_path / "judged")
    assert again.returncode == FAILED
    assert verdicts(tmp_path / "judged")["verdicts"] == told["verdicts"]

    assert rehearse(file, "--to-the-end").returncode == FAILED
    assert verdicts(tmp_path / "out")["seconds"] == pytest.approx(20, abs=0.01)
    assert outcomes(tmp_path / "out")["late"] == "passed"


def test_junit_is_what_ci_reads(rehearse, tmp_path):
    file = tmp_path / "falls.yaml"
    file.write_text(FALLS.replace("name: stands", "name: 'stands <&> \"up\"'"))
    rehearse(file)
    xml = tmp_path / "out" / "junit.xml"
    xmlschema.XMLSchema(ROOT / "tests" / "data" / "junit.xsd").validate(xml)
    suite = ElementTree.parse(xml).getroot()[0]
    assert (suite.get("tests"), suite.get("failures"), suite.get("skipped")) == ("3", "1", "1")
    cases = suite.findall("testcase")
    assert cases[0].get("name") == 'stands <&> "up"'
    assert "base.height was" in cases[0].find("failure").get("message")
    assert cases[2].find("skipped") is not None


def test_the_report_needs_no_other_file(rehearse, tmp_path):
    assert rehearse("stand_up").returncode == 0
    html = (tmp_path / "out" / "report.html").read_text()
    assert html.count("<svg") > 4 and "understudy rehearse stand_up" in html
    for outside in ("http:", "https:", "<script", "<link", "url("):
        assert outside not in html
    pictures = re.findall(r'<img alt="The robot at ([0-9.]+) s" src="data:image/png;base64,([^"]*)"', html)
    seen = re.findall(r'<img alt="What its camera front saw at ([0-9.]+) s" src="data:image/png;base64,([^"]*)"', html)
    assert 1 < len(pictures) <= 4 and len(seen) == 1 and html.count("<img") == len(pictures) + 1
    first = verdicts(tmp_path / "out")["verdicts"][0]["at"]
    assert float(seen[0][0]) == pytest.approx(first, abs=0.001), "nothing failed: that of the first expectation"
    assert all(base64.b64decode(picture).startswith(b"\x89PNG") for _, picture in seen)
    assert not {picture for _, picture in seen} & {picture for _, picture in pictures}
    decided = [one["at"] for one in verdicts(tmp_path / "out")["verdicts"]]
    for at, picture in pictures:
        assert base64.b64decode(picture).startswith(b"\x89PNG") and len(picture) > 10_000
        assert min(abs(float(at) - instant) for instant in decided) < 0.001
    assert not (tmp_path / "out" / "picture.png").exists()
    assert rehearse("stand_up", "--no-pictures").returncode == 0
    bare = (tmp_path / "out" / "report.html").read_text()
    assert "<img" not in bare and 'class="above"' not in bare


# 2 m wide, its face 1 m ahead of a robot that stands at the origin.
WALL = """<mujoco><worldbody>
  <geom type="plane" size="0 0 1"/>
  <geom type="box" size="0.1 1 0.5" pos="1.1 0 0.5"/>
</worldbody></mujoco>"""
METRE, MIDDLE = 40, 160  # pixels of the view from above


@pytest.mark.parametrize("robot", ["go2", "g1"])
def test_the_report_shows_the_wall_that_the_lidar_saw_where_it_stands(rehearse, tmp_path, robot):
    (tmp_path / "wall.xml").write_text(WALL)
    file = tmp_path / "looks.yaml"
    file.write_text(f"scenario: It looks at a wall\nrobot: {robot}\nstart: standing\nscene: {tmp_path / 'wall.xml'}\n"
                    "duration: 2\nexpect:\n  - {always: base.tilt < 30 deg, from: 1.5, name: stands}\n")
    assert rehearse(file).returncode == 0
    view = re.search(r'<svg class="above".*?</svg>', (tmp_path / "out" / "report.html").read_text())[0]
    for outside in ("http:", "https:", "<script", "url("):
        assert outside not in view
    tall = "".join(re.findall(r'<path class="height[2-5]" d="([^"]*)"', view))
    cells = [(int(x), int(y)) for x, y in re.findall(r"M(\d+) (\d+)h", tall)]
    ahead = sorted((MIDDLE - y) / METRE for x, y in cells if abs(x - MIDDLE) < 0.6 * METRE and y < MIDDLE - 0.6 * METRE)
    assert len(ahead) > 10
    assert ahead[len(ahead) // 2] == pytest.approx(1.0, abs=0.12)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_stop_signal_has_it_judge_what_there_is_and_finish_the_recording(runtime_dir, tmp_path, number):
    file = tmp_path / "long.yaml"
    file.write_text("scenario: It stands\nrobot: go2\nduration: 100000\n"
                    "expect:\n  - {always: base.height > 0.2, name: stands}\n")
    out = tmp_path / "out"
    with subprocess.Popen([os.environ["UNDERSTUDY"], "rehearse", file, "--out", out], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True) as process:
        eventually(lambda: (out / "recording.mcap").exists() and (out / "recording.mcap").stat().st_size > 3_000_000)
        process.send_signal(number)
        _, said = process.communicate(timeout=30)
    assert process.returncode == OPEN, said
    assert verdicts(out)["stopped"] == "interrupted"
    assert set(outcomes(out).values()) == {"not judged"}
    with open(out / "recording.mcap", "rb") as recording:
        assert make_reader(recording, validate_crcs=True).get_summary().statistics.message_count > 1000
    assert list(runtime_dir.iterdir()) == []


def test_a_real_robots_recording_is_not_judged_by_a_truth_that_it_does_not_have(rehearse, understudy, tmp_path):
    rehearse("stand_up")
    real = tmp_path / "real.mcap"
    with open(tmp_path / "out" / "recording.mcap", "rb") as source, open(real, "wb") as target:
        writer = Writer(target)
        writer.start()
        ids = {}
        for schema, channel, message in make_reader(source).iter_messages(topics=["/lowstate"]):
            if channel.id not in ids:
                schema_id = writer.register_schema(schema.name, schema.encoding, schema.data)
                ids[channel.id] = writer.register_channel(channel.topic, "cdr", schema_id)
            writer.add_message(ids[channel.id], message.log_time, message.data, message.publish_time)
        writer.finish()
    expect = tmp_path / "expect.yaml"
    expect.write_text("robot: go2\nexpect:\n  - {always: gap(lowstate) < 3 ms, name: wire}\n"
                      "  - {always: q(FR_calf) < 0, name: joint}\n"
                      "  - {always: base.height > 0, name: truth}\n  - {never: refused happens, name: events}\n")
    done = understudy("judge", real, expect, "--out", tmp_path / "judged")
    assert done.returncode == OPEN, done.stdout + done.stderr
    assert outcomes(tmp_path / "judged") == {"wire": "passed", "joint": "passed", "truth": "not judged",
                                             "events": "not judged"}
    assert "the simulation's truth, which this recording does not have" in done.stdout


def test_the_documents_ladder_says_up_to_where_and_gives_the_next_settings(rehearse, understudy, tmp_path):
    text = (ROOT / "docs" / "rehearsing.md").read_text()
    file = tmp_path / "ladder.yaml"
    file.write_text(re.search(r"```yaml\n(scenario:.*?)```", text[text.index("## Stages"):], re.DOTALL).group(1))
    done = rehearse(file)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "may go up to stage 'on the mat', 2 of 3; next is 'alone'" in done.stdout
    ladder = verdicts(tmp_path / "out")["ladder"]
    assert [one["holds"] for one in ladder["stages"]] == [True, True, False]
    torque = ladder["stages"][2]["limits"][0]
    assert torque["outcome"] == "failed" and torque["margin"] < 0 and torque["unit"] == "N·m"
    assert "torque(" in torque["explanation"]
    assert ladder["next_settings"] in done.stdout and "torque_limit: 2.37" in done.stdout
    # The next settings are a layer: a robot that is so weak does not stand up, and goes to no stage.
    layer = tmp_path / "out" / "next_stage.yaml"
    assert "torque_limit: 2.37" in layer.read_text()
    assert understudy("check", "--robot", "go2", layer).returncode == 0
    weak = file.read_text() + "settings:\n" + "".join(
        f"  {line}\n" for line in layer.read_text().splitlines() if not line.startswith("#"))
    file.write_text(weak)
    done = rehearse(file)
    assert done.returncode == FAILED and "may go up to no stage" in done.stdout, done.stdout + done.stderr


# Stands by LowCmd every 5 ms; its knees are at about -1.3 rad, of a range from -2.72 to -0.84.
RATES = """
scenario: It stands by LowCmd
robot: go2
start: standing
settings: {motion: {service: none}}
program: {at: 0.5, until: 4}
expect:
  - {eventually: gate is following, name: is followed}
stages:
  - {name: at ease, joint_margin: 0.1, command_rate: 5}
  - {name: far from its ends, joint_margin: 0.6}
  - {name: too often, command_rate: 1000}
"""


def test_stages_limit_how_near_joints_come_to_their_ends_and_how_often_commands_come(rehearse, understudy, tmp_path):
    file = tmp_path / "rates.yaml"
    file.write_text(RATES)
    program = pathlib.Path(__file__).parent / "writes_lowcmd.py"
    done = rehearse(file, program=[sys.executable, program])
    assert done.returncode == 0, done.stdout + done.stderr
    assert "may go up to stage 'at ease', 1 of 3; next is 'far from its ends'" in done.stdout
    ladder = verdicts(tmp_path / "out")["ladder"]
    ease, far, often = ladder["stages"]
    assert [one["holds"] for one in (ease, far, often)] == [True, False, False]
    assert {one["name"]: one["unit"] for one in ease["limits"]} == {
        "at ease: joint_margin": "rad", "at ease: command_rate": "s"}
    assert 0 < ease["limits"][1]["margin"] < 0.2  # of the 0.2 s between two of 5 Hz
    knee, = far["limits"]
    assert knee["outcome"] == "failed" and "_calf_joint)" in knee["explanation"]
    assert -0.3 < knee["margin"] < 0
    assert "gap(rt/lowcmd)" in often["limits"][0]["explanation"] and often["limits"][0]["margin"] < 0
    assert "# Joints keep within" in ladder["next_settings"]
    assert "FR_calf_joint -2.1227 to -1.43776" in ladder["next_settings"]

    # A recording is judged by the stages as the run was.
    done = understudy("judge", tmp_path / "out" / "recording.mcap", file, "--out", tmp_path / "judged")
    assert done.returncode == 0, done.stdout + done.stderr
    assert verdicts(tmp_path / "judged")["ladder"] == ladder
    assert (tmp_path / "judged" / "next_stage.yaml").read_text() == ladder["next_settings"]


@pytest.mark.parametrize("event", ["{at: 0.5, service.call: {service: sport, api: 1004}}",
                                   "{when: base.height > 9, within: 0.3, reset: {}}"])
def test_a_script_that_is_refused_or_waits_in_vain_has_failed(rehearse, understudy, tmp_path, event):
    file = tmp_path / "refused.yaml"
    text = ("scenario: It asks\nrobot: go2\nstart: lying\nduration: 2\nsettings: {motion: {service: none}}\n"
            f"script: [{event}]\nexpect:\n  - {{always: base.height > 0.01, name: is there}}\n")
    file.write_text(text)
    done = rehearse(file)
    assert done.returncode == FAILED, done.stdout + done.stderr
    assert re.search(r"\n  FAIL  the script was refused: .*refused.yaml:6: ", done.stdout)
    assert done.stdout.index("FAIL") < done.stdout.index("PASS")
    told = verdicts(tmp_path / "out")
    assert told["failures"][0]["name"] == "the script" and told["failed"] == 1
    again = understudy("judge", tmp_path / "out" / "recording.mcap", file, "--out", tmp_path / "judged")
    assert again.returncode == FAILED
    file.write_text(text + "  - {count: script_refused happens, least: 1, name: is refused}\n")
    assert rehearse(file).returncode == 0


def test_safe_holds_the_damage_sheet_against_its_limits(rehearse, tmp_path):
    file = tmp_path / "falls.yaml"
    file.write_text(FALLS.replace("expect:", "expect:\n  - safe").replace("duration: 20", "duration: 4"))
    done = rehearse(file, "--to-the-end")
    assert done.returncode == FAILED
    assert re.search(r"FAIL  the robot is beyond its limits: .*\(", done.stdout), done.stdout


def test_reports_of_others_are_not_replaced(rehearse, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "report.html").write_text("mine")
    done = rehearse("stand_up")
    assert done.returncode == 3 and "is not of a rehearsal" in done.stderr
    assert (tmp_path / "out" / "report.html").read_text() == "mine"


def test_a_rehearsal_whose_time_stands_still_fails_at_its_limit_of_wall_time(rehearse, tmp_path):
    """Its program pauses the robot and waits: no limit in simulated time ever comes."""
    file = tmp_path / "waits.yaml"
    file.write_text("scenario: It waits\nrobot: go2\nduration: 5\nprogram:\n"
                    "expect: [{always: base.height > 0.05, name: is there}]\n")
    pauses = ["sh", "-c", f"{os.environ['UNDERSTUDY']} ctl pause; exec sleep 600"]
    begun = time.monotonic()
    done = rehearse(file, "--run-limit", 4, program=pauses)
    assert done.returncode == FAILED, done.stdout + done.stderr
    assert 4 < time.monotonic() - begun < 60
    assert "FAIL  the rehearsal did not end within 4 s of wall time" in done.stdout
    told = verdicts(tmp_path / "out")
    assert told["failures"] == [{"name": "the rehearsal", "why": "did not end within 4 s of wall time"}]
    assert told["seconds"] < 5
    assert outcomes(tmp_path / "out")["is there"] != "failed"
    assert '<h1><span class="word failed">' in (tmp_path / "out" / "report.html").read_text()
    xml = tmp_path / "out" / "junit.xml"
    xmlschema.XMLSchema(ROOT / "tests" / "data" / "junit.xsd").validate(xml)
    suite = ElementTree.parse(xml).getroot()[0]
    assert (suite.get("tests"), suite.get("failures")) == ("2", "1")
    assert suite.findall("testcase")[-1].find("failure").get("message") == told["failures"][0]["why"]
    assert not rehearse(file, program=["true"]).returncode and not verdicts(tmp_path / "out")["failures"]


def test_mistakes_are_explained_before_anything_starts(rehearse, understudy, tmp_path):
    file = tmp_path / "bad.yaml"
    file.write_text("scenario: x\nrobot: go2\nduration: 1\nexpect:\n  - always: base.hight > 0\n")
    for done in (rehearse(file), understudy("check", file)):
        assert done.returncode == 3
        assert "bad.yaml:5: always: no signal 'base.hight'; did you mean 'base.height'?" in done.stderr + done.stdout
    file.write_text("robot: go2\nduration: 1\nexpect:\n  - always: base.height > 0\n")
    for done in (rehearse(file), understudy("check", file)):
        assert done.returncode == 3
        assert "scenario: missing" in done.stderr + done.stdout
    done = rehearse("stnad_up")
    assert done.returncode == 3 and "did you mean 'stand_up'?" in done.stderr
    done = understudy("rehearse", "--set", "terrain.friction=0.3", "stnad_up")
    assert done.returncode == 3 and "did you mean 'stand_up'?" in done.stderr
    assert understudy("rehearse").returncode == 2
    good = understudy("check", *(ROOT / "config" / "scenarios").glob("*.yaml"))
    assert good.returncode == 0 and "6 expectations" in good.stdout
