"""Ways to see that a setting makes a difference: each has check(play), which fails where it does not.

Two runs of the same configuration send the same LowState at the same tick, bit for bit. So where a
key changes what the robot is, any difference at equal ticks is the key's doing. Keys that change
when or whether something happens name what is looked at instead.
"""

import dataclasses
import functools
import pathlib
import tempfile

from peers import GoLowState, HgLowState, listener
from robots import Robot, understudy

TICKS = (200, 500)  # ms after the start, where states are compared
HERE = pathlib.Path(__file__).parent


def options_of(settings):
    return [word for setting in settings for word in ("--set", setting)]


def messages(robot, settings, topic, kind, until, speed=4):
    """The samples of a topic, from wherever discovery lets one in to the tick `until`."""
    with listener(topic, kind, domain=3) as ear:
        # A wait before the first word gives discovery its time: then no sample is missed.
        played = Robot(robot, "--released", "--domain", 3, "--set", "guard.listen_loopback=0.3", "--speed", speed,
                       "--duration", until / 1000, *options_of(settings))
        try:
            played.exit_code()
            said = played.said()
        finally:
            played.end()
        return ear.take(), said


@functools.cache
def states(robot, *settings, until=TICKS[-1] + 20):
    """{tick: LowState} of a run."""
    kind = GoLowState if robot == "go2" else HgLowState
    heard, said = messages(robot, settings, "rt/lowstate", kind, until)
    assert heard, f"{settings}: no rt/lowstate\n{said}"
    return {state.tick: state for state in heard}


class Differs:
    """LowState at equal ticks differs between the settings with and without the changed ones."""

    def __init__(self, *changed, robot="go2", given=()):
        self._changed, self._robot, self._given = changed, robot, given

    def check(self, play):
        before = states(self._robot, *self._given)
        after = states(self._robot, *self._given, *self._changed)
        common = [tick for tick in TICKS if tick in before and tick in after]
        assert common, f"no tick in common: {min(before)}.. and {min(after)}.."
        assert any(content(before[tick]) != content(after[tick]) for tick in common)


def content(state):
    """What a state carries, without when it was sent, in a form that compares."""
    return repr([getattr(state, field.name) for field in dataclasses.fields(state)])


class Seen:
    """look(played robot), which is on the network, differs as the setting does."""

    _before = {}  # what rows saw without their changed key, by what is played and looked at

    def __init__(self, changed, look, robot="go2", given=()):
        self._changed, self._look = changed, look
        self._robot, self._given = robot, tuple(options_of(given))

    def check(self, play):
        alike = (self._look, self._robot, self._given)
        if alike not in self._before:
            self._before[alike] = self._seen(play)
        assert self._before[alike] != self._seen(play, *options_of([self._changed]))

    def _seen(self, play, *options):
        played = play(self._robot, "--released", *self._given, *options)
        look = self._look(played)
        played.end()
        return look


class Counted:
    """How many samples of a topic a second of simulated time brings."""

    def __init__(self, changed, topic, kind, robot="go2"):
        self._changed, self._topic, self._kind, self._robot = changed, topic, kind, robot

    def check(self, play):
        counts = [len(messages(self._robot, settings, self._topic, self._kind, 1000,
                               speed=1)[0])  # slow enough for a busy machine to hear all
                  for settings in ([], [self._changed])]
        assert max(counts) > 1.5 * min(counts), counts


class Refused:
    """A run with the changed key ends with the code, and says the word."""

    def __init__(self, changed, code, word, robot="go2"):
        self._changed, self._code, self._word, self._robot = changed, code, word, robot

    def check(self, play):
        done = understudy("run", self._robot, "--duration", 0.01, *options_of([self._changed]))
        assert done.returncode == self._code, done.stderr
        assert self._word in done.stderr


class MadeGround:
    """`understudy terrain` writes other files with the changed key than without."""

    def __init__(self, changed, scene="rough", given=()):
        self._changed, self._scene, self._given = changed, scene, given

    def check(self, play):
        assert self._written() != self._written(self._changed)

    def _written(self, *changed):
        with tempfile.TemporaryDirectory() as folder:
            images = {shade: pathlib.Path(folder) / f"{shade}.pgm" for shade in ("up", "down")}
            images["up"].write_bytes(b"P5 3 3 255\n" + bytes(range(0, 90, 10)))
            images["down"].write_bytes(b"P5 3 3 255\n" + bytes(range(80, -10, -10)))
            settings = [setting.format(**images) for setting in (*self._given, *changed)]
            out = pathlib.Path(folder) / "out"
            done = understudy("terrain", self._scene, "--out", out, *options_of(settings))
            assert done.returncode == 0, done.stderr
            return {file.name: file.read_bytes() for file in out.iterdir()}


class Elsewhere:
    """Another test, by its path from this folder, tests each value of the key."""

    def __init__(self, file, word):
        self._file, self._word = file, word

    def check(self, play):
        assert self._word in (HERE / self._file).read_text()


class Check:
    def __init__(self, check):
        self.check = check
