"""The recipe with containers of docs/recipes.md, in its own words: the image is built of Debian's packages, and run."""

import os
import pathlib
import shlex
import shutil
import subprocess

import pytest

from console import Terminal, blocks, sections, session
from debian import PATIENCE, apt_options

ROOT = pathlib.Path(__file__).parents[2]
RECIPE = sections((ROOT / "docs" / "recipes.md").read_text())["Docker"]

# The engine: builds the same image of the same file, and runs it in a network of its own, but without the rights that
# containers otherwise need.
DOCKER = """#!/bin/bash -e
exec < /dev/null
buildah() {{ command buildah --root {store} --runroot {store}-run --storage-driver vfs "$@"; }}
case $1 in
build)
  buildah build --isolation chroot "${{@:2}}";;
run)
  test "$2" = --rm
  container=$(buildah from --pull-never "$3")
  words=($(buildah inspect --format '{{{{range .OCIv1.Config.Entrypoint}}}}{{{{.}}}} {{{{end}}}}' "$container"))
  export -f buildah
  unshare --net bash -ec 'ip link set lo up && buildah run --isolation chroot "$0" -- "$@"' \\
    "$container" "${{words[@]}}" "${{@:4}}"
  buildah rm "$container" > /dev/null;;
clean)
  buildah rm --all && buildah rmi --all --force;;
esac
"""


@pytest.fixture(name="clone")
def clone_fixture(tmp_path):
    """What the recipe needs of a clone; there, the package has been made."""
    clone = tmp_path / "understudy"
    shutil.copytree(ROOT / "examples", clone / "examples")
    (clone / "tools").mkdir()
    package = shlex.quote(str(pathlib.Path(os.environ["UNDERSTUDY_PACKAGE"]).absolute()))
    (clone / "tools" / "package").write_text(f"#!/bin/sh -e\nmkdir -p build/release/package\ncp {package} build/release/package\n")
    (clone / "tools" / "package").chmod(0o755)
    return clone


@pytest.fixture(name="programs")
def programs_fixture(tmp_path):
    folder = tmp_path / "bin"
    folder.mkdir()
    options = shlex.join(f"--aptopt={option}" for option in apt_options())
    for name, text in (("docker", DOCKER.format(store=tmp_path / "store")),
                       ("mmdebstrap", f'#!/bin/sh\nexec {shutil.which("mmdebstrap")} {options} "$@"\n')):
        (folder / name).write_text(text)
        (folder / name).chmod(0o755)
    yield folder
    subprocess.run([folder / "docker", "clean"], check=True, capture_output=True)


def test_the_image_is_built_of_debians_packages_and_plays_as_the_page_says(clone, programs):
    environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}
    terminal = Terminal(clone, environment, patience=2 * PATIENCE)
    played = [block for language, block, run in blocks(RECIPE) if run]
    assert played
    try:
        for block in played:
            for line in session(block):
                terminal.type(line)
    finally:
        terminal.close()
