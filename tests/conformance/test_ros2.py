"""A program on ROS 2 itself, Kilted, with Fast DDS 3 as its middleware and no settings."""

import json

import pytest


@pytest.mark.parametrize("robot, family", [("go2", "go"), ("h1", "go"), ("g1", "hg"), ("r1", "hg")])
def test_a_node_finds_the_robots_topics_hears_one_and_does_it_no_harm(rehearse, robot, family):
    run = rehearse(robot, "ros2_node.py")

    assert run.succeeded()
    told = run.report
    assert told["middleware"] == "rmw_fastrtps_cpp"
    # `ros2 topic echo` and `ros2 bag record` refuse a topic with two types. The node writes /lowcmd in another one.
    several = {topic for topic, types in told["types"].items() if len(types) > 1}
    assert several == {"/lowcmd"}
    assert told["types"]["/lowstate"] == [f"unitree_{family}/msg/LowState"]
    assert f"unitree_{family}/msg/LowCmd" in told["types"]["/lowcmd"]
    assert "unitree_api/msg/Request" in told["types"]["/api/motion_switcher/request"]
    if robot in ("go2", "g1"):  # which tell it
        assert json.loads(told["heard"]) == {"connection_state": "not_connected"}
    assert run.refused == {"unmatched": 1}
    assert run.commands["accepted"] == 0


def test_a_node_on_the_simulated_clock_finds_the_robots_topics_and_hears_one(rehearse):
    run = rehearse("go2", "ros2_node.py", options=("--clock", "simulated"))

    assert run.succeeded()
    assert run.report["types"]["/lowstate"] == ["unitree_go/msg/LowState"]
    assert json.loads(run.report["heard"]) == {"connection_state": "not_connected"}
