"""The panel in a browser, as a person uses it: looked at, dragged, pressed, in Debian's Chromium."""

import pathlib

import pytest

from panel_page import DOMAIN, browser, dog, dogs_page, page, show, url_of, visit
from peers import GoLowCmd, go_command, speaker
from robots import understudy

# A small copy of what the view shows now: [r, g, b, a, ...] of 48 x 32 points.
PIXELS = """(() => {
  const { view } = panel;
  view.place(view.snapshot);
  view.renderer.render(view.scene, view.camera);
  const small = Object.assign(document.createElement("canvas"), { width: 48, height: 32 });
  const context = small.getContext("2d");
  context.drawImage(view.canvas, 0, 0, 48, 32);
  return [...context.getImageData(0, 0, 48, 32).data];
})()"""

# Where the base is on the screen [px].
BASE_ON_SCREEN = """(() => {
  const { view } = panel;
  const at = view.bodies[view.base].position.clone().project(view.camera);
  const box = view.canvas.getBoundingClientRect();
  return [box.x + (at.x + 1) / 2 * box.width, box.y + (1 - at.y) / 2 * box.height];
})()"""


def differing(before, after):
    """The share of points that are clearly not the same."""
    changed = sum(any(abs(a - b) > 12 for a, b in zip(before[i:i + 3], after[i:i + 3]))
                  for i in range(0, len(before), 4))
    return changed / (len(before) / 4)


def test_the_panel_shows_the_robot_and_that_it_moves(play, visit):
    robot = play("go2", "--start", "hanging")
    page = visit(url_of(robot))
    before = page.evaluate(PIXELS)
    colours = {tuple(before[i:i + 3]) for i in range(0, len(before), 4)}
    assert len(colours) > 30

    show(page, "rig")
    page.click("#crane-hook")

    robot.becomes(lambda now: not now["crane"]["attached"] and now["base"]["height"] < 0.4)
    page.becomes("panel.view.snapshot.bodies[panel.view.base][2] < 0.4")
    page.evaluate("panel.view.home()")
    assert differing(before, page.evaluate(PIXELS)) > 0.005
    host = url_of(robot).split("#")[0]
    assert [url for url in page.requests if not url.startswith(host)] == []


def test_a_drag_in_the_view_pulls_the_robot_until_it_is_let_go(page):
    page.click("#push-tool")
    x, y = page.evaluate(BASE_ON_SCREEN)
    start = page.evaluate("panel.view.snapshot.bodies[panel.view.base]")

    page.mouse("mousePressed", x, y)
    for way in range(0, 160, 20):
        page.mouse("mouseMoved", x + way, y)
    page.becomes("panel.view.snapshot.pushes.length > 0")
    page.becomes(f"Math.hypot(panel.view.snapshot.bodies[panel.view.base][0] - {start[0]},"
                 f"panel.view.snapshot.bodies[panel.view.base][1] - {start[1]}) > 0.02")
    page.mouse("mouseReleased", x + 140, y, held=False)

    page.becomes("panel.view.snapshot.pushes.length === 0")


def test_a_push_in_numbers_pushes_and_one_without_a_number_is_told_why_not(page):
    show(page, "rig")
    fill = "Object.assign(document.querySelector('#rig form[aria-label=push] [aria-label=\"{}\"]'), {{ value: '{}' }}), 0"
    submit = "document.querySelector('#rig form[aria-label=push]').requestSubmit()"
    page.evaluate(submit)
    page.becomes("document.getElementById('message').textContent.includes('force or impulse')")

    for called, value in (("body", "base_link"), ("force y", "5"), ("for", "60")):
        page.evaluate(fill.format(called, value))
    page.evaluate(submit)
    page.becomes("panel.view.snapshot.pushes.length === 1 && panel.view.snapshot.pushes[0].force[1] === 5")
    page.evaluate("panel.link.post('reset')")

    page.becomes("panel.view.snapshot.pushes.length === 0")
    show(page, "remote")


def test_a_refused_command_is_an_event_with_its_reason(page):
    said = "document.getElementById('event-list').textContent.includes('LowCmd (crc): its crc')"

    with speaker("rt/lowcmd", GoLowCmd, DOMAIN) as program:
        program.speak_until(lambda: page.evaluate(said), go_command())


def test_the_damage_sheet_opens_under_the_motors_and_goes_on(page):
    page.evaluate("document.getElementById('damage').open = true")
    page.becomes("document.querySelectorAll('#damage-rows tr').length === 12")
    note = "document.getElementById('damage-note').textContent"
    cell = "document.querySelector('#damage-rows tr {}').textContent"

    assert page.evaluate(cell.format("th")) == "FR_hip"
    assert 20 <= float(page.evaluate(cell.format("td:nth-child(5)"))) <= 60  # °C
    assert page.evaluate("document.querySelector('#damage-rows td').title") == "limit 23.7 N·m"
    limits = page.evaluate("[...document.querySelectorAll('#damage-limits tr')].map((row) => "
                           "[...row.cells].map((cell) => cell.textContent))")
    assert [row for row in limits if row[0] != "falls" and not all(row)] == []
    limit_of = {row[0]: row[2:] for row in limits}
    reached = {row[0]: row[1] for row in limits}
    assert reached["energy"].endswith(" J") and reached["at torque limit"].split(" ", 2)[1:] in (["s"], ["s", "beyond"])
    assert limit_of["at torque limit"][:2] == ["23.7, 45.43", "N·m"]
    assert "robot.motors[].torque_limit" in limit_of["at torque limit"][2]
    assert limit_of["hardest stop"] == ["1", "rad/s", "assumed: none is published"]
    before = page.evaluate(note)
    assert " fall" in before and " J, " in before
    page.becomes(f"{note} !== {before!r}")  # its energy


def test_pause_stops_time_and_a_step_is_one_tick(page):
    page.click("#pause")
    page.becomes("panel.view.snapshot.paused && !document.getElementById('step').disabled")
    step = page.evaluate("panel.view.snapshot.step")
    page.click("#step")
    page.becomes(f"panel.view.snapshot.step === {step + 1}")
    page.click("#pause")

    page.becomes(f"!panel.view.snapshot.paused && panel.view.snapshot.step > {step + 100}")


def test_a_recording_is_started_and_ended_by_one_button(page):
    pressed = "document.getElementById('record').getAttribute('aria-pressed') === '{}'"
    page.click("#record")
    page.becomes(pressed.format("true"))
    file = pathlib.Path(page.evaluate("document.getElementById('record').title").split(", ")[0])
    try:
        page.click("#record")
        page.becomes(pressed.format("false"))
        assert understudy("recording", file).stdout.startswith(f"{file}: go2, ")
    finally:
        file.unlink()


def test_speed_is_chosen_in_the_bar(page):
    choose = ("(s => {{ s.value = '{}'; s.dispatchEvent(new Event('change')); }})"
              "(document.getElementById('speed'))")

    page.evaluate(choose.format("0.5"))
    page.becomes("panel.view.snapshot.speed === 0.5")
    page.evaluate(choose.format("1"))

    page.becomes("panel.view.snapshot.speed === 1")


def test_a_speed_that_another_sets_is_shown_although_the_list_has_the_focus(page):
    page.evaluate("document.getElementById('speed').focus()")

    page.evaluate("panel.link.post('speed', { speed: 2 })")
    page.becomes("document.getElementById('speed').value === '2'")
    page.evaluate("panel.link.post('speed', { speed: 1 })")

    page.becomes("document.getElementById('speed').value === '1'")
    page.evaluate("document.activeElement.blur()")


def test_a_second_page_lets_go_of_nothing_that_is_held(dog, page, visit):
    page.evaluate("panel.link.post('drag', { body: 'base_link', to: [0, 0, 0.6], for: 60 })")
    second = visit(url_of(dog))
    second.becomes("panel.link.requestsOpen")

    step = second.evaluate("panel.view.snapshot.step")
    second.becomes(f"panel.view.snapshot.step > {step}")

    assert second.evaluate("panel.view.snapshot.pushes.length") == 1
    page.evaluate("panel.link.post('let_go')")


# Requests go nowhere and are all refused; `link.asked` has them.
REFUSE = """(() => {
  const { link } = panel;
  link.asked = [];
  link.request = async (name) => (link.asked.push(name), { status: 409, error: "not today" });
})()"""
REFUSE_NO_MORE = "delete panel.link.request && delete panel.link.asked"


def test_what_is_refused_many_times_a_second_is_complained_of_once(page):
    page.evaluate(REFUSE)
    page.key("keyDown", "KeyE", "e")
    page.becomes("panel.link.asked.length > 4")
    page.key("keyUp", "KeyE", "e")
    page.evaluate(REFUSE_NO_MORE)

    assert page.evaluate("[...document.querySelectorAll('#event-list li')]"
                         ".filter((line) => line.textContent.includes('not today')).length") == 1


def test_space_pauses_once_however_long_it_is_held(page):
    page.evaluate(REFUSE)
    page.key("keyDown", "Space", " ")
    for _ in range(3):
        page.call("Input.dispatchKeyEvent", type="keyDown", code="Space", key=" ", autoRepeat=True)
    page.key("keyUp", "Space", " ")
    asked = page.evaluate("panel.link.asked")
    page.evaluate(REFUSE_NO_MORE)

    assert [name for name in asked if name != "remote.set"] == ["pause"]  # keys let go before


def test_another_robot_at_the_same_address_is_another_page_though_its_process_has_the_same_number(page):
    page.evaluate("window.before = true; panel.link.known.robot = 'g1'; panel.link.snapshots.close()")

    page.becomes("!window.before && window.panel?.view.placed && panel.link.known.robot === 'go2'")


def test_without_the_token_one_may_only_look(dog, visit):
    page = visit(url_of(dog).split("#")[0])

    assert "has no token" in page.text("#token")
    assert page.evaluate("[...document.querySelectorAll('.requests')].every((one) => one.disabled)")
    page.becomes("panel.view.snapshot.motors.length === 12")


def test_it_says_that_the_robot_has_gone_and_what_to_do_when_another_comes(play, visit):
    first = play("go2")
    page = visit(url_of(first))
    port = url_of(first).split(":")[2].split("/")[0]

    first.end()
    page.becomes("document.getElementById('lost').textContent.startsWith('Connection lost')")
    second = play("go2", "--set", f"control.port={port}", name="other")
    page.becomes("document.getElementById('token')?.textContent.includes('Open the new URL')")
    assert page.evaluate("document.getElementById('lost').hidden")
    page.call("Page.navigate", url=url_of(second))

    page.becomes("document.body && !document.body.classList.contains('looking')")
    page.errors.clear()  # the browser reports a server that is not there and a token refused


# What a picture may ask of a graphics card; *assumed*. 20 us for a call, with what WebGL checks and a laptop's driver does,
# make 10 ms of 500. A laptop's graphics of ten years ago do some 500 triangles a microsecond.
MOST_CALLS = 500
MOST_TRIANGLES = 500_000


@pytest.mark.parametrize("options", [["go2"], ["g1_29dof_dex3"], ["go2", "--scene", "rough"]], ids=" ".join)
def test_a_picture_asks_little_of_the_graphics_card(play, visit, options):
    drawn = visit(url_of(play(*options))).evaluate("""(() => {
      const { view } = panel;
      view.quality.level = 0;
      view.quality.apply();
      view.renderer.render(view.scene, view.camera);
      return view.renderer.info.render;
    })()""")
    assert 10 < drawn["calls"] < MOST_CALLS
    assert 10_000 < drawn["triangles"] < MOST_TRIANGLES


# The last one: the view still swings for a while after it.
def test_what_the_robots_camera_sees_is_shown_in_the_view_while_it_is_chosen(page):
    def choose(name):
        page.evaluate("(list => { list.value = '%s'; list.dispatchEvent(new Event('change')); })"
                      "(document.getElementById('eyes'))" % name)

    page.becomes("!document.getElementById('eyes').hidden")
    choose("front")
    page.becomes("!document.getElementById('seen').hidden")
    width, height, colours = page.evaluate("""(seen => {
        const bits = seen.getContext("2d").getImageData(0, 0, seen.width, seen.height).data;
        const colours = new Set();
        for (let i = 0; i < bits.length; i += 400) colours.add(`${bits[i]} ${bits[i + 1]} ${bits[i + 2]}`);
        return [seen.width, seen.height, colours.size];
      })(document.getElementById("seen"))""")
    assert (width, height) == (1280, 720) and colours > 10
    choose("")
    page.becomes("document.getElementById('seen').hidden")


READS_CLOUD = """fetch("/bus").then((reply) => reply.json()).then(({ topics }) => topics.some(({ topic, endpoints }) =>
  topic === "rt/utlidar/%s" && endpoints.some(({ writes }) => !writes)))"""


@pytest.mark.parametrize("button, topic", [("cloud", "cloud"), ("heights", "height_map_array")])
def test_what_the_lidar_sees_is_drawn_while_its_button_is_pressed_and_read_no_longer(play, visit, button, topic):
    page = visit(url_of(play("go2", "--start", "standing")))
    page.becomes(f"!document.getElementById('{button}').hidden")
    assert page.evaluate(READS_CLOUD % topic) is False

    page.click(f"#{button}")
    points = f"panel.sight.clouds.{button}"
    # The ground is where the robot stands. A page that was held up for long begins with no points.
    low, high = page.becomes(f"""(() => {{
        const {{ visible, matrix, geometry }} = {points}, m = matrix.elements, p = geometry.attributes.position;
        if (!visible || p.count < 500) return null;
        const z = [...Array(p.count).keys()].map((i) =>
          m[2] * p.getX(i) + m[6] * p.getY(i) + m[10] * p.getZ(i) + m[14]).sort((a, b) => a - b);
        return [z[Math.floor(0.1 * z.length)], z[Math.floor(0.5 * z.length)]];
      }})()""")
    page.becomes(READS_CLOUD % topic)
    assert -0.06 < low <= high < 0.06

    page.click(f"#{button}")
    page.becomes(f"!{points}.visible")
    page.becomes(f"({READS_CLOUD % topic}).then((reads) => !reads)")


def test_no_drag_takes_the_view_under_the_ground(page):
    x, y = page.middle("#canvas")
    page.mouse("mousePressed", x, y)
    for i in range(1, 11):
        page.mouse("mouseMoved", x, y - 30 * i)
    page.mouse("mouseReleased", x, y - 300, held=False)

    page.becomes("panel.view.controls.getPolarAngle() > 1.5")
    assert page.evaluate("panel.view.camera.position.z") > 0.02
    page.evaluate("panel.view.home()")


def test_the_list_of_robots_leads_to_the_panel_of_another(play, visit, tmp_path):
    world = tmp_path / "world.yaml"
    world.write_text("robots: {left: {robot: go2}, right: {robot: g1, start: {pose: hanging}}}\n")
    page = visit(url_of(play(world, name="pair", ready=False)))
    page.becomes("document.getElementById('robots').length === 2")
    assert page.evaluate("document.getElementById('robots').selectedOptions[0].text") == "left"
    here = page.evaluate("location.port")
    page.evaluate("""(() => {
      const robots = document.getElementById("robots");
      robots.value = robots.options[1].value;
      robots.dispatchEvent(new Event("change"));
    })()""")
    page.becomes(f"location.port !== '{here}' && window.panel?.view.placed"
                 " && document.getElementById('robots').selectedOptions[0]?.text === 'right'")
    assert "G1" in page.text("#robot").upper()


def test_what_presses_on_each_hand_stands_with_the_sensors(play, visit):
    page = visit(url_of(play("g1", "--hands", "left:dex1,right:inspire", "--start", "clamped")))

    page.becomes("/^hands left [0-9.]+ right [0-9.]+ N$/.test([...document.querySelectorAll('#sensor-rows tr')]"
                 ".at(-1)?.innerText.replace(/\\s+/g, ' ').trim())")
