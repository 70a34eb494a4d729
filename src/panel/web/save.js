// What one takes away from the page: the view and the plots as pictures, signals as a table.
import { element } from "./dom.js";

const GAP = 8; // px between plots
const HEAD = 20; // px, for the names over a plot
const FONT = "12px system-ui, sans-serif";

function download(name, blob) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

// "go2 12.34 s.png".
const named = (what, time, ending) =>
  `${document.title.split(" ·")[0]} ${what}${Number.isFinite(time) ? ` ${time.toFixed(2)} s` : ""}.${ending}`;

export function savePicture(view) {
  view.dirty = true;
  view.draw(performance.now()); // what was drawn before is gone from the canvas
  const name = named("view", view.snapshot?.time, "png");
  view.canvas.toBlob((blob) => blob && download(name, blob), "image/png");
}

// All plots, one under the other, with the names of their signals, on the page's ground.
export function pictureOf(plots) {
  const shown = plots.plots.filter(({ dygraph }) => dygraph);
  const style = getComputedStyle(document.body);
  const scale = window.devicePixelRatio || 1;
  const width = Math.max(1, ...shown.map(({ chart }) => chart.clientWidth));
  const height = shown.reduce((sum, { chart }) => sum + HEAD + chart.clientHeight + GAP, 0) || 1;
  const canvas = element("canvas", { width: Math.ceil(scale * width), height: Math.ceil(scale * height) });
  const context = canvas.getContext("2d");
  context.scale(scale, scale);
  context.fillStyle = style.getPropertyValue("--panel");
  context.fillRect(0, 0, width, height);
  context.font = FONT;
  context.textBaseline = "middle";
  let top = 0;
  for (const plot of shown) {
    let left = 4;
    for (const { name, unit, colour } of plot.legend()) {
      const text = `${name}${unit ? `, ${unit}` : ""}`;
      context.fillStyle = colour;
      context.fillRect(left, top + HEAD / 2 - 1.5, 10, 3);
      context.fillStyle = style.color;
      context.fillText(text, left + 14, top + HEAD / 2);
      left += 30 + context.measureText(text).width;
    }
    const box = plot.chart.getBoundingClientRect();
    for (const layer of plot.chart.querySelectorAll("canvas")) {
      const at = layer.getBoundingClientRect();
      context.drawImage(layer, at.x - box.x, top + HEAD + at.y - box.y, at.width, at.height);
    }
    context.fillStyle = style.getPropertyValue("--muted");
    for (const label of plot.chart.querySelectorAll(".dygraph-axis-label")) {
      const at = label.getBoundingClientRect();
      context.fillText(label.textContent, at.x - box.x, top + HEAD + at.y - box.y + at.height / 2);
    }
    top += HEAD + plot.chart.clientHeight + GAP;
  }
  return canvas;
}

export function savePlots(plots) {
  const name = named("plots", plots.history.newest, "png");
  pictureOf(plots).toBlob((blob) => blob && download(name, blob), "image/png");
}

const quoted = (text) => `"${text.replaceAll('"', '""')}"`;

// A header of names with units, then a line for every sample that is kept; a value that is none is empty.
export function tableOf(plots) {
  const names = [...new Set(plots.plots.flatMap((plot) => plot.names))];
  const columns = names.map((name) => plots.index.get(name));
  const head = ["time [s]", ...names.map((name, i) => {
    const { unit } = plots.signals[columns[i]];
    return unit ? `${name} [${unit}]` : name;
  })];
  const lines = [head.map(quoted).join(",")];
  for (let i = plots.history.begin; i < plots.history.end; ++i) {
    const [time, ...values] = plots.history.row(columns, i);
    lines.push([time, ...values.map((value) => (Number.isFinite(value) ? Number(value.toPrecision(7)) : ""))].join(","));
  }
  return `${lines.join("\r\n")}\r\n`;
}

export function saveCsv(plots) {
  download(named("plots", plots.history.newest, "csv"), new Blob([tableOf(plots)], { type: "text/csv" }));
}
