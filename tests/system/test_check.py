"""`understudy check`: what it finds in robots, layers, scenes and models, and how it tells it."""

import json
import pathlib

ROBOTS = pathlib.Path(__file__).parents[2] / "config" / "robots"
MODELS = pathlib.Path(__file__).parents[2] / "models"


def test_check_reads_every_firmware_strictly(understudy, tmp_path):
    robot = tmp_path / "mine.yaml"
    robot.write_text("extends: go2\nrobot:\n  firmwares:\n    '0.5': {moters: 3}\n")
    done = understudy("check", robot)

    assert done.returncode == 3
    assert "mine.yaml:4: key 'robot.moters': unknown" in done.stdout


def test_check_reads_every_revision_strictly(understudy, tmp_path):
    robot = tmp_path / "mine.yaml"
    robot.write_text("extends: go2\nrobot:\n  revisions:\n    x: {moters: 3}\n")
    done = understudy("check", robot)

    assert done.returncode == 3
    assert "mine.yaml:4: key 'robot.moters': unknown" in done.stdout


def test_check_reads_every_revision_against_the_model(understudy, tmp_path):
    robot = tmp_path / "heavy.yaml"
    robot.write_text("extends: g1\nrobot:\n  revisions:\n    x: {bodies: [{name: torso, mass: 9}]}\n")
    done = understudy("check", robot)

    assert done.returncode == 4
    assert "revision x: " in done.stdout
    assert "no body 'torso'" in done.stdout


def test_check_finds_our_own_files_sound(understudy):
    files = [*ROBOTS.glob("*.yaml"), *MODELS.glob("*/*.xml")]
    done = understudy("check", "--json", *files, timeout=60)

    assert done.returncode == 0, done.stdout
    assert [entry["file"] for entry in json.loads(done.stdout)] == [str(file) for file in files]
    assert all(entry["ok"] for entry in json.loads(done.stdout))


def test_check_reads_a_layer_over_a_robot_and_a_scene_as_ground(understudy, tmp_path):
    layer, scene, wrong = tmp_path / "layer.yaml", tmp_path / "course.yaml", tmp_path / "wrong.yaml"
    ice = tmp_path / "ice.yaml"
    layer.write_text("gate: {timeout: 0.5}\n")
    ice.write_text("terrain: {friction: 0.1}\n")  # changes the ground, and names none
    scene.write_text("terrain: {patches: [{kind: rough}]}\n")
    wrong.write_text("gate:\n  timeuot: 0.5\n")

    done = understudy("check", "--robot", "g1", layer, ice, scene, wrong)

    assert done.returncode == 3
    assert done.stdout.splitlines()[:3] == [f"ok   {layer}: layer for --config, fits g1",
                                            f"ok   {ice}: layer for --config, fits g1",
                                            f"ok   {scene}: scene for --scene, fits g1"]
    assert f"{wrong}:2" in done.stdout and "did you mean 'timeout'?" in done.stdout


def test_check_asks_over_which_robot_a_file_is_to_be_read_and_lists_them(understudy, tmp_path):
    layer, expect = tmp_path / "layer.yaml", tmp_path / "expect.yaml"
    layer.write_text("gate: {timeout: 0.5}\n")
    expect.write_text("expect: [{always: gap(lowstate) < 3 ms}]\n")

    done = understudy("check", layer, expect)

    assert done.returncode == 3
    robots = [robot["name"] for robot in json.loads(understudy("robots", "--json").stdout)]
    for line, wrong in zip(done.stdout.splitlines(), (f"{layer}: ", f"{expect}: robot: missing"), strict=True):
        assert wrong in line and "--robot: " + ", ".join(robots) in line
    assert understudy("check", "--robot", "h1", layer, expect).returncode == 0
    expect.write_text("robot: g1\n" + expect.read_text())
    assert understudy("check", expect).returncode == 0


def test_check_tells_the_unsound_from_the_sound(understudy, tmp_path):
    bad = tmp_path / "bad.yaml"
    bad.write_text("robot:\n  nmae: go3\n")
    good = ROBOTS / "go2.yaml"
    done = understudy("check", "--robot", "go2", "--json", bad, good)
    entries = json.loads(done.stdout)

    assert done.returncode == 3
    assert [entry["ok"] for entry in entries] == [False, True]
    assert f"{bad}:2" in entries[0]["text"]
    assert "name" in entries[0]["text"]


def test_check_of_a_bad_model_ends_with_4(understudy, tmp_path):
    bad = tmp_path / "bad.xml"
    bad.write_text("<mujoco><wordbody/></mujoco>")
    done = understudy("check", bad)

    assert done.returncode == 4
    assert done.stdout.startswith("FAIL")
    assert "wordbody" in done.stdout


MUJOCO_3 = """<mujoco>
  <worldbody>
    <body><joint name="knee" range="-1 1" actuatorfrcrange="-5 5"/><geom size="0.1"/></body>
  </worldbody>
  <actuator><motor name="knee" joint="knee"/></actuator>
  <sensor><jointactuatorfrc joint="knee"/></sensor>
</mujoco>
"""


def test_check_lists_what_was_rewritten_each_with_its_line(understudy, tmp_path):
    model = tmp_path / "leg.xml"
    model.write_text(MUJOCO_3)
    entry = json.loads(understudy("check", "--json", model).stdout)[0]
    lines = understudy("check", model).stdout.splitlines()

    assert entry["ok"]
    assert sorted(rewrite["line"] for rewrite in entry["rewrites"]) == [3, 3, 6]
    assert "3 places rewritten" in lines[0]
    assert f"{model}:6: sensor jointactuatorfrc" in "\n".join(lines[1:])


def test_check_names_everything_that_cannot_be_carried_over(understudy, tmp_path):
    model = tmp_path / "leg.xml"
    model.write_text("<mujoco>\n<worldbody>\n<body gravcomp='1'><geom size='1'/>\n<frame/></body>"
                     "\n</worldbody></mujoco>")
    done = understudy("check", model)
    lines = done.stdout.splitlines()

    assert done.returncode == 4
    assert len(lines) == 2
    assert f"{model}:3" in lines[0] and "gravcomp" in lines[0]
    assert f"{model}:4" in lines[1] and "frame" in lines[1]


def test_check_of_what_is_no_description_names_the_kinds_there_are(understudy, tmp_path):
    done = understudy("check", tmp_path / "robot.txt")

    assert done.returncode == 3
    assert ".yaml" in done.stdout
