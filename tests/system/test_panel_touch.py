"""What the panel shows of the pads of hands."""

import pytest

from panel_page import browser, url_of, visit

ASKED = "performance.getEntriesByType('resource').filter(({ name }) => name.includes('parts=touch')).length"
OPEN = "document.getElementById('touch').open = {}"
PADS = "document.querySelectorAll('#touch-hands figure').length"
# Of the pad behind a caption: its rows and columns, its number, and how red its cells are.
PAD = """(() => {{
  const figure = [...document.querySelectorAll('#touch-hands section[aria-label="{hand} hand"] figure')]
    .find((one) => one.textContent.startsWith('{pad} '));
  const canvas = figure.querySelector('canvas');
  const rgba = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
  const red = [...Array(rgba.length / 4).keys()].map((i) => rgba[4 * i + 3] ? rgba[4 * i] - rgba[4 * i + 2] : null);
  return {{ rows: canvas.height, columns: canvas.width, most: figure.querySelector('.num').textContent, red }};
}})()"""


def pad(page, hand, name):
    return page.evaluate(PAD.format(hand=hand, pad=name))


def still(page):
    page.evaluate("new Promise((done) => setTimeout(done, 600))")
    return page.evaluate(ASKED)


def test_each_pad_is_a_grid_of_its_cells_which_is_read_while_it_is_looked_at(play, visit):
    page = visit(url_of(play("g1", "--hands", "inspire_ftp")))

    assert page.evaluate(PADS) == 2 * 17
    assert still(page) == 0
    page.evaluate(OPEN.format("true"))
    page.becomes(f"{ASKED} > 2")
    page.becomes("document.querySelector('#touch-hands .num').textContent === '0.0 N'")
    tip, top = pad(page, "left", "index tip"), pad(page, "right", "thumb top")
    assert (tip["rows"], tip["columns"], top["rows"], top["columns"]) == (3, 3, 12, 8)
    page.evaluate(OPEN.format("false"))
    asked = still(page)
    assert still(page) == asked


def test_what_presses_on_a_cell_colours_it_and_no_other(play, visit):
    page = visit(url_of(play("g1", "--hands", "right:dex3")))
    page.evaluate("panel.link.request('pause')")
    middle_tip = "panel.touch.pads.find(({ name }) => name === 'middle tip')"

    # Of its 12 cells a pad has some; the fullest of them is the third.
    page.evaluate(f"""panel.touch.show(Array(9 * 12).fill(0).map((_, i) => {{
        const cell = i - {middle_tip}.first;
        return cell === [...Array(12).keys()].filter({middle_tip}.has)[2] ? 4 : 0;
      }}))""")
    seen = pad(page, "right", "middle tip")

    assert seen["most"] == "4.0 N"
    there = [red for red in seen["red"] if red is not None]
    assert 0 < len(there) < 12
    assert there[2] > 60 and all(red < 20 for red in there[:2] + there[3:])
    assert pad(page, "right", "index tip")["most"] == "0.0 N"


@pytest.mark.parametrize("robot", [("go2",), ("g1", "--hands", "dex1")])
def test_a_robot_that_feels_nothing_has_no_such_part(play, visit, robot):
    page = visit(url_of(play(*robot)))

    page.becomes("document.querySelectorAll('#sensor-rows tr').length > 2")
    assert page.evaluate("document.getElementById('touch').hidden")
    assert page.evaluate(PADS) == 0
