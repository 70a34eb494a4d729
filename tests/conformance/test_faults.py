"""Every row of docs/reference/faults.md but those of lidars, cameras and hands, seen through the vendor's SDK: caused, seen, taken away, gone."""

import cmath
import math
import statistics

import pytest

# Sensors without errors of their own, whose thermometers follow at once.
CLAMPED = ("--start", "clamped", "--clock", "simulated", "--profile", "ideal", "--set", "robot.hanging.height=0.345",
           # A mainboard that boots and warms within the time that the program looks.
           "--set", "robot.boot={states: 0.3, services: 0.4, motion: 0.6}", "--set", "robot.board.time_constant=0.1",
           # One that is empty must last for the rest of the table.
           "--set", "robot.battery.cutoff_v=0", "--set", "robot.battery.capacity_ah=1000")
# Here what is wrong goes and what it did stays: charge that has gone.
LASTING = {("battery", "empty")}
# What hangs on the load, which is another by then, is gone beside what it was; a swing that is not late is so within
# what the pace of this program scatters by.
RESTORED = {
    ("bus.FR", "slow"): lambda after, during, sound: abs((lag(after, sound) + 0.2) % 0.4 - 0.2) < 0.05,
    ("bus.FR", "jittery"): lambda after, during, sound: abs((lag(after, sound) + 0.2) % 0.4 - 0.2) < 0.05,
    ("rt/lowstate", "lost"): lambda after, during, sound: missing(after) < missing(during),
    ("battery", "weak"): lambda after, during, sound: mean(after, "volts") > mean(during, "volts") + 0.05,
}


@pytest.fixture(scope="module")
def shown(rehearse):
    """What LowState shows, by component and fault; of the sound robot by ("", "")."""
    run = rehearse("go2", "faults.py", options=CLAMPED, patience=200)  # a second and more for each
    assert run.succeeded()
    return {(row["component"], row["fault"]): row for row in run.report["rows"]}


def values(samples, key):
    return [sample[key] for sample in samples]


def spread(samples, key):
    return max(values(samples, key)) - min(values(samples, key))


def roughness(samples, key):
    """By how much each differs from the middle of its neighbours, times two."""
    all_of = values(samples, key)
    return statistics.median(abs(a - 2 * b + c) for a, b, c in zip(all_of, all_of[1:], all_of[2:]))


def turn(samples):
    """rad between the first attitude and the level one."""
    return 2 * math.acos(min(1.0, abs(samples[0]["quaternion"][0])))


def mean(samples, key):
    return statistics.mean(values(samples, key))


def mean_rate(samples, axis=0):
    return statistics.mean(sample["rate"][axis] for sample in samples)


def missing(samples):
    """The share of the messages, one every 2 ms, that did not come."""
    return 1 - (len(samples) - 1) / ((samples[-1]["tick"] - samples[0]["tick"]) / 2)


def lateness(samples):
    """s, of the samples, beside those that have the same."""
    return statistics.mean(sample["at"] - sample["tick"] / 1000 for sample in samples)


def least_late(samples):
    """s, likewise of that which came first, whatever kept this program from the others."""
    return min(sample["at"] - sample["tick"] / 1000 for sample in samples)


def lag(now, sound):
    """s by which the calf swings later than in `sound`, within its period."""
    period = 0.4  # of faults.py
    def phase(samples):
        middle = mean(samples, "q")
        return cmath.phase(sum((s["q"] - middle) * cmath.exp(-2j * math.pi * s["at"] / period) for s in samples))
    return (phase(sound) - phase(now)) / (2 * math.pi) % 1 * period


# By component and fault: whether `now` shows it, beside `sound`, the same robot without. A row of the
# table that has no line here fails.
MOTOR, ENCODER = "FR_calf_joint", "FR_calf_joint.encoder"
SHOWS = {
    (MOTOR, "limp"): lambda now, sound: max(map(abs, values(now, "tau"))) < 0.5 and spread(sound, "tau") > 1,
    (MOTOR, "off"): lambda now, sound: (
        now[-1]["errors"] == 0x100 and now[-1]["bits"] & 0x80 and now[-1]["lost"] > now[0]["lost"]
        and spread(now, "q") == 0),
    (MOTOR, "weak"): lambda now, sound: spread(now, "q") < 0.9 * spread(sound, "q"),
    (MOTOR, "jammed"): lambda now, sound: spread(now, "q") < 0.05 < spread(sound, "q"),
    (MOTOR, "dragging"): lambda now, sound: spread(now, "q") < 0.8 * spread(sound, "q"),
    (MOTOR, "hot"): lambda now, sound: now[-1]["temperature"] > sound[-1]["temperature"] + 50,
    (ENCODER, "off"): lambda now, sound: abs(now[-1]["q"]) < 0.01 and now[-1]["errors"] == 0x20,
    (ENCODER, "stuck"): lambda now, sound: spread(now, "q") < 0.01 < spread(sound, "q"),
    (ENCODER, "garbage"): lambda now, sound: spread(now, "q") > 6 and now[-1]["errors"] == 0x20,
    # The drive follows its encoder: what it reads is nearly where it was told to be, and the torque
    # against the ground tells that the leg is elsewhere.
    (ENCODER, "offset"): lambda now, sound: abs(mean(now, "tau") - mean(sound, "tau")) > 4.5,
    (ENCODER, "drifting"): lambda now, sound: abs(mean(now, "tau") - mean(sound, "tau")) > 4.5,
    (ENCODER, "noisy"): lambda now, sound: roughness(now, "tau") > 1 > roughness(sound, "tau"),
    ("imu", "off"): lambda now, sound: now[-1]["acceleration"] == [0, 0, 0] and sound[-1]["acceleration"] != [0, 0, 0],
    ("imu", "stuck"): lambda now, sound: all(s["acceleration"] == now[0]["acceleration"] for s in now),
    ("imu", "offset"): lambda now, sound: mean_rate(now) - mean_rate(sound) == pytest.approx(0.02, abs=0.005),
    ("imu", "tilted"): lambda now, sound: turn(now) - turn(sound) == pytest.approx(0.05, abs=0.01),
    ("imu", "drifting"): lambda now, sound: now[-1]["quaternion"][3] - now[0]["quaternion"][3] > 0.001,
    ("imu", "noisy"): lambda now, sound: (
        statistics.stdev(s["rate"][0] for s in now) > 3 * statistics.stdev(s["rate"][0] for s in sound)),
    ("foot.FL", "off"): lambda now, sound: max(values(now, "foot")) < min(values(sound, "foot")),
    ("foot.FL", "stuck"): lambda now, sound: spread(now, "foot") == 0,
    ("foot.FL", "weak"): lambda now, sound: (
        mean(now, "foot") < 0.8 * mean(sound, "foot")),
    ("foot.FL", "offset"): lambda now, sound: (
        mean(now, "foot") > mean(sound, "foot") + 5),
    ("battery", "weak"): lambda now, sound: min(values(now, "volts")) < min(values(sound, "volts")) - 0.05,
    ("battery", "empty"): lambda now, sound: now[-1]["soc"] <= 5 < sound[-1]["soc"],
    ("remote", "off"): lambda now, sound: now[-1]["remote"] == [0, 0] and sound[-1]["remote"] == [0x55, 0x51],
    # But for what was under way.
    ("rt/lowstate", "off"): lambda now, sound: len(now) < 0.05 * len(sound),
    ("rt/lowstate", "lost"): lambda now, sound: any(
        b["tick"] - a["tick"] > 3 for a, b in zip(now, now[1:])),
    ("rt/lowstate", "damaged"): lambda now, sound: 0 < sum(not s["crc"] for s in now) < len(now) / 2,
    ("rt/lowstate", "reordered"): lambda now, sound: any(b["tick"] < a["tick"] for a, b in zip(now, now[1:])),
    ("rt/lowstate", "delayed"): lambda now, sound: 0.08 < least_late(now) - least_late(sound) < 0.15,
    ("rt/lowstate", "jittery"): lambda now, sound: lateness(now) - lateness(sound) > 0.03,
    ("bus.FR", "off"): lambda now, sound: (
        now[-1]["bits"] & 0x80 and now[-1]["lost"] > now[0]["lost"] and spread(now, "q") == 0),
    ("bus.FR", "lost"): lambda now, sound: now[-1]["lost"] > now[0]["lost"],
    ("bus.FR", "slow"): lambda now, sound: 0.05 < lag(now, sound) < 0.15,
    ("bus.FR", "jittery"): lambda now, sound: 0.03 < lag(now, sound) < 0.37,
    ("fan.rear_right", "off"): lambda now, sound: now[-1]["fans"][3] and not sound[-1]["fans"][3],
    ("fan.rear_right", "weak"): lambda now, sound: now[-1]["board"] >= sound[-1]["board"] + 2 and not now[-1]["fans"][3],
    ("mainboard", "off"): lambda now, sound: len(now) < 0.05 * len(sound),
    ("mainboard", "hot"): lambda now, sound: now[-1]["board"] > sound[-1]["board"] + 20,
    ("mcu", "off"): lambda now, sound: now[-1]["bits"] & 0x40 and not sound[-1]["bits"] & 0x40,
    ("service.motion_switcher", "off"): lambda now, sound: now[0]["code"] == 3104,  # the SDK's time-out
    ("service.motion_switcher", "slow"): lambda now, sound: now[0]["code"] == 0 and 0.9 < now[0]["seconds"] < 2,
    ("rt/lowstate", "doubled"): lambda now, sound: any(a["tick"] == b["tick"] for a, b in zip(now, now[1:])),
}


def test_every_fault_is_seen_in_low_state(shown):
    sound = shown[("", "")]["during"]
    rows = {row: told["during"] for row, told in shown.items() if row != ("", "")}
    assert set(rows) == set(SHOWS)
    unseen = [row for row, during in rows.items() if not SHOWS[row](during, sound)]
    assert unseen == []


def test_every_fault_is_gone_once_it_is_taken_away(shown):
    sound = shown[("", "")]["during"]
    for row, told in shown.items():
        if row == ("", ""):
            continue
        after = told["after"]
        assert after, row
        if row in RESTORED:
            assert RESTORED[row](after, told["during"], sound), row
        elif row not in LASTING:
            assert not SHOWS[row](after, sound), row
        if row[0].startswith("service."):
            assert after[0]["code"] == 0 and after[0]["seconds"] < 0.9, row
            continue
        last = after[-1]
        assert last["errors"] == 0 and last["bits"] & 0xC0 == 0, row
        assert spread(after, "q") > 0.07, row  # 0.11 of a calf that swings
        assert last["acceleration"][2] > 8, row
        assert last["remote"] == [0x55, 0x51], row
        assert all(values(after, "crc")), row
        assert not any(a["tick"] == b["tick"] for a, b in zip(after, after[1:])), row
