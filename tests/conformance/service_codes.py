"""What each call of services_walk.py must be answered with: (good arguments, bad ones).

The robot lies or hangs damped at every motion call. Codes are those of the SDK's headers (sport of a
quadruped 4201, 4205; of a humanoid 7301; arm 7402, 7404; motion_switcher 7001, 7002, 7004; robot_state
5203; vui, voice and video 100; any 3204), 4206 that of the vendor's Go2 page. That 4201 answers what
a state forbids, 4205, 7301 and 5203 what is not played, and 3204 arguments of a wrong type is assumed
(docs/services.md), and so is that a humanoid answers 0 to heights, balance modes and arm tasks that its
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
# which they cannot walk, and do nothing (docs/sources.md#notes-on-real-robots); that the same holds
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
R1_SPORT = {
    "GetFsmId": plain(OK),
    "GetFsmMode": plain(OK),
    "SetFsmId": taking(OK),
    "SetVelocity": taking(OK),
    "SetSpeedMode": taking(OK),
}
H2_SPORT = R1_SPORT | {
    **{name: plain(OK) for name in (
        "GetBalanceMode", "GetSwingHeight", "GetStandHeight", "GetPhase", "GetArmSdkStatus",
        "GetAvailableFsmIds")},
    "SetBalanceMode": taking(OK),
    "SetSwingHeight": taking(OK),
    "SetStandHeight": taking(OK),
    "SetArmTask": taking(OK),
    "SetPunch": taking(7301),
    "SetArmSdkStatus": taking(OK),
}  # fmt: skip

VUI = {
    "SetSwitch": taking(OK, 100), "SetVolume": taking(OK, 100), "SetBrightness": taking(OK, 100),
    "GetSwitch": plain(OK), "GetVolume": plain(OK), "GetBrightness": plain(OK),
}  # fmt: skip
VIDEO = {"GetImageSample": plain(100)}  # no camera is played
SWITCHER = {"CheckMode": plain(OK), "SelectMode": (7004, 7001), "ReleaseMode": plain(OK)}
ROBOT_STATE = {"ServiceList": plain(OK), "ServiceSwitch": taking(OK)}
GO2_OTHERS = {
    "motion_switcher": SWITCHER,
    "robot_state": ROBOT_STATE,
    "vui": VUI,
    "videohub": VIDEO,
    "obstacles_avoid": {
        "SwitchSet": taking(OK),
        "SwitchGet": plain(OK),
        "UseRemoteCommandFromApi": taking(OK),
        "Move": NO_REPLY,
        "MoveToAbsolutePosition": NO_REPLY,
        "MoveToIncrementPosition": NO_REPLY,
    },
}
B2_OTHERS = {
    "motion_switcher": SWITCHER,
    "robot_state": ROBOT_STATE | {
        "SetReportFreq": taking(OK),
        "LowPowerSwitch": taking(5203),  # not played
        "LowPowerStatus": plain(OK),
        "GetPkgVersion": plain(OK),
    },
    "vui": VUI,
    "front_videohub": VIDEO,
    "back_videohub": VIDEO,
}
CODES = {
    # `mcf` is on, so that no other can be selected
    "go2": {"sport": GO2_SPORT} | GO2_OTHERS | {"motion_switcher": SWITCHER | {"SelectMode": (7002, 7001)}},
    "go2w": {"sport": GO2_SPORT} | GO2_OTHERS,
    "b2": {"sport": B2_SPORT} | B2_OTHERS,
    "b2w": {"sport": B2_SPORT} | B2_OTHERS,
    "a2": {"sport": A2_SPORT, "motion_switcher": SWITCHER},
    "g1": {
        "sport": G1_SPORT,
        "arm": {"ExecuteAction": (7404, 7402), "GetActionList": plain(OK)},
        "voice": {
            "TtsMaker": (OK, 100), "GetVolume": plain(OK), "SetVolume": (OK, 100),
            "LedControl": (OK, 100), "PlayStream": (OK, 100), "PlayStop": (OK, OK),
        },
        "motion_switcher": SWITCHER,
    },
    "h1": {"loco": H1_LOCO, "motion_switcher": SWITCHER},
    "h1_2": {"loco": H1_LOCO, "motion_switcher": SWITCHER},
    "h2": {"sport": H2_SPORT, "motion_switcher": SWITCHER},
    "r1": {"sport": R1_SPORT, "motion_switcher": SWITCHER},
}  # fmt: skip
