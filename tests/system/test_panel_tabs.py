"""What the tabs of the panel show and do: actions, DDS, services, truth, events, what one takes away."""

import os
import re
import time

import pytest

from cyclonedds import idl
from cyclonedds.idl.types import uint32
from panel_page import DOMAIN, browser, dog, dogs_page, page, show, url_of, visit
from peers import GoLowCmd, HgLowState, go_command, listener, speaker
from robots import eventually

def keys_of(page):
    """What was pressed so far."""
    events = page.evaluate("fetch('/events').then((reply) => reply.json())")["events"]
    return [event["detail"]["keys"] for event in events if event["kind"] == "remote"]


def chord(name):
    return f"[...document.querySelectorAll('.chord')].find((one) => one.textContent.startsWith('{name}'))"


def test_a_button_by_the_name_of_a_chord_presses_its_keys_and_damp_stops_all(play, visit):
    robot = play("go2")
    page = visit(url_of(robot))
    robot.becomes(lambda now: now["motion"]["state"] == 100)
    show(page, "actions")
    page.becomes(f"{chord('Sit')} && !{chord('Sit')}.disabled")

    page.evaluate(f"{chord('Sit')}.click()")
    robot.becomes(lambda now: now["motion"]["name"] == "sitting")
    page.click("#damp")  # in the bar, whatever tab is seen

    robot.becomes(lambda now: now["motion"]["state"] == 1001)
    eventually(lambda: keys_of(page)[-4:] == ["R1+B", "", "L2+B", ""])
    page.evaluate(f"{chord('Recovery stand')}.click()")
    robot.becomes(lambda now: now["motion"]["state"] == 100)
    page.evaluate(f"{chord('Trot')}.click()")  # START twice
    eventually(lambda: keys_of(page)[-4:] == ["START", "", "START", ""])


def test_a_button_never_does_what_another_of_the_same_keys_would(play, visit):
    robot = play("go2")
    page = visit(url_of(robot))
    show(page, "actions")

    # L2+A is "stand down" in 1002 and "stand up" elsewhere.
    page.becomes(f"{chord('Stand down')}?.disabled && !{chord('Stand up')}.disabled")
    page.evaluate(f"{chord('Stand up')}.click()")
    robot.becomes(lambda now: now["motion"]["state"] == 1002)

    page.becomes(f"{chord('Stand up')}.disabled && !{chord('Stand down')}.disabled")


def note(name):
    return f"{chord(name)}.querySelector('.note-line').textContent"


def test_an_action_says_what_it_needs_and_what_came_of_a_click(play, visit):
    robot = play("go2")
    page = visit(url_of(robot))
    show(page, "actions")
    page.click("#damp")
    robot.becomes(lambda now: now["motion"]["state"] == 1001)
    page.becomes(f"{note('Balance stand')} === 'press L2+A first'")

    page.evaluate(f"{chord('Balance stand')}.click()")
    page.becomes(f"{note('Balance stand')}.includes('no effect in damping (1001); press L2+A first')")
    assert page.text("#chords-said").startswith("Balance stand: START has no effect")
    page.evaluate(f"{chord('Stand up')}.click()")

    page.becomes(f"{note('Stand up')}.startsWith('taken: ')")
    robot.becomes(lambda now: now["motion"]["state"] == 1002)
    page.becomes(f"!{chord('Balance stand')}.classList.contains('pale')")


@pytest.mark.parametrize("robot", ["g1", "h1", "b2", "r1"])
def test_the_actions_of_every_robot_have_names(play, visit, robot):
    page = visit(url_of(play(robot)))
    show(page, "actions")
    page.becomes("document.querySelectorAll('.chord').length > 1")

    texts = page.evaluate("[...document.querySelectorAll('.chord')].map((one) => one.firstChild.textContent + one.title)")

    assert [text for text in texts if re.search(r"[Ss]tate \d|\d{3}", text)] == []


def test_late_ticks_are_one_line_with_their_count(play, visit):
    page = visit(url_of(play("go2", "--released")))
    lines = "[...document.querySelectorAll('#event-list li')].filter((one) => one.textContent.includes('began late'))"
    add = """(at) => import("/panel/events.js").then(({ Events }) => {
        window.folding ??= new Events();
        window.folding.show({ number: at, kind: "overrun", level: "", time: at, text: "late",
                              detail: { count: at, worst: 0.001 * at } });
      })"""
    page.evaluate("panel.link.on.event = () => {}")  # a busy machine is late too
    page.click("#tab-events")
    page.evaluate("document.getElementById('events-clear').click()")
    for at in (2, 3, 5):
        page.evaluate(f"({add})({at})")

    texts = page.evaluate(f"{lines}.map((one) => one.lastChild.textContent)")

    assert texts == ["10 ticks began late since 2.0 s, the worst by 5.0 ms"]


def test_the_dds_tab_tells_who_reads_and_writes_how_often_and_what_does_not_match(page):
    row = """[...document.querySelectorAll('#dds-rows tr')].find((row) =>
        row.querySelector('.name')?.textContent === 'rt/lowcmd')"""
    with listener("rt/lowstate", HgLowState, DOMAIN), speaker("rt/lowcmd", GoLowCmd, DOMAIN) as program:
        show(page, "dds")
        page.becomes("document.querySelector('#dds-rows .bad')?.textContent.includes("
                     "'type unitree_go::msg::dds_::LowState_, not unitree_hg::msg::dds_::LowState_')")
        page.becomes(f"/process \\d+ \\(.*python.*this robot$/.test({row}?.textContent)")
        # Some messages a second, as they come.
        end = time.monotonic() + 30
        rate = f"Number(({row})?.querySelector('.num').textContent)"
        while not page.evaluate(f"{rate} > 0"):
            program.write_for(0.5, go_command())
            assert time.monotonic() < end
        page.evaluate(f"({row}).querySelector('.name').click()")
        page.becomes("[...document.querySelectorAll('#dds-rows .more')].some((one) =>"
                     "one.textContent === 'this robot reads unitree_go/LowCmd_: best effort, volatile')")
    # Who has gone is forgotten; all topics are there when they are asked for.
    page.becomes("document.querySelectorAll('#dds-rows tr').length === 0")
    page.click("#dds-all")
    page.evaluate("Object.assign(document.getElementById('dds-search'), { value: 'SWITCHER request' })"
                  ".dispatchEvent(new Event('input'))")
    page.becomes("[...document.querySelectorAll('#dds-rows .name')].map((one) => one.textContent).join()"
                 " === 'rt/api/motion_switcher/request,rt/api/motion_switcher_lease/request'")
    show(page, "remote")


def test_the_dds_tab_tells_of_types_of_one_name_with_another_definition(page):
    other = idl.make_idl_struct("LowCmd_", "unitree_go.msg.dds_.LowCmd_", {"wheels": uint32})
    with speaker("rt/lowcmd", other, DOMAIN):
        show(page, "dds")
        page.evaluate("Object.assign(document.getElementById('dds-search'), { value: 'rt/lowcmd' })"
                      ".dispatchEvent(new Event('input'))")
        page.becomes("document.querySelector('#dds-rows .bad')?.textContent.includes("
                     "'each has another definition of unitree_go::msg::dds_::LowCmd_')")
    page.becomes("document.querySelectorAll('#dds-rows .bad').length === 0")
    page.evaluate("Object.assign(document.getElementById('dds-search'), { value: '' })"
                  ".dispatchEvent(new Event('input'))")
    show(page, "remote")


def test_the_services_tab_calls_an_api_and_shows_what_it_answers(page):
    show(page, "services")
    page.evaluate("""(() => {
        const choose = (id, value) => Object.assign(document.getElementById(id), { value })
          .dispatchEvent(new Event("change"));
        choose("service-name", "motion_switcher");
        choose("service-api", "1001");
        document.getElementById("service-form").requestSubmit();
        choose("service-api", "1002");
        document.getElementById("service-form").requestSubmit();
      })()""")
    rows = "[...document.querySelectorAll('#services-rows tr')].map((row) => row.innerText.replace(/\\s+/g, ' '))"

    page.becomes(f"{rows}.some((row) => /^motion_switcher 1001 CheckMode 1 0 ok/.test(row))")
    # Without the name of a motion service: refused, with the reason.
    page.becomes(f"{rows}.some((row) => /^motion_switcher 1002 SelectMode 1 .*parameter/.test(row))")
    page.evaluate("Object.assign(document.getElementById('services-search'), { value: 'checkmode' })"
                  ".dispatchEvent(new Event('input'))")
    page.becomes(f"{rows}.length === 1")
    page.evaluate("Object.assign(document.getElementById('services-search'), { value: '' })"
                  ".dispatchEvent(new Event('input'))")
    show(page, "remote")


def test_truth_stands_beside_what_is_measured_with_its_error(page):
    page.evaluate("document.getElementById('truth').open = true")
    page.becomes("document.querySelectorAll('#truth-rows tr').length > 20")

    rows = page.evaluate("""[...document.querySelectorAll('#truth-rows tr')].map((row) =>
        [...row.children].map((one) => one.textContent.replace('−', '-')))""")
    page.evaluate("document.getElementById('truth').open = false")

    names = [row[0] for row in rows]
    assert names[:2] == ["FR_hip", "FR_thigh"] and "imu roll" in names and "foot FR" in names
    for name, measured, true, error, unit in rows:
        assert unit
        rounded = 10.0 ** -len(measured.partition(".")[2])
        assert abs(float(measured) - float(true) - float(error)) < 1.6 * rounded, name
    assert any(float(row[3]) != 0 for row in rows)


def test_events_are_searched_also_those_that_come_later(page):
    find = "Object.assign(document.getElementById('events-search'), {{ value: '{}' }}).dispatchEvent(new Event('input'))"
    seen = "[...document.querySelectorAll('#event-list li')].filter((one) => !one.hidden).length"
    show(page, "events")
    page.evaluate(find.format("no such thing"))
    assert page.evaluate(seen) == 0
    page.evaluate("panel.link.request('pause').then(() => panel.link.request('resume'))")
    page.becomes("[...document.querySelectorAll('#event-list li')].some((one) => one.textContent.includes('paused'))")
    assert page.evaluate(seen) == 0

    page.evaluate(find.format("PAUSED"))
    page.becomes(f"{seen} > 0")
    page.evaluate(find.format(""))
    show(page, "remote")


def test_the_view_is_looked_at_from_a_side_leaves_a_trail_and_is_remembered(play, visit):
    robot = play("go2")
    page = visit(url_of(robot))
    page.evaluate("Object.assign(document.getElementById('camera'), { value: 'top' })"
                  ".dispatchEvent(new Event('change'))")
    page.becomes("panel.view.camera.position.z - panel.view.controls.target.z > 1.5")
    assert page.evaluate("Math.hypot(panel.view.camera.position.x - panel.view.controls.target.x,"
                         "panel.view.camera.position.y - panel.view.controls.target.y) < 0.1")
    page.click("#trail")
    # It walks on for as long as a slow page takes to see four places.
    page.evaluate("panel.link.post('remote/sticks', { ly: 0.5 })")
    page.becomes("panel.view.trail.points.length > 3")
    page.evaluate("(s => { s.value = 'battery voltage'; s.dispatchEvent(new Event('change')); })"
                  "(document.querySelector('.plot input'))")

    page.click("#plots-add")
    page.evaluate("(s => { s.value = '30'; s.dispatchEvent(new Event('change')); })(panel.plots.controls.seconds)")
    plots = page.evaluate("panel.plots.plots.map(({ names }) => names)")

    page.call("Page.reload")
    page.becomes("window.panel?.view.placed && document.getElementById('trail').ariaPressed === 'true'")
    page.becomes("panel.plots.plots[0].names.includes('battery voltage') && panel.view.trail.visible")
    assert page.evaluate("panel.plots.plots.map(({ names }) => names)") == plots
    assert page.evaluate("panel.plots.controls.seconds.value") == "30"


# x ahead of the base, y to its left.
@pytest.mark.parametrize(("place", "side"), [
    ("front", "x > 1 && Math.abs(y) < 0.3"), ("back", "x < -1 && Math.abs(y) < 0.3"),
    ("left", "y > 1 && Math.abs(x) < 0.3"), ("right", "y < -1 && Math.abs(x) < 0.3"),
])
def test_the_view_is_looked_at_from_the_side_that_is_chosen(page, place, side):
    page.evaluate(f"Object.assign(document.getElementById('camera'), {{ value: '{place}' }})"
                  ".dispatchEvent(new Event('change'))")
    page.becomes(f"""(({{ camera, controls, snapshot, base }}) => {{
        const [, , , w, qx, qy, qz] = snapshot.bodies[base];
        const yaw = Math.atan2(2 * (w * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
        const from = camera.position.clone().sub(controls.target);
        const x = from.x * Math.cos(yaw) + from.y * Math.sin(yaw);
        const y = from.y * Math.cos(yaw) - from.x * Math.sin(yaw);
        return {side};
      }})(panel.view)""")


def test_the_view_is_saved_as_a_picture_with_the_robot_in_it(page):
    page.evaluate("""window.saved = new Promise((done) => {
        const make = URL.createObjectURL;
        URL.createObjectURL = (blob) => {
          URL.createObjectURL = make;
          HTMLAnchorElement.prototype.click = function () { done([this.download, blob]); };
          return make(blob);
        };
      }), 0""")
    page.click("#picture")
    saved = page.evaluate("""window.saved.then(async ([name, blob]) => {
        const picture = await createImageBitmap(blob);
        const canvas = Object.assign(document.createElement("canvas"), { width: picture.width, height: picture.height });
        canvas.getContext("2d").drawImage(picture, 0, 0);
        const bits = canvas.getContext("2d").getImageData(0, 0, picture.width, picture.height).data;
        const colours = new Set();
        for (let i = 0; i < bits.length; i += 4) colours.add(`${bits[i]} ${bits[i + 1]} ${bits[i + 2]}`);
        return { name, size: [picture.width, picture.height], colours: colours.size };
      })""")
    page.evaluate("delete HTMLAnchorElement.prototype.click")

    assert re.fullmatch(r"go2 view \d+\.\d\d s\.png", saved["name"])
    assert min(saved["size"]) > 100
    assert saved["colours"] > 30


@pytest.mark.parametrize(("scene", "seen"), [("flat", False), ("rough", True), ("stairs_up", True)])
def test_the_first_look_has_the_uneven_ground_that_lies_ahead_in_it(play, visit, scene, seen):
    page = visit(url_of(play("go2", "--scene", scene)))

    # A place 3 m ahead of the robot, on the ground.
    at = page.evaluate("""(() => {
        const { view } = panel;
        view.camera.updateMatrixWorld();
        const place = view.bodies[view.base].position.clone();
        const at = place.setX(place.x + 3).setZ(0.05).project(view.camera);
        return [at.x, at.y, at.z];
      })()""")

    assert all(abs(one) < 1 for one in at) == seen, at


def test_plots_are_taken_away_as_a_picture_and_as_a_table(page):
    page.becomes("panel.plots.plots[0].dygraph && panel.plots.history.end - panel.plots.history.begin > 20")
    saved = page.evaluate("""import("/panel/save.js").then((m) => {
        const lines = m.tableOf(panel.plots).trim().split("\\r\\n");
        const picture = m.pictureOf(panel.plots);
        const bits = picture.getContext("2d").getImageData(0, 0, picture.width, picture.height).data;
        const colours = new Set();
        for (let i = 0; i < bits.length; i += 4) colours.add(`${bits[i]} ${bits[i + 1]} ${bits[i + 2]}`);
        return { head: lines[0], first: lines[1].split(",").map(Number), count: lines.length,
                 names: panel.plots.plots.flatMap((plot) => plot.names), colours: [...colours].length,
                 line: colours.has("10 123 196") };
      })""")
    assert saved["head"].startswith('"time [s]","' + saved["names"][0] + " [")
    assert len(saved["first"]) == len(set(saved["names"])) + 1
    assert saved["count"] > 20 and saved["colours"] > 10 and saved["line"]


def test_a_recording_of_another_robot_is_listed_with_the_reason_and_not_offered(play, visit, tmp_path):
    play("g1", "--record", tmp_path / "g1.mcap", "--duration", 0.5, "--speed", "max",
         cwd=tmp_path).process.wait(60)
    page = visit(url_of(play("go2", cwd=tmp_path)))
    show(page, "recordings")
    page.becomes("document.querySelector('#recordings-list button')?.disabled")
    assert "of the robot 'g1', and this is go2" in page.evaluate(
        "document.querySelector('#recordings-list p').textContent")


def test_a_recording_is_listed_and_played_in_the_view_by_its_time_bar(play, visit, tmp_path):
    robot = play("go2", "--released", "--start", "lying", "--record", tmp_path / "way.mcap",
                 "--duration", 3, "--speed", "max", cwd=tmp_path)
    robot.process.wait(60)
    page = visit(url_of(play("go2", cwd=tmp_path)))
    show(page, "recordings")
    page.becomes("document.querySelector('#recordings-list .name')?.textContent === 'way.mcap'")
    page.evaluate("document.querySelector('#recordings-list button').click()")

    # It lies there, and stands here.
    height = "panel.view.snapshot.bodies[panel.view.base][2]"
    page.becomes("document.getElementById('recording-time').textContent.endsWith('of 3.0 s') ||"
                 "document.getElementById('recording-time').textContent.includes('of 2.99')")
    page.evaluate("(bar => { bar.value = 1.5; bar.dispatchEvent(new Event('input')); })"
                  "(document.getElementById('recording-at'))")
    page.becomes("document.getElementById('recording-time').textContent.startsWith('1.5') ||"
                 "document.getElementById('recording-run').textContent === 'Play'")
    page.becomes("document.getElementById('recording-run').textContent === 'Play'")  # at its end
    assert page.evaluate("document.getElementById('recording-at').value > 2.9")
    recorded = page.evaluate(height)
    # All that is shown is the recording's, or blank.
    assert page.text("#time").startswith(("2.9", "3.0"))
    assert page.text("#place").split()[2] == f"{recorded:.2f}"
    assert [page.text(f"#{name}") for name in ("factor", "late", "battery", "line", "owner-text")] == [
        "–", "–", "–", "recording", "way.mcap"]
    row = page.evaluate("[...document.querySelector('#motor-rows tr').children].map((one) => one.textContent)")
    assert row[1] not in ("–", "") and row[3] == "–" and row[4] not in ("–", "") and row[6:8] == ["–", "–"]
    assert page.evaluate("panel.plots.history.newest") == pytest.approx(3, abs=0.1)
    # What acts on the live robot says why it does not, but Damp.
    assert page.evaluate("['pause', 'record', 'reset'].every((id) => document.getElementById(id).matches(':disabled'))")
    assert "Back to live" in page.evaluate("document.getElementById('bar').title")
    assert not page.evaluate("document.getElementById('damp').matches(':disabled')")
    show(page, "events")
    assert page.evaluate("getComputedStyle(document.getElementById('event-list')).visibility") == "hidden"
    assert page.evaluate("document.getElementById('events').inert")
    page.click("#recording-live")

    page.becomes(f"Math.abs({height} - {recorded}) > 0.1")
    assert page.evaluate("document.getElementById('player').hidden")
    page.becomes("document.getElementById('battery').textContent.endsWith('%')")
    assert not page.evaluate("document.getElementById('pause').matches(':disabled')")
    assert page.evaluate("panel.plots.history === panel.plots.live && !document.getElementById('events').inert")


def test_open_gives_the_browser_a_page_that_leads_to_the_panel_and_others_cannot_read(play, tmp_path, monkeypatch):
    browser_program = tmp_path / "xdg-open"
    browser_program.write_text(f'#!/bin/sh\nstat -c %a "$1" > {tmp_path}/seen\ncat "$1" >> {tmp_path}/seen\nexit 3\n')
    browser_program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    robot = play("go2", "--open")
    url = url_of(robot)

    said = robot.heard("no browser could be opened")["message"]  # xdg-open has failed
    mode, page = (tmp_path / "seen").read_text().split("\n", 1)
    assert mode == "600" and f"url={url}" in page
    assert "code 3" in said and said.endswith(url)
