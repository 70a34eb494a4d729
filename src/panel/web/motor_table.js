// All motors at a glance: where they are in their range, how hard they pull, how warm they are.
import { byId, element, number, setClass, setText } from "./dom.js";
import { shortName } from "./signals.js";

// °C at which the vendor's own programs stop (unitree_sdk2, terminations.hpp).
const HOT = { casing: 85, winding: 120 };
const WARM = 15; // °C before that; *assumed*
const HEAVY = 0.8; // of the torque limit; *assumed*
const FULL = 0.98;
const PUSHES = 1; // N·m into its stop, from which it is more than rest; *assumed*

export function temperatureLevel(value, hot) {
  if (value >= hot) return "bad";
  return value >= hot - WARM ? "warn" : "";
}

// A motor at its limit does what it can: nobody has to do anything before it is hot.
export function torqueLevel(tau, limit) {
  return Math.abs(tau) / limit >= HEAVY ? "warn" : "";
}

// `share`: 0 at the lower end of the range, 1 at the upper. What rests at its stop, as the joints of a
// robot that lies, is well.
export function positionLevel(share, tau) {
  return (share <= 0 && tau < -PUSHES) || (share >= 1 && tau > PUSHES) ? "warn" : "";
}

// The faults of each motor and its encoder, in words, by the name of the joint.
export function faultsByMotor(faults) {
  const found = new Map();
  for (const { component, fault } of faults) {
    const [motor, part] = component.split(/\.(encoder)$/);
    found.set(motor, [...(found.get(motor) ?? []), part ? `${part} ${fault}` : fault]);
  }
  return found;
}

class Row {
  constructor(motor, index, onPick) {
    this.motor = motor;
    const cell = (name) => element("td", { class: `num ${name}` });
    const pick = element("button", { type: "button", class: "quiet name",
                                     title: `${motor.name}, ${motor.hand ? `${motor.hand} hand ` : "slot "}` +
                                            `${motor.slot}: plot it` });
    // It may break behind an underscore.
    for (const part of shortName(motor).split(/(?<=_)/)) pick.append(part, element("wbr"));
    pick.addEventListener("click", () => onPick(index));
    this.range = element("i");
    this.effort = element("i");
    this.cells = { q: cell(""), dq: cell(""), tau: cell(""), casing: cell(""), winding: cell("") };
    this.state = element("td", { class: "state" });
    this.node = element("tr", {}, element("th", { scope: "row" }, pick), this.cells.q,
      element("td", { class: "gauge", "aria-hidden": "true" }, this.range), this.cells.dq,
      this.cells.tau, element("td", { class: "gauge middle", "aria-hidden": "true" }, this.effort),
      this.cells.casing, this.cells.winding, this.state);
  }

  // `faults` are the words for what is wrong with it or its encoder.
  show(reading, faults) {
    const { motor, cells } = this;
    const bounded = motor.range && motor.range[1] > motor.range[0];
    const share = bounded ? (reading.q - motor.range[0]) / (motor.range[1] - motor.range[0]) : 0.5;
    const effort = motor.torque_limit > 0 ? reading.tau / motor.torque_limit : 0;
    const levels = {
      q: bounded ? positionLevel(share, reading.tau) : "",
      tau: torqueLevel(reading.tau, motor.torque_limit || Infinity),
      casing: temperatureLevel(reading.casing, HOT.casing),
      winding: temperatureLevel(reading.winding, HOT.winding),
      dq: "",
    };
    const digits = { q: 3, dq: 2, tau: 1, casing: 0, winding: 0 };
    for (const [field, node] of Object.entries(cells)) {
      setText(node, number(reading[field], digits[field]));
      setClass(node, `num ${levels[field]}`);
    }
    this.range.style.setProperty("--at", bounded ? Math.max(0, Math.min(1, share)) : -1);
    this.effort.style.setProperty("--at", Math.max(-1, Math.min(1, effort)));
    setClass(this.range, levels.q);
    setClass(this.effort, levels.tau);
    this.showState(reading, levels, bounded && (share <= 0 || share >= 1), Math.abs(effort) >= FULL, faults);
  }

  // In words too: colour alone is not for everybody.
  showState(reading, levels, atStop, atLimit, faults) {
    const words = [...(faults.length ? [`fault: ${faults.join(", ")}`] : []), ...reading.errors];
    if (levels.casing === "bad" || levels.winding === "bad") words.push("hot");
    const bad = words.length > 0;
    if (!bad && (levels.casing || levels.winding)) words.push("warm");
    if (atLimit) words.push("torque limit");
    else if (!bad && levels.tau) words.push("heavy");
    if (levels.q) words.push("presses against its end stop");
    if (!reading.enabled) words.push("off");
    const level = words.length && reading.enabled ? "warn" : "muted";
    if (atStop && !levels.q) words.push("at stop");
    setText(this.state, words.join(", ") || (reading.recorded ? "–" : "on"));
    setClass(this.state, `state ${bad ? "bad" : level}`);
    setClass(this.node, reading.enabled ? "" : "off");
  }
}

export class MotorTable {
  // onPick(index): a motor was clicked.
  constructor(onPick) {
    this.onPick = onPick;
    this.rows = [];
  }

  setMotors(motors) {
    this.rows = motors.map((motor, i) => new Row(motor, i, this.onPick));
    byId("motor-rows").replaceChildren(...this.rows.map(({ node }) => node));
  }

  show(snapshot) {
    const faulty = faultsByMotor(snapshot.faults ?? []);
    snapshot.motors.forEach((reading, i) => {
      this.rows[i]?.show(reading, faulty.get(this.rows[i].motor.name) ?? []);
    });
    const worst = snapshot.motors.reduce((most, { winding }) => Math.max(most, winding), -Infinity);
    setText(byId("motor-note"), `warmest winding ${number(worst, 0)} °C`);
  }
}
