"""The robots that there are, as `understudy robots --json` lists them."""

import functools
import json
import os
import subprocess


@functools.cache
def fleet():
    """By name, what is listed of each robot."""
    done = subprocess.run([os.environ["UNDERSTUDY"], "robots", "--json"], check=True, capture_output=True, text=True)
    return {robot["name"]: robot for robot in json.loads(done.stdout)}


def quadrupeds():
    return [name for name, robot in fleet().items() if robot["kind"] in ("quadruped", "wheeled")]


def with_api(api):
    """Those whose computer has that table of docs/reference/services.md."""
    return [name for name, robot in fleet().items() if api in robot["apis"]]
