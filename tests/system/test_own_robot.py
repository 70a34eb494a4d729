"""The worked example of docs/own_robot.md, exactly as it is printed there."""

import os
import pathlib
import re
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).parents[2]
FILES = {"xml": "arm.xml", "yaml": "arm.yaml", "python": "reach.py"}  # by the language of its block


def code_blocks(section):
    """(language, text) of each code block of a section of the document."""
    text = (ROOT / "docs" / "own_robot.md").read_text()
    text = text.split(f"## {section}\n")[1].split("\n## ")[0]
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


@pytest.fixture(scope="module")
def blocks():
    """The code blocks of the example, by language."""
    found = code_blocks("A robot of your own")
    assert sorted(language for language, _ in found) == sorted([*FILES, "console"])
    return dict(found)


@pytest.mark.parametrize("language", FILES)
def test_the_document_prints_the_files_of_the_example(blocks, language):
    example = ROOT / "examples" / "two_joint_arm" / FILES[language]

    assert blocks[language] == example.read_text()


def test_the_session_goes_as_it_is_printed(blocks, tmp_path):
    for language, name in FILES.items():
        (tmp_path / name).write_text(blocks[language])
    programs = [pathlib.Path(os.environ["UNDERSTUDY"]).parent, pathlib.Path(sys.executable).parent]
    path = os.pathsep.join([*map(str, programs), os.environ["PATH"]])

    typed = re.findall(r"^\$ (.*)\n((?:[^$].*\n)*)", blocks["console"], re.MULTILINE)

    assert len(typed) == 2
    for command, printed in typed:
        done = subprocess.run(command, shell=True, cwd=tmp_path, env=os.environ | {"PATH": path},
                              capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, done.stderr
        assert done.stdout == printed, done.stderr


def test_the_model_lies_beside_the_file_that_names_it(blocks, tmp_path, understudy):
    (tmp_path / "arm.yaml").write_text(blocks["yaml"])
    missing = understudy("check", tmp_path / "arm.yaml")
    (tmp_path / "arm.xml").write_text(blocks["xml"])

    assert missing.returncode == 4
    assert "arm.xml" in missing.stdout
    assert understudy("check", tmp_path / "arm.yaml").returncode == 0


def test_the_variant_of_another_robot_is_one(tmp_path, understudy):
    [(language, text)] = code_blocks("A robot like another")
    (tmp_path / "heavy.yaml").write_text(text)

    checked = understudy("check", tmp_path / "heavy.yaml")
    ran = understudy("run", tmp_path / "heavy.yaml", "--speed", "max", "--duration", "0.1")

    assert language == "yaml"
    assert checked.returncode == 0, checked.stdout
    assert ran.returncode == 0, ran.stderr
