"""What a robot in this process takes, tells and refuses."""

import threading

import numpy as np
import pytest

import understudy

STANDS = {"start.pose": "standing", "motion.service": "none"}


def stand(robot, seconds, **command):
    for _ in range(round(seconds / 0.002)):
        robot.command(**({"q": robot.standing, "kp": 60, "kd": 5} | command))
        robot.step(0.002)


def test_a_robot_stands_by_commands_and_falls_without():
    robot = understudy.Robot("go2", set=STANDS)
    stand(robot, 1)
    assert robot.time == pytest.approx(1)
    assert robot.truth.tilt < 0.1 and robot.truth.position[2] > 0.25
    robot.step(2)
    assert robot.truth.position[2] < 0.2


def test_arrays_have_a_value_for_each_motor_and_are_the_callers_own():
    robot = understudy.Robot("g1")
    robot.step()
    for values in (robot.state.q, robot.state.dq, robot.state.tau_est, robot.truth.q, robot.truth.torque, robot.standing):
        assert values.shape == (29,) and values.dtype == np.float64
    q = robot.state.q
    q[:] = 7
    assert robot.state.q[0] != 7


def test_there_is_no_state_before_the_first_step():
    robot = understudy.Robot("go2")
    with pytest.raises(RuntimeError, match="before the first step"):
        robot.state
    assert robot.truth.position.shape == (3,)


def test_a_state_is_a_lowstate_and_not_what_other_topics_have_between_them():
    robot = understudy.Robot("go2")
    for step in range(12):
        robot.step()
        assert robot.state.tick == step - step % 2


def test_a_state_that_was_read_stays_as_it_was():
    robot = understudy.Robot("go2", set=STANDS)
    robot.step()
    state = robot.state
    tick, q = state.tick, state.q
    stand(robot, 0.1)
    assert state.tick == tick and (state.q == q).all()
    assert robot.state.tick > tick


@pytest.mark.parametrize(
    "q", [0.5, np.float32(0.5), [0.5] * 12, np.full(12, 0.5, np.float32), np.full(24, 0.5)[::2]]
)
def test_a_command_takes_a_number_or_any_array_of_motors(q):
    robot = understudy.Robot("go2", set={"start.pose": "clamped", "motion.service": "none"})
    for _ in range(200):
        robot.command(q=q, kp=60, kd=3)
        robot.step(0.002)
    assert robot.truth.q[0] == pytest.approx(0.5, abs=0.1)


def test_a_command_of_another_shape_or_topic_names_what_was_expected():
    robot = understudy.Robot("go2", set=STANDS)
    with pytest.raises(ValueError, match=r"kp to be .* shape \(12,\), got 3 numbers"):
        robot.command(kp=[1, 2, 3])
    with pytest.raises(ValueError, match="rt/lowcmd, got 'rt/arm_sdk'"):
        robot.command(topic="rt/arm_sdk")


def test_hands_and_arms_are_commanded_by_their_topics():
    robot = understudy.Robot("g1_29dof_dex3")
    with pytest.raises(ValueError, match="rt/dex3/left/cmd"):
        robot.command(topic="rt/dex3/lfet/cmd")
    robot.command(topic="rt/dex3/left/cmd", q=np.zeros(7), kp=1, kd=0.1)
    robot.command(topic="rt/arm_sdk", q=robot.standing, kp=40, kd=1, weight=1)
    robot.step(0.02)
    assert not [event for event in robot.take_events() if event["kind"] == "refused"]


def finger(robot, motor):
    """The angle of a motor of the left hand; hands stand behind the body."""
    return robot.truth.q[len(robot.joints) + motor]


@pytest.mark.parametrize("make, topic, index", [
    ("inspire_ftp", "rt/inspire_hand/ctrl/l", 3),
    ("brainco", "rt/brainco/left/cmd", 2),
])
def test_a_hand_that_follows_goals_goes_to_an_angle_alone_and_slower_when_told(make, topic, index):
    def reached(**speed):
        robot = understudy.Robot("g1", set={"robot.hand_make": make, "start.pose": "clamped"})
        robot.step(0.1)
        robot.command(topic=topic, q=1.2, **speed)
        robot.step(2)
        return finger(robot, index)

    assert reached() == pytest.approx(1.2, abs=0.1)
    assert 0.02 < reached(dq=0.1) < 0.4


def test_an_ftp_hand_without_torque_does_not_close():
    robot = understudy.Robot("g1", set={"robot.hand_make": "inspire_ftp", "start.pose": "clamped"})
    robot.step(0.1)
    robot.command(topic="rt/inspire_hand/ctrl/l", q=1.2, tau=0)
    robot.step(2)
    assert finger(robot, 3) < 0.4


def test_the_truth_has_the_force_on_each_hand():
    assert understudy.Robot("g1", set={"robot.hand_make": "inspire"}).truth.hand_force.tolist() == [0, 0]
    assert understudy.Robot("go2").truth.hand_force.tolist() == []


def test_a_bad_number_is_refused_as_on_the_bus_and_reported():
    robot = understudy.Robot("go2", set=STANDS)
    robot.take_events()
    robot.command(q=float("nan"))
    robot.step()
    (refused,) = [event for event in robot.take_events() if event["kind"] == "refused"]
    assert refused["detail"]["reason"] == "not_finite" and refused["time"] == 0


@pytest.mark.parametrize("seconds", [0, -1, 0.0015, float("nan"), 1e300])
def test_only_whole_numbers_of_steps_are_made(seconds):
    robot = understudy.Robot("go2")
    with pytest.raises(ValueError, match="whole number of steps of 0.001 s"):
        robot.step(seconds)
    assert robot.time == 0


def test_a_request_is_carried_out_on_this_robot_of_its_world():
    world = understudy.World("go2", "g1")
    world.step(0.1)
    go2, g1 = world.robots
    before = [robot.truth.velocity[1] for robot in (go2, g1)]
    g1.request("push", impulse=np.array([0, 20, 0]))
    world.step(0.05)
    moved = [abs(robot.truth.velocity[1] - was) for robot, was in zip((go2, g1), before)]
    assert moved[1] > 0.1 > moved[0]


def test_a_refused_request_raises_with_the_nearest_word():
    robot = understudy.Robot("go2")
    with pytest.raises(understudy.Error, match="did you mean 'push'"):
        robot.request("puhs")
    with pytest.raises(understudy.Error, match="impulse"):
        robot.request("push", impulse="hard")


def test_a_wrong_robot_key_or_file_raises_with_the_nearest_word(tmp_path):
    with pytest.raises(understudy.Error, match="did you mean 'go2'"):
        understudy.Robot("go3")
    with pytest.raises(understudy.Error, match="start.pos'.*did you mean"):
        understudy.Robot("go2", set={"start.pos": "lying"})
    with pytest.raises(understudy.Error, match="missing.yaml"):
        understudy.Robot("go2", config=tmp_path / "missing.yaml")
    with pytest.raises(ValueError, match="name of a robot"):
        understudy.World()


def test_configuration_comes_from_files_and_values(tmp_path):
    file = tmp_path / "slow.yaml"
    file.write_text("physics: {timestep: 0.002}\n")
    robot = understudy.Robot("go2", config=file, set={"terrain.friction": 0.5, "randomization.delay": [0.001, 0.004]})
    assert robot.world.timestep == 0.002
    assert "friction: 0.5" in robot.world.config()
    assert any("delay" in note for note in robot.world.notes)


def test_states_keep_their_rate_at_a_time_step_that_was_drawn():
    robot = understudy.Robot("go2", set={"randomization.timestep": [0.0005, 0.0005], "randomization.seed": 1})
    assert robot.world.timestep == 0.0005
    ticks = set()
    for _ in range(40):
        robot.step(0.0005)
        ticks.add(robot.state.tick)
    assert len(ticks) == 10  # 500 Hz in 20 ms


def test_equal_seeds_give_equal_states_and_others_do_not():
    def states(seed):
        robot = understudy.Robot("go2", set=STANDS, seed=seed)
        stand(robot, 0.2)
        return np.concatenate([robot.state.q, robot.state.gyroscope])

    assert (states(7) == states(7)).all()
    assert (states(7) != states(8)).any()


def test_robots_in_several_threads_are_those_of_one():
    def height(into, number):
        robot = understudy.Robot("go2", set=STANDS, seed=3)
        stand(robot, 0.3)
        into[number] = robot.truth.position[2]

    heights = [None] * 4
    threads = [threading.Thread(target=height, args=(heights, number)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert None not in heights and len(set(heights)) == 1


def test_a_robot_keeps_its_world():
    robots = understudy.World("go2", "go2").robots
    first = robots[0]
    del robots
    first.step(0.01)
    assert len(first.world.robots) == 2


def test_damage_tells_what_the_motors_and_the_pack_have_suffered():
    robot = understudy.Robot("go2", set=STANDS)
    stand(robot, 0.5)
    damage = robot.damage
    assert damage["time"] == pytest.approx(0.5) and damage["energy"] > 1
    assert damage["hottest"].shape == (12,) and damage["falls"] == 0


def test_an_episode_begins_as_a_new_robot_of_that_seed():
    sets = STANDS | {"randomization.mass": [0.8, 1.2], "randomization.kp": [0.8, 1.2]}

    def told(robot):
        stand(robot, 0.2)
        return np.concatenate([robot.state.q, robot.state.gyroscope, robot.truth.torque])

    robot = understudy.Robot("go2", set=sets, seed=4)
    fourth = told(robot)
    robot.command(q=robot.standing)  # that waits, and is gone
    robot.begin(9)
    assert robot.time == 0 and not [event for event in robot.take_events() if event["time"] > 0]
    assert (told(robot) == told(understudy.Robot("go2", set=sets, seed=9))).all()
    robot.begin(4)
    assert (told(robot) == fourth).all()
