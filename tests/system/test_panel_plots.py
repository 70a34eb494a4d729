"""The panel's plots: their signals, zoomed, held and pointed at, and after the line broke."""

from panel_page import browser, dog, dogs_page, page


def test_a_drag_over_a_plot_zooms_and_holds_and_a_double_click_runs_on(page):
    span = "(([from, to]) => to - from)(panel.plots.plots[0].dygraph.xAxisRange())"
    page.becomes(f"panel.plots.plots[0].dygraph && {span} > 1")
    before = page.evaluate(span)
    x, y = page.middle(".chart")

    page.mouse("mousePressed", x - 30, y)
    page.mouse("mouseMoved", x + 30, y)
    page.mouse("mouseReleased", x + 30, y, held=False)
    page.becomes(f"panel.plots.held && {span} < {0.8 * before}")
    for kind, held, count in (("mousePressed", True, 1), ("mouseReleased", False, 1),
                              ("mousePressed", True, 2), ("mouseReleased", False, 2)):
        page.mouse(kind, x, y, held, clickCount=count)

    page.becomes("!panel.plots.held")


def test_any_signal_can_be_added_to_a_plot_with_what_it_has_been(page):
    page.becomes("panel.plots.history.end - panel.plots.history.begin > 50")

    page.evaluate("(s => { s.value = 'battery voltage'; s.dispatchEvent(new Event('change')); })"
                  "(document.querySelector('.plot input'))")

    page.becomes("panel.plots.plots[0].names.includes('battery voltage') &&"
                 "panel.plots.plots[0].dygraph.numRows() > 20")


def test_a_part_of_a_signals_name_is_enough_and_one_that_none_has_is_marked(page):
    page.evaluate("window.typed = (text) => (s => { s.value = text; s.dispatchEvent(new Event('change')); return s; })"
                  "(document.querySelector('.plot input'))")

    assert page.evaluate("typed('rl_calf POS').validity.valid")
    assert page.evaluate("panel.plots.plots[0].names.includes('RL_calf position')")
    assert not page.evaluate("typed('RL_clf').validity.valid")
    assert page.evaluate("typed('').validity.valid")


def test_a_line_that_broke_is_taken_up_again_and_plots_go_on(page):
    before = page.evaluate("panel.plots.history.end")

    page.evaluate("panel.link.snapshots.close(), 0")

    page.becomes("panel.link.snapshots.readyState === 1 && document.getElementById('lost').hidden")
    page.becomes(f"panel.plots.history.end > {before} + 20")


def test_the_time_under_the_pointer_is_marked_in_every_plot(page):
    page.becomes("panel.plots.history.end - panel.plots.history.begin > 20")
    if page.evaluate("panel.plots.plots.length") < 2:
        page.click("#plots-add")
    page.evaluate("panel.plots.plots[1].addFound('battery voltage'), panel.plots.hold(true)")
    page.becomes("panel.plots.plots.every(({ dygraph }) => dygraph)")
    x, y = page.middle(".chart")
    page.mouse("mouseMoved", x, y, held=False)

    marked = "panel.plots.plots.map(({ dygraph }) => dygraph.getValue(dygraph.getSelection(), 0))"
    page.becomes("panel.plots.plots.every(({ dygraph }) => dygraph.getSelection() >= 0)")
    first, second = page.evaluate(marked)[:2]
    assert abs(first - second) < 0.1
    page.mouse("mouseMoved", x, y + 500, held=False)
    page.evaluate("panel.plots.hold(false)")
