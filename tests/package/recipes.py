"""What the shipped recipes say: units of systemd, a Containerfile, YAML."""

import json
import re
import shlex
import subprocess


def yaml(file):
    """Debian's own Python reads YAML; the vendor's SDKs need another."""
    program = "import json, sys, yaml; json.dump(yaml.load(sys.stdin, yaml.BaseLoader), sys.stdout)"
    return json.loads(subprocess.run(["/usr/bin/python3", "-c", program], input=file.read_text(), check=True,
                                     capture_output=True, text=True).stdout)


def containerfile(file):
    """[(instruction, its text)], lines joined."""
    text = re.sub(r"^#.*\n", "", file.read_text(), flags=re.MULTILINE).replace("\\\n", " ")
    return [tuple(line.split(None, 1)) for line in text.splitlines() if line.strip()]


def unit(file, instance):
    """{key: [values]} of the [Service] of a template, for that instance."""
    service = {}
    section = file.read_text().split("[Service]")[1].split("\n[")[0].replace("%i", instance)
    for line in section.splitlines():
        if "=" in line and not line.startswith("#"):
            key, value = line.split("=", 1)
            service.setdefault(key, []).append(value)
    return service


def environment(service, root):
    """What systemd gives to it: Environment=, then the files there are."""
    given = {}
    for line in service["Environment"]:
        given.update(word.split("=", 1) for word in shlex.split(line))
    for name in service["EnvironmentFile"]:
        file = root / name.lstrip("-").lstrip("/")
        if file.exists():
            words = shlex.split(file.read_text(), comments=True)
            given.update(word.split("=", 1) for word in words)
    return given


def command(service, env):
    """ExecStart= as systemd splits it: $NAME alone becomes the words of its value."""
    words = []
    for word in shlex.split(service["ExecStart"][0]):
        words += env[word[1:]].split() if word.startswith("$") else [word]
    return words
