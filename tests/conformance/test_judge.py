"""The margins of src/judge against those of RTAMT, an evaluator of signal temporal logic by others."""

import json
import os
import pathlib
import random
import subprocess
import warnings

import pytest

with warnings.catch_warnings():
    warnings.simplefilter("ignore", DeprecationWarning)  # of its parser
    import rtamt

TOOL = pathlib.Path(os.environ["UNDERSTUDY"]).resolve().parents[1] / "tests/judge/judge_formulas"
STEP = 1_000_000  # ns
SIGNALS = "xy"


class Generator:
    """Random formulas, in our JSON and as RTAMT reads them, and random signals."""

    def __init__(self, seed):
        self.dice = random.Random(seed)

    def leaf(self):
        signal = self.dice.randrange(len(SIGNALS))
        compare = self.dice.choice(["<", "<=", ">", ">="])
        value = self.dice.randrange(-8, 9) / 4
        return ({"op": "leaf", "signal": signal, "compare": compare, "value": value},
                f"({SIGNALS[signal]} {compare} {value})", 0)

    def formula(self, depth):
        """Gives the JSON, the text, and how many samples it looks ahead."""
        kind = self.dice.choice(["leaf", "not", "all", "any", "always", "eventually"])
        if depth == 0 or kind == "leaf":
            return self.leaf()
        parts = [self.formula(depth - 1) for _ in range(2 if kind in ("all", "any") else 1)]
        ours, texts, ahead = zip(*parts)
        if kind == "not":
            return {"op": kind, "parts": ours}, f"(not {texts[0]})", ahead[0]
        if kind in ("all", "any"):
            word = "and" if kind == "all" else "or"
            return {"op": kind, "parts": ours}, f"({texts[0]} {word} {texts[1]})", max(ahead)
        low = self.dice.randrange(5)
        high = low + self.dice.randrange(6)
        return ({"op": kind, "parts": ours, "from": low * STEP, "to": high * STEP},
                f"({kind}[{low},{high}] {texts[0]})", ahead[0] + high)

    def claim(self):
        operator = self.dice.choice(["always", "never", "eventually", "until"])
        ours, text, ahead = self.formula(3)
        low = self.dice.randrange(6) if operator != "until" else 0
        high = low + self.dice.randrange(12)
        claim = {"formula": ours, "from": low * STEP, "to": high * STEP, "operator": operator}
        if operator == "until":
            until, until_text, until_ahead = self.formula(2)
            claim |= {"operator": "always", "until": until}
            return claim, f"{text} until[{low},{high}] {until_text}", high + max(ahead, until_ahead)
        if operator == "never":
            return claim, f"always[{low},{high}](not {text})", high + ahead
        return claim, f"{operator}[{low},{high}]{text}", high + ahead

    def signals(self, length):
        """Steps and ramps and noise, with values that also meet the compared ones exactly."""
        lines = []
        for _ in SIGNALS:
            value, line = 0.0, []
            for _ in range(length):
                if self.dice.random() < 0.4:
                    value = self.dice.choice([self.dice.uniform(-2, 2), self.dice.randrange(-8, 9) / 4])
                line.append(value)
            lines.append(line)
        return lines


def theirs(text, lines):
    spec = rtamt.StlDiscreteTimeSpecification()
    for name in SIGNALS:
        spec.declare_var(name, "float")
    spec.spec = text
    spec.parse()
    times = list(range(len(lines[0])))
    return spec.evaluate({"time": times, **dict(zip(SIGNALS, lines))})[0][1]


@pytest.mark.parametrize("seed", range(10))
def test_margins_are_those_of_rtamt(seed):
    generator = Generator(seed)
    cases, expected, texts = [], [], []
    for _ in range(60):
        claim, text, ahead = generator.claim()
        lines = generator.signals(ahead + 3)
        samples = [[i * STEP, [line[i] for line in lines]] for i in range(len(lines[0]))]
        cases.append({"claim": claim, "samples": samples})
        expected.append(theirs(text, lines))
        texts.append(text)
    done = subprocess.run([TOOL], input=json.dumps(cases), capture_output=True, text=True, check=True,
                          timeout=60)
    answers = json.loads(done.stdout)
    assert len(answers) == len(cases)
    for answer, margin, text in zip(answers, expected, texts):
        assert answer["margin"] == margin, text
        if margin != 0:
            assert answer["outcome"] == ("passed" if margin > 0 else "failed"), text
