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
    assert module("motor_table", "[0, 0.01, 0.5, 1].map(m.positionLevel)") == [
        "bad", "warn", "", "bad"]
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
