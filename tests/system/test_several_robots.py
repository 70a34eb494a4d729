"""Several robots in one world, each driven by a program of its own that knows of no other."""

import json
import os
import pathlib
import subprocess
import sys
import time

from robots import Robot, eventually, understudy

ROOT = pathlib.Path(__file__).parents[2]
WALK = ROOT / "examples" / "python" / "walk.py"

WORLD = """\
robots:
  left: {robot: go2}
  right: {robot: go2, start: {at: [0, 2, 0]}}
  tall: {robot: g1, start: {at: [0, 4, 0]}}
"""

# The G1 comes down from its crane to a balanced stand.
SCRIPT = """\
script:
  - {at: 0.5, robot: tall, remote.press: {keys: L2+B}}
  - {at: 1, robot: tall, remote.press: {keys: L2+UP}}
  - {after: previous, robot: tall, when: state is 4 and motion.mode is 2, within: 8, crane.lower: 0.4}
  - {after: previous, robot: tall, when: motion.mode is 0 and crane.tension < 1, within: 8,
     remote.press: {keys: R1+Y}}
  - {after: previous, robot: tall, when: state is 501, within: 2, crane.release: }
"""


class World:
    """The robots of one process, each by its name."""

    def __init__(self, run, names):
        self.run = run
        self.names = names

    def ctl(self, robot, *arguments):
        done = understudy("ctl", "--name", f"{self.run.name}-{robot}", *arguments)
        assert done.returncode == 0, f"{robot}: ctl {arguments}: {done.stderr}\n{self.run.said()}"
        return done.stdout

    def status(self, robot):
        return json.loads(self.ctl(robot, "status", "--json"))

    def com(self, robot):
        return json.loads(self.ctl(robot, "snapshot", "--parts", "com"))["com"]

    def events(self, robot, kind):
        events = json.loads(self.ctl(robot, "events", "--json"))["events"]
        return [event for event in events if event["kind"] == kind]

    def wait_ready(self):
        def ready():
            assert self.run.process.poll() is None, f"it ended: {self.run.said()}"
            return all(understudy("ctl", "--name", f"{self.run.name}-{robot}", "wait", "--timeout",
                                  1).returncode == 0 for robot in self.names)

        eventually(ready, what=f"ready\n{self.run.said()}")
        return self


def test_two_go2_walk_beside_a_g1_that_is_pushed(tmp_path):
    world = tmp_path / "world.yaml"
    world.write_text(WORLD)
    script = tmp_path / "script.yaml"
    script.write_text(SCRIPT)
    run = Robot(world, "--script", script, name="three")
    try:
        robots = World(run, ("left", "right", "tall")).wait_ready()
        before = {robot: robots.com(robot) for robot in robots.names}
        programs = [subprocess.Popen([sys.executable, WALK, "lo", domain], stdout=subprocess.PIPE,
                                     stderr=subprocess.STDOUT, text=True)
                    for domain in ("0", "1")]
        said = [program.communicate(timeout=120)[0] for program in programs]
        assert [program.returncode for program in programs] == [0, 0], said
        eventually(lambda: robots.status("tall")["motion"]["state"] == 501, what="the G1 balances")
        robots.ctl("tall", "push", "torso_link", "30", "0", "0", "--for", "0.1")
        time.sleep(2)
        after = {robot: robots.com(robot) for robot in robots.names}
        for walker in ("left", "right"):
            assert after[walker][0] - before[walker][0] > 0.8
            assert abs(after[walker][1] - before[walker][1]) < 0.5
            assert robots.status(walker)["base"]["height"] > 0.2
        assert robots.status("tall")["base"]["tilt"] < 0.3, "its motion service balances it"

        # A reset of one leaves the others where they are.
        robots.ctl("left", "reset")
        assert abs(robots.com("left")[0]) < 0.3
        assert abs(robots.com("right")[0] - after["right"][0]) < 0.1
        assert len(robots.events("tall", "push")) == 1
        assert not robots.events("left", "push")
    finally:
        run.end()


def test_a_fault_of_one_leaves_the_other_as_it_is(tmp_path):
    world = tmp_path / "world.yaml"
    world.write_text("robots: {left: {robot: go2}, right: {robot: go2, start: {at: [0, 2, 0]}}}\n")
    script = tmp_path / "script.yaml"
    script.write_text("script: [{at: 0.2, robot: right, fault: {component: FR_calf_joint, fault: hot, by: 40}}]\n")
    run = Robot(world, "--script", script, name="faulty")
    try:
        robots = World(run, ("left", "right")).wait_ready()
        assert robots.events("left", "fault") == []
        eventually(lambda: len(robots.events("right", "fault")) == 1, what="the script's fault of the right one")
        robots.ctl("right", "fault", "battery", "weak", "--by", "3")
        assert [event["text"] for event in robots.events("right", "fault")] == [
            "FR_calf_joint is hot by 40 °C", "battery is weak by 3"]
        assert robots.events("left", "fault") == []
    finally:
        run.end()


def test_exec_puts_each_robot_in_a_domain_of_its_own():
    program = ("import json, os, subprocess;"
               "print(os.environ['UNDERSTUDY_CONTROL_go2_2']);"
               "sees = subprocess.run([os.environ['UNDERSTUDY'], 'ctl', 'list', '--json'],"
               " capture_output=True, text=True).stdout;"
               "print([robot['name'].rsplit('-', 1)[0] for robot in json.loads(sees)])")
    done = understudy("exec", "go2", "go2", "g1", "--log-level", "info", "--", sys.executable, "-c", program)
    assert done.returncode == 0, done.stderr
    assert "go2_1 is on lo, domain 0;" in done.stderr
    assert "go2_2 is on lo, domain 1;" in done.stderr
    assert "g1 is on lo, domain 2;" in done.stderr
    assert "['g1', 'go2_1', 'go2_2']" in done.stdout


def test_each_robot_has_a_recording_of_its_own(tmp_path):
    done = understudy("exec", "go2", "g1", "--record", tmp_path / "both.mcap", "--", "sleep", "1")
    assert done.returncode == 0, done.stderr
    for robot, family in (("go2", "go"), ("g1", "hg")):
        told = understudy("recording", tmp_path / f"both_{robot}.mcap", "--json")
        assert told.returncode == 0, told.stderr
        assert f'"{robot}"' in told.stdout


MEET = """\
scenario: Two stand
duration: 3
start: standing
robots:
  left: {robot: go2}
  right: {robot: go2, start: {at: [0, 2, 0]}}
script:
  - {at: 1, robot: right, push: {body: base_link, force: [0, 500, 0], for: 0.2}}
expect:
  - {always: "left:base.tilt < 30 deg", name: the left one stands}
  - {always: "right:base.speed < 0.2", name: the right one stays}
  - {eventually: "right:base.speed > 0.5"}
"""
FAILED = 10


def verdicts(folder):
    return json.loads((folder / "verdict.json").read_text())


def test_a_rehearsal_of_two_names_the_one_that_failed(tmp_path):
    file = tmp_path / "meet.yaml"
    file.write_text(MEET)
    assert "scenario for left right" in understudy("check", file).stdout
    out = tmp_path / "out"
    done = understudy("rehearse", file, "--out", out, "--to-the-end")
    assert done.returncode == FAILED, done.stdout + done.stderr
    assert "FAIL  the right one stays" in done.stdout
    assert "  PASS  left\n  FAIL  right\n" in done.stdout
    told = verdicts(out)
    assert [robot["outcome"] for robot in told["robots"]] == ["passed", "failed"]
    assert all(robot["damage"]["time"] > 2 for robot in told["robots"])
    assert told["passed"] == 2
    assert 'name="verdict of right" value="failed"' in (out / "junit.xml").read_text()
    assert "right: " in (out / "report.html").read_text()

    # Any of the recordings leads to the other, and both to the same verdicts.
    again = understudy("judge", out / "recording_right.mcap", file, "--out", tmp_path / "again", "--no-pictures")
    assert again.returncode == FAILED, again.stderr
    assert verdicts(tmp_path / "again")["verdicts"] == told["verdicts"]


def test_a_scenarios_program_reaches_each_robot_by_its_domain(tmp_path):
    file = tmp_path / "walk.yaml"
    file.write_text(f"""\
scenario: The right one walks
robots: {{left: {{robot: go2}}, right: {{robot: go2, start: {{at: [0, 2, 0]}}}}}}
program:
  command: [{sys.executable}, {WALK}, lo, "1"]
expect:
  - {{eventually: "right:base.x > 0.8"}}
  - {{always: "left:base.x < 0.2"}}
  - {{eventually: program.exit_code is 0}}
""")
    done = understudy("rehearse", file, "--out", tmp_path / "out", timeout=180)
    assert done.returncode == 0, done.stdout + done.stderr


def test_pictures_and_figures_are_of_the_chosen_robot(tmp_path):
    world = tmp_path / "world.yaml"
    world.write_text("""\
robots:
  left: {robot: go2, start: {pose: standing}}
  right: {robot: go2, start: {pose: lying, at: [0, 20, 0]}}
""")
    run = Robot(world, name="pair")
    try:
        robots = World(run, ("left", "right")).wait_ready()
        robots.ctl("left", "pause")
        pictures = {}
        for robot in robots.names:
            for track in ((), ("--track", "FL_calf")):
                file = tmp_path / f"{robot}{len(track)}.png"
                done = understudy("picture", file, "--robot", f"pair-{robot}", "--size", "160x96", *track)
                assert done.returncode == 0, done.stderr
                pictures[robot, track] = file.read_bytes()
            assert f'understudy_steps_total{{robot="{robot}"}}' in robots.ctl(robot, "metrics")
            assert robots.status(robot)["name"] == robot
        assert len(set(pictures.values())) == 4, "the camera is at another robot or part of it"
    finally:
        run.end()


def test_the_doctor_looks_at_the_domains_of_several_robots():
    done = understudy("exec", "go2", "go2", "--", os.environ["UNDERSTUDY"], "doctor", "--json", "--seconds", "0.5",
                      "--robots", "1", "--domain", "0", "--domain", "1")
    reports = json.loads(done.stdout)
    assert [report["domain"] for report in reports] == [0, 1]
    for report in reports:
        rows = {row["name"]: row for row in report["checks"]}
        assert rows["robots"]["verdict"] == "ok", rows["robots"]


def test_robots_of_one_domain_are_kept_apart_by_partitions(tmp_path):
    world = tmp_path / "world.yaml"
    world.write_text("""\
robots:
  left: {robot: go2, network: {domain: 0, partition: left}}
  right: {robot: g1, network: {domain: 0, partition: right}}
""")
    run = Robot(world, name="two")
    try:
        robots = World(run, ("left", "right")).wait_ready()
        assert [line for line in run.log() if "left is on lo, domain 0, partition left" in line["message"]]
        assert not robots.status("left")["silenced"] and not robots.status("right")["silenced"]
    finally:
        run.end()


def test_robots_on_one_network_are_refused_with_the_remedy(tmp_path):
    world = tmp_path / "world.yaml"
    world.write_text("robots: {a: {robot: go2}, b: {robot: go2, network: {domain: 0}}}\n")
    done = understudy("run", world)
    assert done.returncode == 3
    assert "give one of them another domain or partition" in done.stderr
