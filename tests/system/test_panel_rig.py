"""What the panel does to a robot that is held, to its settings, by touch, and when its run has ended."""

import json

from panel_page import PHONE, browser, show, url_of, visit
from peers import go_command, speaker, GoLowCmd
from robots import eventually, understudy


def slide(page, joint, angle):
    page.evaluate(f"""(input => {{ input.value = {angle}; input.dispatchEvent(new Event("input")); }})
        (document.querySelector('#joint-sliders input[aria-label="{joint}, rad"]'))""")


def angle_of(page, motor):
    return page.evaluate(f"panel.view.snapshot.motors[{motor}].q")


def test_sliders_move_the_joints_of_a_clamped_robot_until_they_are_let_go(play, visit):
    robot = play("go2", "--start", "clamped", "--released")
    page = visit(url_of(robot))
    show(page, "rig")
    page.click("#joints-on")
    page.becomes("!document.getElementById('joint-sliders').hidden")
    hip = angle_of(page, 0)

    slide(page, "FR_hip", hip + 0.4)

    page.becomes(f"Math.abs(panel.view.snapshot.motors[0].q - {hip + 0.4}) < 0.05")
    assert "holds 1 of 12" in page.text("#joints-state")
    assert page.text("#joints-on") == "Release all joints"
    page.becomes("panel.view.snapshot.command[0].kp > 0 && panel.view.snapshot.command[1].kp === 0")
    page.click("#joints-on")
    page.becomes("panel.view.snapshot.command[0].kp === 0")
    assert page.text("#joints-state") == "off"

    # Whoever leaves lets go.
    page.click("#joints-on")
    slide(page, "FR_hip", hip)
    page.becomes("panel.view.snapshot.command[0].kp > 0")
    show(page, "remote")
    page.becomes("panel.view.snapshot.command[0].kp === 0")


def test_sliders_are_off_where_the_robot_is_free_or_a_program_commands_it(play, visit):
    robot = play("go2", "--start", "clamped", "--released")
    page = visit(url_of(robot))
    show(page, "rig")
    page.becomes("!document.getElementById('joints-on').disabled")
    with speaker("rt/lowcmd", GoLowCmd) as program:
        def commands():
            program.write_for(0.4, go_command())
            return page.evaluate("document.getElementById('joints-on').disabled")

        eventually(lambda: commands() and page.text("#joints-state") == "off: a program commands the motors")
    page.click("#clamp")
    page.becomes("document.getElementById('joints-state').textContent === 'off: the robot is not clamped'")


def test_a_setting_is_seen_with_its_unit_and_range_and_changed(play, visit):
    robot = play("go2")
    page = visit(url_of(robot))
    show(page, "rig")
    page.becomes("document.getElementById('setting-key').options.length > 20")
    page.evaluate("""(key => { key.value = "gate.timeout"; key.dispatchEvent(new Event("change")); })
        (document.getElementById("setting-key"))""")
    assert page.evaluate("document.getElementById('setting-value').value") == "0.2"
    assert page.text("#setting-unit") == "s"
    assert page.text("#setting-does").endswith("a number from 0.001 to 3600 s")
    page.evaluate("""(key => { key.value = "terrain.friction"; key.dispatchEvent(new Event("change")); })
        (document.getElementById("setting-key"))""")
    assert page.text("#setting-does").endswith("; 0 is 0.8 here")
    page.evaluate("""(key => { key.value = "gate.timeout"; key.dispatchEvent(new Event("change")); })
        (document.getElementById("setting-key"))""")

    page.evaluate("document.getElementById('setting-value').value = '0.5'")
    page.evaluate("document.getElementById('settings-form').requestSubmit()")

    page.becomes("fetch('/settings').then((reply) => reply.json()).then(({ settings }) =>"
                 " settings.find(({ key }) => key === 'gate.timeout').value === 0.5)")
    page.becomes("[...document.querySelectorAll('#event-list li')].some((one) =>"
                 " one.textContent.includes('set gate.timeout: 0.5 s, before 0.2'))")


def test_an_open_tab_finds_the_next_robot_of_the_domain_and_asks_for_its_url(play, visit):
    first = play("go2", name="dog")
    address = url_of(first)
    page = visit(address)
    first.end()
    page.becomes("document.getElementById('lost').textContent.startsWith('Connection lost')")

    second = play("go2", name="dog")

    place, token = url_of(second).split("#")
    assert place == address.split("#")[0]
    assert token != address.split("#")[1]
    page.becomes("document.getElementById('token')?.textContent.includes('Open the new URL')")
    page.becomes("window.panel?.view.placed")
    page.errors.clear()  # the browser reports a server that is not there and a token refused


def test_a_joint_is_refused_beyond_its_range(play):
    robot = play("go2", "--start", "clamped", "--released")
    done = understudy("ctl", "joint", "FR_hip_joint", "2")
    assert done.returncode == 1
    assert "FR_hip_joint: expected an angle from -1.0" in done.stderr
    robot.ctl("joint", "FR_hip_joint", "0.2")


def touch(page, kind, *points):
    page.call("Input.dispatchTouchEvent", type=kind,
              touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)])


def test_one_finger_turns_the_view_two_zoom_it_and_a_finger_holds_a_stick(play, visit):
    robot = play("go2")
    page = visit(url_of(robot), **PHONE)
    x, y = page.middle("#canvas")
    camera = "panel.view.camera.position.clone().sub(panel.view.controls.target)"
    before = page.evaluate(f"Math.atan2({camera}.y, {camera}.x)")
    touch(page, "touchStart", (x, y))
    for i in range(1, 6):
        touch(page, "touchMove", (x + 12 * i, y))
    touch(page, "touchEnd")
    page.becomes(f"Math.abs(Math.atan2({camera}.y, {camera}.x) - {before}) > 0.2")

    far = page.evaluate(f"{camera}.length()")
    touch(page, "touchStart", (x - 20, y), (x + 20, y))
    for i in range(1, 6):
        touch(page, "touchMove", (x - 20 - 10 * i, y), (x + 20 + 10 * i, y))
    touch(page, "touchEnd")
    page.becomes(f"{camera}.length() < 0.8 * {far}")

    show(page, "remote")
    x, y = page.middle("[data-stick='lx ly']")
    touch(page, "touchStart", (x, y - 20))
    robot.becomes(lambda now: now["remote"]["ly"] > 0.3)
    touch(page, "touchEnd")
    robot.becomes(lambda now: now["remote"]["ly"] == 0)


def choose(page, name, value):
    page.evaluate(f"""(list => {{ list.value = {json.dumps(value)}; list.dispatchEvent(new Event("change")); }})
        (document.getElementById('{name}'))""")


def test_a_fault_is_chosen_of_those_that_its_component_can_have_is_listed_and_removed(play, visit):
    robot = play("go2", "--start", "clamped", "--released")
    page = visit(url_of(robot))
    show(page, "rig")

    def offered():
        return page.evaluate("[...document.getElementById('fault-kind').options].map(({ value }) => value)")

    def faults():
        return [(one["component"], one["fault"], one["by"])
                for one in page.evaluate("fetch('/snapshot?parts=faults').then((reply) => reply.json())")["faults"]]

    page.becomes("document.getElementById('fault-component').options.length > 40")
    page.becomes("document.getElementById('faults-note').textContent === 'nothing is wrong'")
    choose(page, "fault-component", "imu")
    assert "tilted" in offered() and "limp" not in offered()
    choose(page, "fault-component", "FR_calf_joint")
    assert offered() == ["limp", "off", "weak", "jammed", "dragging", "hot"]
    choose(page, "fault-kind", "limp")
    assert page.evaluate("document.getElementById('fault-by').parentElement.hidden")  # it has no magnitude
    choose(page, "fault-kind", "weak")
    assert page.evaluate("(by => [by.min, by.max, by.placeholder])(document.getElementById('fault-by'))") == [
        "0", "1", "0.5"]
    page.evaluate("document.getElementById('fault-by').value = '0.25'")

    page.evaluate("document.getElementById('fault-form').requestSubmit()")

    eventually(lambda: faults() == [("FR_calf_joint", "weak", 0.25)], what="the fault is there")
    robot.heard("FR_calf_joint is weak")
    page.becomes("document.getElementById('fault-badge').textContent === '1 fault'")
    assert page.text("#fault-list li").startswith("FR_calf_jointweak 0.25, since ")
    page.becomes("[...document.querySelectorAll('#motor-rows .state')]"
                 ".filter((one) => one.textContent.includes('fault: weak')).length === 1")
    page.evaluate("document.querySelector('#fault-list button').click()")
    eventually(lambda: faults() == [], what="the fault has gone")
    robot.heard("FR_calf_joint is no longer weak")
    page.becomes("document.getElementById('fault-badge').hidden && !document.querySelector('#fault-list li')")


def test_the_crane_lowers_a_robot_until_it_stands_and_none_whose_legs_are_limp(play, visit):
    robot = play("g1")
    page = visit(url_of(robot))
    show(page, "rig")
    page.becomes("document.getElementById('crane-said').textContent.includes('its legs do not carry it')")
    assert page.evaluate("document.getElementById('crane-lower-until').disabled")
    for keys, name in (("L2+B", "damping"), ("L2+UP", "ready")):
        robot.ctl("remote", "press", keys)
        robot.becomes(lambda now, name=name: now["motion"]["name"] == name and now["remote"]["keys"] == "")
    page.becomes("!document.getElementById('crane-lower-until').disabled")

    page.evaluate("document.getElementById('crane-lower-until').click()")

    page.becomes("document.getElementById('crane-said').textContent.startsWith('it stands')", seconds=300)
    now = robot.status()
    assert now["crane"]["attached"] and now["crane"]["tension"] < 60 and now["base"]["height"] > 0.6
    assert page.text("#crane-lower-until") == "Lower until it stands"
