"""What a Go2's lidar saw, read from its recording by a reader of ROS 2 bags that knows none of our types."""

import math
import sys
from unittest import mock

import numpy as np
import pytest
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

from clouds import points_of, rotation_of
from rehearsals import rehearse_fixture

# What open3d draws in a browser with; no plane needs it.
sys.modules.update({module: mock.MagicMock() for module in ("dash", "plotly", "plotly.graph_objects")})
import open3d  # noqa: E402

FACE = 1.0  # m: x of the wall's face
TOO_HIGH = 0.02467  # m: all of cloud_base, as a real one's (base_pos in config/robots/go2.yaml)
WALL = f"""<mujoco><worldbody>
  <geom type="plane" size="0 0 1"/>
  <geom type="box" size="0.1 1 0.5" pos="{FACE + 0.1} 0 0.5"/>
</worldbody></mujoco>"""
# A scan of the same: the floor, and the face of the wall.
SCAN = f"""
v -9 -9 0
v 9 -9 0
v 9 9 0
v -9 9 0
f 1 2 3 4
v {FACE} -1 0
v {FACE} 1 0
v {FACE} 1 1
v {FACE} -1 1
f 8 7 6 5
"""
LOOKS = """
scenario: It looks at a wall
robot: go2
start: standing
scene: {scene}
duration: 2
script:
  - {{at: 0.2, service.call: {{service: sport, api: 1008, parameter: '{{"x": 0, "y": 0, "z": 0.5}}'}}}}
expect:
  - {{always: base.tilt < 30 deg, name: stands}}
"""


@pytest.fixture(params=["wall.xml", "wall.obj"])
def seen(request, rehearse, tmp_path):
    """Points in the world, by cloud_base and the transform of its frame, which has the nearest stamp."""
    (tmp_path / request.param).write_text(SCAN if request.param.endswith("obj") else WALL)
    (tmp_path / "looks.yaml").write_text(LOOKS.format(scene=tmp_path / request.param))
    done = rehearse(tmp_path / "looks.yaml", "--no-pictures", "--profile", "ideal")
    assert done.returncode == 0, done.stdout + done.stderr
    bases, clouds = {}, []
    with AnyReader([tmp_path / "out" / "recording.mcap"], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        wanted = [one for one in reader.connections if one.topic in ("/tf", "/utlidar/cloud_base")]
        for connection, time, raw in reader.messages(wanted):
            message = reader.deserialize(raw, connection.msgtype)
            if connection.topic == "/utlidar/cloud_base":
                clouds.append((time, message.header.frame_id, points_of(message)))
                continue
            [base] = [one.transform for one in message.transforms if one.header.frame_id == "world"]
            at = base.translation
            bases[time] = (np.array([at.x, at.y, at.z]), rotation_of(base.rotation))
    assert len(clouds) > 20 and {frame for _, frame, _ in clouds} == {"base_link"}
    middle = 0.033e9  # ns: half of what a cloud lasts
    placed = []
    for time, _, points in clouds:
        at, turned = bases[min(bases, key=lambda stamp: abs(stamp - (time - middle)))]
        placed.append(points @ turned.T + at)
    return np.vstack(placed)


def test_a_plane_through_what_it_saw_of_a_wall_is_the_wall(seen):
    wall = seen[(np.abs(seen[:, 0] - FACE) < 0.1) & (np.abs(seen[:, 1]) < 0.9) & (seen[:, 2] > 0.1) & (seen[:, 2] < 0.9)]
    assert len(wall) > 500
    middle = wall.mean(axis=0)
    normal = np.linalg.svd(wall - middle, full_matrices=False)[2][2]
    assert math.degrees(math.acos(abs(normal[0]))) < 1
    assert middle[0] == pytest.approx(FACE, abs=0.02)


def test_the_ground_is_a_plane_beneath_it(seen):
    ground = seen[(np.abs(seen[:, 2]) < 0.1) & (seen[:, 0] < FACE - 0.2) & (np.hypot(seen[:, 0], seen[:, 1]) < 3)]
    assert len(ground) > 500
    middle = ground.mean(axis=0)
    normal = np.linalg.svd(ground - middle, full_matrices=False)[2][2]
    assert math.degrees(math.acos(abs(normal[2]))) < 1


def planes_of(points):
    """The four largest, one after another: unit normals, and what is to be added to a point's part along it."""
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    open3d.utility.random.seed(1)
    for _ in range(4):
        plane, inside = cloud.segment_plane(distance_threshold=0.02, ransac_n=3, num_iterations=1000)
        yield np.array(plane) / np.linalg.norm(plane[:3])
        cloud = cloud.select_by_index(inside, invert=True)


@pytest.mark.parametrize(("middle", "normal"), [((FACE, 0, 0.5), (1, 0, 0)), ((0, 0, 0), (0, 0, 1))])
def test_open3d_finds_the_wall_and_the_ground_by_itself(seen, middle, normal):
    planes = planes_of(seen - [0, 0, TOO_HIGH])
    off = [(math.degrees(math.acos(min(1, abs(plane[:3] @ normal)))), abs(plane[:3] @ middle + plane[3])) for plane in planes]
    assert min(off)[0] < 1 and min(off)[1] < 0.02, off
