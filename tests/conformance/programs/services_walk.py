"""Calls every method of every client that the vendor's Python SDK has for a robot.

Each method is called once with good arguments and, where it takes any, once with bad ones: a text for
a number, a number for a text. Prints one JSON object: per client and method the codes of both calls
(null where the method returns none), who moved the motors, and what one client read back of what
another had set.
"""

import concurrent.futures
import importlib
import inspect
import json

from sdk_session import arguments

PCM = bytes(3200)  # 0.1 s of silence
CLIENTS = {
    "go2": {
        "sport": "go2.sport.sport_client.SportClient",
        "robot_state": "go2.robot_state.robot_state_client.RobotStateClient",
        "obstacles_avoid": "go2.obstacles_avoid.obstacles_avoid_client.ObstaclesAvoidClient",
        "vui": "go2.vui.vui_client.VuiClient",
        "videohub": "go2.video.video_client.VideoClient",
    },
    "b2": {
        "sport": "b2.sport.sport_client.SportClient",
        "vui": "b2.vui.vui_client.VuiClient",
        "front_videohub": "b2.front_video.front_video_client.FrontVideoClient",
        "back_videohub": "b2.back_video.back_video_client.BackVideoClient",
    },
    "g1": {
        "sport": "g1.loco.g1_loco_client.LocoClient",
        "arm": "g1.arm.g1_arm_action_client.G1ArmActionClient",
        "voice": "g1.audio.g1_audio_client.AudioClient",
    },
    "h1": {"loco": "h1.loco.h1_loco_client.LocoClient"},
}
SWITCHER = "comm.motion_switcher.motion_switcher_client.MotionSwitcherClient"
MOTION = ("sport", "loco", "arm")  # what the motion service serves, or only while it is on
# Passes a dict where the binding wants a text: the client raises.
BROKEN = {("robot_state", "SetReportFreq")}
GOOD = {
    ("robot_state", "ServiceSwitch"): ["vui_service", True],
    ("arm", "ExecuteAction"): [99],
    ("motion_switcher", "SelectMode"): ["dance"],
    ("sport", "SetTaskId"): [0],  # annotated as float, a whole number in the C++ SDK
}
BAD = {("robot_state", "ServiceSwitch"): [7, True]}  # it makes a number of the second itself
BY_TYPE = {int: (1, "one"), float: (0.1, "much"), bool: (True, "yes"), str: ("a", 7)}


def path_points(sport):
    return [sport.PathPoint(0.1 * i, 0, 0, 0, 0, 0, 0) for i in range(sport.SPORT_PATH_POINT_SIZE)]


def arguments_of(module, service, name, method):
    """Good arguments and bad ones."""
    good, bad = [], []
    for parameter in list(inspect.signature(method).parameters.values()):
        kind = str if parameter.annotation is parameter.empty else parameter.annotation
        if kind is list:
            good.append(path_points(module))
            bad.append([])
        elif kind is bytes:
            good.append(PCM)
            bad.append(bytes(100_000))
        else:
            good.append(BY_TYPE[kind][0])
            bad.append(BY_TYPE[kind][1])
    return GOOD.get((service, name), good), BAD.get((service, name), bad)


def call(method, given):
    """The code of a call; None where the method returns none; the text of what it raised."""
    try:
        result = method(*given)
    except Exception as error:  # what the vendor's client raises is part of the report
        return repr(error)
    return result[0] if isinstance(result, tuple) else result


def class_of(path):
    module, name = path.rsplit(".", 1)
    return getattr(importlib.import_module("unitree_sdk2py." + module), name)


def new_client(kind):
    client = kind()
    client.SetTimeout(3.0)
    client.Init()
    return client


def new_clients(paths):
    """One client of each. They wait long in their constructors: all at once but the first, in which
    the binding prepares its types, and only one thread may do that."""
    kinds = {service: class_of(path) for service, path in paths.items()}
    first, *others = kinds
    clients = {first: new_client(kinds[first])}
    with concurrent.futures.ThreadPoolExecutor(len(others)) as pool:
        made = pool.map(new_client, [kinds[service] for service in others])
        return {**clients, **dict(zip(others, made))}


def methods_of(client, service):
    for name, function in vars(type(client)).items():
        if inspect.isfunction(function) and not name.startswith("_") and name != "Init":
            if (service, name) not in BROKEN:
                yield name, getattr(client, name)


def walk(client, service):
    module = inspect.getmodule(type(client))
    report = {}
    for name, method in methods_of(client, service):
        good, bad = arguments_of(module, service, name, method)
        report[name] = {"good": call(method, good)}
        if bad:
            report[name]["bad"] = call(method, bad)
    return report


def main():
    parsed = arguments(__doc__.splitlines()[0],
                       lambda parser: parser.add_argument("robot", choices=sorted(CLIENTS)))
    clients = new_clients({**CLIENTS[parsed.robot], "motion_switcher": SWITCHER})
    report = {"robot": parsed.robot, "calls": {}}
    report["motion_service"] = clients["motion_switcher"].CheckMode()[1]["name"]
    for service, client in clients.items():
        if service in MOTION and not report["motion_service"]:
            client.SetTimeout(0.3)
            client._RegistApi(1, 0)
            report["calls"][service] = {"GetServerApiVersion": {"good": client._Call(1, "")[0]}}
        elif service != "motion_switcher":
            report["calls"][service] = walk(client, service)
    if "robot_state" in clients:
        states = clients["robot_state"].ServiceList()[1]
        report["services"] = {state.name: [state.status, state.protect] for state in states}
    if "vui" in clients:
        clients["vui"].SetVolume(3)
        report["volume_for_another"] = new_client(class_of(CLIENTS[parsed.robot]["vui"])).GetVolume()
    report["calls"]["motion_switcher"] = walk(clients["motion_switcher"], "motion_switcher")
    print(json.dumps(report))


if __name__ == "__main__":
    main()
