"""A new Debian in a folder, as this machine's apt fetches it, and networks for what runs in it. Needs root."""

import contextlib
import os
import pathlib
import re
import shlex
import signal
import subprocess
import time

PATIENCE = 300.0  # s
ENVIRONMENT = {"PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root",
               "LANG": "C.UTF-8", "DEBIAN_FRONTEND": "noninteractive"}

# Processes of their own, which end with the first, and what programs expect to be mounted.
ENTER = """
mount -t proc proc "$0/proc"
mount --bind /dev "$0/dev"
exec chroot --userspec="$1" "$0" env --chdir="$2" "${@:3}"
"""

# systemd as the first process, as in a container: what it could change of this machine is read-only or its own.
BOOT = """
cd "$0"
mount --bind dev dev
mount -t proc proc proc
mount --bind proc/sys proc/sys
mount -o remount,bind,ro proc/sys
mount -t sysfs -o ro sysfs sys
if [ "$(stat -f -c %T /sys/fs/cgroup)" = cgroup2fs ]; then
  mount -t cgroup2 cgroup2 sys/fs/cgroup
else
  mount -t tmpfs -o mode=755 tmpfs sys/fs/cgroup
  mkdir sys/fs/cgroup/systemd sys/fs/cgroup/unified
  mount -t cgroup -o none,name=systemd cgroup sys/fs/cgroup/systemd
  mount -t cgroup2 cgroup2 sys/fs/cgroup/unified
fi
mount -t tmpfs -o mode=755 tmpfs run
pivot_root . mnt
umount -l mnt
exec chroot . env -i container=test PATH="$PATH" /lib/systemd/systemd --unit=basic.target --log-target=null --show-status=no
"""


def apt_sources():
    folder = pathlib.Path("/etc/apt/sources.list.d")
    single = pathlib.Path("/etc/apt/sources.list")
    return [*([single] if single.exists() else []), *sorted(folder.glob("*.list")), *sorted(folder.glob("*.sources"))]


def apt_options():
    """How this machine's apt fetches: through which proxy, with which checks."""
    dump = subprocess.run(["apt-config", "dump", "Acquire"], capture_output=True, text=True, check=True).stdout
    return re.findall(r'^Acquire::[\w:-]+ "[^"]+";$', dump, re.MULTILINE)


def suite():
    release = dict(line.split("=", 1) for line in pathlib.Path("/etc/os-release").read_text().splitlines() if "=" in line)
    return shlex.split(release["VERSION_CODENAME"])[0]


class Network:
    """A network with nothing but lo."""

    def __init__(self):
        self._holder = subprocess.Popen(["unshare", "--net", "sh", "-c", "ip link set lo up && echo && exec cat"],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        assert self._holder.stdout.readline(), "no network of our own"
        self.enter = ["nsenter", f"--target={self._holder.pid}", "--net"]

    def close(self):
        self._holder.stdin.close()
        self._holder.wait()
        self._holder.stdout.close()


class Debian:
    """The least Debian with apt, and systemd, in a folder."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        options = [f"--aptopt={option}" for option in apt_options()]
        subprocess.run(["mmdebstrap", "--mode=root", "--variant=apt", "--format=directory", "--quiet",
                        "--include=systemd",
                        "--dpkgopt=force-unsafe-io", *options, suite(), self.folder, *apt_sources()],
                       check=True, timeout=PATIENCE)
        for name in ("resolv.conf", "hosts"):  # as containers have them
            with contextlib.suppress(FileNotFoundError):
                (self.folder / "etc" / name).write_bytes(pathlib.Path("/etc", name).read_bytes())

    def command(self, *words, user="root", cwd="/", network=None):
        return [*(network.enter if network else []), "unshare", "--mount", "--pid", "--fork", "--kill-child",
                "bash", "-ec", ENTER, self.folder, user, cwd, *map(str, words)]

    def run(self, *words, network=None, env=(), **where):
        """Runs the words to their end; the machine's network is there if no other is named."""
        return subprocess.run(self.command(*words, network=network, **where), capture_output=True, text=True,
                              timeout=PATIENCE, env={**ENVIRONMENT, **dict(env)})

    def must(self, *words, **how):
        """The same, which must succeed; gives its output."""
        done = self.run(*words, **how)
        assert done.returncode == 0, f"{words}: {done.returncode}\n{done.stdout}\n{done.stderr}"
        return done.stdout

    @contextlib.contextmanager
    def start(self, *words, network, env=(), **where):
        """Runs the words in the background until the end of the block."""
        process = subprocess.Popen(self.command(*words, network=network, **where), start_new_session=True,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                   env={**ENVIRONMENT, **dict(env)})
        try:
            yield process
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGTERM)
            try:
                process.communicate(timeout=10)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.communicate()

    @contextlib.contextmanager
    def boot(self, network):
        """Boots it with systemd, until the end of the block; gives run() of what then runs in it, as `run` above."""
        (self.folder / "etc" / "machine-id").touch()
        init = subprocess.Popen([*network.enter, "unshare", "--mount", "--pid", "--uts", "--ipc", "--cgroup", "--fork",
                                 "--kill-child", "bash", "-ec", BOOT, self.folder], env=ENVIRONMENT)

        children = pathlib.Path(f"/proc/{init.pid}/task/{init.pid}/children")

        def run(*words):
            return subprocess.run(["nsenter", f"--target={children.read_text().strip()}", "--all", "--root", "--wd", *map(str, words)],
                                  capture_output=True, text=True, timeout=PATIENCE, env=ENVIRONMENT)

        try:
            eventually(children.read_text, "a first process")
            eventually(lambda: run("systemctl", "is-active", "basic.target").stdout == "active\n", "systemd")
            yield run
        finally:
            init.kill()
            init.wait()

    def path(self, inside):
        return self.folder / str(inside).lstrip("/")


def eventually(condition, what, seconds=60.0):
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"not within {seconds:.0f} s: {what}"
        time.sleep(0.1)
