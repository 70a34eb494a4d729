"""Debian's Chromium without a screen, led by the DevTools protocol over a pair of pipes."""

import base64
import itertools
import json
import os
import pathlib
import select
import shutil
import subprocess
import tempfile
import time

PATIENCE = 120  # s; a page on a busy machine is slow
MODIFIERS = {"Alt": 1, "Control": 2, "Meta": 4, "Shift": 8}

FLAGS = [
    "--headless=new", "--remote-debugging-pipe", "--no-first-run", "--no-default-browser-check",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--disable-extensions", "--hide-scrollbars", "--disable-dev-shm-usage", "--mute-audio",
    # Pictures by the processor: test machines have no graphics card.
    "--use-gl=angle", "--enable-unsafe-swiftshader",
]
# The whole page by a graphics card that the processor plays, as on a desk, but at a few pictures a second.
AS_ON_A_DESK = ["--use-angle=swiftshader"]
# WebGL alone by that, and the rest without: 60 refreshes a second, as long as WebGL has nothing to draw.
WITHOUT_A_CARD = ["--use-angle=swiftshader-webgl", "--disable-gpu-compositing",
                  "--disable-gpu-rasterization", "--disable-accelerated-2d-canvas"]


# What a browser says of a connection that a page closed again at once, as it does where it changes what it follows.
GIVEN_UP = "WebSocket is closed before the connection is established"


class Navigated(Exception):
    """The page went elsewhere while it was asked."""


class Chromium:
    """The browser; `page(url)` opens one. Ends with the `with` block."""

    def __init__(self, graphics=AS_ON_A_DESK):
        program = shutil.which("chromium")
        assert program, "no chromium: apt-get install chromium"
        self._profile = tempfile.mkdtemp(prefix="understudy-chromium-")
        # Chromium's own sandbox wants rights that root and containers have not.
        sandbox = ["--no-sandbox"] if os.geteuid() == 0 else []
        ours, theirs = os.pipe(), os.pipe()
        # Chromium reads from 3 and writes to 4.
        self._out, self._in = ours[1], theirs[0]

        def hand_over():
            read, write = os.dup(ours[0]), os.dup(theirs[1])
            os.dup2(read, 3)
            os.dup2(write, 4)

        self._process = subprocess.Popen(
            [program, *FLAGS, *graphics, *sandbox, f"--user-data-dir={self._profile}", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            close_fds=False, preexec_fn=hand_over)
        os.close(ours[0])
        os.close(theirs[1])
        self._ids = itertools.count(1)
        self._unread = b""
        self._answers = {}
        self.pages = {}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._process.terminate()
        try:
            self._process.wait(10)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        os.close(self._out)
        os.close(self._in)
        shutil.rmtree(self._profile, ignore_errors=True)

    def call(self, method, session=None, **params):
        """One command; gives its result."""
        number = next(self._ids)
        message = {"id": number, "method": method, "params": params}
        if session:
            message["sessionId"] = session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + PATIENCE
        while number not in self._answers:
            left = deadline - time.monotonic()
            assert left > 0, f"{method}: no answer from Chromium"
            self.listen(left)
        answer = self._answers.pop(number)
        if "navigated or closed" in answer.get("error", {}).get("message", ""):
            raise Navigated(method)
        assert "error" not in answer, f"{method}: {answer['error']}"
        return answer["result"]

    def listen(self, seconds):
        """Takes what Chromium says within that time; returns after the first of it."""
        if not select.select([self._in], [], [], seconds)[0]:
            return
        got = os.read(self._in, 1 << 20)
        assert got, f"Chromium ended, code {self._process.poll()}"
        *messages, self._unread = (self._unread + got).split(b"\0")
        for message in map(json.loads, messages):
            if "id" in message:
                self._answers[message["id"]] = message
            elif page := self.pages.get(message.get("sessionId")):
                page.heard(message["method"], message["params"])

    def page(self, url, width=1280, height=800, dark=False, touch=False, script=""):
        """`script`: runs in the page before anything of its own."""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        page = self.pages[session] = Page(self, session, target)
        for domain in ("Page", "Runtime", "Log", "Network"):
            page.call(f"{domain}.enable")
        page.resize(width, height, touch)
        page.scheme("dark" if dark else "light")
        page.call("Page.addScriptToEvaluateOnNewDocument", source=script)
        page.call("Page.navigate", url=url)
        return page

    def main_thread_seconds(self):
        """The processor time that the busiest page's main thread has had."""
        pages = [process["id"] for process in self.call("SystemInfo.getProcessInfo")["processInfo"]
                 if process["type"] == "renderer"]
        return max(int(pathlib.Path(f"/proc/{pid}/schedstat").read_text().split()[0]) for pid in pages) / 1e9


class Page:
    """A tab. `errors`: what its console complained of, every exception and broken rule."""

    def __init__(self, browser, session, target):
        self._browser = browser
        self._session = session
        self._target = target
        self.errors = []
        self.requests = []

    def call(self, method, **params):
        return self._browser.call(method, self._session, **params)

    def close(self):
        self._browser.call("Target.closeTarget", targetId=self._target)
        del self._browser.pages[self._session]

    def heard(self, method, params):
        if method == "Runtime.exceptionThrown":
            details = params["exceptionDetails"]
            self.errors.append(details.get("exception", {}).get("description", details["text"]))
        elif method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning"):
            self.errors.append(" ".join(str(a.get("value", a)) for a in params["args"]))
        elif method == "Log.entryAdded" and params["entry"]["level"] in ("error", "warning"):
            if GIVEN_UP not in params["entry"]["text"]:
                self.errors.append(f"{params['entry']['text']} {params['entry'].get('url', '')}")
        elif method == "Network.requestWillBeSent":
            self.requests.append(params["request"]["url"])

    def resize(self, width, height, touch=False):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=touch)
        self.call("Emulation.setTouchEmulationEnabled", enabled=touch)

    def scheme(self, name):
        """What the system prefers: light or dark."""
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": name}])

    def evaluate(self, expression):
        """The value of a JavaScript expression; a promise is waited for."""
        answer = self.call("Runtime.evaluate", expression=expression, awaitPromise=True,
                           returnByValue=True)
        assert "exceptionDetails" not in answer, f"{expression}: {answer['exceptionDetails']}"
        return answer["result"].get("value")

    def becomes(self, expression, seconds=PATIENCE):
        """Waits until the expression is true in the page and gives its value."""
        deadline = time.monotonic() + seconds
        while True:
            try:
                if value := self.evaluate(expression):
                    return value
            except Navigated:
                pass  # the next page is asked
            assert time.monotonic() < deadline, f"not within {seconds:.0f} s: {expression}"
            self._browser.listen(0.05)

    def text(self, selector):
        return self.evaluate(f"document.querySelector({json.dumps(selector)}).textContent")

    def middle(self, selector):
        return self.evaluate(
            f"(b => [b.x + b.width / 2, b.y + b.height / 2])"
            f"(document.querySelector({json.dumps(selector)}).getBoundingClientRect())")

    def mouse(self, kind, x, y, held=True, **params):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left",
                  buttons=1 if held else 0, **{"clickCount": 1, **params})

    def click(self, selector):
        x, y = self.middle(selector)
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y, held=False)

    def key(self, kind, code, key):
        self.call("Input.dispatchKeyEvent", type=kind, code=code, key=key)

    def screenshot(self, path=None):
        """A PNG of what is seen."""
        png = base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])
        if path:
            with open(path, "wb") as file:
                file.write(png)
        return png
