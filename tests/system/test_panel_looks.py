"""The panel on phones, in light and dark mode, by the Tab key, and without WebGL."""

import pytest

from panel_page import DESK, PHONE, browser, dog, dogs_page, page, show, url_of, visit


def test_a_browser_without_webgl_is_told_what_is_missing(browser, dog):
    page = browser.page("about:blank", **DESK)
    page.call("Page.addScriptToEvaluateOnNewDocument",
              source="HTMLCanvasElement.prototype.getContext = () => null")
    page.call("Page.navigate", url=url_of(dog))

    page.becomes("document.getElementById('lost')?.textContent.includes('needs WebGL')")
    page.close()


def test_a_phone_on_its_side_shows_one_part_and_a_desk_all_again(page):
    seen = """['plots', 'motors', 'remote', 'rig', 'events'].filter(
        (id) => document.getElementById(id).offsetParent)"""
    page.resize(932, 430, touch=True)
    show(page, "motors")
    assert page.evaluate(seen) == ["motors"]
    assert page.evaluate("document.getElementById('motors').getBoundingClientRect().bottom"
                         " <= innerHeight")
    page.resize(DESK["width"], DESK["height"])

    page.becomes("document.getElementById('tab-remote').ariaSelected === 'true'")
    assert page.evaluate(seen) == ["plots", "motors", "remote"]


# What is seen of an element: nothing of it lies beyond the page or, unless that can be moved, beyond what holds it.
CUT_OFF = """[...document.querySelectorAll('body *')].filter((one) => {
  const { width, left, right } = one.getBoundingClientRect();
  if (!one.offsetParent || one.closest('.hidden, option') || !width) return false;
  const clips = getComputedStyle(one).overflowX !== 'visible' && one.clientWidth > 0 && one.tagName !== 'I';
  return left < -1 || right > innerWidth + 1 || (clips && one.scrollWidth > one.clientWidth + 1);
}).map((one) => `${one.tagName} ${one.id} ${one.className} ${one.textContent.slice(0, 40)}`)"""


@pytest.mark.parametrize("desk", [{"width": 1024, "height": 768}, PHONE], ids=["a small desk", "a phone"])
def test_nothing_of_any_part_is_cut_off(play, visit, desk, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    robot = play("g1", "--record", "a_recording_of_this_morning.mcap")
    page = visit(url_of(robot), **desk)
    for tab in ("plots", "motors", "actions", "rig", "events", "dds", "services", "recordings", "remote"):
        show(page, tab)
        page.evaluate("new Promise((done) => setTimeout(done, 300))")
        assert page.evaluate(CUT_OFF) == [], tab
        assert page.text("#ground").endswith(" N")


def test_a_phone_holds_the_remote_and_nothing_is_wider_than_it(play, visit):
    robot = play("g1")
    page = visit(url_of(robot), **PHONE)
    for tab in ("plots", "motors", "actions", "rig", "events", "dds", "services", "recordings", "remote"):
        show(page, tab)
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth"), tab
        assert page.evaluate(
            f"document.getElementById('{tab}').getBoundingClientRect().right <= innerWidth"), tab
        # Nothing in it is cut off, nor can it be moved sideways.
        assert page.evaluate(f"""[...document.querySelectorAll('#{tab}, #{tab} .scroll')].every(
            (one) => one.scrollWidth <= one.clientWidth)"""), tab

    # Two thumbs: a chord that a mouse could not press.
    keys = [page.middle("[data-key=R2]"), page.middle("[data-key=X]")]
    page.call("Input.dispatchTouchEvent", type="touchStart",
              touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(keys)])
    robot.becomes(lambda now: set(now["remote"]["keys"].split("+")) == {"R2", "X"})
    page.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    robot.becomes(lambda now: now["remote"]["keys"] == "")


# The parts of the robot that the tools, the readings or the edges of the view lie over.
COVERED = """(() => {
  const { view } = panel;
  view.camera.updateMatrixWorld();
  const box = view.canvas.getBoundingClientRect();
  const over = [...view.canvas.parentElement.querySelectorAll(".tools, .overlay")]
    .map((one) => one.getBoundingClientRect());
  return view.robotBodies().filter(({ position }) => {
    const at = position.clone().project(view.camera);
    const [x, y] = [box.x + (at.x + 1) / 2 * box.width, box.y + (1 - at.y) / 2 * box.height];
    return Math.abs(at.x) > 1 || Math.abs(at.y) > 1 ||
      over.some(({ left, right, top, bottom }) => x > left && x < right && y > top && y < bottom);
  }).map(({ userData }) => userData.name);
})()"""


@pytest.mark.parametrize("desk", [DESK, PHONE], ids=["a desk", "a phone"])
@pytest.mark.parametrize("robot", ["go2", "g1"])
def test_nothing_lies_over_the_robot_at_the_first_look(play, visit, robot, desk):
    page = visit(url_of(play(robot)), **desk)

    assert page.evaluate(COVERED) == []


def test_the_names_over_a_plot_leave_it_most_of_the_height_on_a_small_desk(play, visit):
    page = visit(url_of(play("g1")), width=1024, height=768)
    page.becomes("panel.plots.plots.every(({ dygraph }) => dygraph)")

    heights = page.evaluate("panel.plots.plots.map(({ node, chart }) => [chart.clientHeight, node.clientHeight])")

    assert len(heights) == 2
    assert all(chart > 0.55 * whole for chart, whole in heights), heights


def test_a_finger_that_rests_on_a_button_is_told_what_it_does_and_a_tap_is_not(play, visit):
    page = visit(url_of(play("go2")), **PHONE)
    x, y = page.middle("#com")

    def touch(kind, *points):
        page.call("Input.dispatchTouchEvent", type=kind, touchPoints=[{"x": x, "y": y} for x, y in points])

    # A tap that is short also on a slow machine.
    page.evaluate("""['pointerdown', 'pointerup'].forEach((kind) => document.getElementById('com').dispatchEvent(
        new PointerEvent(kind, { bubbles: true, pointerType: 'touch' })))""")
    page.evaluate("new Promise((done) => setTimeout(done, 700))")
    assert page.evaluate("document.getElementById('tip').hidden")

    touch("touchStart", (x, y))
    page.becomes("!document.getElementById('tip').hidden")
    assert page.text("#tip") == "Centre of mass"
    touch("touchEnd")
    page.becomes("document.getElementById('tip').hidden")  # after a while


def test_a_question_mark_shows_the_keys_and_not_while_one_types(page):
    show(page, "events")
    page.evaluate("document.getElementById('events-search').focus()")
    page.key("keyDown", "Slash", "?")
    assert not page.evaluate("document.getElementById('help').open")
    page.evaluate("document.activeElement.blur()")

    page.key("keyDown", "Slash", "?")

    assert page.evaluate("document.getElementById('help').open")
    assert "L2+B" in page.text("#help") and "Backspace" in page.text("#help")
    page.click("#help-close")
    assert not page.evaluate("document.getElementById('help').open")


def test_parts_are_resized_and_stay_so(play, visit):
    page = visit(url_of(play("go2", "--released")), width=1440, height=900)
    sizes = """['motors', 'plots'].map((id) => document.getElementById(id).getBoundingClientRect())
        .map(({ width, height }, i) => Math.round(i ? height : width))"""
    width, height = page.evaluate(sizes)

    def drag(bar, dx, dy):
        x, y = page.middle(bar)
        page.mouse("mousePressed", x, y)
        page.mouse("mouseMoved", x + dx, y + dy)
        page.mouse("mouseReleased", x + dx, y + dy, held=False)

    drag("#split-side", -80, 0)
    drag("#split-foot", 0, -60)
    wider, higher = page.evaluate(sizes)
    assert (wider - width, higher - height) == (pytest.approx(80, abs=4), pytest.approx(60, abs=4))

    page.call("Page.reload")
    page.becomes("window.panel?.view.placed")
    page.becomes(f"JSON.stringify({sizes}) === '[{wider},{higher}]'")
    drag("#split-side", 5000, 0)  # nothing can be pushed out of the page
    assert page.evaluate(sizes)[0] >= 320
    page.evaluate("document.querySelectorAll('.split').forEach((one) => one.dispatchEvent(new Event('dblclick')))")
    assert page.evaluate(sizes) == [width, height]


def test_a_phone_gives_the_view_its_room_and_tells_the_state(play, visit):
    page = visit(url_of(play("go2")), **PHONE)
    page.becomes("document.getElementById('owner').textContent === 'standing'")

    assert page.evaluate("document.getElementById('canvas').clientHeight") > 300
    assert page.evaluate("document.querySelector('header').clientHeight") < 90
    assert not page.evaluate("document.getElementById('pause').offsetParent")
    page.click("#bar-more")
    assert page.evaluate("Boolean(document.getElementById('pause').offsetParent)")


# Numbers that nothing gives a unit: no letter or sign of their own, none beside or above them.
WITHOUT_UNIT = """[...document.querySelectorAll('.num, output, .value')].filter((one) => {
  if (!one.offsetParent || !/^[-−]?[0-9.]+( [-−]?[0-9.]+)*$/.test(one.textContent.trim())) return false;
  const unit = (text) => /[a-z°%×µ]/i.test(text ?? "");
  const cell = one.closest('td');
  if (!cell) return !unit(one.parentElement.querySelector('.unit')?.textContent);
  const table = cell.closest('table');
  const head = table.tHead?.rows[0].cells[cell.cellIndex];
  return !unit(head?.querySelector('small')?.textContent) && !unit(cell.parentElement.lastElementChild.textContent)
    && !unit(cell.querySelector('small')?.textContent);
}).map((one) => `${one.id || one.className} ${one.closest('td')?.cellIndex ?? ''} ${one.textContent}`)"""
COUNTS = {"late", "accepted", "refused"}  # of ticks and of commands


def test_every_number_has_its_unit(play, visit):
    robot = play("g1")
    page = visit(url_of(robot))
    page.evaluate("panel.link.post('service/call', { service: 'motion_switcher', api: 1001 })")
    page.evaluate("['truth', 'damage'].forEach((id) => (document.getElementById(id).open = true))")
    page.becomes("document.querySelectorAll('#damage-rows tr').length > 20 &&"
                 "document.querySelectorAll('#truth-rows tr').length > 20")
    for tab in ("remote", "actions", "rig", "events", "dds", "services", "recordings"):
        show(page, tab)
        page.evaluate("new Promise((done) => setTimeout(done, 500))")
        bare = [one for one in page.evaluate(WITHOUT_UNIT) if one.split()[0] not in COUNTS]
        if tab == "services":  # the number of the api and that of its calls
            bare = [one for one in bare if one.split()[1] not in ("1", "3")]
        assert bare == [], tab


def test_nothing_of_the_table_of_motors_is_cut_off_on_a_small_desk(play, visit):
    page = visit(url_of(play("g1_29dof_dex3")), width=1024, height=768)

    assert page.evaluate("(t => t.scrollWidth <= t.clientWidth)(document.querySelector('#motors .scroll'))")
    assert page.evaluate("document.querySelector('#motor-rows .state').scrollWidth") <= page.evaluate(
        "document.querySelector('#motor-rows .state').clientWidth")


CONTRAST = """(() => {
  const style = getComputedStyle(document.documentElement);
  const light = (name) => {
    const probe = document.createElement("i");
    probe.style.color = style.getPropertyValue(name);
    document.body.append(probe);
    const [r, g, b] = getComputedStyle(probe).color.match(/[0-9.]+/g).map((part) => part / 255)
      .map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4));
    probe.remove();
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const against = (text, ground) => {
    const [low, high] = [light(text), light(ground)].sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
  };
  return { ground: light("--panel"),
           least: Math.min(...["--text", "--muted", "--accent", "--good", "--warn", "--bad"]
             .map((name) => against(name, "--panel"))) };
})()"""


def test_it_is_legible_in_light_and_in_dark(page):
    light = page.evaluate(CONTRAST)
    page.scheme("dark")
    dark = page.evaluate(CONTRAST)
    page.scheme("light")

    assert light["ground"] > 0.8 and dark["ground"] < 0.05
    assert min(light["least"], dark["least"]) >= 4.5  # WCAG 2 AA for text


def test_every_control_can_be_reached_by_tab_and_has_a_name(page):
    page.call("Accessibility.enable")

    nodes = page.call("Accessibility.getFullAXTree")["nodes"]

    roles = {"button", "combobox", "checkbox", "textbox", "searchbox", "spinbutton", "tab"}
    controls = [node for node in nodes
                if not node.get("ignored") and node["role"]["value"] in roles]
    assert len(controls) > 40
    assert [node for node in controls if not node["name"].get("value")] == []
    # Of tabs the chosen one alone is in the row; arrow keys reach the others.
    assert page.evaluate("""[...document.querySelectorAll("button, select, input")].filter((one) =>
        one.tabIndex < 0 && !(one.role === "tab" && one.ariaSelected === "false")).length""") == 0
