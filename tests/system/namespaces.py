"""Network namespaces for the tests: the session's own, and a second host on a cable."""

import contextlib
import ctypes
import json
import os
import pathlib
import signal
import subprocess
import sys

CLONE_NEWUSER = 0x10000000
CLONE_NEWNET = 0x40000000


def unshare(flags):
    """unshare(2); raises OSError."""
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.unshare(flags) != 0:
        error = ctypes.get_errno()
        raise OSError(error, f"no network namespace for the tests: {os.strerror(error)}")


def enter_private_network():
    """Moves this process into a network of its own, with a lo that has multicast as `exec`'s has."""
    uid, gid = os.getuid(), os.getgid()
    try:
        unshare(CLONE_NEWNET)
    except PermissionError:
        unshare(CLONE_NEWUSER | CLONE_NEWNET)
        pathlib.Path("/proc/self/setgroups").write_text("deny")
        pathlib.Path("/proc/self/uid_map").write_text(f"0 {uid} 1")
        pathlib.Path("/proc/self/gid_map").write_text(f"0 {gid} 1")
    raise_loopback()


def ip(*arguments):
    """ip(8) in this network, or a failed test that shows what it said."""
    done = subprocess.run(["ip", *arguments], capture_output=True, text=True, timeout=10)
    assert done.returncode == 0, f"ip {' '.join(arguments)}: {done.stderr}"
    return done.stdout


def raise_loopback():
    ip("link", "set", "lo", "up", "multicast", "on")
    ip("route", "add", "224.0.0.0/4", "dev", "lo")


@contextlib.contextmanager
def cable(ours, theirs):
    """Two interfaces of this network joined by a cable: (name, address) each; gone afterwards."""
    ip("link", "add", ours[0], "type", "veth", "peer", "name", theirs[0])
    try:
        for name, address in (ours, theirs):
            ip("address", "add", address, "dev", name)
            ip("link", "set", name, "up")
        yield
    finally:
        ip("link", "delete", ours[0])


@contextlib.contextmanager
def host_on_a_cable(ours, theirs):
    """A second host. `ours` and `theirs` are (interface, address) of either end of the cable.

    Gives the command that runs another command there: a list to be put in front.
    """
    keeper = subprocess.Popen(["unshare", "--net", "sh", "-c", "echo; exec sleep 600"],
                              stdout=subprocess.PIPE)
    try:
        keeper.stdout.readline()  # from here on it is in its own network
        there = ["nsenter", "--target", str(keeper.pid), "--net", "--"]
        ip("link", "add", ours[0], "type", "veth", "peer", "name", theirs[0], "netns",
           str(keeper.pid))
        try:
            ip("address", "add", ours[1], "dev", ours[0])
            ip("link", "set", ours[0], "up")
            for arguments in (["link", "set", "lo", "up"],
                              ["address", "add", theirs[1], "dev", theirs[0]],
                              ["link", "set", theirs[0], "up"]):
                subprocess.run([*there, "ip", *arguments], check=True, timeout=10)
            yield there
        finally:
            ip("link", "delete", ours[0])  # the network's own end would take it some time later
    finally:
        keeper.send_signal(signal.SIGKILL)  # its network goes with the last process in it
        keeper.wait()
        keeper.stdout.close()


@contextlib.contextmanager
def host_on_a_bad_cable(ours, theirs, **faults):
    """As host_on_a_cable, by way of cable_relay.py with these faults."""
    relay = pathlib.Path(__file__).with_name("cable_relay.py")
    with contextlib.ExitStack() as stack:
        def other_network(*command):
            process = stack.enter_context(
                subprocess.Popen(["unshare", "--net", "sh", "-c", 'echo; read -r go; exec "$@"', "sh", *command],
                                 stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True))
            stack.callback(process.kill)  # its network goes with the last process in it
            process.stdout.readline()  # from here on it is in its own network
            return process

        keeper = other_network("sleep", "600")
        middle = other_network(sys.executable, relay, "left", "right", json.dumps(faults))
        there = ["nsenter", "--target", str(keeper.pid), "--net", "--"]
        for name, end, network in ((ours[0], "left", []), (theirs[0], "right", there)):
            subprocess.run([*network, "ip", "link", "add", name, "type", "veth", "peer", "name", end, "netns",
                            str(middle.pid)], check=True, timeout=10)
        stack.callback(ip, "link", "delete", ours[0])
        middle.stdin.write("go\n")
        middle.stdin.flush()
        assert middle.stdout.readline() == "ready\n"
        for network, name, address in (([], *ours), (there, *theirs)):
            for arguments in (["link", "set", "lo", "up"], ["address", "add", address, "dev", name],
                              ["link", "set", name, "up"]):
                subprocess.run([*network, "ip", *arguments], check=True, timeout=10)
        yield there
