"""A program on RustDDS, an implementation of DDS that shares no code with ours: see other_dds/."""

import math
import os
import pathlib
import subprocess

import pytest

import go2_stand_plan as plan

# Made by tools/other_dds.
PROGRAM = pathlib.Path(__file__).parents[2] / "build" / "other_dds" / "debug" / "other_dds"


@pytest.mark.parametrize("network", [(), ("--interface-name", "eth0")], ids=["lo", "cable"])
def test_a_program_on_another_dds_reads_all_states_and_stands_a_go2_up(rehearse, network):
    assert os.access(PROGRAM, os.X_OK), f"{PROGRAM}: missing; make it with tools/other_dds"
    run = rehearse("go2", PROGRAM, options=("--released", *network))

    assert run.succeeded()
    told = run.report
    assert (told["crc_errors"], told["undecoded"]) == (0, 0)
    assert run.refused == {}
    # Half of the 500 a second that are sent: the reader is best effort, and the machine may be busy.
    assert told["states"] > 0.5 * 0.5 * told["ticks_ms"]
    assert run.commands["accepted"] > 0.5 * told["commands"]
    off = max(abs(q - wanted) for q, wanted in zip(told["standing"], plan.STAND, strict=True))
    assert off < plan.STAND_TOLERANCE
    assert math.isclose(math.hypot(*told["quaternion"]), 1, abs_tol=1e-3)
    assert (told["soc"], round(told["power_v"])) == (90, 31)


def test_on_a_simulated_clock_it_says_the_same_twice(tmp_path):
    scenario = tmp_path / "stands_up.yaml"
    scenario.write_text("scenario: a program on another DDS\nrobot: go2\nclock: simulated\nprogram: {limit: 120}\n"
                        "settings: {motion: {service: none}}\nexpect:\n  - {final: program.exit_code is 0}\n")
    done = subprocess.run([os.environ["UNDERSTUDY"], "rehearse", scenario, "--twice", "--no-pictures", "--", PROGRAM],
                          cwd=tmp_path, capture_output=True, text=True, timeout=200)

    assert done.returncode == 0, done.stdout + done.stderr
    assert "clock: simulated, repeatable: yes" in done.stdout
