"""A running robot for tests: a daemon in a private network, programs in it, and claims in the words of `rehearse`.

    def test_stands():
        with understudy.robot("go2") as robot:
            program = robot.run(["python3", "stand.py", "lo"])
            robot.wait("base.height > 0.3", within=10)
            assert robot.always("base.tilt < 10 deg", during=3) and not robot.refused
            assert program.wait(within=20) == 0

pytest has it as the fixture `understudy_robot`. Each robot has a network of its own, so tests may run side by side.
"""

import dataclasses
import itertools
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

from ._understudy import Error

PATIENCE = 60.0  # s of wall time, for what takes less than one on an idle machine
POLL = 0.1  # s
PRINTS = re.compile(r'the program prints "(.*)"')
NUMBERS = itertools.count(1)


def _program():
    return os.environ.get("UNDERSTUDY") or str(pathlib.Path(__file__).parent / "bin" / "understudy")


@dataclasses.dataclass(frozen=True)
class Verdict:
    """Whether a claim holds, and why: true if it passed."""

    claim: str
    outcome: str  # passed, failed, not judged
    why: str
    margin: float | None  # by how much it holds, in the unit of its signal

    def __bool__(self):
        return self.outcome == "passed"


class Program:
    """A program in a robot's network."""

    def __init__(self, robot, words, cwd, env):
        self.words = [str(word) for word in words]
        self._robot = robot
        self._output = robot.folder / f"program_{next(NUMBERS)}.txt"
        asked = {"run": self.words, "cwd": str(cwd or os.getcwd()), "env": env or {}, "output": str(self._output)}
        self._pid = robot._ask(asked)["pid"]

    @property
    def output(self):
        """What it has printed so far, errors included."""
        return self._output.read_text(errors="replace")

    @property
    def exit_code(self):
        """None while it runs; -n if signal n ended it."""
        return self._robot._ask({"poll": self._pid})["code"]

    def wait(self, within=PATIENCE):
        """Waits for its end and returns the exit code. Raises AssertionError after `within` s of wall time."""
        end = time.monotonic() + within
        while (code := self.exit_code) is None:
            assert time.monotonic() < end, f"{self.words} still runs after {within:g} s:\n{self.output}"
            time.sleep(POLL)
        return code

    def stop(self, number=signal.SIGTERM):
        """Sends it a signal."""
        self._robot._ask({"signal": int(number), "pid": self._pid})


class robot:  # noqa: N801  it is used as a function
    """Starts a robot; ends it and its programs when the block ends.

    name: as of `understudy run`. options: words for `understudy exec`, such as "--scene", "rough". set: values by dotted key.
    released: no motion service holds the motors. Raises Error with its log if it does not start.
    """

    def __init__(self, name, *options, released=False, start=None, set=None):
        self.name = f"{name}-{os.getpid()}-{next(NUMBERS)}".replace("/", "-")
        self._of = str(name)
        self._temporary = tempfile.TemporaryDirectory(prefix="understudy-test-")
        self.folder = pathlib.Path(self._temporary.name)
        self.recording = self.folder / "recording.mcap"
        sets = [f"{key}={value if isinstance(value, str) else json.dumps(value)}" for key, value in (set or {}).items()]
        words = [
            _program(), "exec", self._of, "--name", self.name, "--no-panel", "--record", self.recording, *options,
            *(["--released"] if released else []), *(["--start", start] if start else []),
            *(word for one in sets for word in ("--set", one)),
            "--", sys.executable, pathlib.Path(__file__).with_name("keeper.py"),
        ]  # fmt: skip
        self.programs = []
        self._log = open(self.folder / "log.txt", "wb")
        self._process = subprocess.Popen(
            [str(word) for word in words], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._log, text=True
        )
        try:
            self._answer()
        except Error:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """Ends the robot and its programs."""
        if self._process.poll() is None:
            self._process.stdin.close()
            try:
                self._process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        self._process.stdout.close()
        self._log.close()
        self._temporary.cleanup()

    @property
    def log(self):
        """What the daemon has logged."""
        return (self.folder / "log.txt").read_text(errors="replace")

    def run(self, words, cwd=None, env=None):
        """Starts a program in the robot's network; the robot is on `lo`, domain 0. env: added to this process's."""
        self.programs.append(Program(self, words, cwd, env))
        return self.programs[-1]

    def ctl(self, *words):
        """`understudy ctl WORDS`: returns what it prints. Raises Error if the robot refuses."""
        words = [_program(), "ctl", "--name", self.name, *map(str, words)]
        done = subprocess.run(words, capture_output=True, text=True, timeout=PATIENCE)
        if done.returncode != 0:
            raise Error(done.stderr.strip())
        return done.stdout

    @property
    def status(self):
        """`understudy ctl status --json`, as a dict."""
        return json.loads(self.ctl("status", "--json"))

    @property
    def events(self):
        """All events so far: dicts with time [s], kind, text and detail."""
        return json.loads(self.ctl("events", "--json"))["events"]

    @property
    def refused(self):
        """The events of refused commands."""
        return [event for event in self.events if event["kind"] == "refused"]

    def wait(self, condition, within=10.0):
        """Waits until a condition holds, for `within` simulated s; returns its Verdict. Raises AssertionError if it does not."""
        if prints := PRINTS.fullmatch(condition.strip()):
            return self._wait_for_print(condition, prints[1], within)
        verdict = self._judged("eventually", condition, within)
        assert verdict, f"{verdict.claim}: {verdict.why}\n{self._told()}"
        return verdict

    def always(self, condition, during):
        """Watches for `during` simulated s from now and returns the Verdict of `always CONDITION`."""
        return self._judged("always", condition, during)

    def never(self, condition, during):
        """Watches for `during` simulated s from now and returns the Verdict of `never CONDITION`."""
        return self._judged("never", condition, during)

    def _wait_for_print(self, condition, text, within):
        end = self.status["time"] + within
        while True:
            over = self.status["time"] > end
            if any(text in program.output for program in self.programs):
                return Verdict(condition, "passed", "", None)
            assert not over, f"{condition}: not within {within:g} s\n{self._told()}"
            time.sleep(POLL)

    def _judged(self, operator, condition, seconds):
        begin = self.status["time"]
        expected = {operator: condition, "from": begin, "to": begin + seconds}
        file = self.folder / "expect.yaml"
        file.write_text(json.dumps({"robot": self._of, "expect": [expected]}))
        words = [_program(), "judge", self.recording, file, "--json", "--no-pictures", "--out", self.folder / "judged"]
        while True:
            done = subprocess.run([str(word) for word in words], capture_output=True, text=True, timeout=PATIENCE)
            if done.returncode not in (0, 10, 11):
                raise Error(done.stderr.strip())
            verdict = json.loads(done.stdout)["verdicts"][0]
            late = self.status["time"] > begin + seconds + 5  # the recording is at most a second behind
            if verdict["outcome"] != "not judged" or late:
                return Verdict(verdict["asks"], verdict["outcome"], verdict["explanation"], verdict["margin"])
            time.sleep(POLL)

    def _told(self):
        return "\n".join([*(f"{program.words}:\n{program.output}" for program in self.programs), self.log])

    def _ask(self, asked):
        try:
            self._process.stdin.write(json.dumps(asked) + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            pass  # the answer says why
        answer = self._answer()
        if "error" in answer:
            raise Error(answer["error"])
        return answer

    def _answer(self):
        line = self._process.stdout.readline()
        if not line:
            self._process.wait(PATIENCE)
            raise Error(f"the robot ended with code {self._process.returncode}:\n{self.log}")
        return json.loads(line)
