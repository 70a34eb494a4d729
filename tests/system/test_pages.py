"""What the pages name is there: files of examples, links and their headings."""

import pathlib
import re

import pytest

ROOT = pathlib.Path(__file__).parents[2]
PAGES = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CONVENTIONS.md")] + sorted((ROOT / "docs").rglob("*.md"))
# Shipped files, and the page that prints them.
PRINTED = {"examples/randomization.yaml": "reference/randomization.md", "examples/campaign/shoves.yaml": "rehearsing.md"}


def without_code(text):
    return re.sub(r"^```.*?^```$|`[^`\n]+`", "", text, flags=re.MULTILINE | re.DOTALL)


def anchors(page):
    """The names under which links find its headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_link_of_a_page_leads_somewhere(page):
    for link in re.findall(r"\]\(([^)\s]+)\)", without_code(page.read_text())):
        if re.match(r"https?:", link):
            continue
        name, _, heading = link.partition("#")
        target = page.parent / name if name else page
        assert target.exists(), f"{page.name} links to {link}"
        if heading and target.suffix == ".md":
            assert heading in anchors(target), f"{page.name} links to {link}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_example_that_a_page_names_is_shipped(page):
    text = page.read_text()
    made = re.findall(r"^\$ mmdebstrap .* (\S+)$", text, re.MULTILINE)
    for name in set(re.findall(r"(?<!understudy/)\bexamples/[\w./-]*\w", text)) - set(made):
        assert (ROOT / name).exists(), f"{page.name} names {name}"


def test_the_readme_has_no_file_typed_that_nobody_has_but_your_own_and_what_a_command_writes():
    typed = re.findall(r"^\s*\$ ([^#\n]*)", (ROOT / "README.md").read_text(), re.MULTILINE)
    named = re.findall(r"[\w./-]+\.(?:yaml|py|xml|npz|urdf)\b", "\n".join(typed))
    assert named
    assert [name for name in named if not (ROOT / name).exists()] == ["my.urdf"]


@pytest.mark.parametrize("name", PRINTED)
def test_a_page_prints_the_file_that_is_shipped(name):
    assert f"```yaml\n{(ROOT / name).read_text()}```" in (ROOT / "docs" / PRINTED[name]).read_text()
