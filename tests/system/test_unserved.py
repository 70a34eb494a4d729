"""A topic that a program waits for and nobody serves is named where one looks: log, status, panel, doctor."""

import json
import re
import urllib.request

from peers import GoLowCmd, listener
from robots import eventually

TOPIC, REMEDY = "rt/dex1/left/state", "understudy run g1 --hands dex1"


def test_a_topic_that_nobody_here_writes_is_named_once_in_log_status_panel_and_doctor(play, understudy):
    robot = play("g1")
    page = json.loads(robot.ctl("panel", "--json"))["url"].split("/#")[0]

    def in_the_panel():
        with urllib.request.urlopen(f"{page}/bus", timeout=10) as reply:
            return "".join(one["unserved"] for one in json.load(reply)["topics"] if one["topic"] == TOPIC)

    with listener(TOPIC, GoLowCmd):  # of any type: nobody writes it
        robot.heard(TOPIC)
        eventually(lambda: TOPIC in robot.ctl("status"), what="in the status")
        eventually(lambda: REMEDY in in_the_panel(), what="in the panel")
        told = json.loads(understudy("doctor", "--robots", 1, "--json").stdout)["checks"]
        served, = (check for check in told if check["name"] == "served")
        assert served["verdict"] == "warning"
        assert REMEDY in served["finding"]
        assert re.findall(r"(rt/\S+): process", served["finding"]) == [TOPIC]  # and nothing of the robot itself

    line, = (one["message"] for one in robot.log() if TOPIC in one["message"])
    assert REMEDY in line
