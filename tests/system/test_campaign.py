"""Campaigns from a shell: side by side, interrupted, in shards, by Slurm and as Kubernetes would start them."""

import getpass
import json
import os
import pathlib
import re
import shlex
import signal
import socket
import subprocess
import time
from xml.etree import ElementTree

import kubernetes_validate
import pytest
import xmlschema
import yaml

import namespaces
from robots import eventually

ROOT = pathlib.Path(__file__).parents[2]
EXAMPLES = ROOT / "examples" / "campaign"
FAILED, OPEN = 10, 11
REPORTS = ("report.html", "verdict.json", "junit.xml", "runs.jsonl", "runs.txt", "campaign.json")

# Falls where the shove is strong.
SHOVES = """
scenario: A shove
robot: go2
start: standing
duration: 1.2
script:
  - {at: 0.2, push: {body: base_link, force: [0, $force, 0], for: 0.2}}
expect:
  - {always: base.tilt < 30 deg, name: stays up}
vary:
  grid: {$force: [40, 500], terrain.friction: [0.5, 0.8]}
  random: {robot.dynamics.delay: {from: 0, to: 0.004}}
  runs: 2
"""


@pytest.fixture(name="shoves")
def shoves_fixture(tmp_path, monkeypatch):
    """The scenario in the current folder; the environment finds understudy, as that of a cluster does."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", f"{pathlib.Path(os.environ['UNDERSTUDY']).parent}:{os.environ['PATH']}")
    (tmp_path / "shoves.yaml").write_text(SHOVES)
    return "shoves.yaml"


def reports(folder):
    return {name: (pathlib.Path(folder) / name).read_bytes() for name in REPORTS}


def verdict(folder):
    return json.loads((pathlib.Path(folder) / "verdict.json").read_text())


def test_a_campaign_tells_failures_first_and_keeps_their_evidence(understudy, shoves, tmp_path):
    done = understudy("rehearse", shoves, "--out", "out", "--jobs", 2)
    assert done.returncode == FAILED, done.stdout + done.stderr
    lines = [line for line in done.stdout.splitlines() if re.match(r"  (PASS|FAIL)  ", line)]
    assert [line.split()[0] for line in lines] == ["FAIL"] * 4 + ["PASS"] * 4
    assert all("$force=500" in line and "stays up: base.tilt was" in line for line in lines[:4])
    told = verdict("out")
    assert (told["passed"], told["failed"], told["missing"], told["rate"]) == (4, 4, 0, 0.5)
    assert told["failed_runs"] == [5, 6, 7, 8]
    kept = sorted(path.name for path in (tmp_path / "out" / "runs").iterdir() if path.is_dir())
    assert kept == ["000005", "000006", "000007", "000008"]
    assert (tmp_path / "out/runs/000005/recording.mcap").stat().st_size > 10_000
    html = (tmp_path / "out/report.html").read_text()
    assert 'href="runs/000005/report.html"' in html and 'class="map"' in html
    xml = tmp_path / "out/junit.xml"
    xmlschema.XMLSchema(ROOT / "tests" / "data" / "junit.xsd").validate(xml)
    suite = ElementTree.parse(xml).getroot()[0]
    assert (suite.get("tests"), suite.get("failures")) == ("8", "4")
    # The line of a run repeats it, and its recording is judged again by it.
    run = json.loads((tmp_path / "out/runs/000006.json").read_text())
    repeat = shlex.split(run["repeat"])
    assert repeat[:5] == ["understudy", "rehearse", shoves, "--run", "6"]
    assert understudy(*repeat[1:], "--out", "again").returncode == FAILED
    assert verdict("again")["verdicts"][0]["margin"] == run["verdicts"][0]["margin"]
    assert understudy("judge", "again/recording.mcap", shoves, "--run", 6).returncode == FAILED


def test_a_campaign_of_several_robots_varies_one_of_them_and_names_who_failed(understudy, shoves, tmp_path):
    two = SHOVES.replace("robot: go2\n", "robots: {left: {robot: go2}, right: {robot: go2, start: {at: [0, 2, 0]}}}\n")
    two = two.replace("push:", "robot: right, push:").replace("robot.dynamics", "robots.left.robot.dynamics")
    two = two.replace("base.tilt < 30 deg, name: stays up", '"right:base.tilt < 30 deg", name: the right one stays up')
    two = two.replace("expect:", 'expect:\n  - {always: "left:base.tilt < 30 deg", name: the left one stays up}')
    (tmp_path / "two.yaml").write_text(two)
    done = understudy("rehearse", "two.yaml", "--out", "out", "--jobs", 2)
    assert done.returncode == FAILED, done.stdout + done.stderr
    failed = [line for line in done.stdout.splitlines() if line.startswith("  FAIL  ")]
    assert len(failed) == 4 and all("$force=500" in line and "the right one stays up" in line for line in failed)
    delays = {re.search(r"robots.left.robot.dynamics.delay=(\S+)", line)[1] for line in failed}
    assert len(delays) == 2
    assert {path.name for path in (tmp_path / "out/runs/000005").glob("*.mcap")} == {
        "recording_left.mcap", "recording_right.mcap"}


@pytest.mark.parametrize("again", [(), ("--again",)])
def test_a_folder_of_runs_that_no_campaign_made_is_left_alone(understudy, shoves, tmp_path, again):
    logs = tmp_path / "out/runs/000001"  # as trainers of policies keep theirs
    logs.mkdir(parents=True)
    (logs / "events").write_text("precious")
    done = understudy("rehearse", shoves, "--out", "out", *again)
    assert done.returncode == 3 and "is not of a campaign" in done.stderr, done.stderr
    assert (logs / "events").read_text() == "precious"


def test_shards_merge_to_the_report_of_the_whole_byte_by_byte(understudy, shoves):
    understudy("rehearse", shoves, "--out", "whole", "--jobs", 2)
    for i, jobs in ((1, 2), (2, 1), (3, 1)):
        understudy("rehearse", shoves, "--out", f"part{i}", "--jobs", jobs, "--shard", f"{i}/3")
    part = understudy("rehearse", "--merge", "part1", "part2", "--out", "part")
    assert part.returncode == FAILED and verdict("part")["missing"] == 2
    done = understudy("rehearse", "--merge", "part", "part3", "--out", "all")
    assert done.returncode == FAILED, done.stderr
    assert reports("all") == reports("whole")
    assert understudy("rehearse", "--merge", "part1").returncode == 3


def test_ctrl_c_loses_nothing_and_the_same_command_goes_on(understudy, shoves, tmp_path):
    understudy("rehearse", shoves, "--out", "whole")
    command = [os.environ["UNDERSTUDY"], "rehearse", shoves, "--out", "out", "--jobs", "1"]
    # As a terminal does: the whole group hears it.
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          start_new_session=True) as process:
        eventually(lambda: list(tmp_path.glob("out/runs/*.json")))
        os.killpg(process.pid, signal.SIGINT)
        _, said = process.communicate(timeout=20)
    there = len(list(tmp_path.glob("out/runs/*.json")))
    assert process.returncode in (FAILED, OPEN) and 0 < there < 8
    assert f"interrupted before {8 - there} runs" in said
    assert verdict("out")["missing"] == 8 - there
    done = understudy(*command[1:])
    assert f"{there} runs have results already" in done.stderr
    assert reports("out") == reports("whole")


def test_what_varies_in_the_programs_words_reaches_it(understudy, shoves, tmp_path):
    (tmp_path / "program.yaml").write_text("""
scenario: A program
robot: go2
program:
expect: [{final: program.exit_code is 0}]
vary: {grid: {$code: [0, 3]}}
""")
    done = understudy("rehearse", "program.yaml", "--out", "out", "--", "sh", "-c", "exit $code")
    assert done.returncode == FAILED, done.stderr
    assert verdict("out")["failed_runs"] == [2]


def test_a_run_whose_program_hangs_fails_and_the_others_go_on(understudy, shoves, tmp_path):
    (tmp_path / "hangs.yaml").write_text("""
scenario: It may hang
robot: go2
program: {limit: 2}
expect: [{always: base.height > 0, name: is there}]
vary: {grid: {$sleep: [600, 0]}}
""")
    done = understudy("rehearse", "hangs.yaml", "--out", "out", "--jobs", 1, "--", "sh", "-c", "sleep $sleep")
    assert done.returncode == FAILED, done.stderr
    assert verdict("out")["failed_runs"] == [1] and verdict("out")["passed"] == 1
    assert "the program ends within 2 s" in done.stdout


def test_a_run_whose_time_stands_still_fails_at_its_limit_and_the_others_go_on(understudy, shoves, tmp_path):
    """A program stops it, its parent's parent, by SIGSTOP, so that it can do nothing, or pauses it, and waits."""
    hang = tmp_path / "hang.sh"
    hang.write_text("#!/bin/sh\ncase $1 in 0) exit 0;; 1) echo about to hang >&2; kill -STOP $(awk '/PPid/ {print $2}' /proc/$PPID/status);; 2) "
                    f"{os.environ['UNDERSTUDY']} ctl pause;; esac\nexec sleep 60\n")
    hang.chmod(0o755)
    (tmp_path / "hangs.yaml").write_text(
        "scenario: Two hang\nrobot: go2\nduration: 0.6\nprogram: {command: [./hang.sh, $hang]}\n"
        "expect: [{always: base.height > 0, name: is there}]\nvary: {list: [{$hang: 1}, {$hang: 0}, {$hang: 2}]}\n")
    begun = time.monotonic()
    done = understudy("rehearse", "hangs.yaml", "--out", "out", "--jobs", 2, "--run-limit", 8, timeout=60)
    assert done.returncode == FAILED, done.stdout + done.stderr
    assert 8 < time.monotonic() - begun < 40
    told = verdict("out")
    assert (told["passed"], told["failed"], told["failed_runs"]) == (1, 2, [1, 3])
    stopped, paused = (json.loads((tmp_path / f"out/runs/00000{run}.json").read_text()) for run in (1, 3))
    assert stopped["broken"].startswith("did not end within 8 s of wall time")
    # One that can judges what there is.
    assert paused["broken"] == "the rehearsal did not end within 8 s of wall time" and paused["verdicts"]
    assert (tmp_path / "out/runs/000003/report.html").exists()
    assert "did not end within 8 s of wall time" in done.stdout
    assert "did not end within 8 s" in (tmp_path / "out/junit.xml").read_text()


def test_mistakes_are_explained_before_anything_starts(understudy, shoves, tmp_path):
    (tmp_path / "bad.yaml").write_text(SHOVES.replace("terrain.friction: [0.5, 0.8]", "terrain.friction: [0.5, 8]"))
    for done in (understudy("rehearse", "bad.yaml"), understudy("check", "bad.yaml")):
        assert done.returncode == 3
        assert "bad.yaml:11: vary: terrain.friction" in done.stderr + done.stdout
    assert not (tmp_path / "rehearsals").exists()
    (tmp_path / "one.yaml").write_text("scenario: x\nrobot: go2\nduration: 1\nexpect: [{final: base.height > 0}]\n")
    done = understudy("rehearse", "one.yaml", "--jobs", 2)
    assert done.returncode == 3 and "--jobs means nothing" in done.stderr
    assert "there is no run 9" in understudy("rehearse", shoves, "--run", 9).stderr
    assert "campaign of 8 runs over $force terrain.friction" in understudy("check", shoves).stdout


def test_the_documents_campaign_plays(understudy, shoves, tmp_path):
    text = (ROOT / "docs" / "rehearsing.md").read_text()
    campaign = text[text.index("## Campaigns"):]
    (tmp_path / shoves).write_text(re.search(r"```yaml\n(scenario:.*?)```", campaign, re.DOTALL).group(1))
    done = understudy("rehearse", shoves, "--out", "out")
    assert done.returncode == FAILED, done.stdout + done.stderr
    told = verdict("out")
    assert told["runs"] == 12 and 0 < told["passed"] < 12


SLURM = """
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/none
CredType=cred/none
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldPort=6917
SlurmdPort=6918
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
SchedulerParameters=batch_sched_delay=0,sched_interval=1
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES State=UP
"""


@pytest.fixture(name="slurm")
def slurm_fixture(tmp_path, monkeypatch):
    """A cluster of one node, this machine, for one test."""
    folder = tmp_path / "slurm"
    for name in ("state", "spool"):
        (folder / name).mkdir(parents=True)
    host = socket.gethostname().split(".")[0]
    (folder / "slurm.conf").write_text(SLURM.format(folder=folder, host=host, user=getpass.getuser(),
                                                        cores=os.cpu_count()))
    monkeypatch.setenv("SLURM_CONF", str(folder / "slurm.conf"))
    monkeypatch.setenv("PATH", f"{os.environ['PATH']}:/usr/sbin")
    # A resolver that asks for addresses of this machine's kind finds none where there is nothing but 127.0.0.1.
    address = "192.0.2.1/32"
    namespaces.ip("address", "add", address, "dev", "lo")
    daemons = []
    try:
        for command in (["slurmctld", "-D", "-i"], ["slurmd", "-D"]):
            with open(folder / f"{command[0]}.log", "w", encoding="utf-8") as log:
                daemons.append(subprocess.Popen(command, stdout=log, stderr=log))
        eventually(lambda: "idle" in subprocess.run(["sinfo", "-h", "-o", "%t"], capture_output=True,
                                                    text=True, check=False).stdout,
                   what="the node of Slurm is idle: " + str(folder))
        yield
    finally:
        for daemon in reversed(daemons):
            daemon.terminate()
            daemon.wait(10)
        namespaces.ip("address", "del", address, "dev", "lo")


@pytest.mark.usefixtures("slurm")
def test_slurm_plays_a_campaign_as_an_array(understudy, shoves, tmp_path):
    (tmp_path / shoves).write_text(SHOVES.replace("runs: 2", "runs: 1"))
    understudy("rehearse", shoves, "--out", "whole")
    # The tasks fail, as runs do; sbatch has the code of the worst.
    done = subprocess.run(["sbatch", "--wait", "--array=1-2", "--cpus-per-task=1", EXAMPLES / "slurm.sh", shoves,
                           "results"], capture_output=True, text=True, timeout=60, check=False)
    said = "".join(path.read_text() for path in sorted(tmp_path.glob("rehearse-*.log")))
    assert done.returncode == FAILED, done.stdout + done.stderr + said
    assert len(list(tmp_path.glob("rehearse-*-[12].log"))) == 2
    assert reports("results") == reports("whole"), said


def test_kubernetes_starts_the_shards_of_a_job_that_is_valid(understudy, shoves, tmp_path):
    job = yaml.safe_load((EXAMPLES / "kubernetes.yaml").read_text())
    kubernetes_validate.validate(job, kubernetes_validate.latest_version(), strict=True)
    spec = job["spec"]
    container = spec["template"]["spec"]["containers"][0]
    environment = {one["name"]: one["value"] for one in container["env"]}
    assert spec["completionMode"] == "Indexed"
    assert int(environment["SHARDS"]) == spec["completions"] == spec["parallelism"]
    mounts = {mount["mountPath"] for mount in container["volumeMounts"]}
    assert mounts == {environment["OUT"], str(pathlib.Path(environment["SCENARIO"]).parent)}
    (tmp_path / shoves).write_text(SHOVES.replace("runs: 2", "runs: 1"))
    understudy("rehearse", shoves, "--out", "whole", "--network", "host")
    for index in range(2):
        environment.update(SHARDS="2", SCENARIO=shoves, OUT="results", JOB_COMPLETION_INDEX=str(index))
        done = subprocess.run([*container["command"], *container["args"]], env={**os.environ, **environment},
                              capture_output=True, text=True, timeout=60, check=False)
        assert done.returncode == 0, done.stdout + done.stderr
    assert reports("results") == reports("whole")
