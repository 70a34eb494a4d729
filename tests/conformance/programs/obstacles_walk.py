"""Walks a Go2 ahead by the vendor's ObstaclesAvoidClient, with its switch on or off.

Writes one JSON object to a file: what SwitchGet says before and after SwitchSet, and the codes of SwitchSet and
UseRemoteCommandFromApi.
"""

import json
import pathlib
import time

from unitree_sdk2py.go2.obstacles_avoid.obstacles_avoid_client import ObstaclesAvoidClient

from sdk_session import arguments

SPEED = 0.6  # m/s
WALKS = 8.0  # s
EVERY = 0.2  # s


def main():
    parsed = arguments(__doc__.splitlines()[0],
                       lambda parser: (parser.add_argument("switch", choices=("on", "off")),
                                       parser.add_argument("report", type=pathlib.Path)))
    client = ObstaclesAvoidClient()
    client.SetTimeout(10.0)
    client.Init()
    report = {"at_first": client.SwitchGet()}
    report["codes"] = [client.SwitchSet(parsed.switch == "on"), client.UseRemoteCommandFromApi(True)]
    report["switched"] = client.SwitchGet()
    for _ in range(round(WALKS / EVERY)):
        client.Move(SPEED, 0.0, 0.0)
        time.sleep(EVERY)
    parsed.report.write_text(json.dumps(report))


if __name__ == "__main__":
    main()
