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
