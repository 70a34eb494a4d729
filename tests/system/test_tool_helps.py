"""The examples at the head of the helps of tools/, in their own words where a test can."""

import os
import re
import shutil
import subprocess
from xml.etree import ElementTree

import pytest

from desk import ROOT
from robots import understudy

TOOLS = sorted(file.name for file in (ROOT / "tools").iterdir() if file.is_file() and os.access(file, os.X_OK))

# What a test cannot do, by how the line begins: why, and what stands for it.
ELSEWHERE = {
    "tools/sdk_env": "made the environment in which this runs",
    "tools/run_examples (python|cpp) SDK": "needs the vendor's SDKs: test_run_examples.py has it run programs of theirs",
    "tools/identify_go2 CHECKOUT": "needs recordings of others, which nothing here fetches: docs/reference/identify.md says what it told",
}


def run(*words, **how):
    return subprocess.run(words, capture_output=True, text=True, timeout=120, **how)


def help_of(tool):
    done = run(ROOT / "tools" / tool, "--help")
    assert done.returncode == 0, done.stderr
    return done.stdout


def examples_of(tool):
    return re.findall(r"^ +(tools/\S+.*)$", help_of(tool), re.MULTILINE)


def of_tool(name):
    return [line for line in examples_of(name) if not any(re.match(begin, line) for begin in ELSEWHERE)]


@pytest.mark.parametrize("tool", [tool for tool in TOOLS if tool != "bench"])  # whose help is the program's
def test_a_tool_tells_what_it_is_for(tool):
    assert re.search(rf"^[Uu]sage: (tools/)?{tool}\b", help_of(tool), re.MULTILINE)


@pytest.mark.parametrize("line", of_tool("soak"))
def test_a_soak_of_seconds_in_place_of_minutes_goes_as_the_help_says(line, tmp_path):
    command, _, *rest = line.replace("/tmp/night.mcap", str(tmp_path / "night.mcap")).split()
    done = run(ROOT / command, "0.15", *rest)
    assert done.returncode == 0, done.stdout + done.stderr
    assert len(done.stdout.splitlines()) > 10, done.stdout
    assert "--record" not in rest or (tmp_path / "night.mcap").stat().st_size > 0


@pytest.mark.parametrize("line", of_tool("up"))
def test_what_up_starts_after_it_has_built_goes_as_the_help_says(line):
    _, robot, *options = line.split()
    done = understudy("run", robot, *options, "--duration", "0.1", "--no-panel")
    assert done.returncode == 0, done.stderr


def test_add_prints_the_list_of_a_kind_and_names_the_kinds():
    kinds = [line.split()[0] for line in run(ROOT / "tools/add").stdout.splitlines()]
    assert {"fault", "sensor", "topic", "request", "robot"} <= set(kinds)
    for kind in kinds:
        assert "- [ ] " in run(ROOT / "tools/add", kind).stdout, kind
    assert "`src/robot/fault.cc`" in run(ROOT / "tools/add", "fault").stdout


def test_add_prints_the_lists_of_several_kinds_one_after_the_other():
    text = run(ROOT / "tools/add", "sensor", "topic").stdout
    assert text.index("# sensor\n") < text.index("`src/sensors/`") < text.index("# topic\n") < text.index("topic_list.inc")


def test_add_names_the_nearest_kind():
    for words in (["fualt"], ["sensor", "fualt"]):
        done = run(ROOT / "tools/add", *words)
        assert done.returncode == 2
        assert done.stderr == "add: fualt: no such kind; did you mean fault?\n"


PAGE = "docs/page" + ".md"  # of the house


@pytest.fixture(name="house")
def house_fixture(tmp_path):
    """A repository of its own with the tools of pages, and one page."""
    for name in ("rooms", "shells", "add", "words"):
        (tmp_path / "tools").mkdir(exist_ok=True)
        shutil.copy(ROOT / "tools" / name, tmp_path / "tools" / name)
    (tmp_path / "tools/words.txt").write_text(f"frobs -> it again\n{PAGE} 1\n")
    (tmp_path / "docs/images").mkdir(parents=True)
    for name in ("README.md", "CONTRIBUTING.md", "CONVENTIONS.md"):
        (tmp_path / name).write_text("# One\n")
    return tmp_path


def commit(house):
    for words in (["init", "-q", "-b", "work"], ["add", "-A"],
                  ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-q", "-m", "One"]):
        subprocess.run(["git", "-C", house, *words], check=True)


def sentence(words):
    return "A " + "word " * (words - 2) + "more."


def test_words_finds_more_long_sentences_than_a_page_may_have(house):
    page = house / PAGE
    page.write_text(f"# One\n\n{sentence(26)} {sentence(25)}\n\n| {sentence(25)} | {sentence(9)} |\n")
    assert run(house / "tools/words").returncode == 0

    page.write_text(f"# One\n\n- {sentence(26)}\n- {sentence(27)}\n")
    done = run(house / "tools/words")
    assert done.returncode == 1
    assert f"{PAGE}:4: a sentence of 27 words" in done.stderr
    assert "2 sentences of more than 25 words, it may have 1" in done.stderr


def test_words_names_the_sentence_that_the_page_did_not_have(house):
    page = house / PAGE
    page.write_text(f"{sentence(26)}\n")
    commit(house)
    page.write_text(f"{sentence(26)}\n\n{sentence(30)}\n")
    commit(house)
    done = run(house / "tools/words")
    assert f"{PAGE}:3: a sentence of 30 words" in done.stderr
    assert "26 words" not in done.stderr


def test_words_lowers_what_a_page_may_have_and_never_raises_it(house):
    page, table = house / PAGE, house / "tools/words.txt"
    page.write_text(f"{sentence(26)} {sentence(26)}\n")
    run(house / "tools/words", "--lower")
    assert f"{PAGE} 1\n" in table.read_text()

    page.write_text(f"{sentence(25)}\n")
    run(house / "tools/words", "--lower")
    assert PAGE not in table.read_text()


def test_words_reads_the_lines_that_a_change_adds_and_no_others(house):
    page = house / PAGE
    page.write_text("It does frobs.\n")
    commit(house)
    page.write_text("It does frobs.\nIt does so.\n")
    commit(house)
    assert run(house / "tools/words").returncode == 0

    page.write_text("It does frobs.\nIt does so.\nFrobs it goes.\n")
    done = run(house / "tools/words")
    assert done.returncode == 1
    assert done.stderr == f"{PAGE}:3: 'Frobs': write it again\n"


def test_words_says_that_it_read_no_changes_where_there_is_no_history(house):
    (house / PAGE).write_text("It does frobs.\n")
    done = run(house / "tools/words")
    assert done.returncode == 0
    assert "there is no history here" in done.stdout


def test_shells_makes_closed_meshes_of_sections_and_paths(house):
    (house / "models/bot").mkdir(parents=True)
    (house / "models/bot/shells.toml").write_text(
        '[hull]\naxis = "z"\nsections = [[0, 0, 0.1, 0.2, 0.3, 2], [0.5, 0, 0.1, 0.2, 0.3, 2]]\n'
        "[ring]\nclosed = true\npath = [[0.1, 0, 0, 0.01, 0.01], [0, 0.1, 0, 0.01, 0.01], [-0.1, 0, 0, 0.01, 0.01], "
        "[0, -0.1, 0, 0.01, 0.01]]\n")
    assert run(house / "tools/shells", "--check").returncode == 1
    assert run(house / "tools/shells").returncode == 0
    assert run(house / "tools/shells", "--check").returncode == 0
    hull, ring = ElementTree.parse(house / "models/bot/parts/shells.xml").iter("mesh")
    for mesh in (hull, ring):
        numbers = [int(n) for n in mesh.get("vertex").split()]
        points = [numbers[i:i + 3] for i in range(0, len(numbers), 3)]
        faces = [int(n) for n in mesh.get("face").split()]
        faces = [faces[i:i + 3] for i in range(0, len(faces), 3)]
        edges = [(a, b) for f in faces for a, b in zip(f, f[1:] + f[:1])]
        assert sorted(edges) == sorted((b, a) for a, b in edges), "each edge has a face on both sides"
        volume = sum(sum(x * (b[(k + 1) % 3] * c[(k + 2) % 3] - b[(k + 2) % 3] * c[(k + 1) % 3])
                         for k, x in enumerate(a)) for a, b, c in ([points[i] for i in f] for f in faces))
        assert volume > 0, "faces look outwards"
    x = [int(n) for n in hull.get("vertex").split()][::3]
    assert (min(x), max(x)) == (-2000, 1000), "tenths of a millimetre: 0.2 m back, 0.1 m front"


def test_rooms_draws_a_floor_for_each_room_above_what_it_includes(house):
    for room, includes in (("base", ""), ("wire", "base"), ("run", "wire")):
        (house / "src" / room).mkdir(parents=True)
        (house / "src" / room / "a.cc").write_text(f'#include "{includes}/a.h"\n')
    assert run(house / "tools/rooms", "--check").returncode == 1
    assert run(house / "tools/rooms").returncode == 0
    assert run(house / "tools/rooms", "--check").returncode == 0
    picture = (house / "docs/images/rooms.svg").read_text()
    height = {name: float(y) for y, name in re.findall(r'<text x="[\d.]+" y="([\d.]+)"[^>]*>(\w+)<', picture)}
    assert height["run"] < height["wire"] < height["base"]
    assert picture.count("marker-end") == 2

    (house / "src/base/a.cc").write_text('#include "run/a.h"\n')
    done = run(house / "tools/rooms")
    assert done.returncode == 1
    assert "include each other: base -> run -> wire -> base" in done.stderr


def test_no_other_help_of_a_tool_has_an_example():
    there = {line for tool in TOOLS if tool != "bench" for line in examples_of(tool)}
    assert {line for line in there if not any(re.match(begin, line) for begin in ELSEWHERE)} \
        == set(of_tool("soak")) | set(of_tool("up"))
    assert all(any(re.match(begin, line) for line in there) for begin in ELSEWHERE)
