"""Rehearsals of programs: how they start and end, what they print, and the shipped scenarios that need one."""

import pathlib
import re
import sys

from rehearsals import FAILED, outcomes, rehearse_fixture, verdicts

ROOT = pathlib.Path(__file__).parents[2]


def test_a_program_is_started_ended_and_its_exit_code_judged(rehearse, tmp_path):
    file = tmp_path / "program.yaml"
    file.write_text("""
scenario: A program
robot: go2
program: {at: 0.5, until: 1.5, by: kill}
expect:
  - {final: program.exit_code is 137}
  - {count: program_start happens, least: 1, most: 1, to: 1}
  - {never: program_end happens, to: 1.4}
""")
    assert "this scenario needs one" in rehearse(file).stderr
    done = rehearse(file, program=[sys.executable, "-c", "import time; time.sleep(60)"])
    assert done.returncode == 0, done.stdout + done.stderr

    file.write_text("scenario: A program\nrobot: go2\nexpect: [{final: program.exit_code is 0}]\n")
    assert rehearse(file, program=["true"]).returncode == 0
    assert rehearse(file, program=["false"]).returncode == FAILED
    assert rehearse(file, program=["no-such-program"]).returncode == 127


def test_a_script_and_an_expectation_hear_what_the_program_prints(rehearse, tmp_path):
    file = tmp_path / "prints.yaml"
    file.write_text("""
scenario: A program says when it is ready
robot: go2
program:
script:
  - {when: the program prints "policy loaded", within: 10, fault: {component: FR_calf_joint, fault: limp}}
  - {after: previous, when: the program prints "never", within: 0.2, reset: }
expect:
  - {eventually: fault happens, from: the program prints "policy loaded", within: 0.1, name: in time}
  - {never: fault happens, to: 0.5, name: not before}
  - {count: the program prints "policy", least: 2, most: 2, name: both lines}
  - {eventually: script_refused happens, from: fault happens, within: 0.3, name: gives up}
""")
    # Neither flushes: a pipe would keep the lines back until the program ends.
    program = "import time; time.sleep(1); print('a policy'); print('policy loaded'); time.sleep(1)"
    done = rehearse(file, program=[sys.executable, "-c", program])
    assert done.returncode == 0, done.stdout + done.stderr
    assert "a policy\npolicy loaded\n" in done.stdout
    assert "prints.yaml:7: timed out after 0.2 s" in done.stderr
    assert set(outcomes(tmp_path / "out").values()) == {"passed"}


def test_lost_lowcmd_holds_with_a_program_that_writes_it(rehearse, tmp_path):
    program = pathlib.Path(__file__).parent / "writes_lowcmd.py"
    done = rehearse("lost_lowcmd", program=[sys.executable, program])
    assert done.returncode == 0, done.stdout + done.stderr
    done = rehearse("lost_lowcmd", program=[sys.executable, "-c", "import time; time.sleep(60)"])
    assert done.returncode == FAILED
    assert outcomes(tmp_path / "out")["the program is heard"] == "failed"


def test_the_example_with_the_vendors_sdk_stands_up_and_lies_down(rehearse, tmp_path):
    done = rehearse("sdk_stand", "--clock", "simulated",
                    program=[sys.executable, ROOT / "examples" / "python" / "stand.py", "lo"])
    assert done.returncode == 0, done.stdout + done.stderr
    assert len(outcomes(tmp_path / "out")) == 6 and set(outcomes(tmp_path / "out").values()) == {"passed"}


def test_a_g1_picks_a_cube_up_from_a_table_and_its_recording_says_so_too(rehearse, understudy, tmp_path):
    program = [sys.executable, ROOT / "examples" / "python" / "pick_up.py", "lo"]
    done = rehearse("pick_up", program=program)
    assert done.returncode == 0, done.stdout + done.stderr
    assert set(outcomes(tmp_path / "out").values()) == {"passed"}
    judged = understudy("judge", tmp_path / "out" / "recording.mcap", "pick_up", "--out", tmp_path / "judged")
    assert judged.returncode == 0, judged.stdout + judged.stderr
    missed = rehearse("pick_up", "--set", "objects.1.pos=[0.34, 0, 0.75]", program=program, out="missed")
    assert missed.returncode == FAILED, missed.stdout + missed.stderr
    assert outcomes(tmp_path / "missed")["the cube is above the table at the end"] == "failed"


def test_a_program_that_hangs_ends_at_its_limit_and_has_failed(rehearse, understudy, tmp_path):
    file = tmp_path / "hangs.yaml"
    file.write_text("scenario: It hangs\nrobot: go2\nprogram: {limit: 1.5}\n"
                    "expect: [{always: base.height > 0.05, name: is there}]\n")
    hangs = [sys.executable, "-c", "import signal, time; signal.signal(15, signal.SIG_IGN); time.sleep(600)"]
    for options in ((), ("--to-the-end",)):
        done = rehearse(file, *options, program=hangs)
        assert done.returncode == FAILED, done.stdout + done.stderr
        assert outcomes(tmp_path / "out") == {"is there": "passed", "the program ends within 1.5 s": "failed"}
        assert verdicts(tmp_path / "out")["seconds"] < 4
    again = understudy("judge", tmp_path / "out" / "recording.mcap", file, "--out", tmp_path / "judged")
    assert again.returncode == FAILED
    assert verdicts(tmp_path / "judged")["verdicts"] == verdicts(tmp_path / "out")["verdicts"]
    assert rehearse(file, program=["true"]).returncode == 0


def test_a_program_that_dies_ends_the_rehearsal_and_its_last_line_comes_first(rehearse, tmp_path):
    file = tmp_path / "dies.yaml"
    text = ("scenario: It dies\nrobot: go2\nduration: 30\nprogram:\n"
            "expect:\n  - {always: base.height > 0.05, name: is there}\n")
    file.write_text(text)
    done = rehearse(file, program=[sys.executable, "no-such-file.py"])
    assert done.returncode == FAILED, done.stdout + done.stderr
    first = done.stdout.splitlines()[1]
    assert re.match(r"  FAIL  the program ended with exit code 2 after \S+ s: .*can't open file", first), done.stdout
    assert "can't open file" in done.stderr
    assert verdicts(tmp_path / "out")["seconds"] < 20
    expected = text.replace("duration: 30", "duration: 3") + "  - {eventually: program.exit_code is 2, name: as it should}\n"
    file.write_text(expected)
    assert rehearse(file, program=["sh", "-c", "exit 2"]).returncode == 0


def test_a_first_scenario_is_written_for_a_program(understudy, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = understudy("rehearse", "--init", "walk.yaml", "--", "sh", "-c", "sleep 1; exit $0", "0")
    assert done.returncode == 0, done.stderr
    assert understudy("check", "walk.yaml").returncode == 0
    done = understudy("rehearse", "walk.yaml", timeout=240)
    assert done.returncode == 0, done.stdout + done.stderr
    for name in ("stays upright", "no command is refused", "no call is refused"):
        assert f"PASS  {name}" in done.stdout
    done = understudy("rehearse", "walk.yaml", "--", "sh", "-c", "exit 3", timeout=240)
    assert done.returncode == FAILED
    done = understudy("rehearse", "--init", "walk.yaml", "--", "true")
    assert done.returncode == 3 and "is there already" in done.stderr
