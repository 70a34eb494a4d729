"""The Debian package on a Debian that has nothing else: installed, used, upgraded, purged. In the order of the tests."""

import glob
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import pytest

import recipes
from debian import Debian, Network, eventually

ROOT = pathlib.Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
PACKAGE = pathlib.Path(os.environ["UNDERSTUDY_PACKAGE"]).absolute()
ANOTHER_ROBOT = "6"
HEARS = """
from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowState_
import sys
ChannelFactoryInitialize(0, sys.argv[1])
states = ChannelSubscriber("rt/lowstate", LowState_)
states.Init()
print(states.Read(30).tick)
"""


@pytest.fixture(scope="module", name="debian")
def debian_fixture():
    folder = tempfile.mkdtemp(prefix="understudy-debian-")
    # In RAM: it is made, and gone again, in half the time.
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2g,mode=755", "tmpfs", folder], check=True)
    try:
        yield Debian(folder)
    finally:
        subprocess.run(["umount", folder], check=True)
        os.rmdir(folder)


@pytest.fixture(name="network")
def network_fixture():
    network = Network()
    yield network
    network.close()


def ours(debian):
    """Every file and folder of ours."""
    found = debian.must("find", "/", "-xdev", "(", "-path", "/proc", "-o", "-path", "/dev", ")", "-prune", "-o",
                        "-iname", "*understudy*", "-print")
    return sorted(found.split())


def step_in_container(debian, instruction, text, where):
    """Does in the chroot what a line of a Containerfile does in a container; `where` is the user and folder so far."""
    if instruction == "COPY":
        source, target = text.split()
        for file in glob.glob(str(PACKAGE.parent / source)):
            shutil.copy(file, debian.path(target))
    elif instruction == "RUN":
        debian.must("sh", "-ec", text, **where)
    elif instruction == "USER":
        where["user"] = text
    elif instruction == "WORKDIR":
        where["cwd"] = text
    elif instruction not in ("FROM", "ADD"):  # those have the Debian that is there
        return {instruction: json.loads(text)}
    return {}


@pytest.fixture(scope="module", name="image")
def image_fixture(debian):
    """The image that the Containerfile makes: {"where": user and folder, "ENTRYPOINT": words, "CMD": words}."""
    where, image = {"user": "root", "cwd": "/"}, {}
    for instruction, text in recipes.containerfile(EXAMPLES / "container" / "Containerfile"):
        image.update(step_in_container(debian, instruction, text, where))
    return {**image, "where": where}


def test_lintian_finds_nothing_to_say(tmp_path):
    done = subprocess.run(["lintian", "--pedantic", "--display-info", "--allow-root", PACKAGE], capture_output=True,
                          text=True, cwd=tmp_path)

    found = [line for line in done.stdout.splitlines() if not line.startswith("N:")]
    assert [line for line in found if line[0] in "EW"] == [], done.stdout + done.stderr
    assert done.returncode == 0


def test_the_image_plays_a_go2(debian, image, network):
    done = debian.run(*image["ENTRYPOINT"], *image["CMD"], "--duration", "1", network=network, **image["where"])

    assert image["where"]["user"] != "root"
    assert done.returncode == 0, done.stderr
    assert "go2 is on lo, domain 0" in done.stderr


def test_a_program_beside_the_robots_container_hears_it(debian, image, network):
    compose = recipes.yaml(EXAMPLES / "container" / "compose.yaml")["services"]
    robot, program = compose["robot"], compose["program"]
    assert program["network_mode"] == "service:robot"
    health = robot["healthcheck"]["test"]
    assert health[0] == "CMD"

    with debian.start(*image["ENTRYPOINT"], *robot["command"], network=network, **image["where"]):
        eventually(lambda: debian.run(*health[1:], network=network, **image["where"]).returncode == 0, "healthy")
        python, _, *arguments = program["command"]
        assert python == "python3"
        heard = subprocess.run([*network.enter, sys.executable, "-c", HEARS, *arguments], capture_output=True,
                               text=True, timeout=120)

    assert heard.returncode == 0, heard.stderr
    assert int(heard.stdout) > 0


def test_the_devcontainer_is_the_program_of_the_compose_file():
    container = json.loads((EXAMPLES / "container" / "devcontainer.json").read_text())
    compose = recipes.yaml(EXAMPLES / "container" / container["dockerComposeFile"])["services"]

    program = compose[container["service"]]
    assert program["network_mode"] == "service:robot"
    assert container["workspaceFolder"] in [volume.split(":")[1] for volume in program["volumes"]]


def test_layouts_for_viewers_are_installed(debian, image):
    installed = set(debian.must("dpkg", "-L", "understudy").split())
    for layout in sorted((EXAMPLES / "layouts").iterdir()):
        assert f"/usr/share/understudy/examples/layouts/{layout.name}" in installed


def test_completions_lie_where_shells_look_and_manual_pages_where_man_does(debian, image):
    installed = set(debian.must("dpkg", "-L", "understudy").split())
    commands = debian.must("understudy", "complete", "--", "").split()

    assert "run" in commands
    for command in ["understudy", *(f"understudy-{command}" for command in commands)]:
        assert f"/usr/share/man/man1/{command}.1.gz" in installed
    for shell, file in (("bash", "/usr/share/bash-completion/completions/understudy"),
                        ("zsh", "/usr/share/zsh/vendor-completions/_understudy"),
                        ("fish", "/usr/share/fish/vendor_completions.d/understudy.fish")):
        assert debian.path(file).read_text() == debian.must("understudy", "completions", shell)


@pytest.mark.parametrize("program", ["understudy-view", "understudy-remote"])
def test_the_programs_beside_it_start(debian, image, program):
    command = {"understudy-view": "view", "understudy-remote": "remote"}[program]

    # Their libraries are there, or the loader says which is not.
    assert "Usage" in debian.must(f"/usr/libexec/understudy/{program}", command, "--help")


SYSTEM = "lib/systemd/system/understudy@.service"
USER = "usr/lib/systemd/user/understudy@.service"


@pytest.mark.parametrize(("file", "options"), [(SYSTEM, []), (USER, ["--user"])])
def test_systemd_understands_the_unit(debian, image, tmp_path, file, options):
    instance = tmp_path / "understudy@go2.service"
    # Where the program is, is another matter here; whether there is one was seen above.
    text = debian.path(file).read_text().replace("/usr/bin/understudy", os.environ["UNDERSTUDY"])
    instance.write_text(text)

    done = subprocess.run(["systemd-analyze", "verify", "--man=no", *options, instance], capture_output=True, text=True,
                          env={**os.environ, "XDG_RUNTIME_DIR": str(tmp_path)})

    assert done.returncode == 0, done.stderr
    assert done.stderr == ""


@pytest.mark.parametrize("file", [SYSTEM, USER])
def test_a_unit_is_not_started_again_where_another_robot_is(debian, image, network, file):
    service = recipes.unit(debian.path(file), "go2")
    options = {"UNDERSTUDY_OPTIONS": "--duration 60"}
    env = {**recipes.environment(service, debian.folder), **options, "UNDERSTUDY_RUNTIME_DIR": "/tmp/robots"}
    words = recipes.command(service, env)
    other = {**env, "UNDERSTUDY_RUNTIME_DIR": "/tmp/others"}
    with debian.start(*words, network=network, env=env):
        eventually(lambda: debian.run("understudy", "ctl", "--name", "go2", "wait", "--timeout", 2, network=network,
                                      env=env).returncode == 0, "a robot")
        second = debian.run(*words, network=network, env=other)
        same_name = debian.run(*words, network=network, env=env)

    assert service["Restart"] == ["on-failure"]
    assert str(second.returncode) == ANOTHER_ROBOT, second.stderr
    assert {str(second.returncode), str(same_name.returncode)} <= set(service["RestartPreventExitStatus"][0].split())


def test_a_unit_takes_its_options_from_the_files_it_names(debian, image, network):
    service = recipes.unit(debian.path(SYSTEM), "go2")
    assert service["EnvironmentFile"] == ["-/etc/default/understudy", "-/etc/default/understudy-go2"]
    shipped = recipes.environment(service, debian.folder)
    assert recipes.command(service, shipped) == ["/usr/bin/understudy", "run", "go2", "--name", "go2"]
    own = debian.path("/etc/default/understudy-go2")
    own.write_text('UNDERSTUDY_OPTIONS="--start standing --released"\n')

    env = recipes.environment(service, debian.folder)
    folder = env["UNDERSTUDY_RUNTIME_DIR"]  # as RuntimeDirectory= makes it
    assert folder == f"/run/{service['RuntimeDirectory'][0]}" and service["RuntimeDirectoryMode"] == ["0700"]
    debian.must("install", "-d", "-m", "700", "-o", "nobody", folder)
    asks = ["understudy", "ctl", "--socket", f"{folder}/go2.sock"]  # root, as docs/install.md has it
    with debian.start(*recipes.command(service, env), network=network, env=env, user="nobody"):
        eventually(lambda: debian.run(*asks, "wait", "--timeout", 2, network=network).returncode == 0, "a robot")
        printed = json.loads(debian.must(*asks, "status", "--json", network=network))
    own.unlink()
    shutil.rmtree(debian.path(folder))

    assert printed["robot"] == "go2"
    assert printed["commands"]["state"] == "start"  # released: no motion service is on


def test_systemd_starts_a_robot_again_but_none_where_another_is(debian, image, network):
    with debian.boot(network) as run:
        def shows(unit, **expected):
            shown = run("systemctl", "show", unit).stdout.splitlines()
            return all(f"{key}={value}" in shown for key, value in expected.items())

        def answers():
            return run("understudy", "ctl", "--socket", "/run/understudy-go2/go2.sock", "wait", "--timeout", 2)

        started = run("systemctl", "start", "understudy@go2")
        assert started.returncode == 0, started.stderr
        eventually(lambda: answers().returncode == 0, "a robot")

        run("systemctl", "start", "understudy@g1")
        eventually(lambda: shows("understudy@g1", ActiveState="failed"), "the other gives up")
        assert shows("understudy@g1", ExecMainStatus=ANOTHER_ROBOT, NRestarts=0)

        run("systemctl", "kill", "--signal=KILL", "understudy@go2")
        eventually(lambda: shows("understudy@go2", ActiveState="active", NRestarts=1), "a new start")
        eventually(lambda: answers().returncode == 0, "a robot again")
        status = run("sh", "-c", "cat /proc/$(systemctl show -p MainPID --value understudy@go2)/status").stdout
        run("systemctl", "stop", "understudy@go2")
        assert shows("understudy@go2", ActiveState="inactive", Result="success")
    uid, capabilities = re.search(r"Uid:\s+(\d+)", status)[1], re.search(r"CapEff:\s+(\w+)", status)[1]

    assert int(uid) != 0
    assert int(capabilities, 16) == 0


def test_an_upgrade_keeps_the_options_that_were_set(debian, image, tmp_path):
    options = debian.path("/etc/default/understudy")
    mine = options.read_text().replace('UNDERSTUDY_OPTIONS=""', 'UNDERSTUDY_OPTIONS="--seed 7"')
    options.write_text(mine)
    unpacked = tmp_path / "unpacked"
    subprocess.run(["dpkg-deb", "--raw-extract", PACKAGE, unpacked], check=True)
    control = unpacked / "DEBIAN" / "control"
    control.write_text(re.sub(r"(?m)^Version: .*", "Version: 99-0", control.read_text()))
    default = unpacked / "etc" / "default" / "understudy"
    default.write_text(default.read_text() + "# Of the new version.\n")
    subprocess.run(["dpkg-deb", "--build", "-Znone", unpacked, debian.path("/tmp/new.deb")], check=True,
                   stdout=subprocess.DEVNULL)

    debian.must("dpkg", "--install", "--force-confdef", "--force-confold", "/tmp/new.deb")
    debian.path("/tmp/new.deb").unlink()

    assert debian.must("dpkg-query", "-W", "-f", "${Version} ${Status}", "understudy") == "99-0 install ok installed"
    assert options.read_text() == mine
    assert debian.must("understudy", "--version").startswith("understudy ")


def test_a_purge_leaves_nothing(debian, image):
    enabled = debian.path("/etc/systemd/system/multi-user.target.wants/understudy@go2.service")
    enabled.parent.mkdir(parents=True, exist_ok=True)
    enabled.symlink_to("/lib/systemd/system/understudy@.service")
    debian.must("dpkg", "--remove", "understudy")
    assert "/etc/default/understudy" in ours(debian)

    debian.must("dpkg", "--purge", "understudy")

    # A purge leaves the homes of users alone: the logs and the panel's address of their runs are theirs.
    left = [path for path in ours(debian) if not path.startswith(("/tmp/", "/root/.local/state/"))]
    assert left == []
    assert debian.run("understudy", "--version").returncode == 127


def test_the_steps_of_the_workflow_work(debian, network):
    job = recipes.yaml(EXAMPLES / "ci" / "understudy.yml")["jobs"]["rehearse"]
    workspace = debian.path("/srv/workspace")
    workspace.mkdir()
    shutil.copy(PACKAGE, workspace)

    steps = [step["run"] for step in job["steps"] if "run" in step]
    assert len(steps) == 3
    for step in steps:
        debian.must("bash", "-e", "-c", step, cwd="/srv/workspace", env=job["env"])

    [artifacts] = [step["with"]["path"] for step in job["steps"] if step.get("uses", "").startswith("actions/upload")]
    assert (workspace / artifacts / "stand_up" / "junit.xml").exists()
    assert (workspace / artifacts / "program.mcap").stat().st_size > 0
