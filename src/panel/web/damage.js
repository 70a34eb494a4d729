// What the run would have done to the robot so far, read while it is looked at.
import { byId, element, number, setClass, setText } from "./dom.js";

const READ_EVERY = 1000; // ms
// What a motor's row shows, after its name; a figure that is none is left out.
const COLUMNS = [
  { of: (motor) => motor.at_torque_limit, digits: 2, bad: true,
    title: (motor) => `at ${motor.torque_limit} N·m` },
  { of: (motor) => motor.at_speed_limit, digits: 2, bad: true,
    title: (motor) => `at ${motor.speed_limit} rad/s` },
  { of: (motor) => motor.tripped, digits: 1, bad: true },
  { of: (motor) => motor.hottest, digits: 0 },
  { of: (motor) => motor.hardest_stop, digits: 1 },
  { of: (motor) => motor.largest_jump, digits: 2 },
];

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
    if (this.rows.length !== sheet.motors.length) this.makeRows(sheet.motors);
    sheet.motors.forEach((motor, i) => {
      COLUMNS.forEach(({ of, digits, bad, title }, column) => {
        const cell = this.rows[i][column];
        const value = of(motor);
        setText(cell, value === 0 ? "" : number(value, digits));
        setClass(cell, bad && value > 0 ? "num warn" : "num");
        if (title) cell.title = title(motor);
      });
    });
  }

  makeRows(motors) {
    this.rows = motors.map(() => COLUMNS.map(() => element("td", { class: "num" })));
    byId("damage-rows").replaceChildren(...motors.map(({ joint }, i) =>
      element("tr", {}, element("th", { scope: "row", text: joint.replace(/_joint$/, "") }),
              ...this.rows[i])));
  }
}
