// Live plots. Every signal has a history, so a plot begins with what has already been.
import { element, number, setText } from "./dom.js";
import { History } from "./history.js";
import { recall, remember } from "./store.js";

const COLOURS = ["#0a7bc4", "#d9600a", "#00997a", "#b755a0", "#c79a00", "#6a6ee0"];
const KEPT = 7200; // samples: two minutes of 60 a second
const ROWS = 1200; // drawn at most while it runs
const EVERY = 66; // ms between pictures
const MOST_PLOTS = 4;
const LEAST_SPAN = 1e-3; // of a value axis, in any unit; *assumed*
const LEAST_SHARE = 1e-3; // of it, of its value; *assumed*
const MOST_SIGNALS = COLOURS.length;
const SPANS = new Set(["2", "5", "10", "30", "60", "120"]); // s, as the page offers them

const { Dygraph } = window; // a classic script
// Its legend writes style attributes, which the page's content policy forbids; ours is the chips.
Dygraph.PLUGINS = Dygraph.PLUGINS.filter((plugin) => plugin !== Dygraph.Plugins.Legend);

class Plot {
  constructor(plots, names) {
    this.plots = plots;
    this.names = [];
    this.dygraph = null;
    this.chips = element("ul", { class: "chips" });
    this.search = element("input", {
      type: "search", list: "signals", placeholder: "add a signal", "aria-label": "Add a signal",
      autocomplete: "off", spellcheck: "false",
    });
    const close = element("button", { type: "button", class: "quiet", text: "×",
                                      "aria-label": "Close this plot", title: "Close this plot" });
    this.chart = element("div", { class: "chart" });
    this.node = element("div", { class: "plot" },
      element("div", { class: "plot-head" }, this.chips, close), this.chart);
    this.search.addEventListener("change", () => this.addFound(this.search.value));
    this.search.addEventListener("input", () => this.search.setCustomValidity(""));
    close.addEventListener("click", () => plots.remove(this));
    // What is about to be moved by hand must not move by itself.
    this.chart.addEventListener("pointerdown", (event) => {
      if (event.shiftKey || event.pointerType === "touch") plots.hold(true);
    });
    for (const name of names) this.add(name);
  }

  // Rows of {name, unit, colour}.
  legend() {
    return this.names.map((name, i) => (
      { name, unit: this.plots.signals[this.plots.index.get(name)].unit, colour: COLOURS[i] }));
  }

  get columns() {
    return this.names.map((name) => this.plots.index.get(name));
  }

  // Adds the first signal that has all the words typed, in any part of its name.
  addFound(typed) {
    const words = typed.toLowerCase().split(/\s+/).filter(Boolean);
    const has = ({ name }) => words.every((word) => name.toLowerCase().includes(word));
    const found = this.plots.index.has(typed) ? typed : this.plots.signals.find(has)?.name;
    this.search.setCustomValidity(words.length && !found ? "no signal has such a name" : "");
    if (words.length && found) this.add(found);
  }

  add(name) {
    if (!this.plots.index.has(name)) return;
    this.search.value = "";
    if (this.names.includes(name) || this.names.length === MOST_SIGNALS) return;
    this.names.push(name);
    this.rebuild();
  }

  drop(name) {
    this.names = this.names.filter((other) => other !== name);
    this.rebuild();
  }

  rebuild() {
    this.dygraph?.destroy();
    this.dygraph = null;
    this.values = this.names.map((name, i) => {
      const value = element("output", { class: "num" });
      const drop = element("button", { type: "button", class: "quiet", text: "×",
                                       "aria-label": `Remove ${name}` });
      drop.addEventListener("click", () => this.drop(name));
      const mark = element("span", { class: "mark" });
      mark.style.background = COLOURS[i];
      const { unit } = this.plots.signals[this.plots.index.get(name)];
      return { value, chip: element("li", {}, mark, element("span", { text: name }), value,
                                    element("span", { class: "unit", text: unit }), drop) };
    });
    this.chips.replaceChildren(...this.values.map(({ chip }) => chip),
                               element("li", {}, this.search));
    this.plots.remember();
    this.draw();
  }

  // All of this only when there is something to draw on: hidden panels have no size.
  draw() {
    const { history, seconds, held } = this.plots;
    if (!this.names.length || !this.chart.clientWidth || history.end === history.begin) return;
    const rows = history.rows(this.columns, held ? -Infinity : history.newest - seconds,
                              held ? KEPT * 2 : ROWS);
    const dateWindow = [Math.max(history.newest - seconds, history.oldest), history.newest];
    if (dateWindow[1] - dateWindow[0] < 0.05) dateWindow[0] = dateWindow[1] - 0.05;
    if (!this.dygraph) this.dygraph = this.newDygraph(rows, dateWindow);
    else if (held) this.dygraph.updateOptions({ file: rows });
    else this.dygraph.updateOptions({ file: rows, dateWindow, valueRange: flatRange(rows) });
    if (!held) this.showValues(history.end - 1);
  }

  newDygraph(rows, dateWindow) {
    return new Dygraph(this.chart, rows, {
      labels: ["time", ...this.names],
      colors: COLOURS.slice(0, this.names.length),
      dateWindow,
      strokeWidth: 1.25,
      axisLabelFontSize: 11,
      xRangePad: 0,
      yRangePad: 6,
      rightGap: 6,
      highlightCircleSize: 2.5,
      gridLineWidth: 1,
      axes: {
        x: { drawGrid: true, axisLabelFormatter: (seconds) => `${number(seconds, 1)} s` },
        y: { axisLabelWidth: 46, 
             axisLabelFormatter: (value, _, __, plot) => axisNumber(value, plot.yAxisRange()) },
      },
      gridLineColor: this.plots.gridColour,
      axisLineColor: this.plots.gridColour,
      zoomCallback: () => this.plots.zoomed(this.dygraph),
      highlightCallback: (_, time) => this.plots.mark(time, this),
      unhighlightCallback: () => this.plots.mark(null, this),
    });
  }

  // Marks the points of that time; null for none.
  mark(time) {
    if (!this.dygraph) return;
    if (time === null) return this.dygraph.clearSelection();
    let [low, high] = [0, this.dygraph.numRows() - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.dygraph.getValue(middle, 0) <= time) low = middle;
      else high = middle - 1;
    }
    this.dygraph.setSelection(low);
  }

  showValues(sample) {
    if (sample < this.plots.history.begin || sample >= this.plots.history.end) return;
    const row = this.plots.history.row(this.columns, sample);
    this.values.forEach(({ value }, i) => setText(value, number(row[i + 1], 3)));
  }
}

// A range for what hardly moves, so that noise is not drawn as large as a motion; null for the rest.
export function flatRange(rows) {
  let [low, high] = [Infinity, -Infinity];
  for (const [, ...values] of rows) {
    for (const value of values) {
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  const least = Math.max(LEAST_SPAN, LEAST_SHARE * Math.abs(low + high) / 2);
  if (!(high - low < least)) return null;
  return [(low + high - least) / 2, (low + high + least) / 2];
}

// As many digits as tell the ticks of that axis apart.
function axisNumber(value, [low, high]) {
  const digits = Math.min(6, Math.max(0, Math.ceil(1 - Math.log10(high - low))));
  return number(value, digits);
}

// What was kept of the plots, if it is what we keep.
export function layoutOf(kept) {
  const isNames = (names) => Array.isArray(names) && names.every((name) => typeof name === "string");
  return Array.isArray(kept?.plots) && kept.plots.every(isNames) ? kept : null;
}

export class Plots {
  // `controls`: the elements list, hold, seconds, add, options (a datalist).
  constructor(controls) {
    this.controls = controls;
    this.plots = [];
    this.signals = [];
    this.index = new Map();
    this.history = new History(0, 1); // what is drawn
    this.live = this.history; // that of the robot, which goes on while a recording's is drawn
    this.held = false;
    this.last = 0;
    controls.hold.addEventListener("click", () => this.hold(!this.held));
    controls.seconds.addEventListener("change", () => {
      this.hold(false);
      this.remember();
      this.drawAll();
    });
    controls.add.addEventListener("click", () => this.open([]));
  }

  get seconds() {
    return Number(this.controls.seconds.value);
  }

  // Begins anew with the signals of another robot; `standard`: names for each plot.
  setSignals(signals, standard) {
    this.signals = signals;
    this.index = new Map(signals.map(({ name }, i) => [name, i]));
    this.live = this.history = new History(signals.length, KEPT);
    this.controls.options.replaceChildren(
      ...signals.map(({ name, unit }) => element("option", { value: name, label: unit })));
    for (const plot of this.plots.splice(0)) this.discard(plot);
    const kept = layoutOf(recall("plots"));
    if (kept && SPANS.has(kept.seconds)) this.controls.seconds.value = kept.seconds;
    for (const names of kept?.plots ?? standard) this.open(names);
  }

  open(names) {
    if (this.plots.length === MOST_PLOTS) return;
    const plot = new Plot(this, names);
    this.plots.push(plot);
    this.controls.list.append(plot.node);
    this.changed();
  }

  remove(plot) {
    this.plots.splice(this.plots.indexOf(plot), 1);
    this.discard(plot);
    this.changed();
  }

  discard(plot) {
    plot.dygraph?.destroy();
    plot.node.remove();
  }

  // Shows these signals in the first plot.
  showFirst(names) {
    if (!this.plots.length) return this.open(names);
    this.plots[0].names = names.filter((name) => this.index.has(name));
    this.plots[0].rebuild();
  }

  changed() {
    this.controls.add.disabled = this.plots.length === MOST_PLOTS;
    this.remember();
    for (const plot of this.plots) plot.dygraph?.resize();
  }

  remember() {
    remember("plots", { plots: this.plots.map(({ names }) => names), seconds: this.controls.seconds.value });
  }

  // Draws the signals of a recording from now on, or those of the robot again.
  replay(on) {
    this.hold(false);
    this.history = on ? new History(this.signals.length, KEPT) : this.live;
    this.drawAll();
  }

  // A snapshot of the robot, or of the recording that is drawn.
  push(snapshot) {
    const history = snapshot.recorded ? this.history : this.live;
    history.push(snapshot.time, (i) => this.signals[i].read(snapshot));
    if (history !== this.history) return;
    const now = performance.now();
    if (this.held || now - this.last < EVERY) return;
    this.last = now;
    this.drawAll();
  }

  drawAll() {
    for (const plot of this.plots) plot.draw();
  }

  // Plots stand still and show all that is kept, to zoom and pan in; the robot goes on.
  hold(on) {
    if (on === this.held) return;
    this.held = on;
    this.controls.hold.setAttribute("aria-pressed", on);
    setText(this.controls.hold, on ? "Run" : "Hold");
    this.drawAll();
  }

  // The time under the pointer in one plot is that of all; null: it has left.
  mark(time, own) {
    const sample = time === null ? this.history.end - 1 : this.history.find(time);
    for (const plot of this.plots) {
      plot.showValues(sample);
      if (plot !== own) plot.mark(time);
    }
  }

  // A drag over a plot zooms in, which means to hold; a double click zooms out, which means to run.
  zoomed(dygraph) {
    const [from, to] = dygraph.xAxisRange();
    const whole = !dygraph.isZoomed();
    this.hold(!whole);
    if (whole) return;
    for (const plot of this.plots) {
      if (plot.dygraph !== dygraph) plot.dygraph?.updateOptions({ dateWindow: [from, to] });
    }
  }

  setTheme(gridColour) {
    this.gridColour = gridColour;
    for (const plot of this.plots) {
      plot.dygraph?.updateOptions({ gridLineColor: gridColour, axisLineColor: gridColour });
    }
  }

  resize() {
    for (const plot of this.plots) {
      if (plot.dygraph) plot.dygraph.resize();
      else plot.draw();
    }
  }
}
