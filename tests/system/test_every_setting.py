"""No setting is without effect: every key of `run --help-config` is changed, and something differs."""

import os
import pathlib
import re
import tempfile
import time

import pytest
from unitree_sdk2py.idl.unitree_go.msg.dds_ import SportModeState_
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import HandState_, IMUState_

import namespaces
from differences import (
    Check,
    Counted,
    Differs,
    Elsewhere,
    MadeGround,
    Refused,
    Seen,
    content,
    messages,
    options_of,
    states,
)
from peers import GoLowCmd, GoLowState, go_command
from probes import (
    accepted_with_wrong_head,
    ankle_behind_its_motors,
    arm_moves,
    arm_weight,
    braking_gain,
    commanded,
    drives_hard_at_speed,
    fastest_finger,
    fastest_hip,
    finger_at_its_stop,
    follows_a_slow_client,
    hand_command,
    hand_states,
    hears_arm_actions,
    hears_hg,
    is_told_on_its_topic,
    lowering_takes,
    MIDDLE,
    motion_service,
    moves_by_user_lowcmd,
    on_board,
    shown_by_the_hand,
    state_of_the_switcher,
    state_told,
    stick_wish,
    times_out,
)
from robots import understudy

DATA = pathlib.Path(__file__).parents[2]


def interface_is_used(play):
    with namespaces.cable(("veth0", "10.9.8.1/24"), ("veth1", "10.9.8.2/24")):
        robot = play("go2", "--set", "network.interface=veth0")
        assert "on veth0" in robot.heard("is on")["message"]
        robot.end()


def listening_takes_its_time(key, interface):
    """Wall seconds that a run needs, with two values of how long it listens first."""
    def check(play):
        walls = []
        with namespaces.cable(("veth0", "10.9.8.1/24"), ("veth1", "10.9.8.2/24")):
            for listen in (0, 1.5):
                started = time.monotonic()
                done = understudy("run", "go2", "--duration", 0.01, "--interface", interface,
                                  "--set", f"guard.{key}={listen}")
                assert done.returncode == 0, done.stderr
                walls.append(time.monotonic() - started)
        assert walls[1] > walls[0] + 0.7, walls
    return check


def row_of_one(changed, given="kind: rough"):
    return MadeGround(f"terrain.patches=[{{{{{changed}}}}}]", "row",
                      (f"terrain.patches=[{{{{{given}}}}}]",))


def differs_lying(key, value):
    return Differs(f"robot.{key}={value}")


def differs_standing(key, value, *given):
    return Differs(f"robot.{key}={value}", given=("start.pose=standing", *given))


def differs_hanging(setting):
    return Differs(setting, given=("start.pose=hanging",))


DROPPED = ("start.pose=standing", "robot.standing.height=1")  # lands hard on held legs
DIVERGING = ("start.pose=hanging", "crane.stiffness=1000000", "crane.damping=100000",
             "physics.timestep=0.01", "robot.rates.lowstate_hz=100", "robot.rates.motion_hz=100",
             "robot.rates.service_hz=100")


def arm_sdk(key, value):
    return Seen(f"robot.arm_sdk.{key}={value}", arm_weight, robot="g1", given=("motion.service=ai",))


def by_a_chord(changed, look=lambda played: played.status()["motion"], does="debug"):
    """The motion service after L2+B, where that is the only chord."""
    def press(played):
        played.ctl("remote", "press", "L2+B")
        time.sleep(0.3)
        return look(played)

    given = f"robot.remote.chords=[{{keys: L2+B, does: {does}}}]"
    return Seen(f"robot.remote.chords=[{{{changed}}}]", press, robot="g1",
                given=("motion.service=ai", given))


DEX3 = "g1_29dof_dex3"


def hand(changed, look, *given):
    return Seen(f"robot.hands.0.{changed}", look, robot=DEX3,
                given=("start.pose=clamped", "sensors.noise=false", *given))


def finger(changed, look, *given):
    return hand(f"motors.{MIDDLE}.{changed}", look,
                *(f"robot.hands.0.motors.{MIDDLE}.{setting}" for setting in given))


def board(changed):
    return Seen(f"robot.services=[{{name: one}}, {{{changed}}}]", on_board,
                given=("robot.services=[{name: one}, {name: two}]",))


MCF = ("motion.service=mcf",)

SETTINGS = {
    "motion.service": Seen("motion.service=mcf", motion_service),
    "motion.fight": Seen("motion.fight=true", given=MCF, look=lambda robot: commanded(
        robot, GoLowCmd, go_command())["commands"]["accepted"] > 0),
    "robot.firmware": Seen("robot.firmware=1.1.5", motion_service, given=("motion.service=''",)),
    "robot.kind": Seen("robot.kind=other", state_told, given=MCF),
    "robot.apis": Seen("robot.apis=[config]", state_of_the_switcher),
    "robot.arm_action_state": Seen("robot.arm_action_state=false", hears_arm_actions, robot="g1",
                                   given=("motion.service=ai",)),
    "robot.state_id_since": Seen("robot.state_id_since=''", state_told),
    "robot.services[].name": board("name: three"),
    "robot.services[].alias": Seen("robot.services=[{name: mcf, alias: ai}]", motion_service,
                                   given=("motion.service=''",)),
    "robot.services[].on": board("name: two, on: false"),
    "robot.services[].protect": board("name: two, protect: true"),
    "robot.services[].since": board("name: two, since: 9"),
    "robot.services[].before": board("name: two, before: 1"),
    "robot.arm_sdk.slots": Seen("robot.arm_sdk.slots=[15]", arm_moves, robot="g1",
                                given=("motion.service=ai",)),
    "robot.arm_sdk.weight_slot": arm_sdk("weight_slot", 30),
    "robot.arm_sdk.weight_in_mode_pr": arm_sdk("weight_in_mode_pr", "true"),
    "robot.arm_sdk.timeout": arm_sdk("timeout", 0.01),
    "robot.user_lowcmd": Seen("robot.user_lowcmd=false", moves_by_user_lowcmd, robot="g1",
                              given=("motion.service=ai",)),
    "robot.remote.chords[].keys": by_a_chord("keys: A, does: debug"),
    "robot.remote.chords[].clicks": by_a_chord("keys: L2+B, clicks: 2, does: debug"),
    "robot.remote.chords[].does": by_a_chord("keys: L2+B, does: damp"),
    "robot.remote.chords[].value": by_a_chord("keys: L2+B, does: set_fsm, value: 1",
                                              does="set_fsm"),
    "robot.remote.chords[].from": by_a_chord("keys: L2+B, does: debug, from: [99]"),
    "robot.remote.speed": Seen("robot.remote.speed=[0.1, 0, 0]", stick_wish),
    "robot.rates.service_hz": Seen("robot.rates.service_hz=1", follows_a_slow_client,
                                   given=("start.pose=clamped", "motion.fight=true", *MCF)),
    "scene": Refused("scene=moon", 4, "no scene 'moon'"),
    "terrain.difficulty": MadeGround("terrain.difficulty=0.9"),
    "terrain.friction": MadeGround("terrain.friction=0.3"),
    "terrain.size": MadeGround("terrain.size=[6,3]"),
    "terrain.seed": MadeGround("terrain.seed=2"),
    "terrain.image": MadeGround("terrain.image={down}", "image", ("terrain.image={up}",)),
    "terrain.image_height": MadeGround("terrain.image_height=2", "image", ("terrain.image={up}",)),
    "terrain.patches[].kind": row_of_one("kind: waves"),
    "terrain.patches[].difficulty": row_of_one("kind: rough, difficulty: 0.9"),
    "terrain.patches[].friction": row_of_one("kind: rough, friction: 0.3"),
    "terrain.patches[].length": row_of_one("kind: rough, length: 3"),
    "terrain.patches[].image": row_of_one("kind: image, image: '{down}'",
                                          "kind: image, image: '{up}'"),
    "control.panel": Seen("control.panel=false", lambda robot: "panel: http" in robot.said()),
    "control.address": Seen("control.address=127.0.0.2", lambda robot: robot.heard("panel: ")["message"][:23]),
    "control.port": Seen("control.port=17707", lambda robot: ":17707/" in robot.heard("panel: ")["message"]),
    "network.interface": Check(interface_is_used),
    "network.domain": Elsewhere("test_neighbours.py", '"--domain"'),
    "guard.listen_loopback": Check(listening_takes_its_time("listen_loopback", "lo")),
    "guard.listen_network": Check(listening_takes_its_time("listen_network", "veth0")),
    "guard.on_stranger": Elsewhere("test_neighbours.py", "guard.on_stranger="),
    "time.speed": Elsewhere("test_time.py", '"--speed", "0.5"'),
    "time.duration": Elsewhere("test_life_cycle.py", '"--duration"'),
    "time.realtime": Seen("time.realtime=false", lambda robot: "SCHED_FIFO" in robot.said()),
    "physics.timestep": Differs("physics.timestep=0.0005"),
    "physics.on_divergence": Check(lambda play: divergence_answers()),
    "sensors.quantise": Differs("sensors.quantise=false"),
    "sensors.noise": Differs("sensors.noise=false"),
    "sensors.seed": Differs("sensors.seed=2"),
    "gate.mode": Seen("gate.mode=lenient", accepted_with_wrong_head),
    "gate.timeout": Seen("gate.timeout=0.001", times_out, given=("gate.timeout=10",)),
    "gate.damping_kd": differs_hanging("gate.damping_kd=50"),
    "crane.length": Seen("crane.length=1", lambda robot: robot.status()["crane"]["length"],
                         given=("start.pose=hanging",)),
    "crane.stiffness": differs_hanging("crane.stiffness=2000"),
    "crane.damping": differs_hanging("crane.damping=0"),
    "crane.speed": Seen("crane.speed=5", lowering_takes, given=("start.pose=hanging",)),
    "start.pose": Differs("start.pose=standing"),
    "robot.name": Seen("robot.name=rex", lambda robot: robot.status()["robot"]),
    "robot.description": Check(lambda play: description_is_shown()),
    "robot.model": Refused("robot.model=none.xml", 4, "none.xml"),
    "robot.base_body": Refused("robot.base_body=FR_calf", 4, "FR_calf"),
    "robot.family": Seen("robot.family=hg", lambda robot: hears_hg(robot),
                         given=("robot.rates.lf_hz=20",)),
    "robot.mode_machine": Differs("robot.mode_machine=6", robot="g1"),
    "robot.revision": Differs("robot.revision=13", robot="g1"),
    "robot.locked_joints": Differs("robot.locked_joints=[waist_roll_joint]", robot="g1"),
    "robot.bodies[].name": Refused("robot.bodies=[{name: nobody}]", 4, "nobody"),
    "robot.bodies[].pos": differs_standing("bodies", "[{name: FR_calf, pos: [0, 0, -0.25]}]"),
    "robot.bodies[].mass": differs_standing("bodies", "[{name: FR_calf, mass: 2}]"),
    "robot.bodies[].com": differs_standing("bodies", "[{name: FR_calf, com: [0, 0, -0.2]}]"),
    "robot.bodies[].inertia": Elsewhere("../mjcf/revise_test.cc", ".inertia ="),
    "robot.sites[].name": Refused("robot.sites=[{name: nowhere}]", 4, "nowhere"),
    "robot.sites[].pos": differs_standing("sites", "[{name: imu, pos: [0.2, 0, 0]}]"),
    "robot.motors[].armature": differs_standing("motors.0.armature", 0.5),
    "robot.crane_body": differs_hanging("robot.crane_body=FR_calf"),
    "robot.crane_point": differs_hanging("robot.crane_point=[0.1, 0, 0.06]"),
    "robot.default_start": Differs("robot.default_start=standing"),
    "robot.motors[].joint": Differs("robot.motors.0.joint=FL_hip_joint",
                                    "robot.motors.3.joint=FR_hip_joint",
                                    given=("start.pose=standing",)),
    "robot.motors[].slot": Differs("robot.motors.11.slot=13", given=("robot.dynamics=catalogue",)),
    "robot.motors[].torque_limit": Differs("robot.motors.2.torque_limit=1", given=DROPPED),
    "robot.motors[].knee_speed": Seen("robot.motors.0.knee_speed=0.1", drives_hard_at_speed,
                                      given=("start.pose=clamped",
                                             "robot.motors.0.no_load_speed=6",
                                             "robot.motors.0.knee_speed=5")),
    "robot.motors[].no_load_speed": Seen("robot.motors.0.no_load_speed=2", fastest_hip,
                                         given=("start.pose=clamped",
                                                "robot.motors.0.knee_speed=1")),
    "robot.motors[].q_step": differs_lying("motors.0.q_step", 0.01),
    "robot.motors[].dq_step": differs_lying("motors.0.dq_step", 0.1),
    "robot.motors[].tau_step": differs_lying("motors.0.tau_step", 1),
    "robot.motors[].hold_kp": differs_standing("motors.0.hold_kp", 30),
    "robot.motors[].hold_kd": differs_standing("motors.0.hold_kd", 1),
    "robot.motors[].strength": differs_standing("motors.2.strength", 0.5),
    "robot.motors[].kp_scale": differs_standing("motors.2.kp_scale", 0.5),
    "robot.motors[].kd_scale": differs_standing("motors.2.kd_scale", 0.5),
    "robot.motors[].rise_per_nm2_c": differs_standing("motors.2.rise_per_nm2_c", 1000),
    "robot.dynamics.use": differs_standing("dynamics.use", "catalogue"),
    "robot.dynamics.fitted[].slots": differs_standing(
        "dynamics.fitted", "[{slots: [1], frictionloss: 3}]",
        "robot.dynamics.fitted=[{slots: [2], frictionloss: 3}]"),
    "robot.dynamics.fitted[].armature": differs_standing("dynamics.fitted.2.armature", 0.5),
    "robot.dynamics.fitted[].damping": differs_standing("dynamics.fitted.2.damping", 3),
    "robot.dynamics.fitted[].frictionloss": differs_standing("dynamics.fitted.2.frictionloss", 3),
    "robot.dynamics.fitted[].kd_share": differs_standing("dynamics.fitted.2.kd_share", 0.1),
    "robot.dynamics.delay": Elsewhere("../emulator/commands_test.cc", "dynamics.delay ="),
    "randomization.seed": Differs("randomization.seed=2",
                                  given=("randomization.seed=1", "randomization.mass=[0.5, 1.5]")),
    "randomization.delay": Elsewhere("../robot/randomization_test.cc", ".delay = {"),
    **{f"randomization.{key}": Differs(f"randomization.{key}=[{value}, {value}]",
                                       given=("start.pose=standing",))
       for key, value in {
           "friction": 0.2, "mass": 1.5, "base_com": 0.05, "inertia": 2, "motor_strength": 0.5,
           "damping": 2, "armature": 2, "frictionloss": 2, "timestep": 0.0005, "kp": 0.5, "kd": 0.5,
           "imu_mounting": 0.1, "gravity_tilt": 0.1, "floor_softness": 4,
       }.items()},
    "robot.parallel[].pitch": Seen("robot.parallel=[{pitch: 3, roll: 5, roll_ratio: 1}]",
                                   ankle_behind_its_motors, robot="g1", given=("start.pose=clamped",)),
    "robot.parallel[].roll": Seen("robot.parallel=[{pitch: 4, roll: 3, roll_ratio: 1}]",
                                  ankle_behind_its_motors, robot="g1", given=("start.pose=clamped",)),
    "robot.parallel[].roll_ratio": Seen("robot.parallel=[{pitch: 4, roll: 5, roll_ratio: 4}]",
                                        ankle_behind_its_motors, robot="g1",
                                        given=("start.pose=clamped",)),
    "robot.hands[].name": hand("name=claw", lambda robot: robot.status()["hands"][0]["name"]),
    "robot.hands[].topic": hand("topic=dex4/left", is_told_on_its_topic),
    "robot.hands[].motors[].joint": Refused("robot.hands.0.motors.0.joint=none", 4, "none", DEX3),
    **{f"robot.hands[].motors[].{key}": finger(f"{key}={value}", finger_at_its_stop)
       for key, value in {
           "torque_limit": 0.25, "q_step": 1, "tau_step": 0.3, "strength": 0.5, "kp_scale": 0.2,
           "kd_scale": 0.2, "rise_per_nm2_c": 1000000,
       }.items()},
    "robot.hands[].motors[].knee_speed": finger("knee_speed=0.1", fastest_finger, "torque_limit=0.2"),
    "robot.hands[].motors[].no_load_speed": finger("no_load_speed=2", fastest_finger, "knee_speed=1"),
    "robot.hands[].motors[].dq_step": finger("dq_step=100", fastest_finger),
    "robot.hands[].motors[].armature": finger("armature=1", fastest_finger),
    "robot.hands[].motors[].lock_kd": finger("lock_kd=0.02", braking_gain, "lock_kd=0.01",
                                             "tau_step=0", "dq_step=0"),
    "robot.hands[].pads[].taxels": hand("pads.0.taxels=[1]",
                                        shown_by_the_hand("press_sensor_state")),
    "robot.hands[].timeout": hand("timeout=0.05", lambda robot: hand_states(
        robot, hand_command(watched=1))[-1].motor_state[MIDDLE].mode, "robot.hands.0.timeout=10"),
    "robot.hands[].temperature_c": hand("temperature_c=50", shown_by_the_hand("press_sensor_state")),
    "robot.hands[].supply_v": hand("supply_v=12", shown_by_the_hand("power_v")),
    "robot.rates.hand_hz": Counted("robot.rates.hand_hz=250", "rt/dex3/left/state", HandState_, DEX3),
    "robot.imu.site": Differs("robot.imu.site=secondary_imu", robot="g1"),
    "robot.imu.secondary_site": Check(lambda play: secondary_imu_is_there()),
    "robot.imu.gyro_step": differs_lying("imu.gyro_step", 0.1),
    "robot.imu.accel_step": differs_lying("imu.accel_step", 0.5),
    "robot.imu.gyro_noise": differs_lying("imu.gyro_noise", 1),
    "robot.imu.accel_noise": differs_lying("imu.accel_noise", 1),
    "robot.imu.temperature_c": differs_lying("imu.temperature_c", 50),
    "robot.encoder_noise.q_steps": differs_lying("encoder_noise.q_steps", 100),
    "robot.encoder_noise.dq_steps": differs_lying("encoder_noise.dq_steps", 100),
    "robot.encoder_noise.tau_steps": differs_lying("encoder_noise.tau_steps", 100),
    "robot.feet[].name": Refused("robot.feet.0={name: heel, geoms: [none]}", 4, "heel"),
    "robot.feet[].geoms": differs_standing("feet.0.geoms", "[FL]"),
    "robot.feet[].axis": differs_standing("feet.0.axis", "[1, 0, 0]"),
    "robot.foot_sensor.offset_counts": differs_lying("foot_sensor.offset_counts", 100),
    "robot.foot_sensor.counts_per_newton": differs_standing("foot_sensor.counts_per_newton", 3),
    "robot.rates.lowstate_hz": Counted("robot.rates.lowstate_hz=1000", "rt/lowstate", GoLowState),
    "robot.rates.motion_hz": Check(lambda play: motion_rate().check(play)),
    "robot.rates.lf_hz": Counted("robot.rates.lf_hz=50", "rt/lf/lowstate", GoLowState),
    "robot.battery.cells": differs_lying("battery.cells", 6),
    "robot.battery.capacity_ah": differs_lying("battery.capacity_ah", 0.0001),
    "robot.battery.start_soc": differs_lying("battery.start_soc", 0.3),
    "robot.battery.cell_full_v": differs_lying("battery.cell_full_v", 4.5),
    "robot.battery.cell_empty_v": differs_lying("battery.cell_empty_v", 2.5),
    "robot.battery.internal_ohm": differs_lying("battery.internal_ohm", 1),
    "robot.battery.idle_a": differs_lying("battery.idle_a", 3),
    "robot.battery.watt_per_nm2": differs_standing("battery.watt_per_nm2", 5),
    "robot.thermal.ambient_c": differs_lying("thermal.ambient_c", 10),
    "robot.thermal.rest_rise_c": differs_lying("thermal.rest_rise_c", 30),
    "robot.thermal.rise_per_nm2_c": differs_standing("thermal.rise_per_nm2_c", 1000),
    "robot.thermal.time_constant": differs_standing("thermal.time_constant", 1,
                                                    "robot.thermal.rise_per_nm2_c=10"),
    **{f"robot.motion.quadruped.{key}": Elsewhere("../motion/quadruped/settings_test.cc", word)
       for key, word in {
           "stand_height": "stand_height=", "foot_x": "foot_x=", "height_range": "height_range=",
           "euler_range": "euler_range=", "sit": "sit=", "kp": "quadruped.kp=", "kd": "quadruped.kd=",
           "damping_kd": "damping_kd=", "wheel_kp": "wheel_kp=", "wheel_kd": "wheel_kd=",
       }.items()},
    **{f"robot.motion.humanoid.{key}": Elsewhere("../motion/humanoid/fsm_test.cc", f"spec.{key} =")
       for key in ("lock_stand", "balance", "squat", "sit", "balanced_squat", "unplayed")},
    **{f"robot.motion.humanoid.{key}": Elsewhere("../motion/humanoid/motion_test.cc", word)
       for key, word in (("squat_q", "SquatsAndRisesWithLockedJoints"),
                         ("sit_q", "LocksItsJointsAsOnAChair"),
                         ("arm_actions", "WavesAndLetsItsArmDown"))},
    "robot.lying.q": differs_lying("lying.q", [0, 1, -2.5] * 4),
    "robot.lying.height": differs_lying("lying.height", 0.3),
    "robot.lying.quat": differs_lying("lying.quat", "[0.7071, 0, 0, 0.7071]"),
    "robot.standing.q": differs_standing("standing.q", [0, 0.8, -1.5] * 4),
    "robot.standing.height": differs_standing("standing.height", 0.5),
    "robot.standing.quat": differs_standing("standing.quat", "[0.7071, 0, 0, 0.7071]"),
    "robot.hanging.q": differs_hanging(f"robot.hanging.q={[0, 0.8, -1.5] * 4}"),
    "robot.hanging.height": Seen("robot.hanging.height=1",
                                 lambda robot: round(robot.status()["base"]["height"], 1),
                                 given=("start.pose=clamped",)),
    "robot.hanging.quat": differs_hanging("robot.hanging.quat=[0.7071, 0, 0, 0.7071]"),
}


def divergence_answers():
    """Told to stop the run ends with 7; told to reset it goes on to its duration."""
    codes = [understudy("run", "go2", "--speed", "max", "--duration", 3,
                        *options_of([*DIVERGING, f"physics.on_divergence={action}"])).returncode
             for action in ("stop", "reset")]
    assert codes == [7, 0]


def description_is_shown():
    """Of a robot file, by `robots`: a copy of ours with another line in it."""
    file = DATA / "config" / "robots" / "go2.yaml"
    with tempfile.TemporaryDirectory() as folder:
        robots = pathlib.Path(folder) / "config" / "robots"
        robots.mkdir(parents=True)
        text = file.read_text()
        changed = re.sub(r"(?m)^  description: .*$", "  description: a dog", text)
        assert changed != text
        (robots / "rex.yaml").write_text(changed)
        listed = understudy("robots", env={**os.environ, "UNDERSTUDY_DATA_DIR": folder}).stdout
    assert listed.rstrip().endswith("a dog")


def secondary_imu_is_there():
    counts = [len(messages("g1", settings, "rt/secondary_imu", IMUState_, 200)[0])
              for settings in ((), ("robot.imu.secondary_site=''",))]
    assert counts[0] > 100
    assert counts[1] == 0


def motion_rate():
    return Counted("robot.rates.motion_hz=100", "rt/sportmodestate", SportModeState_)


def keys():
    reference = understudy("run", "go2", "--help-config").stdout
    return re.findall(r"^\| `([^`]+)` \|", reference, re.MULTILINE)


def test_every_key_of_the_reference_has_a_row_here_and_no_other():
    assert sorted(keys()) == sorted(SETTINGS)


def test_two_runs_of_the_same_configuration_send_the_same_states():
    first = states("go2", "robot.default_start=lying")
    second = states("go2")
    common = first.keys() & second.keys()

    assert len(common) > 100
    assert all(content(first[tick]) == content(second[tick]) for tick in common)


def rows():
    """Every key. Those that look at a robot while the wall clock runs go one after another."""
    one_by_one = pytest.mark.xdist_group("live")
    return [pytest.param(key, marks=one_by_one if isinstance(row, (Check, Seen)) else ())
            for key, row in SETTINGS.items()]


@pytest.mark.parametrize("key", rows())
def test_a_key_has_an_effect(play, key):
    SETTINGS[key].check(play)
