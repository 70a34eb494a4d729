"""docs/recipes.md and docs/deploying.md as they stand: their commands are typed, and print what the pages show."""

import contextlib
import json
import os
import pathlib
import re
import subprocess
import sys

import pytest

from console import Terminal, blocks, sections, session
from gamepads import LEAST, Gamepad, mapping
from namespaces import host_on_a_cable
from robots import eventually, understudy

ROOT = pathlib.Path(__file__).parents[2]
PAGES = [ROOT / "docs" / "recipes.md", ROOT / "docs" / "deploying.md"]
RECIPES = {heading: text for page in PAGES for heading, text in sections(page.read_text()).items() if "```" in text}
WITH_THE_PACKAGE = "Docker"  # played where that is: tests/package/test_recipe.py
# A cable as its cards find it before anybody gives them an address.
HERE, THERE = ("eth0", "169.254.0.1/16"), ("eth0", "169.254.0.2/16")

# In place of what this machine lacks; docs/dev/recipe_tests.md lists them.
STAND_INS = {
    "sudo": 'exec "$@"',
    "git": 'test "$1" = clone',
    # The build of the vendor's SDK: its example's place is taken by one on the vendor's compiled library.
    "cmake": f"""case $1 in
-S) exit;;
--build) mkdir -p "$2/bin" && printf '#!/bin/sh\\nexec {sys.executable} {{}}\\n' > "$2/bin/go2_stand_example" &&
  chmod +x "$2/bin/go2_stand_example";;
esac""".format(ROOT / "tests/conformance/programs/go2_stand_cpp.py"),
    "ros2": f'exec {sys.executable} {ROOT / "tests/system/ros2_stand_in.py"} "$@"',
}


@pytest.fixture
def folder(tmp_path):
    """A clone to work in: what is in ours, without writing to it."""
    clone = tmp_path / "understudy"
    clone.mkdir()
    for entry in ROOT.iterdir():
        (clone / entry.name).symlink_to(entry)
    return clone


@pytest.fixture
def environment(tmp_path):
    """A user's, with understudy, the SDK's Python and the stand-ins on the PATH."""
    programs = tmp_path / "bin"
    programs.mkdir()
    for name, does in STAND_INS.items():
        (programs / name).write_text(f"#!/bin/sh\n{does}\n")
        (programs / name).chmod(0o755)
    path = [programs, pathlib.Path(os.environ["UNDERSTUDY"]).parent, pathlib.Path(sys.executable).parent]
    state = tmp_path / "state"  # where the logs of robots in the background are
    return {**os.environ, "PATH": os.pathsep.join([*map(str, path), os.environ["PATH"]]), "XDG_STATE_HOME": str(state)}


@pytest.fixture
def gamepad(runtime_dir):
    """One that is plugged in and known to SDL, before anybody looks."""
    one = Gamepad(runtime_dir)
    one.plug()
    listed = understudy("remote", "--list-gamepads", env=one.environment).stdout
    guid = re.search(r"guid ([0-9a-f]{32})", listed)[1]
    one.close()
    (runtime_dir / "gamepad").unlink()
    one = Gamepad(runtime_dir)
    one.plug()
    one.environment["SDL_GAMECONTROLLERCONFIG"] = mapping(guid)
    yield one
    one.close()


def press_start_and_push(gamepad):
    def status():
        return json.loads(understudy("ctl", "status", "--json").stdout)

    gamepad.plug()  # the first to look at it was --list-gamepads
    eventually(lambda: status()["remote"]["there"], what="the gamepad is the remote")
    gamepad.press("start")
    eventually(lambda: status()["remote"]["keys"] == "START", what="the robot reads the key")
    gamepad.release("start")
    gamepad.move("lefty", LEAST)
    eventually(lambda: status()["motion"]["name"] == "walking", what="it walks")


def play(text, terminals, by_hand):
    """Types the blocks of a recipe, in their order."""
    for language, block, run in blocks(text):
        assert language == "console" or not run, f"a block of {language}: nothing runs it"
        for line in session(block) if run else []:
            if line.command.startswith("# "):
                by_hand[line.command[2:]]()
            else:
                terminals[line.terminal].type(line)


@pytest.mark.parametrize("recipe", [recipe for recipe in RECIPES if recipe != WITH_THE_PACKAGE])
def test_a_recipe_goes_as_it_is_written(recipe, folder, environment, request):
    with contextlib.ExitStack() as stack:
        by_hand, fronts = {}, {"": []}
        if "gamepad" in recipe:
            gamepad = request.getfixturevalue("gamepad")
            by_hand["press Start, then push the left stick forward"] = lambda: press_start_and_push(gamepad)
            for name in ("LD_PRELOAD", "UNDERSTUDY_VIRTUAL_GAMEPAD", "SDL_GAMECONTROLLERCONFIG",
                         "SDL_GAMECONTROLLER_IGNORE_DEVICES_EXCEPT"):
                environment[name] = gamepad.environment[name]
        if "jetson$" in RECIPES[recipe]:
            there = stack.enter_context(host_on_a_cable(HERE, THERE))
            for front in ([], there):
                subprocess.run([*front, "ip", "address", "flush", "dev", "eth0"], check=True)
            fronts["jetson"] = there
        terminals = {}
        for name, front in fronts.items():
            terminals[name] = Terminal(folder, environment, front)
            stack.callback(terminals[name].close)
        stack.callback(subprocess.run, [os.environ["UNDERSTUDY"], "ctl", "stop"], capture_output=True)
        play(RECIPES[recipe], terminals, by_hand)


def test_every_recipe_is_reached_from_the_top_of_the_page():
    top = PAGES[0].read_text().split("\n## ")[0]

    def anchor(heading):
        return re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-")

    linked = re.findall(r"\((?:deploying\.md)?#([\w-]+)\)", top)
    assert linked == [anchor(heading) for heading in RECIPES]
