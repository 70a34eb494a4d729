"""Runs the sessions that a page shows: what is typed in its ```console blocks, and that what they print is printed.

    $ command        typed in this terminal; exit code 0 unless the page shows another as [N]
    jetson$ command  typed in the terminal of that name
    $ # words        done by hand; the test does it
    printed          occurs in what was printed from that command on, in this order; … stands for anything

A block is left out only where the page itself says so: the paragraph before it begins with *Not run by the tests*.
"""

import dataclasses
import os
import queue
import re
import subprocess
import textwrap
import threading
import time

PROMPT = re.compile(r"(\w*)\$ (.*)")
NOT_RUN = "*Not run by the tests*"
PATIENCE = 120.0  # s, for a command
AFTERWARDS = 20.0  # s, for what comes after it, from the background


@dataclasses.dataclass
class Typed:
    """A line that is typed, and the lines that the page shows after it."""

    terminal: str
    command: str
    printed: list


def sections(page):
    """{heading: text} of a page."""
    return dict(re.findall(r"^## (.*?)\n(.*?)(?=^## |\Z)", page, re.MULTILINE | re.DOTALL))


def blocks(text):
    """(language, text, whether the tests run it) of each block of code."""
    found = []
    for block in re.finditer(r"^( *)```(\w*)\n(.*?)^\1```$", text, re.MULTILINE | re.DOTALL):
        before = text[:block.start()].strip().split("\n\n")[-1]
        found.append((block[2], textwrap.dedent(block[3]), not before.startswith(NOT_RUN)))
    return found


def session(block):
    """The lines of a console block, those that end in a backslash joined with what follows."""
    lines = []
    for line in block.replace("\\\n", " ").splitlines():
        if typed := PROMPT.fullmatch(line):
            lines.append(Typed(typed[1], typed[2], []))
        elif line.strip():
            lines[-1].printed.append(line)
    return lines


def matches(shown, text):
    """Whether the lines shown occur in the text, in their order."""
    pattern = ".*?".join(".*?".join(map(re.escape, line.strip().split("…"))) for line in shown)
    return re.search(pattern, text, re.DOTALL) is not None


class Terminal:
    """A shell; `here` is put in front of it, as nsenter is."""

    def __init__(self, folder, environment, here=(), patience=PATIENCE):
        self._patience = patience
        self._shell = subprocess.Popen([*here, "bash", "--noprofile", "--norc"], cwd=folder, env=environment, text=True,
                                       stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self._lines = queue.Queue()
        self._said = []
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self._shell.stdout:
            self._lines.put(line)

    def _wait(self, condition, seconds, what):
        deadline = time.monotonic() + seconds
        while not condition():
            try:
                self._said.append(self._lines.get(timeout=0.1))
            except queue.Empty:
                assert time.monotonic() < deadline, f"not within {seconds:.0f} s: {what}\n{''.join(self._said)}"

    def type(self, line, verdict=0):
        """Types it, waits for its end, and for what the page shows; a failed test if either does not come. `verdict` is an
        exit code that is as good as 0."""
        self._said = []
        mark = f"::{os.urandom(8).hex()}"
        self._shell.stdin.write(f"{line.command}\ncode=$?; echo; echo {mark} $code\n")
        self._shell.stdin.flush()
        self._wait(lambda: self._said and self._said[-1].startswith(mark), self._patience,
                   f"{line.command} ends")
        code = self._said.pop().split()[1]
        wanted = re.fullmatch(r"\[(\d+)\]", line.printed[-1]) if line.printed else None
        shown = line.printed[:-1] if wanted else line.printed
        assert code in ([wanted[1]] if wanted else ["0", str(verdict)]), f"{line.command}: exit code {code}\n{''.join(self._said)}"
        self._wait(lambda: matches(shown, "".join(self._said)), AFTERWARDS,
                   "\n".join([f"{line.command} prints", *shown, "but"]))

    def close(self):
        self._shell.stdin.close()
        self._shell.wait(PATIENCE)
