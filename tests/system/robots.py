"""A running understudy, as a user sees it: its process, its log, `ctl`."""

import itertools
import json
import os
import signal
import subprocess
import tempfile
import time

NUMBERS = itertools.count(1)  # no two robots of a session have the same name
PATIENCE = 60.0  # s, for what takes less than one on an idle machine


def understudy(*arguments, timeout=PATIENCE, **how):
    """Runs understudy to its end."""
    return subprocess.run([os.environ["UNDERSTUDY"], *map(str, arguments)], capture_output=True,
                          text=True, timeout=timeout, **how)


def eventually(condition, seconds=PATIENCE, what=""):
    """Waits until condition() holds and gives its value; a failed test when it does not."""
    deadline = time.monotonic() + seconds
    while True:
        if value := condition():
            return value
        assert time.monotonic() < deadline, f"not within {seconds:.0f} s: {what or condition}"
        time.sleep(0.02)


class Robot:
    """`understudy run`, started. `here` is put in front of the command, as nsenter is."""

    def __init__(self, robot, *options, here=(), name=None, json_log=True, **how):
        self._log = tempfile.TemporaryFile("w+")
        self.name = name or f"{robot}-{next(NUMBERS)}"
        self.command = [*here, os.environ["UNDERSTUDY"], "run", robot, "--name", self.name,
                        *(["--json"] if json_log else []), *map(str, options)]
        how.setdefault("stderr", self._log)
        self.process = subprocess.Popen(self.command, **how)

    @property
    def pid(self):
        return self.process.pid

    def said(self):
        """The log so far, as text."""
        self._log.seek(0)
        return self._log.read()

    def log(self):
        """The log so far: one object a line."""
        return [json.loads(line) for line in self.said().splitlines(keepends=True)
                if line.endswith("\n") and line.startswith("{")]

    def heard(self, text, level=None, seconds=PATIENCE):
        """Waits until a line of the log contains the text; gives that line."""
        def find():
            for line in self.log():
                if text in line["message"] and level in (None, line["level"]):
                    return line
            return None

        return eventually(find, seconds, f"the log says '{text}':\n{self.said()}")

    def ctl(self, *arguments):
        """understudy ctl --name <this robot> ...; gives its output, or a failed test."""
        done = understudy("ctl", "--name", self.name, *arguments)
        assert done.returncode == 0, f"ctl {arguments}: {done.stderr}\n{self.said()}"
        return done.stdout

    def status(self):
        return json.loads(self.ctl("status", "--json"))

    def wait_ready(self):
        def ready():
            assert self.process.poll() is None, f"it ended: {self.said()}"
            return understudy("ctl", "--name", self.name, "wait", "--timeout", 1).returncode == 0

        eventually(ready, what=f"ready\n{self.said()}")
        return self

    def becomes(self, condition, seconds=PATIENCE):
        """Waits until condition(status) holds and gives that status."""
        def find():
            status = self.status()
            return status if condition(status) else None

        return eventually(find, seconds, f"the status\n{self.said()}")

    def send(self, number):
        self.process.send_signal(number)

    def exit_code(self, seconds=PATIENCE):
        """Waits for the end."""
        return self.process.wait(seconds)

    def end(self):
        """Ends it if it still runs, whatever it is doing."""
        if self.process.poll() is None:
            self.send(signal.SIGCONT)
            self.send(signal.SIGTERM)
            try:
                self.process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self._log.close()
