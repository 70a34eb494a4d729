"""Clouds and poses of a recording, as rosbags decodes them."""

import numpy as np


def rotation_of(q):
    w, x, y, z = q.w, q.x, q.y, q.z
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def pose_of(position, orientation):
    """A 4 x 4 matrix."""
    pose = np.eye(4)
    pose[:3, :3] = rotation_of(orientation)
    pose[:3, 3] = position.x, position.y, position.z
    return pose


def field_of(cloud, name, kind="<f4"):
    """Of each point, a field of that kind."""
    [offset] = [field.offset for field in cloud.fields if field.name == name]
    rows = np.asarray(cloud.data).reshape(-1, cloud.point_step)
    return rows[:, offset:offset + np.dtype(kind).itemsize].copy().view(kind)[:, 0].astype(float)


def points_of(cloud):
    """Rows of x, y, z in the cloud's frame."""
    return np.column_stack([field_of(cloud, axis) for axis in "xyz"])
