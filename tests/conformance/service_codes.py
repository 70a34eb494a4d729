"""What each call of services_walk.py must be answered with: (good arguments, bad ones).

The robot lies or hangs damped at every motion call. Codes are those of the SDK's headers (sport of a
quadruped 4201, 4205; of a humanoid 7301; arm 7402, 7404; motion_switcher 7001, 7002, 7004; robot_state
5203; vui, voice and video 100; any 3204), 4206 that of the vendor's Go2 page. That 4201 answers what
a state forbids, 4205, 7301 and 5203 what is not played, and 3204 arguments of a wrong type is assumed
(docs/reference/services.md), and so is that a humanoid answers 0 to heights, balance modes and arm tasks that its
state ignores, as a real G1 does to other such requests.
"""

OK = 0
PARAMETER = 3204
POSTURE = 4201  # not from this state
GESTURE = 4206  # not in this posture
NOT_PLAYED = 4205
NO_REPLY = (OK, OK)  # the client asks for none: its own success


def plain(code):
    """Of a call without arguments."""
    return code, None


def taking(code, bad=PARAMETER):
    return code, bad


QUADRUPED = {
    "Damp": plain(OK),
    "StopMove": plain(OK),
    "StandUp": plain(OK),
    "StandDown": plain(OK),  # from damping: the vendor's Go2-W page
    "RecoveryStand": plain(OK),
    "BalanceStand": plain(POSTURE),
    "Move": NO_REPLY,
    "SpeedLevel": taking(OK),
    "AutoRecoverySet": taking(OK),
}
GO2_SPORT = QUADRUPED | {
    "Euler": taking(POSTURE),
    "Sit": plain(GESTURE),
    "RiseSit": plain(GESTURE),
    "Hello": plain(GESTURE),
    "Stretch": plain(GESTURE),
    "Pose": taking(GESTURE),
    "SwitchJoystick": taking(OK),
    "AutoRecoveryGet": plain(OK),
    **{name: plain(GESTURE) for name in ("Content", "Dance1", "Dance2", "Scrape", "Heart")},
    **{name: plain(POSTURE) for name in ("FreeWalk", "StaticWalk", "TrotRun")},
    "ClassicWalk": taking(POSTURE),
    **{name: plain(NOT_PLAYED) for name in (
        "FrontFlip", "FrontJump", "FrontPounce", "LeftFlip", "BackFlip", "SwitchAvoidMode")},
    **{name: taking(NOT_PLAYED) for name in (
        "FreeBound", "FreeJump", "FreeAvoid", "WalkUpright", "CrossStep", "HandStand")},
}  # fmt: skip
B2_SPORT = QUADRUPED | {
    "BodyHeight": taking(POSTURE),
    "TrajectoryFollow": (OK, 4101),  # sent without a reply; the client counts the points itself
    "FreeWalk": plain(POSTURE),
    "ContinuousGait": taking(OK),
    "SwitchMoveMode": taking(OK),
    **{name: taking(POSTURE) for name in (
        "SwitchGait", "MoveToPos", "ClassicWalk", "FastWalk", "FreeEuler")},
    **{name: taking(NOT_PLAYED) for name in ("VisionWalk", "HandStand")},
}  # fmt: skip
A2_SPORT = {name: code for name, code in QUADRUPED.items() if name != "AutoRecoverySet"} | {
    "Move": taking(POSTURE),  # its client wants a reply
    "Euler": taking(POSTURE),
    "BodyHeight": taking(POSTURE),
    "SetAutoRecovery": taking(OK),
    "SpeedLevel": taking(OK),  # read by GetState
    "GetState": plain(OK),
    "ResetEstimator": plain(POSTURE),
    **{name: taking(POSTURE) for name in ("BodyPosition", "SwitchGait", "Trajectory")},
    **{name: plain(NOT_PLAYED) for name in ("FrontFlip", "BackFlip")},
    **{name: taking(NOT_PLAYED) for name in (
        "LeftSideGait", "RightSideGait", "HandStand", "BipedStand")},
}  # fmt: skip


# What G1, H1 and H1-2 share. Robots answer 0 to a state that they cannot reach and to a velocity at
# which they cannot walk, and do nothing (docs/dev/sources.md#notes-on-real-robots); that the same holds
# of heights, balance mode and arm tasks is assumed. Only what is not played is a failure: 7301.
HUMANOID = {
    "SetFsmId": taking(OK),
    "SetVelocity": taking(OK),
    "SetStandHeight": taking(OK),
    "Damp": plain(OK),
    "Start": plain(OK),
    "ZeroTorque": plain(OK),
    "StopMove": plain(OK),
    "HighStand": plain(OK),
    "LowStand": plain(OK),
    "Move": taking(OK),
}
G1_SPORT = HUMANOID | {
    "SetBalanceMode": taking(OK),
    "SetTaskId": taking(OK),
    "BalanceStand": taking(OK),
    "WaveHand": (OK, OK),  # what it makes of bad arguments is good, here and in the next
    "ShakeHand": (OK, OK),
    "Sit": plain(OK),
    "Squat2StandUp": plain(7301),  # up from the ground: not played
    "Lie2StandUp": plain(7301),
    "StandUp2Squat": plain(7301),
}
H1_LOCO = HUMANOID | {"StandUp": plain(OK)}
R1_SPORT = {  # as seen on two robots, which have codes of their own; it is in damping already
    "GetFsmId": plain(OK),
    "GetFsmMode": plain(3203),
    "SetFsmId": taking(1001),
    "SetVelocity": taking(127, 3202),
    "SetArmTask": taking(7301),
    "SetSpeedMode": taking(3203, 3203),
}
H2_SPORT = {
    "SetFsmId": taking(OK),
    "SetVelocity": taking(OK),
    "SetSpeedMode": taking(OK),
    **{name: plain(OK) for name in (
        "GetFsmId", "GetFsmMode", "GetBalanceMode", "GetSwingHeight", "GetStandHeight", "GetPhase", "GetArmSdkStatus",
        "GetAvailableFsmIds")},
    "SetBalanceMode": taking(OK),
    "SetSwingHeight": taking(OK),
    "SetStandHeight": taking(OK),
    "SetArmTask": taking(OK),
    "SetPunch": taking(7301),
    "SetArmSdkStatus": taking(OK),
}  # fmt: skip
G1_LOCO = {  # before firmware 1.4
    **{name: plain(OK) for name in (
        "GetFsmId", "GetFsmMode", "GetBalanceMode", "GetSwingHeight", "GetStandHeight", "GetPhase")},
    **{name: taking(OK) for name in (
        "SetFsmId", "SetBalanceMode", "SetSwingHeight", "SetStandHeight", "SetVelocity")},
    "SetTaskId": taking(3203, 3203),  # as on a robot of 2025-02
}  # fmt: skip

VUI = {
    "SetSwitch": taking(OK, 100), "SetVolume": taking(OK, 100), "SetBrightness": taking(OK, 100),
    "GetSwitch": plain(OK), "GetVolume": plain(OK), "GetBrightness": plain(OK),
}  # fmt: skip
VIDEO = {"GetImageSample": plain(OK)}
BUSY, UNKNOWN = 7002, 7004  # of SelectMode: `mcf` is on, so that no other can be selected
SWITCHER = {"CheckMode": plain(OK), "SelectMode": (UNKNOWN, 7001), "ReleaseMode": plain(OK)}
ROBOT_STATE = {"ServiceList": plain(OK), "ServiceSwitch": taking(OK)}
VOICE = {
    "TtsMaker": (OK, 100), "GetVolume": plain(OK), "SetVolume": (OK, 100),
    "LedControl": (OK, 100), "PlayStream": (OK, 100), "PlayStop": (OK, OK),
}  # fmt: skip
# By table of docs/reference/services.md: its service and the codes of its calls.
CODES = {
    "motion_switcher": ("motion_switcher", SWITCHER),
    "sport_go2": ("sport", GO2_SPORT),
    "sport_go2w": ("sport", GO2_SPORT),
    "sport_b2": ("sport", B2_SPORT),
    "sport_b2w": ("sport", B2_SPORT),
    "sport_a2": ("sport", A2_SPORT),
    "sport_g1": ("sport", G1_SPORT),
    "sport_h2": ("sport", H2_SPORT),
    "sport_r1": ("sport", R1_SPORT),
    "loco_h1": ("loco", H1_LOCO),
    "loco_g1": ("loco", G1_LOCO),
    "arm_g1": ("arm", {"ExecuteAction": (7404, 7402), "GetActionList": plain(OK)}),
    "robot_state_go2": ("robot_state", ROBOT_STATE),
    "robot_state": ("robot_state", ROBOT_STATE | {
        "SetReportFreq": taking(OK),
        "LowPowerSwitch": taking(5203),  # not played
        "LowPowerStatus": plain(OK),
        "GetPkgVersion": plain(OK),
    }),
    "obstacles_avoid": ("obstacles_avoid", {
        "SwitchSet": taking(OK),
        "SwitchGet": plain(OK),
        "UseRemoteCommandFromApi": taking(OK),
        "Move": NO_REPLY,
        "MoveToAbsolutePosition": NO_REPLY,
        "MoveToIncrementPosition": NO_REPLY,
    }),
    "vui": ("vui", VUI),
    "voice": ("voice", VOICE),
    "videohub": ("videohub", VIDEO),
    "front_videohub": ("front_videohub", VIDEO),
    "back_videohub": ("back_videohub", VIDEO),
}  # fmt: skip
NOT_CALLED = {"config", "uwbswitch"}  # the pinned SDK has no client of them


def codes_of(apis, motion_service):
    """By service, the codes of a robot with those tables while that motion service is on."""
    codes = dict(CODES[api] for api in apis if api not in NOT_CALLED)
    if motion_service == "mcf":
        codes["motion_switcher"] = SWITCHER | {"SelectMode": (BUSY, 7001)}
    return codes
