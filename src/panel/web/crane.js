// Lowers a robot that hangs from its crane until its feet carry it.
import { byId, number, setText } from "./dom.js";

const STRETCH = 0.03; // m of tether at a time; *assumed*, as the next four
const NEARLY = 0.005; // m: the last stretch is paid out
const CARRIED = 0.1; // of its weight that the crane may still carry when it stands
const TILTED = 0.6; // rad, from which it is not going to stand
const MOST = 2; // m in all
const LIMP = new Set(["damping", "zero torque"]); // in which its legs do not carry it

// N: what hangs on the base.
export function weightOf({ bodies, base, gravity }) {
  const hangs = [];
  bodies.forEach(({ parent }, id) => hangs.push(id === base || (id > 0 && hangs[parent] === true)));
  const mass = bodies.reduce((sum, body, id) => sum + (hangs[id] ? body.mass : 0), 0);
  return mass * Math.hypot(...gravity);
}

// What to do at a status, {done, text} or {lower: m}. `way`: {start, asked} [m of tether], `weight` in N.
export function nextOf(way, { crane, base }, weight) {
  if (!crane.attached) return { done: true, text: "the crane has been released" };
  if (base.tilt > TILTED) return { done: true, text: `stopped: it tips over, by ${number(base.tilt, 2)} rad` };
  if (crane.length < way.asked - NEARLY) return { lower: 0 };
  if (crane.tension < CARRIED * weight) {
    return { done: true, text: `it stands: the crane carries ${number(crane.tension, 0)} of ${number(weight, 0)} N. Release lets go` };
  }
  if (crane.length - way.start > MOST) return { done: true, text: "stopped after 2 m" };
  return { lower: STRETCH };
}

export class CraneLowering {
  // request(name, values) sends, reports a refusal and resolves to its text, "" if there is none.
  constructor(request) {
    this.request = request;
    this.way = null;
    this.said = "";
    this.weight = 0;
    this.button = byId("crane-lower-until");
    this.button.addEventListener("click", () => (this.way ? this.stop("stopped") : this.start()));
    document.addEventListener("visibilitychange", () => document.hidden && this.way && this.stop("stopped"));
  }

  setScene(scene) {
    this.weight = weightOf(scene);
  }

  start() {
    const { length } = this.status.crane;
    this.said = "";
    this.way = { start: length, asked: length };
    this.show(this.status);
  }

  stop(text) {
    this.way = null;
    this.said = text;
    this.show(this.status);
  }

  async show(status) {
    this.status = status;
    const { attached } = status.crane;
    const limp = status.motion.service !== "" && LIMP.has(status.motion.name);
    if (!attached && !this.way) this.said = "";
    this.button.hidden = !attached && !this.way;
    this.button.disabled = limp && !this.way;
    this.button.title = limp ? `in ${status.motion.name} its legs do not carry it` : "";
    setText(this.button, this.way ? "Stop lowering" : "Lower until it stands");
    setText(byId("crane-said"), limp && !this.way && attached ? this.button.title
      : this.way ? "lowering …" : this.said);
    if (!this.way) return;
    const next = nextOf(this.way, status, this.weight);
    if (next.done) return this.stop(next.text);
    if (next.lower === 0) return;
    this.way.asked = status.crane.length + next.lower;
    const refused = await this.request("crane.lower", { by: next.lower });
    if (refused && this.way) this.stop(refused);
  }
}
