// What the robot senses besides its motors: inertial units, battery, feet.
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
  }

  setSensors(scene, snapshot) {
    const widest = Math.max(3, snapshot.feet.length);
    const cell = (label, after) => {
      const value = element("span", { class: "value" });
      const mark = element("small", { class: "muted", text: label });
      const node = element("td", { class: "num" }, ...(after ? [value, " ", mark] : [mark, " ", value]));
      return { value, node };
    };
    this.rows = rowsOf(scene, snapshot).map((row) => {
      const pick = element("button", { type: "button", class: "quiet name", text: row.name,
                                       title: `plot ${row.plot.join(", ")}` });
      pick.addEventListener("click", () => this.onPick(row.plot));
      const cells = row.labels.map((label) => cell(label, row.unit === ""));
      const rest = Array.from({ length: widest - cells.length }, () => element("td"));
      const node = element("tr", {}, element("th", { scope: "row" }, pick),
                           ...cells.map((one) => one.node), ...rest,
                           element("td", { class: "muted", text: row.unit }));
      return { ...row, cells, node };
    });
    byId("sensor-rows").replaceChildren(...this.rows.map(({ node }) => node));
  }

  show(snapshot) {
    for (const { cells, digits, values, level } of this.rows) {
      const now = values(snapshot);
      now.forEach((value, i) => setText(cells[i].value, number(value, digits)));
      if (level) cells.forEach(({ node }) => setClass(node, `num ${level(now)}`));
    }
  }
}
