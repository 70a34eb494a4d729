// What presses on the pads of the hands, cell by cell, read while it is looked at.
import { byId, element, number, setText } from "./dom.js";

const READ_EVERY = 100; // ms
const FULL = 5; // N on a cell from which on it has its strongest colour
const CELL = 7; // px

// The pads that feel something, by hand: {hand, name, rows, columns, first, has(cell)}, where `first` is
// the place of the pad's first cell in a snapshot's touch.
export function handsOf(pads) {
  const hands = new Map();
  let first = 0;
  for (const { hand, name, rows, columns, taxels } of pads) {
    const there = new Set(taxels);
    const pad = { name: name.replace(`${hand}_`, "").replace(/^hand_/, "").replaceAll("_", " "),
                  rows, columns, first, has: (cell) => !there.size || there.has(cell) };
    first += rows * columns;
    if (name) hands.set(hand, [...(hands.get(hand) ?? []), pad]);
  }
  return hands;
}

// 0 to 1, steeper where little presses.
export const strengthOf = (newton) => Math.sqrt(Math.min(Math.max(newton / FULL, 0), 1));

export class TouchSheet {
  constructor(link) {
    this.link = link;
    this.pads = [];
    this.details = byId("touch");
    this.details.addEventListener("toggle", () => this.read());
    setInterval(() => this.read(), READ_EVERY);
  }

  setScene({ pads = [] }) {
    const hands = handsOf(pads);
    this.pads = [...hands.values()].flat();
    this.details.hidden = !this.pads.length;
    byId("touch-hands").replaceChildren(...[...hands].map(([hand, own]) =>
      element("section", { "aria-label": `${hand} hand` }, element("h3", { text: `${hand} hand` }),
              element("div", { class: "pads" }, ...own.map((pad) => this.makePad(pad))))));
  }

  makePad(pad) {
    pad.canvas = element("canvas", { width: pad.columns, height: pad.rows, role: "img",
                                     "aria-label": `${pad.name}, ${pad.rows} × ${pad.columns} cells` });
    pad.canvas.style.width = `${CELL * pad.columns}px`;
    pad.most = element("small", { class: "num" });
    return element("figure", { title: "The number is of the cell that feels most" }, pad.canvas,
                   element("figcaption", {}, pad.name, " ", pad.most));
  }

  async read() {
    if (!this.pads.length || !this.details.open || document.hidden || this.reading) return;
    this.reading = true;
    try {
      this.show((await this.link.json("/snapshot?parts=touch")).touch);
    } catch {
      // The lost line says it.
    }
    this.reading = false;
  }

  show(touch) {
    for (const pad of this.pads) {
      const cells = touch.slice(pad.first, pad.first + pad.rows * pad.columns);
      setText(pad.most, `${number(Math.max(...cells), 1)} N`);
      const drawn = cells.join();
      if (pad.drawn !== drawn) this.draw(pad, cells);
      pad.drawn = drawn;
    }
  }

  draw(pad, cells) {
    const pen = pad.canvas.getContext("2d");
    const style = getComputedStyle(pad.canvas);
    pen.clearRect(0, 0, pad.columns, pad.rows);
    cells.forEach((newton, i) => {
      if (!pad.has(i)) return;
      const place = [i % pad.columns, Math.floor(i / pad.columns), 1, 1];
      pen.globalAlpha = 1;
      pen.fillStyle = style.getPropertyValue("--line");
      pen.fillRect(...place);
      pen.globalAlpha = strengthOf(newton);
      pen.fillStyle = style.getPropertyValue("--bad");
      pen.fillRect(...place);
    });
  }
}
