"""What is planned to fail, seen through the vendor's messages."""

import json

from unitree_sdk2py.idl.std_msgs.msg.dds_ import String_

from peers import listener

FAULTS = """
faults:
  - {component: fan.front, fault: off, at: 1, for: 4}
  - {component: bus.FR, fault: off, at: 2, for: 2}
"""


def test_a_fan_and_a_bus_fail_as_planned_and_come_back(play, tmp_path):
    file = tmp_path / "faults.yaml"
    file.write_text(FAULTS)
    robot = play("go2", "--released", "--speed", 4, "--domain", 3, "--config", file)
    with listener(domain=3) as ear, listener("rt/errorlist", String_, domain=3) as errors:
        ear.wait()
        states = ear.take_for(2)
        lists = [json.loads(text.data)["errors"] for text in errors.take_for(0.1)]
    robot.heard("bus.FR is off")
    robot.heard("fan.front is no longer off")
    robot.end()

    def at(begin, end):
        return [state for state in states if begin < state.tick < end]

    fan = at(1100, 1900)
    assert fan and all(state.fan_frequency[3] == 4 and state.bit_flag == 0x24 for state in fan)
    both = at(2200, 3800)
    assert both and all(state.bit_flag == 0xA4 for state in both)
    for state in both:
        assert [state.motor_state[i].reserve[0] for i in range(4)] == [0x100, 0x100, 0x100, 0]
    last = at(5200, 9000)
    assert last and all(state.fan_frequency[3] == 0 and state.bit_flag == 0x24 for state in last)
    assert [motor.reserve[0] for motor in last[-1].motor_state] == [0] * 20
    assert last[-1].motor_state[0].lost > 500
    told = [sorted((source, code) for _, source, code in entries) for entries in lists]
    assert [(200, 4)] in told
    assert [(100, 128), (200, 4), (300, 256), (301, 256), (302, 256)] in told
    assert told[-1] == []


def test_a_configuration_with_what_the_robot_has_not_is_refused_with_its_line(understudy, tmp_path):
    file = tmp_path / "faults.yaml"
    file.write_text(FAULTS + "  - {component: bus.FX, fault: off}\n")
    for asked in (("check", "--robot", "go2", file), ("run", "go2", "--config", file)):
        done = understudy(*asked)
        assert done.returncode == 3
        assert "faults.yaml:5: faults.2: the robot has no 'bus.FX'; did you mean 'bus." in done.stdout + done.stderr
