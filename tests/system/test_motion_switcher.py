"""The service that hands the motors over, asked by the vendor's Python client."""

import json
import threading

import pytest
from unitree_sdk2py.comm.motion_switcher.motion_switcher_api import (
    MOTION_SWITCHER_API_VERSION,
)
from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient

from peers import GoLowCmd, go_command, join, speaker

SET_SILENT, GET_SILENT = 1004, 1005  # not in the Python client; numbers of the C++ SDK's
UNKNOWN_API = 1999
BAD_PARAMETER, UNKNOWN_NAME = 7001, 7004
API_NOT_IMPLEMENTED = 3203


def new_client():
    join(0)
    client = MotionSwitcherClient()
    client.SetTimeout(5.0)
    client.Init()
    for api in (SET_SILENT, GET_SILENT, UNKNOWN_API):
        client._RegistApi(api, 0)
    return client


@pytest.fixture(scope="module")
def client():
    return new_client()


@pytest.fixture(autouse=True)
def robot(play):
    return play("go2")


def test_the_robots_own_motion_service_holds_the_motors(client):
    assert client.CheckMode() == (0, {"form": "0", "name": "mcf"})


def test_released_nothing_holds_them_and_lowcmd_is_followed(client, robot):
    assert client.ReleaseMode()[0] == 0
    assert client.CheckMode()[1]["name"] == ""
    with speaker("rt/lowcmd", GoLowCmd) as commander:
        commander.write_for(0.3, go_command())
        assert robot.becomes(lambda now: now["commands"]["accepted"])
    assert client.ReleaseMode()[0] == 0


def test_a_selected_service_takes_the_motors_back(client, robot):
    client.ReleaseMode()
    assert client.SelectMode("mcf")[0] == 0
    assert client.CheckMode()[1]["name"] == "mcf"
    with speaker("rt/lowcmd", GoLowCmd) as commander:
        commander.write_for(0.3, go_command())
        status = robot.becomes(lambda now: now["commands"]["refused"]["motion_service"])
    assert status["commands"]["accepted"] == 0


def test_services_of_another_firmware_are_unknown(client, robot):
    assert client.SelectMode("ai")[0] == UNKNOWN_NAME


def test_an_unknown_motion_service_is_refused_as_unknown(client):
    assert client.SelectMode("nonsense")[0] == UNKNOWN_NAME


@pytest.mark.parametrize("parameter", ["", "{}", '{"name": 1}', "[]", "null", '"ai"', "{"])
def test_a_selection_without_a_name_is_a_bad_parameter(client, parameter):
    assert client._Call(1002, parameter)[0] == BAD_PARAMETER


def test_silence_is_remembered(client):
    for silent in (True, False):
        assert client._Call(SET_SILENT, json.dumps({"silent": silent}))[0] == 0
        code, data = client._Call(GET_SILENT, "{}")
        assert code == 0
        assert json.loads(data) == {"silent": silent}


@pytest.mark.parametrize("parameter", ["", "{}", '{"silent": 1}', "[]"])
def test_a_silence_that_is_not_a_truth_value_is_a_bad_parameter(client, parameter):
    assert client._Call(SET_SILENT, parameter)[0] == BAD_PARAMETER


def test_the_server_has_the_clients_api_version(client):
    assert client.GetServerApiVersion() == (0, MOTION_SWITCHER_API_VERSION)


def test_an_unknown_call_is_answered_as_not_implemented(client):
    assert client._Call(UNKNOWN_API, "{}")[0] == API_NOT_IMPLEMENTED


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

    assert answers == {"check": [0] * 50, "select": [UNKNOWN_NAME] * 50}
