// Bars between the parts of the page that mouse, finger and arrow keys move; a double click puts one back.
// Where they are, the browser remembers by robot.
import { byId } from "./dom.js";
import { recall, remember } from "./store.js";

const STEP = 16; // px that an arrow key moves one by

// Of each bar the property of the style that it sets [px], the least of what is after it and before it,
// and the key that makes the part after it larger.
const BARS = [
  { id: "split-side", property: "--side", least: 320, rest: 320, axis: "x", more: "ArrowLeft", less: "ArrowRight" },
  { id: "split-foot", property: "--foot", least: 120, rest: 160, axis: "y", more: "ArrowUp", less: "ArrowDown" },
];

// Cuts a size so that both parts keep their least.
export const cut = (size, whole, { least, rest }) => Math.round(Math.max(least, Math.min(whole - rest, size)));

class Bar {
  constructor(bar, changed) {
    Object.assign(this, bar, { node: byId(bar.id), main: byId("main"), changed });
    this.node.addEventListener("pointerdown", (event) => {
      this.node.setPointerCapture(event.pointerId);
      event.preventDefault();
    });
    this.node.addEventListener("pointermove", (event) => {
      if (this.node.hasPointerCapture(event.pointerId)) this.keep(this.behind(event.clientX, event.clientY));
    });
    this.node.addEventListener("dblclick", () => this.keep(null));
    this.node.addEventListener("keydown", (event) => {
      const way = { [this.more]: 1, [this.less]: -1 }[event.key];
      if (!way) return;
      event.preventDefault();
      const { right, bottom } = this.node.getBoundingClientRect();
      this.keep(this.behind(right, bottom) + way * STEP);
    });
  }

  // px between a place and the end of the page.
  behind(x, y) {
    const { right, bottom } = this.main.getBoundingClientRect();
    return this.axis === "x" ? right - x : bottom - y;
  }

  // null: as wide as the page has it.
  set(size) {
    const whole = this.axis === "x" ? this.main.clientWidth : this.main.clientHeight;
    if (size === null) this.main.style.removeProperty(this.property);
    else this.main.style.setProperty(this.property, `${cut(size, whole, this)}px`);
    this.changed();
  }

  keep(size) {
    this.set(size);
    remember(`split.${this.id}`, size);
  }

  restore() {
    const size = recall(`split.${this.id}`);
    if (typeof size === "number") this.set(size);
  }
}

export class Splitters {
  // changed(): parts have other sizes.
  constructor(changed) {
    this.bars = BARS.map((bar) => new Bar(bar, changed));
  }

  // Where they were when this robot was looked at last.
  restore() {
    for (const bar of this.bars) bar.restore();
  }
}
