"""The panel as a remote controller: keys of the keyboard, chords, taps, a gamepad, and what a program reads of them."""

import struct

from panel_page import DOMAIN, browser, dog, dogs_page, page
from peers import listener
from robots import eventually


def remote_bytes(samples):
    """Keys, and sticks in hundredths, as a program reads them from LowState."""
    def read(message):
        data = bytes(message.wireless_remote)
        sticks = [round(100 * struct.unpack_from("<f", data, at)[0]) for at in (4, 8, 12, 20)]
        return struct.unpack_from("<H", data, 2)[0], dict(zip(("lx", "rx", "ry", "ly"), sticks))

    return [read(sample) for sample in samples]


def test_keys_of_the_keyboard_reach_wireless_remote(page):
    with listener(domain=DOMAIN) as program:
        page.key("keyDown", "KeyA", "a")
        page.key("keyDown", "KeyE", "e")
        eventually(lambda: any(keys == 1 << 8 and sticks["ly"] == 100
                               for keys, sticks in remote_bytes(program.take())), what="A, forward")
        page.key("keyUp", "KeyA", "a")
        page.key("keyUp", "KeyE", "e")

        eventually(lambda: any(keys == 0 and sticks["ly"] == 0
                               for keys, sticks in remote_bytes(program.take())), what="let go")


def events_of(page, kind):
    events = page.evaluate("fetch('/events').then((reply) => reply.json())")["events"]
    return [event for event in events if event["kind"] == kind]


def presses_of(page, keys):
    """How often those keys have gone down together so far."""
    return sum(event["detail"]["keys"] == keys for event in events_of(page, "remote"))


STALL = "(() => { const end = performance.now() + %d; while (performance.now() < end); })()"


def test_a_chord_is_one_press_however_slow_the_page_is(page):
    before = presses_of(page, "L2+A")
    page.key("keyDown", "KeyW", "w")
    page.key("keyDown", "KeyA", "a")
    eventually(lambda: presses_of(page, "L2+A") == before + 1)
    page.evaluate(STALL % 1500)  # meanwhile the robot lets go
    page.becomes("panel.view.snapshot.remote.keys === ''")
    page.evaluate("new Promise((done) => setTimeout(done, 600))")  # and the page renews what is held
    assert page.evaluate("document.querySelector('[data-key=A]').ariaPressed") == "true"
    assert presses_of(page, "L2+A") == before + 1
    page.key("keyUp", "KeyA", "a")
    page.key("keyDown", "KeyA", "a")

    eventually(lambda: presses_of(page, "L2+A") == before + 2)
    page.key("keyUp", "KeyA", "a")
    page.key("keyUp", "KeyW", "w")
    page.becomes("panel.view.snapshot.remote.keys === ''")
    assert presses_of(page, "L2+A") == before + 2


def test_a_tap_is_heard_however_short_it_is(page):
    before = presses_of(page, "X")
    for count in range(1, 6):
        page.evaluate("""["keydown", "keyup"].forEach((kind) => window.dispatchEvent(
            new KeyboardEvent(kind, { code: "KeyX", key: "x" })))""")
        eventually(lambda: presses_of(page, "X") == before + count)
        eventually(lambda: events_of(page, "remote")[-1]["detail"]["keys"] == "")  # it has let go


def test_a_gamepad_reaches_wireless_remote(page):
    # As the browser shows one: L2 (button 6) and B (1) pressed, the right stick to the left.
    page.evaluate("""navigator.getGamepads = () => [{ mapping: "standard", id: "pad",
        buttons: Array.from({ length: 16 }, (_, i) => ({ pressed: i === 6 || i === 1 })),
        axes: [0.01, 0, -1, 0] }], 0""")

    with listener(domain=DOMAIN) as program:
        eventually(lambda: any(
            keys == (1 << 5 | 1 << 9) and sticks["rx"] == -100 and sticks["lx"] == 0
            for keys, sticks in remote_bytes(program.take())), what="L2+B, left")
    assert page.text("#gamepad") == "gamepad: pad"
    page.evaluate("navigator.getGamepads = () => [], 0")
