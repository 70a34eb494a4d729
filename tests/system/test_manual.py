"""The manual pages that tools/manual makes of the helps."""

import os
import re
import subprocess

import pytest

from desk import ROOT


def write_pages(folder):
    return subprocess.run([ROOT / "tools/manual", os.environ["UNDERSTUDY"], folder, "2026-01-02"], capture_output=True,
                          text=True, timeout=60)


@pytest.fixture(name="pages", scope="module")
def pages_fixture(tmp_path_factory):
    folder = tmp_path_factory.mktemp("man") / "man1"
    assert write_pages(folder).returncode == 0
    return folder


def read(page):
    """The page as one reads it, on one line."""
    shown = subprocess.run(["man", "--warnings=w", "--no-hyphenation", "--no-justification", "-l", page], capture_output=True, text=True, check=True,
                           env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "200", "MAN_KEEP_FORMATTING": ""})
    assert shown.stderr == "", page
    return " ".join(re.sub(".\b", "", shown.stdout).split())


def words(text):
    return " ".join(text.split())


def test_each_command_has_a_page_and_the_program_itself(understudy, pages):
    commands = understudy("complete", "--", "").stdout.split()

    assert "run" in commands and "ctl" in commands
    assert {page.name for page in pages.iterdir()} == {"understudy.1", *(f"understudy-{name}.1" for name in commands)}


def test_no_page_has_a_fault_of_form(pages):
    done = subprocess.run(["mandoc", "-Tlint", "-W", "style", *sorted(pages.iterdir())], capture_output=True, text=True)

    assert done.stdout + done.stderr == ""
    assert done.returncode == 0


def test_a_page_says_all_that_the_help_says(understudy, pages):
    for command in understudy("complete", "--", "").stdout.split():
        page = read(pages / f"understudy-{command}.1")
        text = understudy(command, "--help").stdout
        assert words(text.splitlines()[0]) in page
        for option in re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.MULTILINE):
            assert re.search(rf"(^|[ ,]){option}([ ,]|$)", page), f"{command} {option}"
        # Of a command with others below it, those are pages or sections of their own.
        head = "\nSubcommands:" if "\nSubcommands:" in text else "\nOptions:"
        footer = text[text.find("\n\n", text.find(head)):] if command != "ctl" else ""
        for line in footer.splitlines():
            if re.match(" {2}-| {20}", line):  # options of a group of their own, and what they do
                continue
            line = words(re.sub(r"^Examples?:", "", line.strip()))
            assert line in page, f"{command}: {line}"


def test_the_page_of_ctl_has_every_request_with_its_example(understudy, pages):
    page = read(pages / "understudy-ctl.1")

    for verb in (["push"], ["crane", "lower"], ["remote", "press"], ["status"], ["fault"]):
        text = understudy("ctl", *verb, "--help").stdout
        assert f"{' '.join(verb)} [OPTIONS]" in page
        assert f"{words(text.splitlines()[0])}." in page
        for example in re.findall(r"^Example: (.*)", text, re.MULTILINE):
            assert words(example) in page


def test_what_is_meant_by_roff_is_shown_as_it_was_written(understudy, pages):
    # Quotes and minus signs would else be other letters.
    assert "A robot's name (see `understudy robots`) or its YAML" in read(pages / "understudy-run.1")
    assert "understudy ctl damage --json | jq .damage.falls" in read(pages / "understudy-ctl.1")


def test_pages_that_cannot_be_written_are_an_error(tmp_path):
    (tmp_path / "man").write_text("no folder")
    done = write_pages(tmp_path / "man" / "man1")

    assert done.returncode == 1
    assert str(tmp_path / "man") in done.stderr
