// What the run would have done to the robot so far, read while it is looked at.
import { byId, element, number, setClass, setText } from "./dom.js";

const READ_EVERY = 1000; // ms
// What a motor's row shows, after its name; a figure that is none is left out. It is held against a
// limit of the motor's own, or the sheet's for all; times that are counted at a limit are bad as such.
const COLUMNS = [
  { of: "at_torque_limit", digits: 2, own: "torque_limit", counts: true },
  { of: "at_speed_limit", digits: 2, own: "speed_limit", counts: true },
  { of: "tripped", digits: 1, counts: true },
  { of: "hottest", digits: 0 },
  { of: "hardest_stop", digits: 1 },
  { of: "largest_jump", digits: 2, own: "jump_limit" },
];

// A limit in as many digits as one reads.
const short = (limit) => String(Number(limit.toPrecision(4)));

// A limit of the sheet, or those that its motors have: "23.7, 45.43".
function limitText({ figure, limit }, motors) {
  if (limit !== null) return short(limit);
  const own = COLUMNS.find(({ of }) => of === figure)?.own;
  const all = new Set(own ? motors.map((motor) => motor[own]).filter((value) => value > 0) : []);
  return [...all].sort((a, b) => a - b).map(short).join(", ");
}

export class DamageSheet {
  constructor(link) {
    this.link = link;
    this.rows = [];
    this.details = byId("damage");
    this.details.addEventListener("toggle", () => this.read());
    setInterval(() => this.read(), READ_EVERY);
  }

  async read() {
    if (!this.details.open || document.hidden) return;
    try {
      this.show((await this.link.json("/snapshot?parts=damage")).damage);
    } catch {
      // The lost line says it.
    }
  }

  show(sheet) {
    const falls = `${sheet.falls} ${sheet.falls === 1 ? "fall" : "falls"}`;
    setText(byId("damage-note"), `${falls}, tilt ${number(sheet.worst_tilt, 2)} rad, ` +
      `shock ${number(sheet.shock, 0)} m/s², ${number(sheet.energy, 0)} J, ` +
      `${number(sheet.peak_current, 0)} A at most`);
    if (this.rows.length !== sheet.motors.length) this.makeRows(sheet);
    sheet.limits.forEach((one, i) => {
      const mark = one.mark === "ok" ? "" : ` ${one.mark}`;
      setText(this.reached[i], `${short(one.reached)} ${one.reached_unit}${mark}`.trim());
      setClass(this.reached[i], one.mark === "beyond" ? "num warn" : "num");
      this.reached[i].title = one.motor;
    });
    const limits = Object.fromEntries(sheet.limits.map((limit) => [limit.figure, limit]));
    sheet.motors.forEach((motor, i) => {
      COLUMNS.forEach(({ of, digits, own, counts }, column) => {
        const cell = this.rows[i][column];
        const value = motor[of];
        const limit = own ? motor[own] : limits[of].limit;
        const bad = limit > 0 && value > (counts ? 0 : limit);
        setText(cell, value === 0 ? "" : number(value, digits));
        setClass(cell, bad ? "num warn" : "num");
        cell.title = limit > 0 ? `limit ${short(limit)} ${limits[of].unit}` : "no limit is known";
      });
    });
  }

  makeRows({ motors, limits }) {
    this.rows = motors.map(() => COLUMNS.map(() => element("td", { class: "num" })));
    this.reached = limits.map(() => element("td", { class: "num" }));
    byId("damage-limits").replaceChildren(...limits.map((one, i) =>
      element("tr", {}, element("th", { scope: "row", text: one.figure.replaceAll("_", " ") }), this.reached[i],
              element("td", { class: "num", text: limitText(one, motors) }),
              element("td", { text: one.unit }), element("td", { class: "source", text: one.source }))));
    byId("damage-rows").replaceChildren(...motors.map(({ joint }, i) =>
      element("tr", {}, element("th", { scope: "row", text: joint.replace(/_joint$/, "") }),
              ...this.rows[i])));
  }
}
