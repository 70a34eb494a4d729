"""The blocks of Python that pages have for this package run as they are."""

import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).parents[2]
BLOCKS = [
    (page.name, block)
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    for block in re.findall(r"^```python\n(.*?)^```$", page.read_text(), re.MULTILINE | re.DOTALL)
    if "import understudy" in block
]


@pytest.mark.parametrize("page, block", BLOCKS, ids=[page for page, _ in BLOCKS])
def test_a_block_runs(page, block, capsys):
    exec(compile(block, page, "exec"), {})
    assert capsys.readouterr().out


def test_there_is_such_a_block():
    assert "python.md" in [page for page, _ in BLOCKS]
