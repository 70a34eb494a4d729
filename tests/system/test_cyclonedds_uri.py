"""CYCLONEDDS_URI in the forms that users have it in: their programs hear the robot, which goes by its own configuration."""

import os
import subprocess
import sys

import pytest

CARD = '<Interfaces><NetworkInterface name="{card}" priority="default" multicast="default"/></Interfaces>'

# The first one is unitree_ros2's; that without multicast is of ros_team_workspace.
FORMS = {
    "by name": f"<CycloneDDS><Domain><General>{CARD}</General></Domain></CycloneDDS>",
    "for a domain": f'<CycloneDDS><Domain Id="any"><General>{CARD}</General></Domain></CycloneDDS>',
    "fragment": f"<General>{CARD}</General>",
    "comma list": f"<General>{CARD}</General>,<Discovery><ParticipantIndex>auto</ParticipantIndex></Discovery>",
    "file": f"<CycloneDDS><Domain><General>{CARD}</General></Domain></CycloneDDS>",
    "old name": "<CycloneDDS><Domain><General><NetworkInterfaceAddress>{card}</NetworkInterfaceAddress></General></Domain>"
                "</CycloneDDS>",
    "by address": '<General><Interfaces><NetworkInterface address="{address}"/></Interfaces></General>',
    "only spdp": f"<General>{CARD}<AllowMulticast>spdp</AllowMulticast></General>",
    "big messages": f"<General>{CARD}<MaxMessageSize>65500B</MaxMessageSize></General>"
                    "<Internal><Watermarks><WhcHigh>500kB</WhcHigh></Watermarks></Internal>",
    "peers": f"<General>{CARD}<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto"
             '</ParticipantIndex><Peers><Peer address="{robot}"/></Peers></Discovery>',
}

# Waits for a state, without a word to Cyclone but the variable.
READS = """
import sys, time
from cyclonedds.domain import DomainParticipant
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from unitree_sdk2py.idl.unitree_go.msg.dds_ import LowState_

participant = DomainParticipant(0)
reader = DataReader(participant, Topic(participant, "rt/lowstate", LowState_))
deadline = time.monotonic() + 20
while not reader.take():
    assert time.monotonic() < deadline, "no state came"
    time.sleep(0.02)
"""


def uri(form, card, address, robot, folder):
    text = FORMS[form].format(card=card, address=address, robot=robot)
    if form != "file":
        return text
    file = folder / "cyclonedds.xml"
    file.write_text(text)
    return f"file://{file}"


def hears(command, text):
    done = subprocess.run([*command, sys.executable, "-c", READS], env={**os.environ, "CYCLONEDDS_URI": text},
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, f"{text}\n{done.stdout}\n{done.stderr}"


@pytest.mark.parametrize("form", FORMS)
def test_it_hears_a_robot_of_exec(form, tmp_path):
    hears([os.environ["UNDERSTUDY"], "exec", "go2", "--"], uri(form, "lo", "127.0.0.1", "localhost", tmp_path))


@pytest.mark.parametrize("form", FORMS)
def test_it_hears_a_robot_on_a_cable(form, tmp_path):
    hears([os.environ["UNDERSTUDY"], "exec", "go2", "--interface-name", "eth0", "--"],
          uri(form, "eth0", "192.168.123.99", "192.168.123.161", tmp_path))


def test_all_of_them_hear_a_robot_of_run(play, tmp_path):
    play("go2")
    for form in FORMS:
        hears([], uri(form, "lo", "127.0.0.1", "localhost", tmp_path))
