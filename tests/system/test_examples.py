"""Every command that a page or a help shows is one that the program takes; test_help_examples.py runs those of
helps."""

import pathlib
import re
import shlex

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


# Needs what a test machine has not got, or does not end by itself; others run such: test_view, test_recipes,
# test_life_cycle.
RUN_ELSEWHERE = {"--view", "--gamepad", "--detach", "--interface"}


def at_the_examples(folder):
    """A folder with the shipped examples, where what is recorded is in nobody's way."""
    here = folder / "runs"
    if not here.exists():
        here.mkdir()
        (here / "examples").symlink_to(ROOT / "examples")
        for file in [*(ROOT / "examples").glob("*/*.yaml"), ROOT / "examples" / "randomization.yaml"]:
            (here / file.name).symlink_to(file)
    return here


def succeeded(done, words):
    """Or it lacks a file that is the reader's, or that a command before it makes."""
    missing = "cannot be read" in done.stderr or "no such file" in done.stderr.lower()
    assert done.returncode == 0 or missing, f"{words}: {done.stderr}"


def check(words, folder):
    """Nothing is wrong with the command line; a robot starts by it, if all files that it names are there."""
    ours = check_names(words)
    if words[0] in ("run", "exec"):
        here = at_the_examples(folder)
        succeeded(run(*ours, "--print-config", *words[len(ours):], cwd=here), words)
        if words[0] == "run" and not RUN_ELSEWHERE & set(ours):
            succeeded(run(*ours, "--duration", "0.1", "--no-panel", cwd=here), words)
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
