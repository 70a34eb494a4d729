"""Reads what the programs of a lidar make of its clouds with the vendor's Python SDK, walks, and releases the motion
service. Prints what it found as one JSON object.

    sight_watch.py go2|g1 SECONDS
"""

import math
import sys
import time
from dataclasses import dataclass

import lz4.block
import numpy as np
from base_truth import Truth, way_from
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.annotations import autoid, final
from cyclonedds.idl.types import array, float64, sequence, uint8, uint16, uint32, uint64
from unitree_sdk2py.comm.motion_switcher.motion_switcher_client import MotionSwitcherClient
from unitree_sdk2py.core.channel import ChannelFactoryInitialize, ChannelSubscriber
from unitree_sdk2py.go2.sport.sport_client import SportClient
from unitree_sdk2py.idl.geometry_msgs.msg.dds_ import PointStamped_, PoseStamped_, Quaternion_, Vector3_
from unitree_sdk2py.idl.nav_msgs.msg.dds_ import Odometry_
from unitree_sdk2py.idl.sensor_msgs.msg.dds_ import PointCloud2_
from unitree_sdk2py.idl.std_msgs.msg.dds_ import Header_
from unitree_sdk2py.idl.unitree_go.msg.dds_ import HeightMap_

from ending import end_with


@dataclass
@final
@autoid("sequential")
class Imu_(IdlStruct, typename="sensor_msgs.msg.dds_.Imu_"):
    """As sensor_msgs of ROS 2: the pinned SDK lacks it."""

    header: Header_
    orientation: Quaternion_
    orientation_covariance: array[float64, 9]
    angular_velocity: Vector3_
    angular_velocity_covariance: array[float64, 9]
    linear_acceleration: Vector3_
    linear_acceleration_covariance: array[float64, 9]


@dataclass
@final
@autoid("sequential")
class VoxelMapCompressed_(IdlStruct, typename="unitree_go.msg.dds_.VoxelMapCompressed_"):
    """As unitree_go of ROS 2: the SDK for Python lacks it."""

    stamp: float64
    frame_id: str
    resolution: float64
    origin: array[float64, 3]
    width: array[uint16, 3]
    src_size: uint64
    data: sequence[uint8]


@dataclass
@final
@autoid("sequential")
class VoxelHeightMapState_(IdlStruct, typename="unitree_go.msg.dds_.VoxelHeightMapState_"):
    """As go2_ros2_sdk has it: no SDK of the vendor does."""

    stamp: float64
    stamp_cloud: float64
    stamp_odom: float64
    height_map_size: uint32
    voxel_map_size: uint32


class Topic:
    """What has come on a topic."""

    def __init__(self, name, kind):
        self.messages = []
        self._channel = ChannelSubscriber("rt/utlidar/" + name, kind)
        self._channel.Init(self.messages.append, 300)

    def during(self, seconds):
        before = len(self.messages)
        time.sleep(seconds)
        return len(self.messages) - before


def stamp_of(message):
    return message.header.stamp.sec + 1e-9 * message.header.stamp.nanosec


def hz_of(stamps):
    return (len(stamps) - 1) / (stamps[-1] - stamps[0])


def imu_of(messages):
    f = np.mean([[getattr(m.linear_acceleration, axis) for axis in "xyz"] for m in messages], axis=0)
    return {"frame": messages[0].header.frame_id, "hz": hz_of([stamp_of(m) for m in messages]), "f": list(f)}


def floats_of(message, offset):
    data = np.frombuffer(bytes(message.data), dtype=np.uint8).reshape(message.width, message.point_step)
    return np.ascontiguousarray(data[:, offset : offset + 4]).view(np.float32)[:, 0]


def voxels_of(message):
    """The middles of those that are full, as programs of ROS 2 and WebRTC have them: shape (n, 3), m."""
    bits = np.frombuffer(lz4.block.decompress(bytes(message.data), uncompressed_size=message.src_size), np.uint8)
    z, y, x = np.nonzero(np.unpackbits(bits).reshape(message.width[::-1]))
    return np.array(message.origin) + message.resolution * np.stack([x, y, z], axis=1)


def zeros_in(message):
    return float(np.mean([(floats_of(message, 0) == 0) & (floats_of(message, 4) == 0) & (floats_of(message, 8) == 0)]))


def place_of(pose):
    q = pose.orientation
    yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
    return [pose.position.x, pose.position.y, yaw]


def go2(seconds):
    imu, deskewed = Topic("imu", Imu_), Topic("cloud_deskewed", PointCloud2_)
    ranges, heights = Topic("range_info", PointStamped_), Topic("height_map_array", HeightMap_)
    voxels, maps = Topic("voxel_map_compressed", VoxelMapCompressed_), Topic("map_state", VoxelHeightMapState_)
    odometry, pose = Topic("robot_odom", Odometry_), Topic("robot_pose", PoseStamped_)
    time.sleep(1 + seconds)
    _, truth = Truth().read()
    report = {"imu": imu_of(imu.messages), "truth": truth}
    last = deskewed.messages[-1]
    report["deskewed"] = {
        "frame": last.header.frame_id,
        "fields": [[field.name, field.offset] for field in last.fields],
        "point_step": last.point_step,
        "width": last.width,
        "zeros": zeros_in(last),
    }
    last = ranges.messages[-1]
    report["ranges"] = {"frame": last.header.frame_id, "clear": [last.point.x, last.point.y, last.point.z]}
    last = heights.messages[-1]
    cells = np.array(last.data)
    seen = cells[cells < 1e9]
    report["heights"] = {
        "frame": last.frame_id,
        "size": [last.width, last.height, len(cells)],
        "resolution": last.resolution,
        "hz": hz_of([message.stamp for message in heights.messages]),
        "seen": len(seen),
        "median": float(np.median(seen)),
    }
    last = voxels.messages[-1]
    full = voxels_of(last)
    level = np.abs(full[:, 1]) < 0.5
    report["voxels"] = {
        "frame": last.frame_id,
        "size": [*last.width, last.src_size],
        "hz": hz_of([message.stamp for message in voxels.messages]),
        "lowest": last.origin[2],
        "wall": list(np.unique(full[level & (full[:, 2] > 0.2), 0])),
        "ground": int(np.sum(np.abs(full[:, 2]) < 0.05)),
    }
    last = maps.messages[-1]
    report["maps"] = {
        "hz": hz_of([message.stamp for message in maps.messages]),
        "cloud_age": last.stamp - last.stamp_cloud,
        "odometry_age": last.stamp - last.stamp_odom,
        "sizes": [last.height_map_size, last.voxel_map_size],
        "full": len(full),
    }
    odometries = list(odometry.messages)
    by_stamp = {stamp_of(m): place_of(m.pose.pose) for m in odometries}
    poses = [m for m in list(pose.messages) if stamp_of(m) <= max(by_stamp)]
    report["odometry_hz"], report["pose_hz"] = hz_of(sorted(by_stamp)), hz_of([stamp_of(m) for m in poses])
    known = [m for m in poses if stamp_of(m) >= min(by_stamp)]
    report["shared"] = sum(by_stamp.get(stamp_of(m)) == place_of(m.pose) for m in known) / len(known)

    sport = SportClient()
    sport.SetTimeout(10)
    sport.Init()
    sport.BalanceStand()
    time.sleep(1)
    told, truth = place_of(odometry.messages[-1].pose.pose), Truth().read()[1]
    for _ in range(30):
        sport.Move(-0.5, 0, 0)
        time.sleep(0.1)
    sport.StopMove()
    time.sleep(2)
    now = place_of(odometry.messages[-1].pose.pose), Truth().read()[1]
    report["way"] = {"told": way_from(told, now[0]), "true": way_from(truth, now[1])}

    switcher = MotionSwitcherClient()
    switcher.SetTimeout(5)
    switcher.Init()
    switcher.ReleaseMode()
    time.sleep(0.2)
    topics = {"imu": imu, "deskewed": deskewed, "ranges": ranges, "heights": heights, "voxels": voxels, "maps": maps, "odometry": odometry, "pose": pose}
    report["released"] = {name: topic.during(0.3) for name, topic in topics.items()}
    return report


def g1(seconds):
    cloud, imu = Topic("cloud_livox_mid360", PointCloud2_), Topic("imu_livox_mid360", Imu_)
    time.sleep(1 + seconds)
    last = cloud.messages[-1]
    return {
        "frame": last.header.frame_id,
        "fields": [[field.name, field.offset, field.datatype] for field in last.fields],
        "point_step": last.point_step,
        "width": last.width,
        "zeros": zeros_in(last),
        "hz": hz_of([stamp_of(message) for message in cloud.messages]),
        "imu": imu_of(imu.messages),
    }


if __name__ == "__main__":
    ChannelFactoryInitialize(0, "lo")
    end_with({"go2": go2, "g1": g1}[sys.argv[1]](float(sys.argv[2])))
