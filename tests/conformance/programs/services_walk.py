"""Calls every method of every client that the vendor's Python SDK has for a robot.

Each method is called once with good arguments and, where it takes any, once with bad ones: a text for
a number, a number for a text. Motion is asked of a damped robot each time. Robots whose clients the
pinned SDK lacks are called by the api ids of its C++ headers. Prints one JSON object: per client and
method the codes of both calls (what the method returns, or was answered where it returns none), who
moved the motors, and what one client read back of what another had set.
"""

import concurrent.futures
import importlib
import inspect
import json
import time

from unitree_sdk2py.rpc.client import Client

from sdk_session import arguments

PCM = bytes(3200)  # 0.1 s of silence
# By table of docs/reference/services.md: its service, and the vendor's client of it.
CLIENTS = {
    "sport_go2": ("sport", "go2.sport.sport_client.SportClient"),
    "sport_go2w": ("sport", "go2.sport.sport_client.SportClient"),
    "sport_b2": ("sport", "b2.sport.sport_client.SportClient"),
    "sport_b2w": ("sport", "b2.sport.sport_client.SportClient"),
    "sport_g1": ("sport", "g1.loco.g1_loco_client.LocoClient"),
    "loco_h1": ("loco", "h1.loco.h1_loco_client.LocoClient"),
    "arm_g1": ("arm", "g1.arm.g1_arm_action_client.G1ArmActionClient"),
    "robot_state_go2": ("robot_state", "go2.robot_state.robot_state_client.RobotStateClient"),
    "obstacles_avoid": (
        "obstacles_avoid",
        "go2.obstacles_avoid.obstacles_avoid_client.ObstaclesAvoidClient",
    ),
    "vui": ("vui", "go2.vui.vui_client.VuiClient"),
    "voice": ("voice", "g1.audio.g1_audio_client.AudioClient"),
    "videohub": ("videohub", "go2.video.video_client.VideoClient"),
    "front_videohub": ("front_videohub", "b2.front_video.front_video_client.FrontVideoClient"),
    "back_videohub": ("back_videohub", "b2.back_video.back_video_client.BackVideoClient"),
}
SWITCHER = "comm.motion_switcher.motion_switcher_client.MotionSwitcherClient"
MOTION = ("sport", "loco", "arm")  # what the motion service serves, or only while it is on
NUMBER, TEXT = {"data": 1}, {"data": "one"}
VELOCITY = {"velocity": [0.1, 0.0, 0.0], "duration": 1.0}, {"velocity": "much", "duration": 1.0}
XYZ = {"x": 0.1, "y": 0.0, "z": 0.0}, {"x": "much", "y": 0.0, "z": 0.0}
FLAG = {"data": True}, TEXT
# Name: id, good parameter, bad parameter if it takes any; from the headers of unitree_sdk2. The
# pinned SDK has no client for these, or, of a B2's robot_state, one that cannot be imported.
B2_ROBOT_STATE = {
    "ServiceSwitch": (1001, {"name": "vui_service", "switch": 1}, {"name": 7, "switch": 1}),
    "SetReportFreq": (1002, {"interval": 1, "duration": 1}, {"interval": "much", "duration": 1}),
    "ServiceList": (1003, {}),
    "LowPowerSwitch": (1004, {"switch": 1}, {"switch": "yes"}),
    "LowPowerStatus": (1005, {}),
    "GetPkgVersion": (1006, {}),
}
R1_SPORT = {
    "GetFsmId": (7001, {}),
    "GetFsmMode": (7002, {}),
    "SetFsmId": (7101, NUMBER, TEXT),
    "SetVelocity": (7105, *VELOCITY),
    "SetArmTask": (7106, {"data": 0}, TEXT),
    "SetSpeedMode": (7107, NUMBER, TEXT),
}
A2_SPORT = {
    "Damp": (1001, {}),
    "BalanceStand": (1002, {}),
    "StopMove": (1003, {}),
    "StandUp": (1004, {}),
    "StandDown": (1005, {}),
    "RecoveryStand": (1006, {}),
    "Euler": (1007, *XYZ),
    "Move": (1008, *XYZ),
    "BodyPosition": (1009, *[{**xyz, "yaw": 0.0} for xyz in XYZ]),
    "SwitchGait": (1011, NUMBER, TEXT),
    "BodyHeight": (1013, NUMBER, TEXT),
    "SpeedLevel": (1015, NUMBER, TEXT),
    "LeftSideGait": (1016, NUMBER, TEXT),
    "RightSideGait": (1017, NUMBER, TEXT),
    "HandStand": (1018, NUMBER, TEXT),
    "BipedStand": (1019, NUMBER, TEXT),
    "FrontFlip": (1020, {}),
    "BackFlip": (1021, {}),
    "GetState": (1034, {}),
    "Trajectory": (1035, *[
        {"path": path, "feedback_mode": 0, "external_x": 0.0, "external_y": 0.0, "external_yaw": 0.0}
        for path in ([{"t_from_start": 0.1, "x": 0.0, "y": 0.0, "yaw": 0.0}], "straight")]),
    "SetAutoRecovery": (1040, NUMBER, TEXT),
    "ResetEstimator": (1111, {}),
}  # fmt: skip
G1_LOCO = {  # of 2024, before firmware 1.4
    "GetFsmId": (7001, {}),
    "GetFsmMode": (7002, {}),
    "GetBalanceMode": (7003, {}),
    "GetSwingHeight": (7004, {}),
    "GetStandHeight": (7005, {}),
    "GetPhase": (7006, {}),
    "SetFsmId": (7101, {"data": 200}, TEXT),
    "SetBalanceMode": (7102, NUMBER, TEXT),
    "SetSwingHeight": (7103, NUMBER, TEXT),
    "SetStandHeight": (7104, NUMBER, TEXT),
    "SetVelocity": (7105, *VELOCITY),
    "SetTaskId": (7106, {"data": 0}, TEXT),
}
H2_SPORT = R1_SPORT | {
    "GetBalanceMode": (7003, {}),
    "GetSwingHeight": (7004, {}),
    "GetStandHeight": (7005, {}),
    "GetPhase": (7006, {}),
    "GetArmSdkStatus": (7007, {}),
    "GetAvailableFsmIds": (7008, {}),
    "SetBalanceMode": (7102, NUMBER, TEXT),
    "SetSwingHeight": (7103, NUMBER, TEXT),
    "SetStandHeight": (7104, NUMBER, TEXT),
    "SetArmTask": (7106, {"data": 0}, TEXT),
    "SetPunch": (7108, {"data": [0.1]}, TEXT),
    "SetArmSdkStatus": (7109, *FLAG),
}
BY_ID = {
    "robot_state": ("robot_state", B2_ROBOT_STATE),
    "sport_a2": ("sport", A2_SPORT),
    "sport_h2": ("sport", H2_SPORT),
    "sport_r1": ("sport", R1_SPORT),
    "loco_g1": ("loco", G1_LOCO),
}
# Walked by all, and those that no client of the pinned SDK calls.
EVERYWHERE, NO_CLIENT = ["motion_switcher"], ["config", "uwbswitch"]
DAMP_BY_ID = {
    "sport_a2": ("sport", 1001, "{}"),
    "sport_h2": ("sport", 7101, '{"data":1}'),
    "sport_r1": ("sport", 7101, '{"data":1}'),
    "loco_g1": ("loco", 7101, '{"data":1}'),
}
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


def call(client, method, given):
    """What the method returns, or what it was answered where it returns none; the text of what it
    raised."""
    answered = []
    ask = client._Call

    def listening(*ids_and_parameters):
        answer = ask(*ids_and_parameters)
        answered.append(answer[0])
        return answer

    client._Call = listening
    try:
        result = method(*given)
    except Exception as error:  # what the vendor's client raises is part of the report
        return repr(error)
    finally:
        client._Call = ask
    if result is None and answered:
        return answered[-1]
    return result[0] if isinstance(result, tuple) else result


def class_of(path):
    module, name = path.rsplit(".", 1)
    return getattr(importlib.import_module("unitree_sdk2py." + module), name)


def new_client(kind):
    client = kind()
    client.SetTimeout(10.0)
    client.Init()
    return client


def new_clients(paths):
    """One client of each. They wait long in their constructors: all at once but the first, in which
    the binding prepares its types, and only one thread may do that."""
    kinds = {service: class_of(path) for service, path in paths.items()}
    first, *others = kinds
    clients = {first: new_client(kinds[first])}
    if not others:
        return clients
    with concurrent.futures.ThreadPoolExecutor(len(others)) as pool:
        made = pool.map(new_client, [kinds[service] for service in others])
        return {**clients, **dict(zip(others, made))}


def methods_of(client, service):
    for name, function in vars(type(client)).items():
        if inspect.isfunction(function) and not name.startswith("_") and name != "Init":
            if (service, name) not in BROKEN:
                yield name, getattr(client, name)


def walk(client, service, settle):
    module = inspect.getmodule(type(client))
    report = {}
    for name, method in methods_of(client, service):
        good, bad = arguments_of(module, service, name, method)
        settle()
        report[name] = {"good": call(client, method, good)}
        if bad:
            report[name]["bad"] = call(client, method, bad)
    return report


def client_by_id(service, ids):
    client = Client(service, False)
    client.SetTimeout(3.0)
    for id in ids:
        client._RegistApi(id, 0)
    return client


def walk_by_id(service, rows, settle):
    client = client_by_id(service, [id for id, *_ in rows.values()])
    report = {}
    for name, (id, *parameters) in rows.items():
        settle()
        codes = [client._Call(id, json.dumps(parameter))[0] for parameter in parameters]
        report[name] = dict(zip(("good", "bad"), codes))
    return report


def damper(clients, apis):
    """The client that damps the robot, and the call that does."""
    for api in apis:
        if api in DAMP_BY_ID:
            service, id, parameter = DAMP_BY_ID[api]
            client = client_by_id(service, [id])
            return client, lambda: client._Call(id, parameter)[0]
    client = clients["sport" if "sport" in clients else "loco"]
    return client, lambda: call(client, client.Damp, [])


def nothing():
    pass


def main():
    parsed = arguments(__doc__.splitlines()[0],
                       lambda parser: parser.add_argument("apis", help="of the robot, joined by commas"))
    apis = parsed.apis.split(",")
    unknown = set(apis) - {*CLIENTS, *BY_ID, *EVERYWHERE, *NO_CLIENT}
    if unknown:
        raise SystemExit(f"no client and no ids for {sorted(unknown)}")
    paths = dict(CLIENTS[api] for api in apis if api in CLIENTS)
    clients = new_clients({**paths, "motion_switcher": SWITCHER})
    switcher = clients.pop("motion_switcher")
    damped_by, damp = damper(clients, apis)
    report = {"calls": {}, "motion_service": switcher.CheckMode()[1]["name"]}
    for service, client in clients.items():
        report["calls"][service] = walk(client, service, damp if service in MOTION else nothing)
    for service, rows in (BY_ID[api] for api in apis if api in BY_ID):
        report["calls"][service] = walk_by_id(service, rows, damp if service in MOTION else nothing)
    if "vui" in clients:
        clients["vui"].SetVolume(3)
        report["volume_for_another"] = new_client(class_of(paths["vui"])).GetVolume()
    report["calls"]["motion_switcher"] = walk(switcher, "motion_switcher", nothing)
    damped_by.SetTimeout(0.5)
    time.sleep(0.5)  # until the client knows that nobody reads
    report["after_release"] = damp()
    print(json.dumps(report))


if __name__ == "__main__":
    main()
