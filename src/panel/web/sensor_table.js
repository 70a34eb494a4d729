// What the robot senses besides its motors: inertial units, battery, feet; and
// what presses on its hands.
import { byId, element, number, setClass, setText } from "./dom.js";
import { rollPitchYaw } from "./signals.js";

// Of the charge, at which the vendor's own programs stop (unitree_sdk2, terminations.hpp).
export const LOW = 0.2;

const RPY = ["roll", "pitch", "yaw"];
const XYZ = ["x", "y", "z"];

// Rows of {name, unit, digits, labels, values(snapshot), plot: names of signals, level(values)}; a
// label is what a value is called, or its unit where `unit` is "".
function rowsOf(scene, snapshot) {
  const rows = [];
  snapshot.imus.forEach((_, i) => {
    const name = i === 0 ? "imu" : (scene.imus?.[i] ?? `imu ${i + 1}`);
    const xyz = (what) => XYZ.map((axis) => `${name} ${what} ${axis}`);
    rows.push(
      { name: `${name} rpy`, unit: "rad", digits: 3, labels: RPY,
        values: (f) => rollPitchYaw(f.imus[i].quaternion),
        plot: RPY.map((axis) => `${name} ${axis}`) },
      { name: `${name} gyro`, unit: "rad/s", digits: 3, labels: XYZ,
        values: (f) => f.imus[i].gyroscope,
        plot: xyz("gyroscope") },
      { name: `${name} acc`, unit: "m/s²", digits: 2, labels: XYZ,
        values: (f) => f.imus[i].accelerometer,
        plot: xyz("accelerometer") });
  });
  if (snapshot.feet.length) {
    rows.push({ name: "feet", unit: "N", digits: 0, values: (f) => f.feet,
                labels: snapshot.feet.map((_, i) => scene.feet?.[i] ?? i),
                plot: snapshot.feet.map((_, i) => `foot ${scene.feet?.[i] ?? i} force`) });
  }
  rows.push({ name: "battery", unit: "", digits: 1, labels: ["V", "A", "%"],
              plot: ["battery voltage", "battery current"],
              values: ({ battery: { voltage, current, soc } }) => [voltage, current, 100 * soc],
              level: ([, , soc]) => (soc < 100 * LOW ? "warn" : "") });
  return rows;
}

export class SensorTable {
  // onPick(names): the signals of a row are to be plotted.
  constructor(onPick) {
    this.onPick = onPick;
    this.rows = [];
    this.hands = { names: "", cells: [] };
  }

  setSensors(scene, snapshot) {
    this.widest = Math.max(3, snapshot.feet.length);
    this.hands = { names: "", cells: [] };
    this.rows = rowsOf(scene, snapshot).map((row) => {
      const pick = element("button", { type: "button", class: "quiet name", text: row.name,
                                       title: `plot ${row.plot.join(", ")}` });
      pick.addEventListener("click", () => this.onPick(row.plot));
      return { ...row, ...this.makeRow(pick, row.labels, row.unit) };
    });
    byId("sensor-rows").replaceChildren(...this.rows.map(({ node }) => node));
  }

  // A row of a cell for each label, which stands behind its value where `unit` is "".
  makeRow(name, labels, unit) {
    const cells = labels.map((label) => {
      const value = element("span", { class: "value" });
      const mark = element("small", { class: "muted", text: label });
      const parts = unit === "" ? [value, " ", mark] : [mark, " ", value];
      return { value, node: element("td", { class: "num" }, ...parts) };
    });
    const rest = Array.from({ length: this.widest - cells.length }, () => element("td"));
    const node = element("tr", {}, element("th", { scope: "row" }, name), ...cells.map((one) => one.node),
                         ...rest, element("td", { class: "muted", text: unit }));
    return { cells, node };
  }

  // force: N by hand, as `hand_force` of the status; {} of a robot without hands.
  showHands(force) {
    if (!this.rows.length) return;
    const names = Object.keys(force);
    if (this.hands.names !== names.join()) {
      this.hands.node?.remove();
      this.hands = { names: names.join(), cells: [] };
      if (!names.length) return;
      Object.assign(this.hands, this.makeRow("hands", names, "N"));
      byId("sensor-rows").append(this.hands.node);
    }
    names.forEach((name, i) => setText(this.hands.cells[i].value, number(force[name], 1)));
  }

  show(snapshot) {
    for (const { cells, digits, values, level } of this.rows) {
      const now = values(snapshot);
      now.forEach((value, i) => setText(cells[i].value, number(value, digits)));
      if (level) cells.forEach(({ node }) => setClass(node, `num ${level(now)}`));
    }
  }
}
