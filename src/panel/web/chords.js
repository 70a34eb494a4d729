// What the robot's chords do, by name: one button each, and one that damps, which is always there.
import { byId, element, setClass, setText } from "./dom.js";

const NO_SERVICE = "no motion service is on";
const PRESS = 0.12; // s of wall time that the keys of a chord are down; *assumed*
const BETWEEN = 250; // ms between two presses of one; the robot allows 500 of simulated time
const LEAST = 0.02, MOST = 10; // s of simulated time: a few ticks, and no key for ever

// PRESS in simulated seconds; `speed` 0 is unbounded, and taken for 20.
const pressed = (speed) => Math.min(MOST, Math.max(LEAST, PRESS * (speed || 20)));

const upper = (text) => text.charAt(0).toUpperCase() + text.slice(1);
// "START twice", as one says it.
export const keysOf = ({ keys, clicks }) => (clicks > 1 ? `${keys} twice` : keys);

// Chords of one name and the same keys, in other states, are one button.
export function buttonsOf(chords) {
  const buttons = new Map();
  for (const chord of chords) {
    const name = chord.does === "debug" ? "debug mode" : chord.name;
    const known = buttons.get(`${name} ${keysOf(chord)}`);
    if (!known) buttons.set(`${name} ${keysOf(chord)}`, { ...chord, name });
    else known.from = known.from.length && chord.from.length ? [...known.from, ...chord.from] : [];
  }
  return [...buttons.values()];
}

const sameDeed = (a, b) => a !== undefined && a.does === b.does && a.value === b.value;

// What each chord's keys do in the present state: the first of the robot's list that counts in it.
export function doingNow(chords, { service, state }) {
  const now = new Map();
  for (const chord of chords) {
    // A motion service does what a chord says; without one there is nothing left to do but damp.
    const counts = service === "" ? chord.does === "damp"
      : chord.from.length === 0 || chord.from.includes(state);
    if (counts && !now.has(keysOf(chord))) now.set(keysOf(chord), chord);
  }
  return now;
}

export class Chords {
  // request(name, values) sends and reports a refusal; speed() is that of simulated time.
  constructor(request, speed) {
    this.request = request;
    this.speed = speed;
    this.rows = [];
    this.chords = [];
    this.damp = null;
    byId("damp").addEventListener("click", () => this.damp && this.press(this.damp));
  }

  setScene({ chords = [] }) {
    this.damp = chords.find(({ does }) => does === "damp") ?? null;
    byId("damp").hidden = !this.damp;
    if (this.damp) byId("damp").title = `${keysOf(this.damp)}: every motor only brakes, from any state`;
    this.chords = chords;
    this.rows = buttonsOf(chords).filter(({ does }) => does !== "damp").map((chord) => {
      const button = element("button", { type: "button", class: "chord" },
        element("span", { text: upper(chord.name) }), element("kbd", { text: keysOf(chord) }));
      button.addEventListener("click", () => this.press(chord));
      return { chord, button };
    });
    byId("chords").replaceChildren(...this.rows.map(({ button }) => button));
    byId("chords-none").hidden = this.rows.length > 0;
  }

  async press({ keys, clicks }) {
    for (let click = 0; click < clicks; ++click) {
      if (click > 0) await new Promise((done) => setTimeout(done, BETWEEN));
      const answered = this.request("remote.press", { keys, for: pressed(this.speed()) });
      if (click + 1 === clicks) await answered;
    }
  }

  // Those that the present state does not know are pale, and the robot says why when they are pressed.
  // Where the same keys do something else now, they cannot be.
  showStatus({ motion }) {
    const on = motion.service !== "";
    const doNow = doingNow(this.chords, motion);
    for (const { chord, button } of this.rows) {
      const now = doNow.get(keysOf(chord));
      const works = sameDeed(now, chord);
      setClass(button, `chord ${works ? "" : "pale"}`);
      button.disabled = now !== undefined && !works;
      button.title = works ? "" : now ? `${keysOf(chord)} is ${now.name} now` : !on ? NO_SERVICE
        : `not in ${motion.name} (${motion.state}), but in ${chord.from.join(", ")}`;
    }
    setText(byId("chords-state"), on ? `${motion.service}: ${motion.name}` : NO_SERVICE);
  }
}
