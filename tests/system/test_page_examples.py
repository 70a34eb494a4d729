"""Every block of code of every page, in its own words: what one types is typed at a desk, what one writes into a file is
loaded, what is shown after a command is printed. test_recipes.py types recipes.md and deploying.md."""

import contextlib
import os
import pathlib
import re
import sys

import pytest

from console import blocks
from desk import ROOT, put_program
from namespaces import host_on_a_cable
from page_session import Session, load, typed

PAGES = [page for page in [*ROOT.glob("*.md"), *sorted((ROOT / "docs").rglob("*.md")), *ROOT.glob("models/*/README.md"),
                           ROOT / "tests" / "data" / "README.md"] if page.name not in ("recipes.md", "deploying.md")]
TYPED = ("sh", "console")
LOADED = ("yaml", "json", "xml", "python", "http", "websocket")
BUILT = ("cpp", "cmake")  # tests/assembly/package.cmake builds and runs them
SHOWN = "text"  # a formula, a diagram, a file of the system, lines of a log: nothing to type
COMMAND = re.compile(r"^\s*(\$ |(sudo )?(\./)?(understudy|tools/|python3?|apt|cmake|curl|docker|systemctl|export|ros2) ?)")

# What a test cannot do, by how the line begins: why, and what stands for it.
ELSEWHERE = {
    r"(\./)?tools/check\b": "builds and runs all tests, this one too: .ci/run is `tools/check --all`",
    r"(\./)?tools/package\b": "builds the release anew: tests/package has it made and installs what it makes",
    r"(sudo )?apt-get install": "changes the machine: tests/package/test_package.py installs the package on a new Debian",
    r"systemctl ": "needs systemd as the first process: tests/package/test_package.py boots one and starts the unit",
    r"mmdebstrap |buildah |podman ": "fetches a Debian: tests/package/test_recipe.py makes the image so and runs it",
    r"docker compose": "needs Docker's engine: tests/package/test_package.py runs what compose.yaml says, in one network",
    r"sudo understudy run go2 --interface eth0 --as-robot": "needs a card and root: test_two_hosts.py runs it on a cable",
    r"understudy run \w+ --look ~": "needs the vendor's meshes: test_pictures.py draws a robot by some of its own",
    r"understudy run go2 --scene office\.": "needs a scan: test_sight.py stands and looks in one of its own",
    r"understudy rehearse slow.yaml": "needs a policy that walks: tests/rehearse/vary_test.cc varies what a program thinks",
    r"(sudo )?setcap ": "changes the program under test, and needs the right to: docs/reference/realtime.md says what to look for",
    r'pip install "?\.|python -m understudy': "builds all once more: tools/python_env does it, tests/python/test_package.py runs it",
    r"python3 examples/training/go2_flat/train.py": "trains for an hour: tests/python/test_training.py trains for some seconds",
    r"python -m g1_lab": "needs mjlab, which takes gigabytes: tests/python/programs/mjlab_task.py steps it, by hand",
    r"understudy rehearse examples/training": "needs a walk that was trained: test_policy.py judges one that stands",
    r"ros2 bag play": "needs ROS 2: test_ros_topics.py decodes the same topics of a recording by ROS 2's definitions",
    r"understudy exec go2 --scene examples/course": "walks for a minute: tests/conformance/test_course.py runs it",
    r"tools/run_examples": "needs the vendor's SDKs built: test_run_examples.py has it run programs of theirs",
    r"cmake -S . -B build/mine|cmake --build build/mine": "builds all with MuJoCo 3: `tools/check --mujoco3`, a part of .ci/run",
}

# In place of what takes minutes.
STAND_INS = {
    "tools/up": 'echo "building (release)"\nexec understudy run "$@"',
    "tools/sdk_env": "test -f build/sdk-env/bin/activate",  # the tests run in it
    "bin/cmake": f"""case $1 in
--preset) exec {{cmake}} --list-presets -S {ROOT} | grep -q "\\"$2\\"";;
--build) grep -rq "understudy_test(${{4%_test}}$" {ROOT}/tests;;
esac""",
}
# A card, and at the other end of its cable a second computer.
HERE, FAR = ("eth0", "10.0.0.7/24"), ("eth0", "10.0.0.222/24")


@pytest.fixture(name="clone")
def clone_fixture(desk):
    """The desk in a clone: what is in ours, without writing to it, and with what is built."""
    for name in ("tests", "examples", "config", "models"):
        (desk / name).symlink_to(ROOT / name)
    for name, does in STAND_INS.items():
        put_program(desk, name, does.replace("{cmake}", "/usr/bin/cmake"))
    for file in (ROOT / "tools").iterdir():
        if not (desk / "tools" / file.name).exists():
            (desk / "tools" / file.name).symlink_to(file)
    built = pathlib.Path(os.environ["UNDERSTUDY"]).resolve().parents[1]
    (desk / "build" / "release").mkdir(parents=True)
    (desk / "build" / "release" / "bin").symlink_to(desk / "bin")
    (desk / "build" / "dev").symlink_to(built)
    (desk / "build" / "sdk-env").symlink_to(sys.prefix)
    vendors = desk / "unitree_mujoco" / "unitree_robots"
    vendors.mkdir(parents=True)
    (vendors / "go2").symlink_to(ROOT / "models" / "go2")
    return desk


def elsewhere(command):
    return [line for line in ELSEWHERE if re.match(line, command)]


def lines_of(page):
    """All that a page has one type."""
    return [line for language, block, _ in blocks(page.read_text()) if language in TYPED
            for line in typed(language, block)]


def has_code(page):
    return any(language != SHOWN for language, _, _ in blocks(page.read_text()))


@pytest.mark.parametrize("page", [page for page in PAGES if has_code(page)], ids=lambda page: page.stem)
def test_a_page_goes_as_it_is_written(page, clone, screen, monkeypatch):
    monkeypatch.setenv("DISPLAY", screen.name)
    with contextlib.ExitStack() as stack:
        fronts = {"far": stack.enter_context(host_on_a_cable(HERE, FAR))} if page.stem == "doctor" else {}
        session = stack.enter_context(Session(clone, fronts))
        for language, block, _ in blocks(page.read_text()):
            if language in TYPED:
                for line in typed(language, block):
                    if not elsewhere(line.command):
                        session.type(line)
            elif language not in (*BUILT, SHOWN):
                load(language, block, session)


def test_what_is_only_shown_has_nothing_to_type():
    for page in PAGES:
        for language, block, _ in blocks(page.read_text()):
            assert language in (*TYPED, *LOADED, *BUILT, SHOWN), f"{page.name} has a block of '{language}': nothing runs it"
            assert language != SHOWN or not COMMAND.search(block), f"{page.name} only shows a command:\n{block}"
        prose = re.sub(r"^( *)```.*?^ *```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
        assert not re.search(r"\n\n {4}\S", prose), f"{page.name} has a block of code that has no language"


def test_a_page_still_has_each_line_that_is_run_elsewhere():
    there = [found for page in PAGES for line in lines_of(page) for found in elsewhere(line.command)]
    assert set(there) == set(ELSEWHERE)
