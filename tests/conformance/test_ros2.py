"""A program on ROS 2 itself, Kilted, with Fast DDS 3 as its middleware and no settings."""

import json

import pytest


@pytest.mark.parametrize("family", ["go", "hg"])
def test_a_node_finds_the_robots_topics_hears_one_and_does_it_no_harm(rehearse, family):
    run = rehearse({"go": "go2", "hg": "g1"}[family], "ros2_node.py")

    assert run.succeeded()
    told = run.report
    assert told["middleware"] == "rmw_fastrtps_cpp"
    assert f"unitree_{family}/msg/LowState" in told["types"]["/lowstate"]
    assert f"unitree_{family}/msg/LowCmd" in told["types"]["/lowcmd"]
    assert "unitree_api/msg/Request" in told["types"]["/api/sport/request"]
    assert json.loads(told["heard"]) == {"connection_state": "not_connected"}
    assert run.refused == {"unmatched": 1}
    assert run.commands["accepted"] == 0
