"""The window: `understudy view` and `run --view`, on a screen without a monitor."""

import json
import os
import subprocess

import pytest

from robots import PATIENCE, eventually
from screens import Screen, difference

# In the middle of a window of 400 x 300 in the screen's corner: the robot, and nothing of the texts.
SIZE = "400x300"
MIDDLE = (60, 90, 280, 130)


@pytest.fixture
def screen():
    server = Screen()
    yield server
    server.end()


class Window:
    """`understudy view` of a robot; look() waits until it shows it."""

    def __init__(self, robot, screen, *options):
        self.screen = screen
        self.title = f"Understudy: {robot.name}"
        self.process = subprocess.Popen(
            [os.environ["UNDERSTUDY"], "view", "--name", robot.name, "--size", SIZE, *options],
            env=screen.environment, stderr=subprocess.PIPE, text=True)

    def opens(self):
        def find():
            if self.process.poll() is not None:
                pytest.fail(f"view ended with {self.process.returncode}: {self.process.communicate()[1]}")
            return self.screen.find(self.title)

        self.screen.xdotool("windowmove", eventually(find, what=f"a window '{self.title}'"), 0, 0)
        self.screen.xdotool("mousemove", 200, 150)
        eventually(lambda: len(set(self.middle())) > 20, what="a picture in the window")
        return self

    def middle(self):
        return self.screen.pixels(*MIDDLE)

    def key(self, *keys):
        self.screen.xdotool("key", *keys)

    def changed_since(self, before, share=0.02):
        return eventually(lambda: difference(before, self.middle()) > share,
                          what="another picture in the window")

    def exit_code(self):
        return self.process.wait(PATIENCE)

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.communicate()


@pytest.fixture
def look(screen):
    """look(robot, ...): a Window onto it."""
    windows = []

    def start(robot, *options):
        windows.append(Window(robot, screen, *options))
        return windows[-1].opens()

    yield start
    for window in windows:
        window.end()


def settle(robot):
    """Until it has been there for a while."""
    return robot.becomes(lambda status: status["time"] > 0.5)


def test_the_window_shows_the_robot_move(play, look):
    robot = play("go2")
    settle(robot)
    window = look(robot)
    still = window.middle()
    assert difference(still, window.middle()) < 0.005

    robot.ctl("push", "base_link", 0, 0, 400, "--for", 0.3)

    window.changed_since(still)


def test_dragging_with_the_mouse_lifts_the_robot_and_letting_go_drops_it(play, look):
    robot = play("go2", "--start", "lying", "--set", "robot.motion.quadruped.stands_up=false")
    low = settle(robot)["base"]["height"]
    window = look(robot)

    def lifted():  # where drawing takes long, two clicks are too far apart to be a double one
        window.screen.xdotool("mouseup", 1, "keyup", "ctrl", "mousemove", 200, 150)
        window.screen.xdotool("sleep", 0.5, "click", "--repeat", 2, "--delay", 40, 1)
        window.screen.xdotool("sleep", 0.5, "keydown", "ctrl", "mousedown", 1)
        for y in range(145, 60, -5):
            window.screen.xdotool("mousemove", 200, y, "sleep", 0.02)
        window.screen.xdotool("sleep", 0.5)
        return robot.status()["base"]["height"] > low + 0.02

    def pulls():
        return json.loads(robot.ctl("snapshot", "--parts", "pushes"))["pushes"]

    def rests():  # on its belly or on its side, as it fell
        return abs(robot.status()["base"]["height"] - robot.status()["base"]["height"]) < 1e-4

    eventually(lifted, what=f"lifted\n{robot.said()}")
    eventually(pulls, what="a pull while the button is held")

    window.screen.xdotool("mouseup", 1, "keyup", "ctrl")
    eventually(lambda: not pulls(), what="no pull once it is let go")
    eventually(rests, what=f"it rests\n{robot.said()}")


def test_closing_the_window_leaves_the_robot_on_the_wire(play, look):
    robot = play("go2")
    window = look(robot)

    window.key("Escape")

    assert window.exit_code() == 0
    before = robot.status()["steps"]
    robot.becomes(lambda status: status["steps"] > before)


def test_keys_pause_step_and_go_on(play, look):
    robot = play("go2")
    window = look(robot)

    def stands():
        first = robot.status()["steps"]
        return robot.status()["steps"] == first and first

    window.key("space")
    steps = eventually(stands, what="a pause")
    window.key("Right")
    robot.becomes(lambda status: status["steps"] == steps + 1)
    window.key("space")
    robot.becomes(lambda status: status["steps"] > steps + 100)


def test_the_keyboard_in_the_window_is_the_remote_controller_until_escape(play, look):
    robot = play("go2")
    window = look(robot)

    window.key("r")
    window.screen.xdotool("keydown", "w", "keydown", "b")
    robot.becomes(lambda status: status["remote"]["keys"] == "L2+B")
    window.screen.xdotool("keyup", "w", "keyup", "b")
    robot.becomes(lambda status: status["remote"]["keys"] == "")
    window.screen.xdotool("keydown", "a")
    robot.becomes(lambda status: status["remote"]["keys"] == "A")
    robot.ctl("pause")
    before = robot.status()["steps"]
    window.key("Escape")

    def let_go():
        robot.ctl("step", 1)
        return robot.status()["remote"]["keys"] == ""

    eventually(let_go)
    assert robot.status()["steps"] - before < 300, "it was let go, long before it ended by itself"
    assert window.process.poll() is None

    window.key("Escape")
    assert window.exit_code() == 0


def test_keys_change_what_is_shown(play, look):
    robot = play("go2")
    settle(robot)
    window = look(robot)

    before = window.middle()
    window.key("x")  # collision shapes
    window.changed_since(before)
    before = window.middle()
    window.key("F1")
    eventually(lambda: difference(before, window.middle()) > 0.001)


def test_run_with_a_view_opens_the_window_and_goes_on_once_it_is_closed(play, screen):
    robot = play("go2", "--view", env=screen.environment)
    screen.window(f"Understudy: {robot.name}")
    screen.xdotool("mousemove", 300, 200)

    def closed():  # keys are lost before it is on the screen
        screen.xdotool("sleep", 0.3, "key", "q")
        return "the window was closed" in robot.said()

    eventually(closed)
    assert robot.status()["ready"]


def test_a_missing_display_is_a_warning_and_the_robot_goes_on(play):
    environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    robot = play("go2", "--view", env=environment)

    robot.heard("the window ended with code 1", "warning")
    assert "DISPLAY" in robot.said()
    assert robot.status()["ready"]


def test_the_window_of_a_robot_that_ends_says_so_and_stays(play, look):
    robot = play("go2")
    window = look(robot)
    robot.end()

    window.screen.xdotool("sleep", 0.5)
    assert window.process.poll() is None
    window.key("Escape")
    assert window.exit_code() == 0


def test_a_view_of_no_robot_says_what_to_do(understudy):
    done = understudy("view")
    assert done.returncode == 1
    assert "understudy run" in done.stderr


def test_a_view_of_another_robot_names_the_nearest(play, understudy):
    play("go2", name="fido")
    done = understudy("view", "--name", "fid")
    assert done.returncode == 1
    assert '"fido"' in done.stderr


def test_the_robot_itself_knows_nothing_of_opengl():
    libraries = subprocess.run(["ldd", os.environ["UNDERSTUDY"]], capture_output=True, text=True,
                               check=True).stdout
    for library in ("libGL", "libEGL", "libglfw", "libOSMesa", "libX11", "libav"):
        assert library not in libraries
