"""What a user's odometry by lidar, unmodified, makes of the clouds of a walk: kiss-icp, from the recording."""

import numpy as np
import pytest
from kiss_icp.config import KISSConfig
from kiss_icp.kiss_icp import KissICP
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from clouds import field_of, points_of, pose_of
from rehearsals import rehearse_fixture

MOUNT = (0.18, 0, 0.13)  # m: a Mid-360 on a Go2's back, level
# By remote from the hall through the living room into the kitchen and back, by what the robot has reached: a lap has 14.5 m.
# The sticks are let go some 20 degrees before a turn is complete: it goes on that far.
LAP = """
  - {after: previous, remote.sticks: {ly: 0.8, rx: 0}}
  - {after: previous, when: base.y > 1.4, within: 30, remote.sticks: {ly: 0, rx: 0.4}}
  - {after: previous, when: base.yaw < 22 deg, within: 30, remote.sticks: {ly: 0.8, rx: 0}}
  - {after: previous, when: base.x > 3.9, within: 30, remote.sticks: {ly: 0, rx: -0.4}}
  - {after: previous, when: base.yaw > 158 deg, within: 30, remote.sticks: {ly: 0.8, rx: 0}}
  - {after: previous, when: base.x < 1.75, within: 30, remote.sticks: {ly: 0, rx: -0.4}}
  - {after: previous, when: base.yaw > -112 deg and base.yaw < 0 deg, within: 30, remote.sticks: {ly: 0.8, rx: 0}}
  - {after: previous, when: base.y < -2.4, within: 30, remote.sticks: {ly: 0, rx: -0.4}}
  - {after: previous, when: base.yaw > 68 deg, within: 30, remote.sticks: {ly: 0, rx: 0}}"""
SCENARIO = """
scenario: It walks through three rooms and back
robot: go2
start: standing
scene: {scene}
duration: {duration}
settings:
  terrain: {{difficulty: 0}}
  start: {{at: [1.5, -2.7, 1.57]}}
  robot: {{lidar: {{make: Mid-360, pos: {mount}, rpy: [0, 0, 0], noise: 0.02, range: [0.1, 40]}}}}
script:
  - {{at: 1, remote.sticks: {{ly: 0, rx: 0}}}}{laps}
expect:
  - {{always: base.tilt < 25 deg, name: stays up}}
"""
EVERY, THIN = 2, 11  # clouds, and points of each, of which kiss-icp gets one: in no step with its four beams


def read(recording):
    """By time [ns]: clouds, where the robot's odometry and where the simulation have the base."""
    clouds, told, true = [], {}, {}
    cloud, odometry = "/utlidar/cloud_livox_mid360", "/utlidar/robot_odom"
    with AnyReader([recording], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        wanted = [one for one in reader.connections if one.topic in ("/tf", cloud, odometry)]
        for connection, time, raw in reader.messages(wanted):
            message = reader.deserialize(raw, connection.msgtype)
            if connection.topic == cloud:
                points, stamps = points_of(message)[::THIN], field_of(message, "timestamp", "<f8")[::THIN]
                seen = np.any(points != 0, axis=1)
                clouds.append((time, points[seen], stamps[seen]))
            elif connection.topic == odometry:
                told[time] = pose_of(message.pose.pose.position, message.pose.pose.orientation)
            else:
                [base] = [one.transform for one in message.transforms if one.header.frame_id == "world"]
                true[time] = pose_of(base.translation, base.rotation)
    return clouds, told, true


def at(poses, times):
    instants = np.array(sorted(poses))
    return [poses[instants[np.argmin(np.abs(instants - time))]] for time in times]


def by_kiss_icp(clouds):
    """Poses of the lidar in that of the first cloud; settings are kiss-icp's own but for the lidar's range."""
    config = KISSConfig()
    config.data.max_range, config.data.min_range = 40.0, 0.5
    config.mapping.voxel_size = config.data.max_range / 100  # as its pipeline takes it
    config.registration.max_num_threads = 1  # which of several is first moves the last bits
    odometry = KissICP(config)
    poses = []
    for _, points, stamps in clouds:
        odometry.register_frame(points, stamps)
        poses.append(odometry.last_pose)
    return poses


def rms(poses, places):
    return float(np.sqrt(np.mean(np.sum(np.square([pose[:3, 3] for pose in poses] - places), axis=1))))


@pytest.fixture(name="walk")
def walk_fixture(rehearse, tmp_path):
    """walk(scene, laps): metres that were walked; by how many kiss-icp and the robot's odometry are off, from the true begin on."""
    def walk(scene, laps):
        (tmp_path / "walk.yaml").write_text(SCENARIO.format(
            scene=scene, mount=list(MOUNT), laps=LAP * laps, duration=3 + 37 * laps))
        done = rehearse(tmp_path / "walk.yaml", "--no-pictures")
        assert done.returncode == 0, done.stdout + done.stderr
        clouds, told, true = read(tmp_path / "out" / "recording.mcap")
        clouds = clouds[::EVERY]
        mount = np.eye(4)
        mount[:3, 3] = MOUNT
        times = [time for time, *_ in clouds]
        base = at(true, times)
        places = np.array([pose[:3, 3] for pose in base])
        by_lidar = [base[0] @ mount @ pose @ np.linalg.inv(mount) for pose in by_kiss_icp(clouds)]
        told = at(told, times)
        by_legs = [base[0] @ np.linalg.inv(told[0]) @ pose for pose in told]
        way = float(np.sum(np.linalg.norm(np.diff(places[:, :2], axis=0), axis=1)))
        return way, rms(by_lidar, places), rms(by_legs, places)

    return walk


def test_kiss_icp_follows_a_walk_through_three_rooms_better_than_the_legs_do(walk):
    way, by_lidar, by_legs = walk("apartment", laps=2)
    assert way > 28
    assert by_lidar < 0.02 * way
    assert by_lidar < 0.5 * by_legs


def test_kiss_icp_is_lost_where_there_is_nothing_to_see(walk):
    way, by_lidar, by_legs = walk("flat", laps=1)
    assert way > 12
    assert by_lidar > 0.02 * way
    assert by_lidar > by_legs
