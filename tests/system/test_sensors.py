"""Sensors that err as a profile says, seen through the vendor's messages."""

import json
import pathlib

from peers import listener

# It lies, released, on no more than its sensors' errors; --speed so that the tests are short.
LIES = ("--released", "--speed", 4, "--domain", 3)
JOINTS = 12


def readings(play, *options, seconds=0.6):
    """What LowState says of a robot that lies still: means of angles and accelerometer, temperature."""
    robot = play("go2", *LIES, *options)
    with listener(domain=3) as ear:
        ear.wait()
        states = [state for state in ear.take_for(seconds) if state.tick > 500]
    robot.end()
    assert len(states) > 100
    mean = [sum(state.motor_state[i].q for state in states) / len(states) for i in range(JOINTS)]
    accel = [sum(state.imu_state.accelerometer[i] for state in states) / len(states) for i in range(3)]
    return {"q": mean, "accel": accel, "feet": list(states[-1].foot_force),
            "rpy": list(states[-1].imu_state.rpy)}


def distance(ones, others):
    return max(abs(one - other) for one, other in zip(ones, others))


def test_a_worn_robot_reads_joints_and_gravity_otherwise_than_an_ideal_one(play):
    ideal = readings(play, "--profile", "ideal")
    worn = readings(play, "--profile", "worn")
    again = readings(play, "--profile", "worn")
    other = readings(play, "--profile", "worn", "--set", "sensors.seed=2")
    # Zeros of encoders have a deviation of 0.01 rad, biases of the accelerometer one of 0.25 m/s².
    assert 0.005 < distance(worn["q"], ideal["q"]) < 0.05
    assert 0.05 < distance(worn["accel"], ideal["accel"]) < 1
    assert distance(worn["rpy"][:2], ideal["rpy"][:2]) > 0.003
    assert abs(sum(value * value for value in ideal["accel"]) ** 0.5 - 9.81) < 0.02
    # A robot's errors are its own.
    assert distance(worn["q"], again["q"]) < 1e-3
    assert distance(worn["q"], other["q"]) > 0.005


def test_what_the_user_sets_lies_above_the_profile(understudy):
    printed = understudy("run", "go2", "--profile", "worn", "--set", "sensors.encoder.zero=0.5", "--print-config")
    assert "\nprofile: worn\n" in printed.stdout
    assert "    zero: 0.5\n" in printed.stdout
    assert "    gyro_bias: 0.0005\n" in printed.stdout


def test_a_scenario_and_its_campaign_have_a_profile_and_their_reports_name_it(understudy, tmp_path):
    scenario = tmp_path / "stands.yaml"
    text = ("scenario: It stands\nrobot: go2\nstart: standing\nduration: 0.5\nprofile: harsh\n"
            "expect:\n  - {always: base.tilt < 30 deg, name: stays up}\n")
    scenario.write_text(text)
    done = understudy("rehearse", scenario, "--out", tmp_path / "one")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "<th>Profile of sensors</th><td><code>harsh</code>" in (tmp_path / "one/report.html").read_text()
    done = understudy("rehearse", scenario, "--profile", "worn", "--out", tmp_path / "other")
    assert "<th>Profile of sensors</th><td><code>worn</code>" in (tmp_path / "other/report.html").read_text()
    scenario.write_text(text + "vary:\n  grid: {profile: [ideal, worn, hursh]}\n")
    done = understudy("rehearse", scenario, "--out", tmp_path / "all")
    assert done.returncode == 3
    assert "no profile 'hursh'; did you mean 'harsh'?" in done.stderr
    scenario.write_text(text + "vary:\n  grid: {profile: [ideal, worn]}\n")
    done = understudy("rehearse", scenario, "--out", tmp_path / "all", "--jobs", 1)
    assert done.returncode == 0, done.stdout + done.stderr
    verdict = json.loads(pathlib.Path(tmp_path / "all/verdict.json").read_text())
    assert verdict["passed"] == 2
