"""Pages of the panel in Debian's Chromium, for the tests that look at them and hold them. Whoever imports a
fixture from here has it as its own."""

import tempfile

import pytest

from chromium import Chromium
from robots import Robot

DOMAIN = 7  # of the robot that tests share
DESK = {"width": 1100, "height": 700}
PHONE = {"width": 390, "height": 844, "touch": True}


@pytest.fixture(scope="module")
def browser():
    with Chromium() as chromium:
        yield chromium


@pytest.fixture
def visit(browser):
    """visit(url, ...): a page of the panel that shows the robot. Its console has to stay silent."""
    pages = []

    def open_page(url, **how):
        pages.append(shown(browser.page(url, **{**DESK, **how})))
        return pages[-1]

    yield open_page
    for page in pages:
        page.close()
        assert page.errors == []


@pytest.fixture(scope="module")
def dog():
    """A Go2 that stands, for all tests to which it does not matter what was done to it before; on a
    domain of its own, beside those that other tests start."""
    with tempfile.TemporaryDirectory(prefix="understudy-") as folder, \
            pytest.MonkeyPatch.context() as patch:
        patch.setenv("UNDERSTUDY_RUNTIME_DIR", folder)
        patch.setenv("XDG_STATE_HOME", folder)
        robot = Robot("go2", "--domain", DOMAIN, "--released", "--start", "standing")
        robot.wait_ready()
        yield robot
        robot.end()


@pytest.fixture(scope="module")
def dogs_page(browser, dog):
    return shown(browser.page(url_of(dog), **DESK))


@pytest.fixture
def page(dogs_page):
    """The panel of that Go2."""
    yield dogs_page
    assert dogs_page.errors == [], dogs_page.errors


def shown(page):
    page.becomes("window.panel?.view.placed")
    return page


def url_of(robot):
    """What the robot says at its start."""
    return "http" + robot.heard("panel: http")["message"].split("panel: http")[1].split()[0]


def show(page, tab):
    page.evaluate(f"document.getElementById('tab-{tab}').click()")
