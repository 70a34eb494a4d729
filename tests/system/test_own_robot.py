"""The worked example of docs/own_robot.md, exactly as it is printed there; test_page_examples.py types its session."""

import pathlib
import re

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
