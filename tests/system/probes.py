"""What one looks at in a running robot to see what a setting does: each takes a Robot and gives a value
that is the same however often it is taken, and another when the setting is another."""

import time

from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient
from unitree_sdk2py.g1.loco.g1_loco_client import LocoClient
from unitree_sdk2py.go2.robot_state.robot_state_client import RobotStateClient
from unitree_sdk2py.idl.default import unitree_hg_msg_dds__HandCmd_
from unitree_sdk2py.idl.std_msgs.msg.dds_ import String_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import SportModeState_
from unitree_sdk2py.idl.unitree_hg.msg.dds_ import HandCmd_, HandState_

from peers import (
    GoLowCmd,
    HgLowCmd,
    HgLowState,
    go_command,
    hg_command,
    join,
    listener,
    speaker,
)
from robots import eventually

MIDDLE = 3  # motor of the left hand that most of what is said of hands is about


def accepted_with_wrong_head(played):
    message = go_command()
    message.head = [1, 2]
    return commanded(played, GoLowCmd, message)["commands"]["accepted"] > 0


def times_out(played):
    return commanded(played, GoLowCmd, go_command())["commands"]["timeouts"] > 0


def commanded(played, kind, message, seconds=0.4):
    """The status right after commands for a while."""
    with speaker("rt/lowcmd", kind) as client:
        client.write_for(seconds, message, period=0.02)
        return played.status()


def ankle_behind_its_motors(played):
    """Angles [rad] of a G1's knee, ankle pitch and roll whose motors, A and B where they are two,
    were asked for certain places; read in joint space right after."""
    message = hg_command(mode_machine=5, mode_pr=1)
    for slot, q in ((3, 0.5), (4, 0.3), (5, -0.3)):
        message.motor_cmd[slot].kp, message.motor_cmd[slot].kd = 100.0, 4.0
        message.motor_cmd[slot].q = q
    with speaker("rt/lowcmd", HgLowCmd) as client, listener("rt/lowstate", HgLowState) as ear:
        client.write_for(1.0, message)
        client.write_for(0.02, hg_command(mode_machine=5))
        state = eventually(lambda: next((s for s in ear.take() if s.mode_pr == 0
                                         and s.tick > 500), None))
    return [round(state.motor_state[slot].q, 1) for slot in (3, 4, 5)]


def driven_hip(played):
    """The states of a hip, motor 0, that is asked for 20 N·m until it meets its stop."""
    message = go_command()
    message.motor_cmd[0].tau = 20.0
    with speaker("rt/lowcmd", GoLowCmd) as client, listener() as ear:
        client.write_for(0.6, message)
        return [state.motor_state[0] for state in ear.take()]


def fastest_hip(played):
    return round(max(abs(motor.dq) for motor in driven_hip(played)))


def drives_hard_at_speed(played):
    """Whether more than 17 N·m are left at 2.5 to 4.5 rad/s."""
    torques = [motor.tau_est for motor in driven_hip(played) if 2.5 < motor.dq < 4.5]
    assert torques, "the hip never was that fast"
    return max(torques) > 17


def lowering_takes(played):
    """Metres of tether that half a second of simulated time pays out, in tenths."""
    before = played.status()
    played.ctl("crane", "lower", "1")
    after = played.becomes(lambda now: now["time"] > before["time"] + 0.5)
    return after["crane"]["length"] - before["crane"]["length"] > 0.3


def arm_weight(played):
    """Of rt/arm_sdk, half a second after clients have stopped sending 0.5 in slot 29."""
    message = hg_command(mode_machine=0)
    message.motor_cmd[29].q = 0.5
    with speaker("rt/arm_sdk", HgLowCmd) as client:
        client.write_for(0.4, message)
        time.sleep(0.5)
        return played.status()["motion"]["arm_weight"]


def arm_moves(played, topic="rt/arm_sdk"):
    """Whether an elbow comes near -0.5 rad, where a client holds it; left alone it hangs."""
    message = hg_command(mode_machine=0)
    message.motor_cmd[29].q = 1.0
    message.motor_cmd[18].q, message.motor_cmd[18].kp, message.motor_cmd[18].kd = -0.5, 60.0, 2.0
    with speaker(topic, HgLowCmd) as client, listener("rt/lowstate", HgLowState) as ear:
        client.write_for(1.0, message)
        return abs(ear.take()[-1].motor_state[18].q + 0.5) < 0.3


def moves_by_user_lowcmd(played):
    join(0)
    client = LocoClient()
    client.SetTimeout(5.0)
    client.Init()
    client._RegistApi(7110, 0)  # SwitchToUserCtrl; not in the Python client
    assert client._Call(7110, '{"data": false}')[0] == 0
    return arm_moves(played, "rt/user_lowcmd")


def hand_command(status=1, watched=0, **fields):
    message = unitree_hg_msg_dds__HandCmd_()
    for i, motor in enumerate(message.motor_cmd):
        motor.mode = i | status << 4 | watched << 7
    for field, value in fields.items():
        setattr(message.motor_cmd[MIDDLE], field, value)
    return message


def hand_states(played, *messages, after=0.4):
    """What the left hand tells from the first of these commands on, `after` seconds apart."""
    with listener("rt/dex3/left/state", HandState_) as ear:
        ear.wait()
        with speaker("rt/dex3/left/cmd", HandCmd_) as client:
            client.speak_until(lambda: played.status()["hands"][0]["accepted"], messages[0])
            ear.take()
            for message in messages:
                client.write(message)
                time.sleep(after)
        return ear.take()


def fastest_finger(played):
    """rad/s, of one that is pushed from its stop to where it is closed."""
    hand_states(played, hand_command(tau=1.0))
    closing = hand_states(played, hand_command(tau=-1.0))
    return round(max(abs(state.motor_state[MIDDLE].dq) for state in closing))


def finger_at_its_stop(played):
    """Angle, torque and temperatures of one that all terms of the motor law press to where it is closed."""
    pressing = hand_states(played, hand_command(q=-2.57, kp=0.5, dq=-4.0, kd=0.1, tau=-0.1))
    motor = pressing[-1].motor_state[MIDDLE]
    return round(motor.q, 1), round(motor.tau_est, 1), motor.temperature


def braking_gain(played):
    """Torque per rate of a finger that is locked while it moves."""
    hand_states(played, hand_command(tau=1.0))
    braking = hand_states(played, hand_command(dq=-5.0, kd=0.1), hand_command(status=0), after=0.15)
    locked = [state.motor_state[MIDDLE] for state in braking]
    ratios = [-motor.tau_est / motor.dq for motor in locked if not motor.mode >> 4 and motor.dq < -0.3]
    assert ratios, "it never moved locked"
    return round(ratios[0], 3)


def shown_by_the_hand(field):
    def look(played):
        with listener("rt/dex3/left/state", HandState_) as ear:
            return repr(getattr(ear.wait()[-1], field))

    return look


def is_told_on_its_topic(played):
    with listener("rt/dex3/left/state", HandState_) as ear:
        return bool(ear.take_for(2.0))


def follows_a_slow_client(played):
    """Whether a hip, fought over with a client of 50 Hz, mostly does what the client says."""
    message = go_command()
    message.motor_cmd[0].tau = 5.0
    with speaker("rt/lowcmd", GoLowCmd) as client, listener() as ear:
        client.write_for(0.6, message, period=0.02)
        torques = [state.motor_state[0].tau_est for state in ear.take()][-200:]
    return sum(torque > 2 for torque in torques) > len(torques) / 2


def stick_wish(played):
    played.ctl("remote", "sticks", "--ly", "1")
    return played.becomes(lambda now: now["remote"]["ly"] == 1)["remote"]["wish"]


def state_of_the_switcher(played):
    join(0)
    client = MotionSwitcherClient()
    client.SetTimeout(5.0)
    client.Init()
    return client.CheckMode()


def on_board(played):
    """What robot_state lists."""
    join(0)
    client = RobotStateClient()
    client.SetTimeout(5.0)
    client.Init()
    code, services = client.ServiceList()
    assert code == 0
    return [(one.name, one.status, one.protect) for one in services]


def motion_service(played):
    return played.status()["motion"]["service"]


def state_told(played):
    with listener("rt/sportmodestate", SportModeState_) as ear:
        return ear.wait()[-1].error_code


def hears_arm_actions(robot):
    with listener("rt/arm/action/state", String_) as ear:
        return bool(ear.take_for(0.5))


def hears_hg(robot):
    with listener("rt/lowstate", HgLowState) as ear:
        return bool(ear.take_for(0.5))
