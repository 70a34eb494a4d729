"""Pictures and films without a display: `understudy picture` and `understudy film`."""

import json
import os
import pathlib
import signal
import struct
import subprocess
import time

import pytest
from mcap.writer import Writer

from robots import PATIENCE, eventually


def without_display():
    return {name: value for name, value in os.environ.items() if name != "DISPLAY"}


def size_of(png):
    head = png.read_bytes()[:24]
    assert head[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", head[16:24])


def pixels_of(png):
    """Each pixel's red, green and blue, row by row."""
    raw = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", png, "-f", "rawvideo", "-pix_fmt", "rgb24", "-"],
                         capture_output=True, check=True).stdout
    return [tuple(raw[i:i + 3]) for i in range(0, len(raw), 3)]


def colors_of(png):
    """How many different pixels a picture has."""
    return len(set(pixels_of(png)))


def probe(film):
    """What ffprobe says of the pictures in a film."""
    done = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", film],
                          capture_output=True, check=True)
    stream, = json.loads(done.stdout)["streams"]
    return stream



@pytest.mark.parametrize("gl", ["egl", "osmesa"])
def test_a_picture_has_the_size_that_was_asked_for_and_something_in_it(play, understudy, tmp_path, gl):
    robot = play("go2")
    picture = tmp_path / "go2.png"
    done = understudy("picture", picture, "--name", robot.name, "--size", "200x120", "--gl", gl,
                      env=without_display())

    assert done.returncode == 0, done.stderr
    assert size_of(picture) == (200, 120)
    assert colors_of(picture) > 100


def test_where_egl_has_no_driver_osmesa_draws(play, understudy, tmp_path):
    robot = play("go2")
    here = ("--name", robot.name, "--size", "32x32")
    no_drivers = {**without_display(), "__EGL_VENDOR_LIBRARY_FILENAMES": "/dev/null"}
    done = understudy("picture", tmp_path / "a.png", *here, "--gl", "egl", env=no_drivers)
    assert done.returncode == 1
    assert "apt-get install" in done.stderr

    done = understudy("picture", tmp_path / "a.png", *here, env=no_drivers)
    assert done.returncode == 0, done.stderr


def test_a_picture_shows_what_is_asked_for(play, understudy, tmp_path):
    robot = play("go2", "--start", "hanging")
    plain, collision = tmp_path / "plain.png", tmp_path / "collision.png"
    look = ("--name", robot.name, "--size", "160x120", "--track", "FR_calf", "--distance", 1)
    assert understudy("picture", plain, *look).returncode == 0
    assert understudy("picture", collision, *look, "--show", "collision,com,joints").returncode == 0
    assert plain.read_bytes() != collision.read_bytes()


def test_a_robot_is_drawn_by_another_copy_of_its_meshes(play, understudy, tmp_path):
    (tmp_path / "copy").mkdir()
    (tmp_path / "copy/block.obj").write_text(
        "v 0 0 0\nv .3 0 0\nv 0 .3 0\nv 0 0 .3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
    (tmp_path / "copy/dog.xml").write_text(
        '<mujoco><asset><mesh name="block" file="block.obj"/></asset><worldbody><body name="base_link">'
        '<geom type="mesh" mesh="block" rgba="1 0 1 1"/></body></worldbody></mujoco>')
    robot = play("go2", "--start", "hanging", "--look", tmp_path / "copy")
    picture = tmp_path / "look.png"
    done = understudy("picture", picture, "--name", robot.name, "--size", "160x120")

    assert done.returncode == 0, done.stderr
    said = f"drawn by the meshes of {tmp_path}/copy/dog.xml, 1 bodies"
    assert any(said in line["message"] for line in robot.log())
    magenta = [p for p in pixels_of(picture) if p[0] > 2 * p[1] and p[2] > 2 * p[1]]
    assert len(magenta) > 50


def test_a_robot_is_drawn_by_meshes_of_collada_in_their_colours(play, understudy, tmp_path):
    dae = pathlib.Path(__file__).parents[1] / "fuzz/corpus/dae/two_colours"  # flat
    (tmp_path / "flat.dae").write_text(dae.read_text().replace("<color>1 0.5 0 0.2<", "<color>1 0 1 1<"))
    (tmp_path / "dog.urdf").write_text(
        '<robot name="dog"><link name="base_link"><visual><origin xyz="0.5 -0.5 -0.8"/><geometry>'
        '<mesh filename="flat.dae"/></geometry></visual></link></robot>')
    robot = play("go2", "--start", "hanging", "--look", tmp_path / "dog.urdf")
    picture = tmp_path / "look.png"
    done = understudy("picture", picture, "--name", robot.name, "--size", "160x120", "--elevation", -60)

    assert done.returncode == 0, done.stderr
    assert any(f"{tmp_path}/dog.urdf, 1 bodies" in line["message"] for line in robot.log())
    magenta = [p for p in pixels_of(picture) if p[0] > 1.3 * p[1] and p[2] > 1.3 * p[1]]
    assert len(magenta) > 50


RED_WALLS = {
    "wall.xml": '<mujoco><worldbody><geom type="plane" size="0 0 1"/>'
                '<geom type="box" size="0.1 3 3" pos="1.6 0 3" rgba="1 0 0 1"/></worldbody></mujoco>',
    "scan.obj": "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\nv 1.5 -3 0 1 0 0\nv 1.5 3 0 1 0 0\n"
                "v 1.5 3 6 1 0 0\nv 1.5 -3 6 1 0 0\nf 8 7 6 5\n",
}


@pytest.mark.parametrize("scene", RED_WALLS)
def test_a_picture_is_taken_from_where_the_robots_camera_is(play, understudy, tmp_path, scene):
    (tmp_path / scene).write_text(RED_WALLS[scene])
    scene = tmp_path / scene
    robot = play("go2", "--start", "clamped", "--scene", scene)
    picture = tmp_path / "front.png"
    done = understudy("picture", picture, "--name", robot.name, "--size", "32x18", "--camera", "front")
    assert done.returncode == 0, done.stderr
    red, green, blue = pixels_of(picture)[9 * 32 + 16]
    assert red > 2 * green and red > 2 * blue


def test_a_picture_is_refused_with_a_reason(play, understudy, tmp_path):
    robot = play("go2")
    there = tmp_path / "there.png"
    there.write_bytes(b"mine")
    here = ("--name", robot.name, "--size", "32x32")
    for arguments, code, words in (
            ((there, *here), 9, ["there.png", "--overwrite"]),
            ((tmp_path / "no" / "a.png", *here), 1, ["no folder"]),
            ((tmp_path / "a.png", *here, "--camera", "frnt"), 4, ["frnt"]),
            ((tmp_path / "a.png", *here, "--track", "FR_caf"), 4, ["FR_caf", "FR_calf"]),
            ((tmp_path / "a.jpg", *here), 2, [".png"]),
            ((tmp_path / "a.png", "--name", robot.name, "--size", "0x9"), 2, ["WIDTHxHEIGHT"]),
            ((tmp_path / "a.png", "--name", "nobody"), 1, ["nobody"])):
        done = understudy("picture", *arguments)
        assert done.returncode == code, (arguments, done.stderr)
        for word in words:
            assert word in done.stderr + done.stdout
    assert there.read_bytes() == b"mine"
    assert understudy("picture", there, *here, "--overwrite").returncode == 0
    assert size_of(there) == (32, 32)


def test_a_film_is_as_long_as_was_asked_for(play, understudy, tmp_path):
    robot = play("go2")
    film = tmp_path / "go2.mp4"
    done = understudy("film", film, "--name", robot.name, "--seconds", 1, "--fps", 10, "--size", "160x90",
                      "--orbit", 40, env=without_display())

    assert done.returncode == 0, done.stderr
    stream = probe(film)
    assert (stream["width"], stream["height"]) == (160, 90)
    assert stream["codec_name"] == "h264"
    assert int(stream["nb_read_frames"]) == 10
    assert float(stream["duration"]) == pytest.approx(1)
    assert list(tmp_path.iterdir()) == [film]


def test_ctrl_c_ends_a_film_that_can_be_played(play, tmp_path):
    robot = play("go2")
    film = tmp_path / "go2.mp4"
    process = subprocess.Popen([os.environ["UNDERSTUDY"], "film", film, "--name", robot.name, "--seconds", "600",
                                "--fps", "10", "--size", "160x90"], stderr=subprocess.PIPE, text=True)
    eventually(lambda: list(tmp_path.glob("*.part")))
    time.sleep(2)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=PATIENCE)

    assert process.returncode == 0, said
    assert 1 <= int(probe(film)["nb_read_frames"]) < 100
    assert list(tmp_path.iterdir()) == [film]


def test_a_film_of_a_robot_that_ends_is_whole(play, tmp_path):
    robot = play("go2")
    film = tmp_path / "go2.mp4"
    process = subprocess.Popen([os.environ["UNDERSTUDY"], "film", film, "--name", robot.name, "--seconds", "600",
                                "--fps", "10", "--size", "160x90"], stderr=subprocess.PIPE, text=True)
    eventually(lambda: list(tmp_path.glob("*.part")))
    time.sleep(1)
    robot.end()
    _, said = process.communicate(timeout=PATIENCE)

    assert process.returncode == 0, said
    assert "ends early" in said
    assert int(probe(film)["nb_read_frames"]) >= 1


def test_a_film_is_refused_with_a_reason(play, understudy, tmp_path):
    robot = play("go2")
    there = tmp_path / "there.mp4"
    there.write_bytes(b"mine")
    here = ("--name", robot.name, "--size", "32x32", "--seconds", 0.2)
    for arguments, code, word in (
            ((there, *here), 9, "--overwrite"),
            ((tmp_path / "a.avi", *here), 2, ".mp4"),
            ((tmp_path / "a.mp4", "--name", robot.name, "--size", "33x32"), 1, "even"),
            ((tmp_path / "a.mp4", *here, "--fps", 0), 2, "--fps")):
        done = understudy("film", *arguments)
        assert done.returncode == code, (arguments, done.stderr)
        assert word in done.stderr + done.stdout
    assert there.read_bytes() == b"mine"


def test_a_film_without_ffmpeg_names_the_package(play, understudy, tmp_path):
    robot = play("go2")
    done = understudy("film", tmp_path / "a.mp4", "--name", robot.name, "--size", "32x32",
                      env={**os.environ, "PATH": str(tmp_path)})
    assert done.returncode == 1
    assert "apt-get install ffmpeg" in done.stderr


@pytest.fixture(scope="module", name="recording")
def recording_fixture(tmp_path_factory):
    """A second of a Go2 that falls: it was held up, and nobody commands it."""
    file = tmp_path_factory.mktemp("recording") / "fall.mcap"
    subprocess.run([os.environ["UNDERSTUDY"], "exec", "go2", "--released", "--start", "hanging", "--speed", "max",
                    "--record", file, "--overwrite", "--", "sleep", "2"], check=True, timeout=PATIENCE)
    return file


def test_a_recording_is_drawn_at_the_time_that_was_asked_for(understudy, recording, tmp_path):
    pictures = [tmp_path / "begin.png", tmp_path / "later.png", tmp_path / "again.png"]
    for picture, at in zip(pictures, (0, 1, 1), strict=True):
        done = understudy("picture", picture, "--recording", recording, "--at", at, "--size", "160x90",
                          "--lookat", 0, 0, 0.3, env=without_display())
        assert done.returncode == 0, done.stderr
        assert size_of(picture) == (160, 90)
        assert colors_of(picture) > 100
    begin, later, again = (picture.read_bytes() for picture in pictures)
    assert begin != later
    assert later == again


def test_a_film_of_a_recording_is_as_long_as_its_part(understudy, recording, tmp_path):
    film = tmp_path / "fall.mp4"
    done = understudy("film", film, "--recording", recording, "--from", 0.2, "--to", 0.7, "--speed", 0.5, "--fps", 10,
                      "--size", "160x90", env=without_display())
    assert done.returncode == 0, done.stderr
    assert int(probe(film)["nb_read_frames"]) == 10


def frames_of(film, size):
    """The pictures of a film, as bytes."""
    raw = subprocess.run(["ffmpeg", "-loglevel", "error", "-i", film, "-f", "rawvideo", "-pix_fmt", "gray", "-"],
                         capture_output=True, check=True).stdout
    pixels = size[0] * size[1]
    return [raw[at:at + pixels] for at in range(0, len(raw), pixels)]


def test_clock_and_events_stand_in_a_film_unless_it_is_to_be_plain(understudy, recording, tmp_path):
    films = {}
    for plain in (False, True):
        film = tmp_path / f"{plain}.mp4"
        done = understudy("film", film, "--recording", recording, "--to", 0.4, "--fps", 5, "--size", "320x180",
                          "--lookat", 0, 0, 50, *(["--plain"] if plain else []), env=without_display())
        assert done.returncode == 0, done.stderr
        films[plain] = frames_of(film, (320, 180))
    told, plain = films[False], films[True]
    assert len(told) == len(plain) == 2

    def differ(a, b, rows):
        part = slice(rows.start * 320, rows.stop * 320)
        return sum(abs(x - y) > 40 for x, y in zip(a[part], b[part]))

    upper, middle, lower = range(0, 40), range(40, 110), range(110, 180)
    assert differ(told[0], plain[0], upper) > 50
    assert differ(told[1], plain[1], lower) > 50  # the events of the begin
    assert differ(told[0], plain[0], middle) == 0
    assert differ(told[0], told[1], upper) > 5  # the clock goes on


def test_a_film_of_a_running_robot_shows_what_happens_to_it(play, understudy, tmp_path):
    robot = play("go2")
    size, lower_left = (320, 180), [(x, y) for x in range(5, 60) for y in range(150, 176)]
    shade = {}
    for plain in (False, True):
        film = tmp_path / f"{plain}.mp4"
        assert understudy("ctl", "--name", robot.name, "push", "base_link", 0, 1, 0).returncode == 0
        done = understudy("film", film, "--name", robot.name, "--seconds", 0.6, "--fps", 5, "--size", "320x180",
                          "--lookat", 0, 0, 50, *(["--plain"] if plain else []), env=without_display())
        assert done.returncode == 0, done.stderr
        last = frames_of(film, size)[-1]
        shade[plain] = sum(last[y * size[0] + x] for x, y in lower_left) / len(lower_left)
    assert shade[False] < 0.8 * shade[True]


@pytest.mark.parametrize("ending, codec", [(".gif", "gif"), (".webp", "webp"), (".mp4", "h264")])
def test_a_film_is_of_the_kind_that_its_name_says(understudy, recording, tmp_path, ending, codec):
    film = tmp_path / f"fall{ending}"
    done = understudy("film", film, "--recording", recording, "--from", 0.2, "--to", 0.6, "--fps", 10, "--size", "96x54",
                      env=without_display())
    assert done.returncode == 0, done.stderr
    if ending == ".webp":  # whose films ffprobe does not read
        assert film.read_bytes().count(b"ANMF") == 4
    else:
        assert probe(film)["codec_name"] == codec and int(probe(film)["nb_read_frames"]) == 4


def test_an_encoder_that_ffmpeg_lacks_is_named(understudy, recording, tmp_path):
    ffmpeg = tmp_path / "ffmpeg"
    ffmpeg.write_text("#!/bin/sh\necho \"Unknown encoder 'libwebp_anim'\" >&2\nexit 1\n")
    ffmpeg.chmod(0o700)
    done = understudy("film", tmp_path / "a.webp", "--recording", recording, "--to", 0.3, "--size", "32x32",
                      env={**without_display(), "PATH": str(tmp_path)})
    assert done.returncode == 1
    assert "no encoder for .webp" in done.stderr and "apt-get install ffmpeg" in done.stderr
    assert list(tmp_path.iterdir()) == [ffmpeg]


def test_what_is_no_recording_or_no_time_of_it_is_refused_with_a_reason(understudy, recording, tmp_path):
    other = tmp_path / "other.mcap"
    other.write_bytes(b"not a recording")
    picture, film = tmp_path / "a.png", tmp_path / "a.mp4"
    for arguments, code, word in (
            (("picture", picture, "--recording", other), 9, "other.mcap"),
            (("picture", picture, "--recording", tmp_path / "none.mcap"), 9, "none.mcap"),
            (("picture", picture, "--recording", recording, "--at", 1e6), 1, "1000000"),
            (("picture", picture, "--at", 1), 2, "--recording"),
            (("picture", picture, "--recording", recording, "--name", "dog"), 2, "--name"),
            (("film", film, "--recording", recording, "--from", 0.5, "--to", 0.1), 1, "0.5"),
            (("film", film, "--recording", recording, "--seconds", 1), 2, "--seconds")):
        done = understudy(*arguments)
        assert done.returncode == code, (arguments, done.stderr)
        assert word in done.stderr + done.stdout
    assert not picture.exists()
    assert not film.exists()


@pytest.mark.parametrize("second", [float("nan"), float("inf"), -1.0, 1e300])
def test_a_state_of_no_time_is_refused(understudy, tmp_path, second):
    file, film = tmp_path / "damaged.mcap", tmp_path / "a.mp4"
    with file.open("wb") as out:
        writer = Writer(out)
        writer.start()
        channel = writer.register_channel("understudy/truth", "cdr", 0)
        truth = struct.pack("<4sqd4Id", b"\0\1\0\0", 1, second, 0, 0, 0, 0, 0)
        writer.add_message(channel, log_time=7, data=truth, publish_time=7)
        writer.finish()
    done = understudy("film", film, "--recording", file)

    assert done.returncode == 9
    assert "damaged.mcap: at byte" in done.stderr and "a state of second" in done.stderr
    assert list(tmp_path.iterdir()) == [file]
