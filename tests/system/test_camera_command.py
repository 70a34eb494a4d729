"""`understudy camera`, and the example that publishes what it shows."""

import json
import math
import os
import pathlib
import signal
import subprocess
import sys

import numpy as np
import pytest
import zmq

from robots import eventually

UNDERSTUDY = os.environ["UNDERSTUDY"]
EXAMPLE = pathlib.Path(__file__).parents[2] / "examples" / "python" / "image_server.py"
BEGIN, END = b"\xff\xd8", b"\xff\xd9"
PITCH, FOCAL_V, CENTRE_V = 0.8307767, 606.3, 247.6  # of a G1's: rad, pixels
AHEAD, UP = 0.0576235, 0.42987  # m: from the waist's joint to the camera, in the torso
WAIST_OVER_BASE, WAIST_PITCH = 0.044, 21  # m; its place in qpos


def size_of(jpeg):
    """Width and height, as ffprobe reads them."""
    asked = ["ffprobe", "-v", "error", "-show_entries", "stream=width,height", "-of", "csv=p=0", "-f", "mjpeg", "-"]
    return subprocess.run(asked, input=jpeg, capture_output=True, check=True).stdout.decode().strip()


def depths(file):
    """Of a PNG of 640 by 480 pixels, in m."""
    raw = ["ffmpeg", "-loglevel", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "gray16le", "-"]
    return np.frombuffer(subprocess.run(raw, capture_output=True, check=True).stdout, "<u2").reshape(480, 640) / 1000


@pytest.fixture
def robot(play):
    return play("g1", "--start", "clamped")


def test_a_camera_is_listed_and_its_picture_saved_once(robot, understudy, tmp_path):
    listed = understudy("camera").stdout.split("\n")
    assert listed[1].split() == ["head", "640x480", "yes", "none", "none"]
    assert listed[2].split() == ["head_stereo", "1280x480", "none", "none", "none"]
    assert [line.split()[0] for line in listed[3:5]] == ["left_wrist", "right_wrist"]
    file = tmp_path / "head.jpg"
    assert understudy("camera", "head", "--out", file).returncode == 0
    assert size_of(file.read_bytes()) == "640,480"

    file.write_text("mine")
    refused = understudy("camera", "head", "--out", file)
    assert refused.returncode == 9 and "exists already" in refused.stderr
    assert file.read_text() == "mine"
    assert understudy("camera", "head", "--out", file, "--overwrite").returncode == 0
    assert file.read_bytes().startswith(BEGIN)

    nowhere = understudy("camera", "head", "--out", tmp_path / "none" / "x.jpg")
    assert nowhere.returncode == 1 and "no folder" in nowhere.stderr
    no_name = understudy("camera", "a b", "--out", tmp_path / "x.jpg")
    assert no_name.returncode == 1 and "no camera 'a b'" in no_name.stderr
    unknown = understudy("camera", "haed", "--out", tmp_path / "x.jpg")
    assert unknown.returncode == 1 and "did you mean 'head'?" in unknown.stderr
    assert not (tmp_path / "x.jpg").exists()


def test_a_stream_has_whole_pictures_and_ends_in_time_or_with_its_reader(robot):
    command = [UNDERSTUDY, "camera", "head", "--out", "-", "--hz", "20"]
    done = subprocess.run([*command, "--seconds", "4"], capture_output=True, timeout=60)
    assert done.returncode == 0
    assert done.stdout.startswith(BEGIN) and done.stdout.endswith(END)
    assert done.stdout.count(END + BEGIN) >= 1
    with subprocess.Popen(command, stdout=subprocess.PIPE) as reader_gone:
        assert reader_gone.stdout.read(2) == BEGIN
        reader_gone.stdout.close()
        assert reader_gone.wait(60) == -signal.SIGPIPE


def test_its_depth_is_that_of_the_ground_before_it(robot, understudy, tmp_path):
    file = tmp_path / "depth.png"
    assert understudy("ctl", "pause").returncode == 0  # its waist gives way, slowly
    assert understudy("camera", "head", "--depth", "--out", file).returncode == 0
    qpos = json.loads(understudy("ctl", "snapshot", "--parts", "qpos").stdout)["qpos"]
    waist = qpos[WAIST_PITCH]
    depth = depths(file)
    # How far down a pixel's point lies below the camera, which looks PITCH below the torso's horizon.
    down = (np.arange(480) - CENTRE_V)[:, np.newaxis] / FOCAL_V
    below = depth * (math.sin(PITCH + waist) + down * math.cos(PITCH + waist))
    camera = qpos[2] + WAIST_OVER_BASE + UP * math.cos(waist) - AHEAD * math.sin(waist)
    ground = below[:240]  # its upper half, where no part of the robot is
    assert (ground > 0).mean() > 0.9
    assert np.median(ground) == pytest.approx(camera, abs=0.02)
    assert np.percentile(np.abs(ground - np.median(ground)), 80) < 0.01
    refused = understudy("camera", "head", "--depth", "--out", file)
    assert refused.returncode == 9 and "exists already" in refused.stderr


def test_the_cameras_at_the_wrists_see_their_own_grippers(play, understudy, tmp_path):
    play("g1", "--start", "clamped", "--hands", "dex1")
    seen = []
    for side in ("left", "right"):
        file = tmp_path / f"{side}.png"
        assert understudy("camera", f"{side}_wrist", "--depth", "--out", file).returncode == 0
        seen.append(depths(file))
    left, right = seen
    gripper = left[260:470, 170:310]  # the camera is 2.5 cm beside its middle, towards the body
    assert (gripper > 0).mean() > 0.5
    assert np.median(gripper[gripper > 0]) == pytest.approx(0.127, abs=0.015)
    mirrored = right[260:470, 330:470]
    assert np.median(mirrored[mirrored > 0]) == pytest.approx(0.127, abs=0.015)
    assert (mirrored > 0).mean() > 0.5
    assert not left[:100].any()  # the ground is farther than it measures


def test_a_stream_of_depth_is_files_of_png(robot):
    command = [UNDERSTUDY, "camera", "head", "--depth", "--out", "-", "--hz", "20", "--seconds", "3"]
    done = subprocess.run(command, capture_output=True, timeout=60)
    assert done.returncode == 0 and done.stdout.startswith(b"\x89PNG") and done.stdout.count(b"IEND") >= 1


def test_a_camera_that_measures_no_depth_says_so(play, understudy, tmp_path):
    play("go2")
    assert understudy("camera").stdout.split("\n")[1].split()[:3] == ["front", "1280x720", "none"]
    refused = understudy("camera", "front", "--depth", "--out", tmp_path / "depth.png")
    assert refused.returncode == 1 and "the camera front measures no depth" in refused.stderr
    assert not (tmp_path / "depth.png").exists()


def test_a_camera_that_loses_every_picture_sends_none_until_that_is_over(robot, understudy):
    assert understudy("ctl", "fault", "camera.head", "lossy", "--by", "1").returncode == 0
    assert "gives no picture this time" in understudy("camera", "head", "--out", "x.jpg").stderr
    with subprocess.Popen([UNDERSTUDY, "camera", "head", "--out", "-"], stdout=subprocess.PIPE) as stream:
        assert understudy("ctl", "fault", "camera.head", "none").returncode == 0
        assert stream.stdout.read(2) == BEGIN
        stream.terminate()


@pytest.fixture
def serve():
    """Starts the image server with those options."""
    path = f"{pathlib.Path(UNDERSTUDY).parent}:{os.environ['PATH']}"
    started = []

    def start(*options):
        started.append(subprocess.Popen([sys.executable, EXAMPLE, *options], env={**os.environ, "PATH": path}))
        return started[-1]

    yield start
    for server in started:
        server.terminate()
        server.wait(60)


def connected(kind, port):
    """As teleimager's client connects."""
    socket = zmq.Context.instance().socket(kind)
    socket.setsockopt(zmq.LINGER, 0)
    socket.setsockopt(zmq.RCVTIMEO, 60_000)
    if kind == zmq.SUB:
        socket.setsockopt(zmq.CONFLATE, 1)
        socket.setsockopt(zmq.SUBSCRIBE, b"")
    socket.connect(f"tcp://127.0.0.1:{port}")
    return socket


def served():
    """What the server answers to the request of teleimager's client."""
    with connected(zmq.REQ, 60000) as socket:
        socket.send(b"GET_DATA")
        return socket.recv_json()


def looks(server):
    """How many programs of the server look through a camera."""
    return len(pathlib.Path(f"/proc/{server.pid}/task/{server.pid}/children").read_text().split())


def test_the_image_server_sends_head_and_wrists_as_teleimager_does(robot, serve):
    server = serve()
    cameras = served()
    assert list(cameras) == ["head_camera", "left_wrist_camera", "right_wrist_camera"]
    assert [camera["zmq_port"] for camera in cameras.values()] == [55555, 55556, 55557]
    for camera in cameras.values():
        assert camera["enable_zmq"] and not camera["enable_webrtc"] and not camera["binocular"]
        assert camera["image_shape"] == [480, 640] and camera["fps"] == 30
    assert looks(server) == 0  # nobody reads
    pictures = []
    for port in (55555, 55556, 55557):
        with connected(zmq.SUB, port) as socket:
            pictures.append(socket.recv())
            assert pictures[-1].startswith(BEGIN) and pictures[-1].endswith(END)
            assert size_of(pictures[-1]) == "640,480"
            assert size_of(socket.recv()) == "640,480"
    assert len(set(pictures)) == 3
    eventually(lambda: looks(server) == 0)


def test_the_image_server_sends_both_eyes_of_the_head_side_by_side(robot, serve):
    serve("--binocular")
    head = served()["head_camera"]
    assert head["binocular"] and head["image_shape"] == [480, 1280]
    with connected(zmq.SUB, head["zmq_port"]) as socket:
        assert size_of(socket.recv()) == "1280,480"


def test_the_image_server_ends_with_the_robot_that_it_shows(robot, serve):
    server = serve()
    with connected(zmq.SUB, 55555) as socket:
        socket.recv()
        robot.end()
        assert server.wait(60) != 0


def test_the_image_server_offers_no_camera_that_the_robot_lacks(play, serve):
    play("h1", "--start", "clamped")
    server = serve()
    cameras = served()
    assert [camera["enable_zmq"] for camera in cameras.values()] == [True, False, False]
    two = serve("--binocular")
    assert two.wait(60) != 0  # beside the first
    server.terminate()
    assert server.wait(60) == 0
