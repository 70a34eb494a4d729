"""What the panel asks of a graphics card."""

import pytest

from graphics_card import browser, visit

# What a picture may ask; *assumed*. 20 us for a call, with what WebGL checks and a laptop's driver does, make 10 ms of 500. A
# laptop's graphics of ten years ago do some 500 triangles a microsecond.
MOST_CALLS = 500
MOST_TRIANGLES = 500_000

# What a picture asks of the graphics card when nothing is spared.
ONE_PICTURE = """(() => {
  const { view } = panel;
  view.quality.level = 0;
  view.quality.apply();
  Object.assign(drawn, { calls: 0, triangles: 0 });
  view.renderer.render(view.scene, view.camera);
  return drawn;
})()"""


@pytest.mark.parametrize("options", [["go2"], ["g1_29dof_dex3"], ["go2", "--scene", "rough"]], ids=" ".join)
def test_a_picture_asks_little_of_the_graphics_card(play, visit, options):
    page = visit(play(*options))

    drawn = page.evaluate(ONE_PICTURE)

    assert 10 < drawn["calls"] < MOST_CALLS
    assert 10_000 < drawn["triangles"] < MOST_TRIANGLES
