"""Every command in the prose of a page is one that the program takes; test_page_examples.py and test_recipes.py type those
that stand in blocks, test_help_examples.py those of helps."""

import pathlib
import re
import shlex

import pytest

from helps import commands
from robots import understudy

ROOT = pathlib.Path(__file__).parents[2]
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
PLACEHOLDER = re.compile(r"\b[A-Z]{3,}\b|…|\.\.\.|[<\[]")
OPERATORS = {";", "|", "||", "&", "&&", ">", ">>", "<", "(", ")"}


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


def check_names(words):
    """The program has the command and each option."""
    ours = words[:words.index("--")] if "--" in words else words
    known = words[0] in commands() + ["--version", "help"] or understudy(words[0], "--help").returncode == 0
    assert known, words
    for i, word in enumerate(ours):
        if word.startswith("--"):
            name = word.split("=")[0]
            assert name in understudy("complete", "--", *ours[:i], name).stdout.split() + ["--help"], f"{name} of {words}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_the_program_takes_every_command_in_the_prose_of_a_page(page):
    prose = re.sub(r"^( *)```.*?^ *```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    for span in re.findall(r"`(understudy [^`\n]+)`", prose):
        for words in commands_of(span):
            if not PLACEHOLDER.search(" ".join(words)):
                check_names(words)
