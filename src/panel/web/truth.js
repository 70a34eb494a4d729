// What the sensors measured beside what was so at that instant, read while it is looked at.
import { byId, element, number, setClass, setText } from "./dom.js";
import { rollPitchYaw, shortName } from "./signals.js";

const READ_EVERY = 250; // ms
const UNITS = { q: "rad", dq: "rad/s", tau: "N·m" };
const DIGITS = { q: 6, dq: 4, tau: 3 };

// The angle between two, the short way round.
export const turn = (from, to) => Math.atan2(Math.sin(to - from), Math.cos(to - from));

// Rows of {name, unit, digits, measured, true, error}; `field` of the motors is q, dq or tau.
export function comparisonOf(scene, snapshot, field) {
  const rows = scene.motors.map((motor, i) => {
    const [measured, real] = [snapshot.motors[i]?.[field], snapshot.truth[field][i]];
    return { name: shortName(motor), unit: UNITS[field], digits: DIGITS[field], measured, true: real,
             error: measured - real };
  });
  snapshot.truth.imus.forEach((real, i) => {
    const name = i === 0 ? "imu" : (scene.imus?.[i] ?? `imu ${i + 1}`);
    const unit = snapshot.imus[i];
    const add = (what, unitName, digits, measured, so, error) =>
      rows.push({ name: `${name} ${what}`, unit: unitName, digits, measured, true: so, error });
    const [told, so] = [unit, real].map(({ quaternion }) => rollPitchYaw(quaternion));
    ["roll", "pitch", "yaw"].forEach((axis, k) =>
      add(axis, "rad", 6, told[k], so[k], turn(so[k], told[k])));
    for (const [what, key, unitName, digits] of [["gyro", "gyroscope", "rad/s", 4],
                                                 ["acc", "accelerometer", "m/s²", 3]]) {
      ["x", "y", "z"].forEach((axis, k) =>
        add(`${what} ${axis}`, unitName, digits, unit[key][k], real[key][k], unit[key][k] - real[key][k]));
    }
  });
  snapshot.truth.feet.forEach((real, i) => {
    rows.push({ name: `foot ${scene.feet?.[i] ?? i}`, unit: "N", digits: 1, measured: snapshot.feet[i],
                true: real, error: snapshot.feet[i] - real });
  });
  return rows;
}

export class TruthSheet {
  constructor(link) {
    this.link = link;
    this.scene = null;
    this.rows = [];
    this.details = byId("truth");
    this.details.addEventListener("toggle", () => this.read());
    byId("truth-of").addEventListener("change", () => this.read());
    setInterval(() => this.read(), READ_EVERY);
  }

  setScene(scene) {
    this.scene = scene;
    this.rows = [];
  }

  async read() {
    if (!this.scene || !this.details.open || document.hidden) return;
    try {
      this.show(await this.link.json("/snapshot?parts=truth,motors,imus,feet"));
    } catch {
      // The lost line says it.
    }
  }

  show(snapshot) {
    const field = byId("truth-of").value;
    const rows = comparisonOf(this.scene, snapshot, field);
    if (this.rows.length !== rows.length) this.makeRows(rows);
    rows.forEach((row, i) => {
      const cells = this.rows[i];
      for (const part of ["measured", "true", "error"]) setText(cells[part], number(row[part], row.digits));
      setText(cells.unit, row.unit);
      setClass(cells.error, "num error");
    });
    const worst = rows.slice(0, this.scene.motors.length)
      .reduce((most, row) => (Math.abs(row.error) > Math.abs(most.error) ? row : most));
    setText(byId("truth-note"), `largest error ${number(worst.error, worst.digits)} ${worst.unit}, ${worst.name}`);
  }

  makeRows(rows) {
    this.rows = rows.map(() => Object.fromEntries(["measured", "true", "error", "unit"].map((part) =>
      [part, element("td", { class: part === "unit" ? "muted" : "num" })])));
    byId("truth-rows").replaceChildren(...rows.map(({ name }, i) =>
      element("tr", {}, element("th", { scope: "row", text: name }), ...Object.values(this.rows[i]))));
  }
}
