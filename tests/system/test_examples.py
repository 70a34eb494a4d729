"""Every command that a page or a help shows is one that the program takes, and those of `ctl` work."""

import pathlib
import re
import shlex
import shutil

import pytest

from robots import understudy as run

ROOT = pathlib.Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
PLACEHOLDER = re.compile(r"\b[A-Z]{3,}\b|…|\.\.\.|[<\[]")
OPERATORS = {";", "|", "||", "&", "&&", ">", ">>", "<", "(", ")"}
USAGE = 2  # the exit code for a command line that is none


def commands_of(line):
    """The commands of understudy on a line of a shell, each a list of words."""
    lexer = shlex.shlex(line, posix=True, punctuation_chars=True)
    lexer.whitespace_split = True
    found, command = [], []
    for word in [*lexer, ";"]:
        if word in OPERATORS:
            if word.startswith(">") and command and command[-1].isdigit():
                command.pop()  # of 2>
            if command[:1] == ["understudy"]:
                found.append(command[1:])
            command = []
        else:
            command.append(word)
    return found


def commands():
    return run("complete", "--", "").stdout.split()


def lines_of_page(page):
    """The lines of its blocks of code, and what stands between backticks, which may be a part of a command."""
    text = page.read_text().replace("\\\n", " ")
    return (re.findall(r"^\s*(?:\$ )?((?:\w+=\S+ )*understudy .*)$", text, re.MULTILINE),
            re.findall(r"`(understudy [^`\n]+)`", re.sub(r"^    .*$", "", text, flags=re.MULTILINE)))


def lines_of_help(*command):
    """The examples at its end, whose remarks are two spaces away."""
    text = run(*command, "--help").stdout
    return [re.split(r"\s{2,}", line)[0]
            for line in re.findall(r"(?:^Example: |^  )([^:`\n]*understudy .*)$", text[text.find("\nExample"):],
                                   re.MULTILINE)]


def verbs():
    """Every subcommand, those of groups too."""
    def below(*path):
        children = run("complete", "--", *path, "").stdout.split() if path[0] == "ctl" and len(path) < 3 else []
        children = [child for child in children if run("ctl", *path[1:], child, "--help").returncode == 0]
        return [path] + [verb for child in children for verb in below(*path, child)]

    return [verb for command in commands() for verb in below(command)]


def check_names(words):
    """The program has the command and each option; gives the words before `--`."""
    ours = words[:words.index("--")] if "--" in words else words
    assert words[0] in commands() + ["--version", "help"], words
    for i, word in enumerate(ours):
        if word.startswith("--"):
            name = word.split("=")[0]
            assert name in run("complete", "--", *ours[:i], name).stdout.split() + ["--help"], f"{name} of {words}"
    return ours


def check(words, folder):
    """Nothing is wrong with the command line, as far as one can tell without a robot that runs."""
    ours = check_names(words)
    if words[0] in ("run", "exec"):
        done = run(*ours, "--print-config", *words[len(ours):], cwd=folder)
        missing = "cannot be read" in done.stderr or "no such file" in done.stderr.lower()
        assert done.returncode == 0 or missing, f"{words}: {done.stderr}"
    elif words[:2] != ["ctl", "wait"] and words[0] not in ("rehearse", "judge"):
        done = run(*words, cwd=folder)
        assert done.returncode != USAGE, f"{words}: {done.stderr}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_program_takes_every_command_of_a_page(page, tmp_path):
    lines, spans = lines_of_page(page)
    for line in lines:
        for words in commands_of(line):
            if not PLACEHOLDER.search(" ".join(words)):
                check(words, tmp_path)
    for span in spans:
        for words in commands_of(span):
            if not PLACEHOLDER.search(" ".join(words)):
                check_names(words)


def test_the_program_takes_every_example_of_its_help(tmp_path):
    for verb in verbs():
        lines = lines_of_help(*verb)
        assert lines or verb[0] == "ctl", f"{verb} has no example"
        for line in lines:
            for words in commands_of(line):
                check(words, tmp_path)


def test_every_example_of_ctl_works(play, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # where it records to
    robot = play("go2", "--start", "hanging")
    before = {"step": ["pause"], "resume": [], "release": [], "raise": ["crane", "attach"], "attach": [],
              "joint": ["clamp", "on"]}
    for verb in verbs():
        name = verb[-1]
        if verb[0] != "ctl" or verb == ("ctl",) or name in ("wait", "panel", "stop"):
            continue
        for line in lines_of_help(*verb):
            for words in commands_of(line):
                if words[0] != "ctl" or {"--watch", "--follow", "--name"} & set(words):
                    continue
                if before.get(name):
                    robot.ctl(*before[name])
                robot.ctl(*words[1:])
                if name == "step":
                    robot.ctl("resume")


WALKS = """
scenario: A program ends well
robot: go2
program:
expect: [{final: program.exit_code is 0}]
"""
SHOVES = """
scenario: Seventeen short shoves
robot: go2
start: standing
duration: 0.3
script: [{at: 0.1, push: {body: base_link, force: [0, $force, 0], for: 0.1}}]
expect: [{never: base.height < 0.2, name: does not fall}]
vary: {grid: {$force: {from: 1, to: 17, whole: true}}}
"""


def test_every_example_of_rehearse_and_judge_works(tmp_path):
    """In a folder that has the files which they name."""
    (tmp_path / "walk.yaml").write_text(WALKS)
    (tmp_path / "walk.py").write_text("import sys\nassert sys.argv[1] in ('lo', 'eth0')\n")
    shutil.copy(ROOT / "config" / "scenarios" / "push.yaml", tmp_path)
    (tmp_path / "shoves.yaml").write_text(SHOVES)
    (tmp_path / "expect.yaml").write_text("expect: [{always: gap(lowstate) < 3 ms}]\n")
    for part in (1, 3, 4):
        shard = run("rehearse", "shoves.yaml", "--shard", f"{part}/4", "--out", f"part{part}", cwd=tmp_path, timeout=120)
        assert shard.returncode == 0, shard.stderr
    lines = lines_of_help("rehearse") + lines_of_help("judge")
    assert len(lines) > 9
    for line in lines:
        [words] = commands_of(line)
        done = run(*words, cwd=tmp_path, timeout=240)
        assert done.returncode == 0, f"{line}: {done.stdout}{done.stderr}"
        if line.endswith("rehearse stand_up"):
            shutil.copy(tmp_path / "rehearsals" / "stand_up" / "recording.mcap", tmp_path / "real_robot.mcap")
