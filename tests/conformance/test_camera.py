"""The pictures and the video of robots' cameras, read with the vendor's Python SDK and from the network, and decoded by
ffmpeg and PyAV: what stands in front is where the lens has it."""

import subprocess

import numpy as np
import pytest
from pupil_apriltags import Detector

WIDTH, HEIGHT = 1280, 720
FOCAL, CENTRE = (864.4, 863.7), (639.2, 373.3)
K1, K2, P1, P2 = -0.3546, 0.1021, -0.0016, -0.0012
CAMERA = (0.32715, 0.643)  # m ahead, and over the ground, of a Go2 that is clamped
AWAY = 1.5 - CAMERA[0]  # m to the red face
HALF = (0.3, 0.2)  # m, of its width and height
SCENE = f"""<mujoco><worldbody>
  <light directional="true" dir="1 0 -1" diffuse="0.5 0.5 0.5"/>
  <geom type="plane" size="0 0 1" rgba="0.3 0.3 0.3 1"/>
  <geom type="box" size="0.1 {HALF[0]} {HALF[1]}" pos="1.6 0 {CAMERA[1]}" rgba="0.9 0.05 0.05 1"/>
</worldbody></mujoco>"""


def pixel_of(x, y):
    """By OpenCV's model of a lens: where a direction is seen, x to the right and y down per depth."""
    r2 = x * x + y * y
    radial = 1 + K1 * r2 + K2 * r2 * r2
    u = x * radial + 2 * P1 * x * y + P2 * (r2 + 2 * x * x)
    v = y * radial + P1 * (r2 + 2 * y * y) + 2 * P2 * x * y
    return CENTRE[0] + FOCAL[0] * u, CENTRE[1] + FOCAL[1] * v


def decoded(jpeg):
    """Rows of pixels of red, green, blue."""
    shape = ["ffprobe", "-v", "error", "-show_entries", "stream=width,height,codec_name", "-of", "csv=p=0", jpeg]
    assert subprocess.run(shape, capture_output=True, text=True, check=True).stdout.strip() == f"mjpeg,{WIDTH},{HEIGHT}"
    raw = ["ffmpeg", "-loglevel", "error", "-i", jpeg, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"]
    pixels = subprocess.run(raw, capture_output=True, check=True).stdout
    return np.frombuffer(pixels, np.uint8).reshape(HEIGHT, WIDTH, 3).astype(int)


def red_span(line):
    """The first and the last red pixel of a line, and how many of those between are not."""
    red = np.flatnonzero((line[:, 0] > 2 * line[:, 1]) & (line[:, 0] > 60))
    return red[0], red[-1], red[-1] - red[0] + 1 - len(red)


@pytest.fixture(scope="module")
def front(rehearse, tmp_path_factory):
    folder = tmp_path_factory.mktemp("camera")
    (folder / "scene.xml").write_text(SCENE)
    options = ("--start", "clamped", "--scene", str(folder / "scene.xml"))
    run = rehearse("go2", "camera_watch.py", "front", str(folder / "picture.jpg"), "4", options=options)
    assert run.succeeded()
    return run.report, decoded(folder / "picture.jpg")


def test_a_box_ahead_is_where_the_lens_has_it(front):
    _, picture = front
    (left, row), (right, _) = pixel_of(-HALF[0] / AWAY, 0), pixel_of(HALF[0] / AWAY, 0)
    assert red_span(picture[round(row)]) == (pytest.approx(left, abs=2), pytest.approx(right, abs=2), 0)
    (column, top), (_, bottom) = pixel_of(0, -HALF[1] / AWAY), pixel_of(0, HALF[1] / AWAY)
    assert red_span(picture[:, round(column)]) == (pytest.approx(top, abs=2), pytest.approx(bottom, abs=2), 0)


TAG_ID, TAG_X, TAG_Y = 23, 1.2, 0.15  # m
TAG_FACE = TAG_X - 0.0055  # m: its board is 1 cm thick
TAG_HALF = 0.08  # m


def test_a_detector_of_april_tags_finds_the_corners_where_the_lens_has_them(rehearse, tmp_path):
    middle = CAMERA[1] + 0.05  # m over the ground
    tag = f"[{{kind: tag, id: {TAG_ID}, pos: [{TAG_X}, {TAG_Y}, {middle - 0.1}], yaw: 3.14159265}}]"
    run = rehearse("go2", "camera_watch.py", "front", str(tmp_path / "tag.jpg"), "0",
                   options=("--start", "clamped", "--set", f"objects={tag}"))
    assert run.succeeded()
    grey = decoded(tmp_path / "tag.jpg").mean(axis=2).astype(np.uint8)
    [found] = Detector(families="tag36h11").detect(grey)
    assert found.tag_id == TAG_ID and found.hamming == 0
    away = TAG_FACE - CAMERA[0]
    # To the right and down of the camera's axis; from the lower left one on, against the clock.
    expected = [pixel_of((right - TAG_Y) / away, (down + CAMERA[1] - middle) / away)
                for right, down in ((-TAG_HALF, TAG_HALF), (TAG_HALF, TAG_HALF), (TAG_HALF, -TAG_HALF), (-TAG_HALF, -TAG_HALF))]
    assert np.abs(found.corners - np.array(expected)).max() < 2


def test_pictures_come_while_states_go_on_at_their_rate(front):
    report, _ = front
    assert report["codes"] == [0]
    assert report["pictures"] > 4
    assert_states_go_on(report)


@pytest.mark.parametrize("camera", ["b2_front", "b2_back"])
def test_a_b2_sees_ahead_and_behind(rehearse, tmp_path, camera):
    x = 3 if camera == "b2_front" else -3
    (tmp_path / "scene.xml").write_text(SCENE.replace('pos="1.6 0', f'pos="{x} 0'))
    run = rehearse("b2", "camera_watch.py", camera, str(tmp_path / "picture.jpg"), "0",
                   options=("--start", "clamped", "--scene", str(tmp_path / "scene.xml")))
    assert run.succeeded()
    picture = decoded(tmp_path / "picture.jpg")
    red = (picture[:, :, 0] > 2 * picture[:, :, 1]) & (picture[:, :, 0] > 60)
    assert red.sum() > 10_000
    assert np.flatnonzero(red.any(axis=0)).mean() == pytest.approx(WIDTH / 2, abs=20)


def last_frame(file):
    """The last picture of a file of them."""
    return np.fromfile(file, np.uint8).reshape(-1, HEIGHT, WIDTH, 3)[-1].astype(int)


def assert_shows_the_box(picture):
    """H.264 has half of the resolution in its colours."""
    (left, row), (right, _) = pixel_of(-HALF[0] / AWAY, 0), pixel_of(HALF[0] / AWAY, 0)
    assert red_span(picture[round(row)])[:2] == (pytest.approx(left, abs=4), pytest.approx(right, abs=4))
    (column, top), (_, bottom) = pixel_of(0, -HALF[1] / AWAY), pixel_of(0, HALF[1] / AWAY)
    assert red_span(picture[:, round(column)])[:2] == (pytest.approx(top, abs=4), pytest.approx(bottom, abs=4))


def assert_states_go_on(report):
    """One state in 2 ms of simulated time, but for what a best-effort reader loses on a busy machine."""
    assert report["states_per_tick"] > 0.9
    assert report["pace"] > 0.5


@pytest.fixture(scope="module")
def video(rehearse, tmp_path_factory):
    folder = tmp_path_factory.mktemp("video")
    (folder / "scene.xml").write_text(SCENE)
    options = ("--start", "clamped", "--scene", str(folder / "scene.xml"))
    run = rehearse("go2", "video_watch.py", "1720", str(folder / "frames.rgb"), str(folder / "by_pyav.rgb"), "10",
                   options=options, patience=120)
    assert run.succeeded()
    return run.report, folder / "frames.rgb"


def test_ffmpeg_joins_the_stream_in_its_middle_and_sees_the_box(video):
    _, frames = video
    assert_shows_the_box(last_frame(frames))


def test_pyav_joins_it_too(video):
    _, frames = video
    assert_shows_the_box(last_frame(frames.with_name("by_pyav.rgb")))


def test_the_stream_is_rtp_with_frames_to_join_at_every_two_seconds(video):
    report, _ = video
    assert report["kinds"] == [[0x80, 96]] and report["sources"] == 1
    assert report["longest"] <= 1400
    assert report["lost"] == 0
    assert report["keys"] == pytest.approx(report["seconds"] / 2, abs=1.5)
    assert report["before_keys"] == [[7, 8]]
    assert min(report["steps"]) > 0.03  # s of simulated time; 1/13.8 where the computer draws that fast


def test_states_go_on_at_their_rate_beside_the_stream(video):
    report, _ = video
    assert_states_go_on(report)


@pytest.mark.parametrize("robot, topic", [("go2", "rt/frontvideostream"), ("b2", "rt/front_videohub/videostream")])
def test_the_topic_of_the_video_has_frames_that_ffmpeg_decodes(rehearse, tmp_path, robot, topic):
    (tmp_path / "scene.xml").write_text(SCENE.replace('pos="1.6 0', 'pos="3 0'))
    run = rehearse(robot, "video_topic.py", topic, str(tmp_path / "frames.h264"), "5",
                   options=("--start", "clamped", "--scene", str(tmp_path / "scene.xml")))
    assert run.succeeded()
    assert run.report["others"] == 0
    times = run.report["times"]
    assert times == sorted(set(times))
    raw = ["ffmpeg", "-loglevel", "error", "-f", "h264", "-i", tmp_path / "frames.h264", "-f", "rawvideo", "-pix_fmt", "rgb24",
           tmp_path / "frames.rgb"]  # fmt: skip
    subprocess.run(raw, check=True)
    picture = last_frame(tmp_path / "frames.rgb")
    assert ((picture[:, :, 0] > 2 * picture[:, :, 1]) & (picture[:, :, 0] > 60)).sum() > 10_000
