"""The panel's modules, one by one, in a browser."""

import pytest

from panel_page import browser, dog, dogs_page, page


def test_its_modules_do_what_they_say(page):
    def module(name, expression):
        return page.evaluate(f"import('/panel/{name}.js').then((m) => {expression})")

    # A history forgets the oldest, keeps peaks when thinned and begins anew when time does.
    assert module("history", """{
        const history = new m.History(2, 100);
        for (let i = 0; i < 150; ++i) history.push(i, (k) => (i === 77 ? 9 : k));
        const rows = history.rows([0, 1], -Infinity, 20);
        const all = { count: history.end - history.begin, oldest: history.oldest,
                      rows: rows.length, peak: Math.max(...rows.map((row) => row[1])) };
        history.push(3, () => 0);
        return { ...all, anew: history.newest, left: history.end - history.begin };
      }""") == {"count": 100, "oldest": 50, "rows": 20, "peak": 9, "anew": 3, "left": 1}
    # Both ways at once is neither; of two hands the one that goes further counts.
    assert module("remote_inputs", "m.valuesOf(m.together([m.fromKeyboard(['w', 'b', 'e'], true),"
                  "m.fromKeyboard(['s', 'f', 'j'])]))") == {
                      "keys": "B+L2", "lx": 0, "ly": 0.5, "rx": -1, "ry": 0}
    assert module("motor_table", "[84, 71, 60].map((c) => m.temperatureLevel(c + 1, 85))") == [
        "bad", "warn", ""]
    # Nobody has to do anything about a torque; what is hot has to be let cool.
    assert module("motor_table", "[-30, 20, 5].map((tau) => m.torqueLevel(tau, 24))") == ["warn", "warn", ""]
    # At its stop a motor is well unless it pushes into it.
    assert module("motor_table", "[[0, 0.9], [0, -0.9], [0, -5], [0, 5], [0.5, 9], [1, 5], [1, -5]].map(([share, tau]) =>"
                  " m.positionLevel(share, tau))") == ["", "", "warn", "", "", "warn", ""]
    # Looks are given up when most pictures are slow, not for the hour that the page was out of sight.
    assert module("quality", """{
        const levels = (spans) => {
          const quality = new m.Quality({ setPixelRatio: () => {} }, {}, 0);
          let now = 1;
          quality.drew(now);
          return spans.map((span) => (quality.drew((now += span)), quality.level));
        };
        const steady = Array(40).fill(17);
        return [levels([400, ...steady, 3.6e6, ...steady]), levels(Array(40).fill(40))].map(
          (all) => Math.max(...all));
      }""") == [0, 3]
    # What hardly moves is not drawn as large as a motion.
    assert module("plots", "[m.flatRange([[0, 2, NaN], [1, 2.0001, 2]]), m.flatRange([[0, 1], [1, 1.5]])]") == [
        pytest.approx([1.99905, 2.00105], abs=1e-4), None]
    roll, pitch, yaw = module("signals", "m.rollPitchYaw([0.5, 0.5, 0.5, 0.5])")
    assert (roll, pitch, yaw) == pytest.approx((1.5708, 0, 1.5708), abs=1e-4)
    # A mesh and a height field as they come over the wire: the first row of heights is that of least y.
    assert module("geoms", """{
        const words = new Uint32Array([3, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2]);
        new Float32Array(words.buffer, 8, 9).set([0, 0, 0, 1, 0, 0, 0, 2, 0]);
        const mesh = m.meshGeometry(words.buffer);
        const field = new Uint32Array([2, 3, 0, 0, 0, 0, 0, 0]);
        new Float32Array(field.buffer, 8, 6).set([1, 0, 0, 0, 0, 0]);
        const ground = m.heightFieldGeometry(field.buffer, [3, 2, 0.5, 0.1]).attributes.position;
        const top = [...Array(6).keys()].find((i) => ground.getZ(i) > 0);
        return { normal: [...mesh.attributes.normal.array.slice(0, 3)], faces: mesh.index.count / 3,
                 top: [ground.getX(top), ground.getY(top), ground.getZ(top)] };
      }""") == {"normal": [0, 0, 1], "faces": 1, "top": [-3, -2, 0.5]}
    # Relief is seen: high ground is lighter than low, and lines at every 0.5 m, darker, bend with it.
    assert module("geoms", """{
        const field = new Uint32Array(2 + 21 * 21);
        field.set([21, 21]);
        new Float32Array(field.buffer)[2 + 1 * 21 + 2] = 1;
        const tint = m.heightFieldGeometry(field.buffer, [1, 1, 0.5, 0.1]).attributes.color;
        const at = (row, column) => tint.getX((20 - row) * 21 + column);
        return { high: at(1, 2) > at(1, 1), lines: [...Array(21).keys()].filter((k) => at(3, k) < at(3, 3)),
                 rows: [...Array(21).keys()].filter((k) => at(k, 3) < at(3, 3)) };
      }""") == {"high": True, "lines": [0, 5, 10, 15, 20], "rows": [0, 5, 10, 15, 20]}


# Chords as GET /scene has them of a robot that stands up, balances and sits.
CHORDS = """[["L2+B", "damp", [], { 1: 1, 2: 1, 3: 1, 4: 1 }], ["L2+A", "stand_down", [2], { 2: 4 }],
  ["L2+A", "stand_up", [], { 1: 2, 4: 2, 3: 2 }], ["L2+X", "recovery_stand", [], { 1: 3 }],
  ["START", "balance_stand", [], { 2: 3 }], ["R1+B", "sit", [], { 3: 5 }], ["L2+Y", "zero_torque", [1], { 1: 0 }],
  ["L1+X", "run", [], {}]].map(([keys, does, from, effects]) => ({ keys, does, from, clicks: 1, value: 0, name: does,
    simulated: does !== "run", effects: Object.entries(effects).map(([a, to]) => ({ from: Number(a), to })) }))"""


def test_an_action_says_what_has_to_be_pressed_before_it(page):
    def need(does, state, service="mcf"):
        return page.evaluate(f"""import("/panel/chords.js").then((m) => {{
            const chords = {CHORDS};
            return m.needOf(chords.find(({{ does }}) => does === "{does}"), chords,
                            {{ service: "{service}", state: {state}, name: "damping" }});
          }})""")

    assert need("balance_stand", 2) == ""
    assert need("balance_stand", 1) == "press L2+A first"
    # Nobody recovers a robot that has not fallen, nor lets one drop that stands.
    assert need("sit", 1) == "press L2+A, then START first"
    assert need("stand_down", 3) == "press L2+A first"
    # The only way.
    assert need("zero_torque", 3) == "press L2+B first"
    assert need("sit", 0) == "not in damping"
    assert need("run", 1) == "not simulated"
    assert need("sit", 3, service="") == "no motion service is on"


def test_late_ticks_and_the_way_down_from_the_crane_are_added_up(page):
    def module(name, expression):
        return page.evaluate(f"import('/panel/{name}.js').then((m) => {expression})")

    assert module("events", """[[3, 0.002, 4], [1, 0.009, 5], [2, 0.001, 6]].reduce((sum, [n, worst, time]) =>
        m.lateSoFar(sum, { detail: { count: n, worst }, time }), null)""") == {
            "count": 6, "worst": 0.009, "from": 4}
    assert module("crane", """m.weightOf({ base: 1, gravity: [0, 0, -10], bodies: [
        { parent: 0, mass: 0 }, { parent: 0, mass: 10 }, { parent: 1, mass: 5 }, { parent: 0, mass: 7 }] })""") == 150

    def next_of(tension, length=1, tilt=0, attached="true", asked=1):
        return module("crane", f"""m.nextOf({{ start: 1, asked: {asked} }}, {{ base: {{ tilt: {tilt} }},
            crane: {{ attached: {attached}, length: {length}, tension: {tension} }} }}, 340)""")

    assert next_of(300) == {"lower": 0.03}
    assert next_of(300, asked=1.03, length=1.01) == {"lower": 0}  # the last stretch is still on its way
    assert next_of(30)["text"].startswith("it stands")
    assert next_of(300, tilt=0.7)["text"].startswith("stopped: it tips over")
    assert next_of(300, length=3.1)["text"] == "stopped after 2 m"
    assert next_of(0, attached="false")["text"] == "the crane has been released"


ROW = """{ name: "arm.wave_at", does: "Waves", fields: [
  { key: "times", kind: "whole", range: [1, 9], required: true, does: "How often" },
  { key: "for", kind: "number", unit: "s", range: [0.1, 60], default: 2, does: "How long" },
  { key: "to", kind: "vector", unit: "m", range: [-1, 1], does: "Where" },
  { key: "off", kind: "vector", range: [-1, 1], does: "Not given" },
  { key: "with", kind: "word", words: ["left", "right"], does: "Which hand" },
  { key: "body", kind: "body", required: true, does: "Of the model" },
  { key: "slow", kind: "switch", default: 1, does: "Whether" },
  { key: "song", kind: "name", does: "Hummed" }] }"""


def test_a_request_gets_its_form_by_its_row_alone(page):
    made = page.evaluate(f"""import("/panel/forms.js").then(({{ makeForm }}) => {{
        const asked = [];
        const form = makeForm({ROW}, ["torso", "head"], (...what) => asked.push(what));
        document.body.append(form);
        const one = (called) => form.querySelector(`[aria-label="${{called}}"]`);
        const options = (called) => [...one(called).options].map(({{ value }}) => value);
        const before = form.checkValidity();
        Object.entries({{ times: "3", "to x": "0.5", "to z": "-1", with: "right", body: "head" }})
          .forEach(([called, value]) => (one(called).value = value));
        form.requestSubmit();
        one("times").value = "10";
        form.requestSubmit(); // out of range: the browser says so
        const times = ["type", "min", "max", "step", "required"].map((name) => one("times")[name]);
        const text = [...form.children].map(({{ firstChild, lastChild }}) =>
          [firstChild.data.trim(), lastChild.data.trim()].join(" ").trim());
        form.remove();
        return {{ asked, before, times, text, words: options("with"), bodies: options("body"),
                  step: one("for").step, value: one("for").value, slow: one("slow").value,
                  slows: options("slow") }};
      }})""")

    assert made["asked"] == [["arm.wave_at", {"times": 3, "for": 2, "to": [0.5, 0, -1], "with": "right",
                                              "body": "head", "slow": True}]]
    assert not made["before"]  # something that is needed is missing
    assert made["times"] == ["number", "1", "9", "1", True]
    assert (made["step"], made["value"], made["slow"]) == ("any", "2", "On")
    assert made["slows"] == ["Off", "On"]
    assert made["words"] == ["", "left", "right"] and made["bodies"] == ["", "torso", "head"]
    assert made["text"] == ["times", "for s", "to m", "off", "with", "body", "slow", "song", "wave at wave at"]


def test_every_request_that_nothing_else_makes_has_a_form_and_no_other(page):
    rows = page.evaluate("fetch('/requests').then((reply) => reply.json())")["requests"]
    forms = page.evaluate("[...document.querySelectorAll('#rig form')].map((form) => form.ariaLabel)")
    made = """Promise.all(["bar", "crane", "drag", "faults", "joints", "remote", "rig", "services", "settings"].map((name) =>
        fetch(`/panel/${name}.js`).then((reply) => reply.text()))).then((texts) => texts.join())"""
    code = page.evaluate(made)
    also = {"crane.lower"}  # a button makes it again and again, a form once
    for name in (row["name"] for row in rows if row["name"] not in also):
        by_hand = f'"{name}"' in code
        # What press, hold, release, sticks and on do, the picture of the remote controller does by remote.set.
        assert (name in forms) != (by_hand or name.startswith("remote.")), name
