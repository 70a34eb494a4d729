"""The clouds of a Go2's lidar, read with the vendor's Python SDK; rates, sizes and layout are those of real ones."""

import math

import pytest

WALL = 1.5  # m ahead
SCENE = f"""<mujoco><worldbody>
  <geom type="plane" size="0 0 1"/>
  <geom type="box" size="0.1 3 1" pos="{WALL + 0.1} 0 1"/>
</worldbody></mujoco>"""
FIELDS = [["x", 0, 7, 1], ["y", 4, 7, 1], ["z", 8, 7, 1], ["intensity", 16, 7, 1], ["ring", 20, 4, 1], ["time", 24, 7, 1]]


@pytest.fixture(scope="module")
def lidar(rehearse, tmp_path_factory):
    scene = tmp_path_factory.mktemp("scene") / "wall.xml"
    scene.write_text(SCENE)
    run = rehearse("go2", "cloud_watch.py", "3", options=("--start", "standing", "--scene", str(scene)))
    assert run.succeeded()
    return run.report


def test_clouds_have_rate_size_and_layout_of_a_real_one(lidar):
    cloud = lidar["cloud"]
    assert cloud["frame"] == "utlidar_lidar"
    assert cloud["fields"] == FIELDS
    assert cloud["point_step"] == 32 and cloud["row_step_fits"]
    assert cloud["hz"] == pytest.approx(15, abs=0.05)
    assert 1200 < cloud["sizes"][0] <= cloud["sizes"][1] <= 1440
    assert cloud["off_grid"] < 0.01
    assert cloud["gaps"] == [0x7F] and cloud["tails"] == [0]


def test_cloud_base_has_part_of_the_same_points(lidar):
    base = lidar["cloud_base"]
    assert base["frame"] == "base_link"
    assert base["fields"] == FIELDS
    assert base["tails"] == [0x7F]
    assert lidar["stamps_shared"] > 0.8, "but for what a best-effort reader loses"
    assert 500 < base["sizes"][0] <= base["sizes"][1] <= 720


def test_a_wall_is_where_it_stands(lidar):
    wall = lidar["wall"]
    assert wall["seen"]["points"] > 200
    away = (WALL - wall["x"]) * math.cos(wall["yaw"])
    assert wall["seen"]["distance"] == pytest.approx(away, abs=0.02)
    assert wall["seen"]["yaw"] == pytest.approx(-wall["yaw"], abs=math.radians(1))


def test_the_switch_turns_it_off_and_on(lidar):
    assert lidar["off"] == 0
    assert lidar["on"] > 3


def test_a_released_motion_service_takes_cloud_base_away_and_not_the_cloud(lidar):
    assert lidar["base_released"] == 0
    assert lidar["cloud_released"] > 3


@pytest.fixture(scope="module")
def sight(rehearse, tmp_path_factory):
    scene = tmp_path_factory.mktemp("scene") / "wall.xml"
    scene.write_text(SCENE)
    run = rehearse("go2", "sight_watch.py", "go2", "3", options=("--start", "standing", "--scene", str(scene)))
    assert run.succeeded()
    return run.report


def test_the_lidars_unit_feels_in_its_own_axes(sight):
    imu = sight["imu"]
    assert imu["frame"] == "utlidar_imu" and imu["hz"] == pytest.approx(250, abs=1)
    # Two real ones: (1.71, -1.86, -9.18), (1.98, -2.79, -9.18).
    assert imu["f"][2] < -9 and math.hypot(*imu["f"]) == pytest.approx(9.81, abs=0.1)


def test_a_deskewed_cloud_is_mostly_zeros_as_a_real_one(sight):
    deskewed = sight["deskewed"]
    assert deskewed["frame"] == "odom"
    assert deskewed["fields"] == [["x", 0], ["y", 4], ["z", 8], ["intensity", 16]]
    assert deskewed["point_step"] == 32 and deskewed["width"] == 10720
    assert 0.86 < deskewed["zeros"] < 0.9


def test_the_range_ahead_is_that_of_the_wall(sight):
    assert sight["ranges"]["frame"] == "base_link"
    away = (WALL - sight["truth"][0]) * math.cos(sight["truth"][2])
    assert sight["ranges"]["clear"] == pytest.approx([away, 2, 2], abs=0.03)


def test_the_map_of_heights_has_the_ground(sight):
    heights = sight["heights"]
    assert heights["frame"] == "odom" and heights["size"] == [128, 128, 128 * 128]
    assert heights["resolution"] == pytest.approx(0.06) and heights["hz"] == pytest.approx(11.44, abs=0.2)
    assert heights["seen"] > 1000 and abs(heights["median"]) < 0.03


def test_voxels_are_full_where_the_wall_and_the_ground_are(sight):
    voxels = sight["voxels"]
    assert voxels["frame"] == "odom" and voxels["size"] == [128, 128, 38, 77824]
    assert voxels["hz"] == pytest.approx(7.3, abs=0.3) and voxels["lowest"] == pytest.approx(-0.575)
    away = (WALL - sight["truth"][0]) * math.cos(sight["truth"][2])
    # Odometry begins where the robot stood; the wall is a plane, and its voxels are those around it.
    assert voxels["wall"] == pytest.approx([away] * len(voxels["wall"]), abs=0.08) and voxels["wall"]
    assert voxels["ground"] > 200


def test_the_state_of_the_maps_is_that_of_both(sight):
    maps = sight["maps"]
    assert maps["hz"] == pytest.approx(11.44, abs=0.2)
    assert 0 < maps["cloud_age"] < 0.2 and maps["odometry_age"] == 0
    assert maps["sizes"] == pytest.approx([sight["heights"]["seen"], maps["full"]], rel=0.1)


def test_every_pose_is_one_of_the_odometry(sight):
    assert sight["odometry_hz"] == pytest.approx(150, abs=3) and sight["pose_hz"] == pytest.approx(18.75, abs=0.4)
    assert sight["shared"] > 0.8, "but for what a best-effort reader loses"


def test_odometry_tells_a_way_that_is_short(sight):
    assert sight["way"]["true"][0] < -0.8
    assert sight["way"]["told"][0] / sight["way"]["true"][0] == pytest.approx(1 / 1.1995, abs=0.03)


def test_what_needs_the_motion_service_stops_with_it(sight):
    released = sight["released"]
    assert released.pop("imu") > 50
    assert set(released.values()) == {0}


def test_a_g1_sends_the_clouds_of_a_mid360(rehearse):
    run = rehearse("g1", "sight_watch.py", "g1", "3", options=("--start", "standing"))
    assert run.succeeded()
    cloud = run.report
    assert cloud["frame"] == "livox_frame" and cloud["hz"] == pytest.approx(10, abs=0.1)
    assert cloud["fields"] == [
        ["x", 0, 7], ["y", 4, 7], ["z", 8, 7], ["intensity", 12, 7], ["tag", 16, 2], ["line", 17, 2], ["timestamp", 18, 8]
    ]  # fmt: skip
    assert cloud["point_step"] == 26 and cloud["width"] == 20000
    assert 0.05 < cloud["zeros"] < 0.6
    assert cloud["imu"]["frame"] == "livox_frame" and cloud["imu"]["hz"] == pytest.approx(200, abs=1)
    assert math.hypot(*cloud["imu"]["f"]) == pytest.approx(1, abs=0.02), "in units of g"
