"""A page of the panel on a laptop whose graphics card takes no time, since there is none here: WebGL's draw calls do nothing
but count. All else is the page as it is: socket, JSON, scene, three.js, plots, tables, layout. Whoever imports a fixture from
here has it as its own.
"""

import pytest

from chromium import WITHOUT_A_CARD, Chromium
from panel_page import shown, url_of

LAPTOP = {"width": 1440, "height": 900}

# A graphics card that takes no time. `drawn` counts what it was given; `spent` has, for every refresh of the screen,
# the time [ms] that the page's own callbacks took since the one before: what came over the socket, and the picture.
GRAPHICS_CARD = """(() => {
  const drawn = (window.drawn = { calls: 0, triangles: 0 });
  const draw = (mode, count, instances = 1) => {
    ++drawn.calls;
    if (mode === 4) drawn.triangles += (count / 3) * instances;
  };
  const elements = (mode, count) => draw(mode, count);
  const arrays = (mode, first, count) => draw(mode, count);
  const elementsOfMany = (mode, count, type, offset, instances) => draw(mode, count, instances);
  const arraysOfMany = (mode, first, count, instances) => draw(mode, count, instances);
  for (const { prototype } of [WebGLRenderingContext, WebGL2RenderingContext]) {
    Object.assign(prototype, { drawElements: elements, drawArrays: arrays, clear: () => {},
      drawElementsInstanced: elementsOfMany, drawArraysInstanced: arraysOfMany });
    const { getParameter, getExtension } = prototype;
    const UNMASKED_RENDERER = 0x9246;
    prototype.getParameter = function (name) {
      return name === UNMASKED_RENDERER ? "a graphics card" : getParameter.call(this, name);
    };
    prototype.getExtension = function (name) {
      const extension = getExtension.call(this, name);
      if (name !== "ANGLE_instanced_arrays" || !extension) return extension;
      return { drawElementsInstancedANGLE: elementsOfMany, drawArraysInstancedANGLE: arraysOfMany,
        vertexAttribDivisorANGLE: extension.vertexAttribDivisorANGLE.bind(extension) };
    };
  }

  window.spent = [];
  let since = 0;
  const timed = (callback) => function (...given) {
    const begin = performance.now();
    callback.apply(this, given);
    since += performance.now() - begin;
  };
  const { requestAnimationFrame } = window;
  window.requestAnimationFrame = (callback) => requestAnimationFrame((now) => {
    timed(callback)(now);
    spent.push(since);
    since = 0;
  });
  const message = Object.getOwnPropertyDescriptor(WebSocket.prototype, "onmessage");
  Object.defineProperty(WebSocket.prototype, "onmessage", {
    set(callback) { message.set.call(this, timed(callback)); },
  });
})()"""


@pytest.fixture(scope="module")
def browser():
    with Chromium(WITHOUT_A_CARD) as chromium:
        yield chromium


@pytest.fixture
def visit(browser):
    """visit(robot): a page of its panel, on a laptop whose graphics card takes no time."""
    pages = []

    def open_page(robot):
        pages.append(shown(browser.page(url_of(robot), **LAPTOP, script=GRAPHICS_CARD)))
        return pages[-1]

    yield open_page
    for page in pages:
        page.close()
        assert [error for error in page.errors if "GPU stall" not in error] == []
