"""What a user's odometry by lidar, unmodified, makes of the clouds of a walk: kiss-icp, from the recording."""

import math
import pathlib

import numpy as np
import pytest
import yaml
from kiss_icp.config import KISSConfig
from kiss_icp.kiss_icp import KissICP
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from clouds import field_of, points_of, pose_of
from rehearsals import rehearse_fixture

ROOT = pathlib.Path(__file__).parents[2]
# Four rounds of 2.6 m across through the living room: some 32 m.
SCENARIO = """
scenario: It walks round and round
robot: go2
start: standing
scene: {scene}
duration: 74
settings:
  terrain: {{difficulty: 0}}
  start: {{at: [0.9, -0.8, 0]}}
script:
  - {{at: 1, remote.sticks: {{ly: 0.5, rx: -0.25}}}}
  - {{at: 73, remote.sticks: {{ly: 0, rx: 0}}}}
expect:
  - {{always: base.tilt < 25 deg, name: stays up}}
"""
AT_ONCE = 10  # clouds of a frame of kiss-icp: most points of one are the robot's own and the ground beside it
ROBOT = ((-0.6, -0.33), (0.42, 0.33))  # m, in its base: what is above that is its own


def read(recording):
    """By time [ns]: clouds, where the robot's odometry and where the simulation have the base."""
    clouds, told, true = [], {}, {}
    with AnyReader([recording], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        wanted = [one for one in reader.connections if one.topic in ("/tf", "/utlidar/cloud", "/utlidar/robot_odom")]
        for connection, time, raw in reader.messages(wanted):
            message = reader.deserialize(raw, connection.msgtype)
            if connection.topic == "/utlidar/cloud":
                clouds.append((time, points_of(message), field_of(message, "time")))
            elif connection.topic == "/utlidar/robot_odom":
                told[time] = pose_of(message.pose.pose.position, message.pose.pose.orientation)
            else:
                [base] = [one.transform for one in message.transforms if one.header.frame_id == "world"]
                true[time] = pose_of(base.translation, base.rotation)
    return clouds, told, true


def at(poses, time):
    return poses[min(poses, key=lambda one: abs(one - time))]


def by_kiss_icp(clouds, mount):
    """Instants [ns], and by them poses of the lidar in that of the first."""
    config = KISSConfig()
    config.data.max_range, config.data.min_range, config.data.deskew = 20.0, 0.1, True
    config.mapping.voxel_size = 0.2
    config.adaptive_threshold.initial_threshold = 1.0
    config.registration.max_num_iterations, config.registration.max_num_threads = 50, 1
    odometry = KissICP(config)
    times, poses = [], []
    for first in range(0, len(clouds) - AT_ONCE + 1, AT_ONCE):
        frame = clouds[first:first + AT_ONCE]
        points = np.vstack([points for _, points, _ in frame])
        stamps = np.concatenate([1e-9 * (end - frame[0][0]) + stamps for end, _, stamps in frame])
        in_base = points @ mount[:3, :3].T + mount[:3, 3]
        others = np.any((in_base[:, :2] < ROBOT[0]) | (in_base[:, :2] > ROBOT[1]), axis=1)
        odometry.register_frame(points[others], stamps[others])
        times.append(frame[-1][0])
        poses.append(odometry.last_pose)
    return times, poses


def rms(errors):
    return float(np.sqrt(np.mean(np.sum(np.square(errors), axis=1))))


@pytest.fixture(name="walk")
def walk_fixture(rehearse, tmp_path):
    """walk(scene): metres that were walked; by how many kiss-icp and the robot's odometry are off, both from the true begin on."""
    def walk(scene):
        (tmp_path / "walk.yaml").write_text(SCENARIO.format(scene=scene))
        done = rehearse(tmp_path / "walk.yaml", "--no-pictures")
        assert done.returncode == 0, done.stdout + done.stderr
        clouds, told, true = read(tmp_path / "out" / "recording.mcap")
        lidar = yaml.safe_load((ROOT / "config" / "robots" / "go2.yaml").read_text())["robot"]["lidar"]
        roll, pitch, yaw = lidar["rpy"]
        mount = np.eye(4)
        mount[:3, :3] = turned(2, yaw) @ turned(1, pitch) @ turned(0, roll)
        mount[:3, 3] = lidar["pos"]
        times, seen = by_kiss_icp(clouds, mount)
        base = [at(true, time) for time in times]
        places = np.array([pose[:3, 3] for pose in base])
        by_lidar = [base[0] @ mount @ pose @ np.linalg.inv(mount) for pose in seen]
        origin = base[0] @ np.linalg.inv(at(told, times[0]))
        by_legs = [origin @ at(told, time) for time in times]
        way = float(np.sum(np.linalg.norm(np.diff(places[:, :2], axis=0), axis=1)))
        return way, *(rms(np.array([pose[:3, 3] for pose in poses]) - places) for poses in (by_lidar, by_legs))

    return walk


def turned(axis, angle):
    """A rotation about x, y or z."""
    c, s = math.cos(angle), math.sin(angle)
    rotation = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    rotation[i, i], rotation[i, j], rotation[j, i], rotation[j, j] = c, -s, s, c
    return rotation


def test_kiss_icp_follows_a_walk_through_a_room_to_two_hundredths_of_its_way(walk):
    way, by_lidar, by_legs = walk("apartment")
    assert way > 28
    assert by_lidar < 0.02 * way, f"the robot's own odometry: {by_legs:.2f} m"


def test_kiss_icp_is_lost_where_there_is_nothing_to_see(walk):
    way, by_lidar, _ = walk("flat")
    assert way > 28
    assert by_lidar > 0.02 * way
