"""The service that hands the motors over, asked by the vendor's Python client."""

import threading

import pytest
from unitree_sdk2py.comm.motion_switcher.motion_switcher_api import (
    MOTION_SWITCHER_API_VERSION,
)
from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient

from peers import GoLowCmd, go_command, join, speaker

BUSY, UNKNOWN_NAME = 7002, 7004


def new_client():
    join(0)
    client = MotionSwitcherClient()
    client.SetTimeout(5.0)
    client.Init()
    return client


@pytest.fixture(scope="module")
def client():
    return new_client()


@pytest.fixture(autouse=True)
def robot(play):
    return play("go2")


def test_lowcmd_is_followed_from_release_until_a_service_of_this_firmware_is_selected(client, robot):
    assert client.CheckMode() == (0, {"form": "0", "name": "mcf"})
    assert client.ReleaseMode()[0] == 0
    assert client.CheckMode()[1]["name"] == ""
    with speaker("rt/lowcmd", GoLowCmd) as commander:
        commander.write_for(0.3, go_command())
        assert robot.becomes(lambda now: now["commands"]["accepted"])
        assert client.SelectMode("ai")[0] == UNKNOWN_NAME
        assert client.SelectMode("mcf")[0] == 0
        assert client.CheckMode()[1]["name"] == "mcf"
        accepted = robot.becomes(lambda now: now["motion"]["service"])["commands"]["accepted"]
        commander.write_for(0.3, go_command())
        status = robot.becomes(lambda now: now["commands"]["refused"]["motion_service"])
    assert status["commands"]["accepted"] == accepted


def test_the_server_has_the_clients_api_version(client):
    assert client.GetServerApiVersion() == (0, MOTION_SWITCHER_API_VERSION)


def test_two_clients_at_once_get_their_own_answers(client):
    answers = {}

    def ask(name, one, call):
        answers[name] = [call(one) for _ in range(50)]

    threads = [
        threading.Thread(target=ask, args=("check", client, lambda one: one.CheckMode()[0])),
        threading.Thread(target=ask, args=("select", new_client(),
                                           lambda one: one.SelectMode("nonsense")[0])),
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30)

    assert answers == {"check": [0] * 50, "select": [BUSY] * 50}, "mcf is on"
