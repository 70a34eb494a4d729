"""Somebody at a desk who follows a page: the robots that it starts, the terminals in which its lines are typed, the files
that it has one write."""

import base64
import json
import os
import pathlib
import re
import signal
import socket
import subprocess

import pytest
import yaml

from console import Terminal, Typed, matches, session
from desk import ENDLESS, drawn_quickly, go_on, prepare, verdict_of, works
from robots import eventually, understudy

STARTS = re.compile(r"((\./)?tools/up|understudy run) (?!.*(--detach|--duration))")
BESIDE_A_ROBOT = re.compile(r"^understudy (ctl|view|remote|excite|picture|film|camera|play .*--commands)\b|^python3 .* lo$|^curl ")
BY_ITSELF = re.compile(r"--recording|--list-gamepads|^understudy play (?!.*--commands)")
PATIENCE = 300.0  # s, for a command
# What a fragment of a scenario leaves out.
SCENARIO = {"scenario": "x", "robot": "go2", "duration": 1, "expect": [{"always": "base.height > 0"}]}


def typed(language, block):
    """The lines of a block that are typed."""
    if language == "console":
        return session(block)
    return [Typed("", line, []) for line in block.replace("\\\n", " ").splitlines() if line.strip()]


class Session:
    """`fronts`: what is put before the shell of the terminal of a name, as nsenter is."""

    def __init__(self, desk, fronts):
        self.desk, self._fronts, self._terminals = desk, fronts, {}
        self._robot, self._echoes, self._records = None, [], None
        self._log = desk / "said_by_the_robot"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop_robots()
        for echo in self._echoes:
            echo.send_signal(signal.SIGINT)
            assert echo.wait(20) == 0
        for terminal in self._terminals.values():
            terminal.close()

    def type(self, line):
        command = line.command.split("  #")[0].strip()
        if made := re.search(r"(?:--record|record start) (\S+\.mcap)", command):
            (self.desk / made[1]).unlink(missing_ok=True)
        if line.terminal:
            self._answer(line.terminal, command)
        elif STARTS.match(command):
            self._start(line, command)
        else:
            self._go_to(command, made)
            if ENDLESS.search(command) or "zsh" in command:
                works(command, self.desk)
            else:
                self._in_the_terminal(line, command)
        if made:
            self._records = made[1]

    def sockets(self):
        return list(pathlib.Path(os.environ["XDG_RUNTIME_DIR"]).glob("understudy/*.sock"))

    def needs_a_robot(self, name=None):
        """The one that runs, if it has that name."""
        if [one for one in self.sockets() if name in (None, one.stem)]:
            return
        command = f"understudy run go2 --start hanging --name {name or 'left'}"
        self._start(Typed("", command, []), command)

    def stop_robots(self):
        for one in self.sockets():  # robots of one world end together
            assert understudy("ctl", "--socket", one, "stop").returncode == 0 or not one.exists()
        eventually(lambda: not self.sockets(), what="all robots have ended")
        if self._robot:
            assert self._robot.wait(20) == 0, self._log.read_text()
        self._robot, self._records = None, None

    def _answer(self, terminal, command):
        """On another machine, until the page is done."""
        echo = subprocess.Popen([*self._fronts[terminal], "bash", "-c", f"exec {command}"], cwd=self.desk,
                                stdout=subprocess.PIPE, text=True)
        self._echoes.append(echo)
        assert "answers on" in echo.stdout.readline()

    def _start(self, line, command):
        """In a terminal of its own."""
        self.stop_robots()
        with self._log.open("w") as log:
            self._robot = subprocess.Popen(["bash", "-c", f"exec {command}"], cwd=self.desk, stdout=log, stderr=log)

        def ready():
            assert self._robot.poll() is None, f"{command}:\n{self._log.read_text()}"
            return "panel: " in self._log.read_text() and self.sockets() and all(
                understudy("ctl", "--socket", one, "wait", "--timeout", 1).returncode == 0 for one in self.sockets())

        eventually(ready, what=command)
        assert matches(line.printed, self._log.read_text()), f"{line.printed}, but:\n{self._log.read_text()}"
        if "--view" in command:  # the processor would draw its window all the while
            self.stop_robots()

    def _go_to(self, command, made):
        """Has the robot there that a line needs, or none."""
        reads_it = self._records and self._records in command
        if BY_ITSELF.search(command) or reads_it or (made and self._records) or "--detach" in command:
            self.stop_robots()
        if played := re.match(r"understudy play (\S+) .*--commands", command):  # of a robot that somebody commanded
            (self.desk / played[1]).unlink()
            (self.desk / played[1]).symlink_to("excited.mcap")
        if BESIDE_A_ROBOT.search(command) and not BY_ITSELF.search(command):
            name = re.search(r"--name (\w+)", command)
            self.needs_a_robot(name[1] if name else None)

    def _in_the_terminal(self, line, command):
        terminal = self._terminals.setdefault("", None) or Terminal(self.desk, dict(os.environ), patience=PATIENCE)
        self._terminals[""] = terminal
        requests = command.startswith("understudy ctl")
        if requests:
            prepare(command)
        terminal.type(Typed("", drawn_quickly(command), line.printed), verdict_of(command))
        if requests and self.sockets():
            go_on()


def load(language, block, at):
    """Has what reads a file of that language read it, in the session `at`."""
    {"yaml": load_yaml, "json": compare_with_status, "http": post, "websocket": exchange,
     "xml": check_model, "python": compile_program}[language](block, at)


def load_yaml(block, at):
    told = yaml.safe_load(block)
    jobs = [job for job in told.values() if isinstance(job, dict) and "artifacts" in job]
    if "scrape_configs" in told:  # Prometheus's
        for target in told["scrape_configs"][0]["static_configs"][0]["targets"]:
            at.type(Typed("", f"curl -s http://{target}/metrics", ["# HELP understudy_"]))
    elif jobs:  # GitLab's
        for line in jobs[0]["script"]:
            at.type(Typed("", line, []))
        assert (at.desk / jobs[0]["artifacts"]["reports"]["junit"]).exists()
    else:
        check_yaml(told, block, at)


def check_yaml(told, block, at):
    """A robot, a script, a scenario, or a layer over a robot; the first line may name the file."""
    names = re.match(r"# (\S+\.yaml)", block)
    file = at.desk / (names[1] if names else "of_the_page.yaml")
    file.unlink(missing_ok=True)
    over = ""
    if told.keys() & {"program", "expect", "vary"}:
        given = told.keys() | ({"robot"} if "robots" in told else set())
        block = "".join(yaml.safe_dump({key: value}) for key, value in SCENARIO.items() if key not in given) + block
    elif not told.keys() & {"script", "robot", "robots", "extends"}:
        over = "--robot go2 "
    file.write_text(block)
    at.type(Typed("", f"understudy check {over}{file.name}", ["ok"]))


def check_model(block, at):
    (at.desk / "of_the_page.xml").write_text(block)
    at.type(Typed("", "understudy check of_the_page.xml", ["ok"]))


def compare_with_status(block, at):
    """A part of `ctl status --json` of the robot that runs."""
    shown, status = json.loads(f"{{{block}}}"), json.loads(understudy("ctl", "status", "--json").stdout)

    def compare(shown, told):
        if isinstance(shown, dict):
            for key, value in shown.items():
                compare(value, told[key])
        else:
            assert shown == pytest.approx(told, abs=0.005)

    compare(shown, status)


def compile_program(block, at):
    """What it does is seen where it is typed; here, that the file of the page is that of the desk."""
    if "import understudy" in block:
        return  # tests/python/test_pages.py runs it in the environment of the package
    assert block in [file.read_text() for file in at.desk.glob("*.py")]


def post(block, at):
    """`POST /path {json}`."""
    path, body = re.fullmatch(r"POST (\S+)\s+(\{.*\})\n", block).groups()
    at.needs_a_robot()
    at.type(Typed("", f"curl -s --unix-socket {at.sockets()[0]} -d '{body}' http://localhost{path}", ['{"ok":true}']))


def exchange(block, at):
    """What goes over the WebSocket of requests: `> ` to the robot, `< ` from it."""
    at.needs_a_robot()
    with socket.socket(socket.AF_UNIX) as wire:
        wire.settimeout(20)
        wire.connect(str(at.sockets()[0]))
        wire.sendall(b"GET /requests HTTP/1.1\r\nHost: localhost\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                     b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: " + base64.b64encode(bytes(16)) + b"\r\n\r\n")
        answers = wire.makefile("rb")
        while answers.readline().strip():
            pass
        for way, text in re.findall(r"^([<>]) (.*)$", block, re.MULTILINE):
            if way == ">":  # one frame of text, masked with zeros
                wire.sendall(bytes([0x81, 0x80 | len(text)]) + bytes(4) + text.encode())
            else:
                assert answers.read(answers.read(2)[1]).decode() == text
