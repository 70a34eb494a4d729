"""Randomization from a shell: ranges, the reported seed, and its replay."""

import json
import pathlib
import re

from peers import listener
from robots import Robot

DOCS = pathlib.Path(__file__).parents[2] / "docs" / "reference" / "randomization.md"
OPTIONS = [word for setting in (
    "start.pose=standing", "randomization.mass=[0.8, 1.2]", "randomization.kp=[0.8, 1.2]",
    "randomization.timestep=[0.0005, 0.001]", "randomization.delay=[0, 0.004]")
    for word in ("--set", setting)]


def example(folder):
    text = re.search(r"```yaml\n(.*?)```", DOCS.read_text(), re.DOTALL).group(1)
    file = folder / "randomization.yaml"
    file.write_text(text)
    return file, text


def limits_of(text):
    return {key: (float(least), float(most)) for key, least, most in
            re.findall(r"^  (\w+): \[([-\d.]+), ([-\d.]+)\]", text, re.MULTILINE)}


def values_of(drawn):
    return drawn.values() if isinstance(drawn, dict) else [drawn]


def run(*options):
    """{tick: what LowState carries} of half a second, and the log."""
    with listener(domain=3) as ear:
        # A wait before the first word gives discovery its time: then no sample is missed.
        robot = Robot("go2", "--released", "--domain", 3, "--set", "guard.listen_loopback=0.3", "--speed", 4,
                      "--duration", 0.52, *OPTIONS, *options)
        try:
            robot.exit_code()
            said = robot.said()
        finally:
            robot.end()
        return {state.tick: repr(state) for state in ear.take()}, said


def test_the_documents_example_draws_every_quantity_within_its_range(play, tmp_path):
    file, text = example(tmp_path)
    robot = play("go2", "--config", file, "--seed", 7)
    told = robot.status()["randomization"]
    limits = limits_of(text)
    assert told["seed"] == 7
    assert told["drawn"].keys() == limits.keys()
    assert len(limits) == 15
    for quantity, (least, most) in limits.items():
        values = dict(told["drawn"][quantity]) if quantity == "gravity_tilt" else None
        for value in [values["angle"]] if values else values_of(told["drawn"][quantity]):
            assert least <= value <= most, quantity
    assert len(told["drawn"]["mass"]) == 13
    assert len(told["drawn"]["kp"]) == 12
    assert len(told["drawn"]["imu_mounting"]) == 3
    line = robot.heard("drawn floor_softness: ")["message"]
    assert line.split()[-1] == f"{told['drawn']['floor_softness']:.4g}"


def test_the_same_seed_draws_the_same_and_another_draws_otherwise(play, tmp_path):
    file, _ = example(tmp_path)
    drawn = []
    for seed in (7, 7, 8):
        robot = play("go2", "--config", file, "--seed", seed)
        drawn.append(robot.status()["randomization"]["drawn"])
        robot.end()
    assert drawn[0] == drawn[1]
    assert all(drawn[0][quantity] != drawn[2][quantity]
               for quantity in drawn[0] if quantity != "timestep")


def test_a_run_is_replayed_from_the_seed_it_told(play):
    """The first run draws its seed; the second is told that and sends the same states, bit for bit."""
    first, said = run()
    seed = re.search(r"randomized from seed (\d+), drawn for this run: --seed \1 repeats it", said).group(1)
    again, _ = run("--seed", seed)
    common = first.keys() & again.keys()
    assert len(common) > 100
    assert all(first[tick] == again[tick] for tick in common)

    other, _ = run("--seed", (int(seed) + 1) % 2**31)
    assert any(first[tick] != other[tick] for tick in first.keys() & other.keys())


def test_a_run_that_is_not_randomized_says_so(play):
    assert play("go2", "--seed", 3).status()["randomization"] is None


def test_exec_tells_a_seed_that_it_has_drawn(understudy):
    done = understudy("exec", "go2", "--json", *OPTIONS, "--", "true")
    assert done.returncode == 0
    lines = [json.loads(line)["message"] for line in done.stderr.splitlines()
             if line.startswith("{")]
    assert any("drawn for this run: --seed " in line for line in lines)


def test_a_range_that_is_none_ends_the_program_before_it_starts(understudy, tmp_path):
    file = tmp_path / "bad.yaml"
    file.write_text("randomization:\n  mass: [1.2, 0.8]\n")
    done = understudy("run", "go2", "--config", file)
    assert done.returncode == 3
    assert "bad.yaml:2: randomization.mass: expected least before most" in done.stderr
