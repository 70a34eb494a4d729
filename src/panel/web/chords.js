// What the robot's chords do, by name: one button each, and one that damps, which is always there. A
// button says what it needs, and after a click what came of it.
import { byId, element, setClass, setText } from "./dom.js";

const NO_SERVICE = "no motion service is on";
const PRESS = 0.12; // s of wall time that the keys of a chord are down; *assumed*
const BETWEEN = 250; // ms between two presses of one; the robot allows 500 of simulated time
const LEAST = 0.02, MOST = 10; // s of simulated time: a few ticks, and no key for ever
const ANSWER = 2000; // ms of wall time within which a state changes or a refusal comes; *assumed*
const SHOWN = 8000; // ms that what came of a click stays on its button; *assumed*

// PRESS in simulated seconds; `speed` 0 is unbounded, and taken for 20.
const pressed = (speed) => Math.min(MOST, Math.max(LEAST, PRESS * (speed || 20)));

const upper = (text) => text.charAt(0).toUpperCase() + text.slice(1);
const sameKeys = (a, b) => a.split("+").sort().join() === b.split("+").sort().join();
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

// What each chord's keys do in a state: the first of the robot's list that counts in it.
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

// The state to which a chord's keys lead from another; undefined: they do something else there, or nothing.
function led(chords, chord, state) {
  const now = doingNow(chords, { service: "any", state }).get(keysOf(chord));
  if (!sameDeed(now, chord)) return undefined;
  if (chord.does === "debug") return state;
  return chord.effects.find(({ from }) => from === state)?.to;
}

// Nobody recovers a robot that has not fallen, nor lets one drop that stands, where there is another way.
const ROUGH = [["debug", "recovery_stand", "damp", "zero_torque"], ["debug", "recovery_stand"]];

function shortestWay(chord, chords, state, without) {
  const seen = new Set([state]);
  const ways = [{ at: state, steps: [] }];
  for (let way = ways.shift(); way; way = ways.shift()) {
    if (led(chords, chord, way.at) !== undefined) return way.steps;
    for (const step of chords.filter(({ does }) => !without.includes(does))) {
      const to = led(chords, step, way.at);
      if (to === undefined || seen.has(to)) continue;
      seen.add(to);
      ways.push({ at: to, steps: [...way.steps, step] });
    }
  }
  return null;
}

// The chords to be pressed before one, the fewest: [] if it works now, null if no way is known.
export function wayTo(chord, chords, state) {
  for (const without of ROUGH) {
    const way = shortestWay(chord, chords, state, without);
    if (way) return way;
  }
  return null;
}

// What a button needs before it works, "" for nothing: "press L2+A first".
export function needOf(chord, chords, { service, state, name }) {
  if (service === "") return chord.does === "damp" ? "" : NO_SERVICE;
  if (!chord.simulated) return "not simulated";
  const steps = wayTo(chord, chords, state);
  if (steps === null) return `not in ${name}`;
  return steps.length ? `press ${steps.map(keysOf).join(", then ")} first` : "";
}

export class Chords {
  // request(name, values) sends, reports a refusal and resolves to its text, "" if there is none;
  // speed() is that of simulated time.
  constructor(request, speed) {
    this.request = request;
    this.speed = speed;
    this.rows = [];
    this.chords = [];
    this.damp = null;
    this.upAt = 0; // ms, when the keys of the last press are up
    this.clicked = null; // {row, before: the status of the motion service, until: ms}
    byId("damp").addEventListener("click", () => this.damp && this.press(this.damp));
  }

  setScene({ chords = [], states = [] }) {
    this.damp = chords.find(({ does }) => does === "damp") ?? null;
    byId("damp").hidden = !this.damp;
    if (this.damp) byId("damp").title = `${keysOf(this.damp)}: every motor only brakes, from any state`;
    this.chords = chords;
    this.names = new Map(states.map(({ id, name }) => [id, name]));
    this.rows = buttonsOf(chords).filter(({ does }) => does !== "damp").map((chord) => {
      const note = element("small", { class: "note-line" });
      const button = element("button", { type: "button", class: "chord" },
        element("span", { text: upper(chord.name) }), element("kbd", { text: keysOf(chord) }), note);
      const row = { chord, button, note, said: "", until: 0 };
      button.addEventListener("click", () => this.click(row));
      return row;
    });
    byId("chords").replaceChildren(...this.rows.map(({ button }) => button));
    byId("chords-none").hidden = this.rows.length > 0;
  }

  // After those of the last press are up: keys that are down together would be another chord.
  async press({ keys, clicks }) {
    const down = this.upAt - performance.now();
    if (down > 0) await new Promise((done) => setTimeout(done, down));
    for (let click = 0; click < clicks; ++click) {
      if (click > 0) await new Promise((done) => setTimeout(done, BETWEEN));
      this.upAt = performance.now() + BETWEEN;
      const answered = this.request("remote.press", { keys, for: pressed(this.speed()) });
      if (click + 1 === clicks) return await answered;
    }
  }

  async click(row) {
    this.say(row, "…", "");
    const clicked = { row, before: this.motion, until: Infinity };
    this.clicked = clicked;
    const refused = await this.press(row.chord);
    if (refused && this.clicked === clicked) this.answer(refused, "bad");
    else clicked.until = performance.now() + ANSWER;
  }

  // What came of the last click.
  answer(text, level) {
    const { row } = this.clicked;
    this.clicked = null;
    this.tell(row, text, level);
  }

  tell(row, text, level) {
    this.say(row, text, level);
    setText(byId("chords-said"), `${upper(row.chord.name)}: ${text}`);
    setClass(byId("chords-said"), level);
  }

  say(row, said, level) {
    Object.assign(row, { said, level, until: performance.now() + SHOWN });
    this.draw(row);
  }

  // The robot says of keys that they have no effect, or that its state is another.
  showEvent({ kind, text, detail }) {
    if (!this.clicked) return;
    const { row } = this.clicked;
    if (kind === "unheeded" && sameKeys(detail.keys, row.chord.keys)) {
      const need = needOf(row.chord, this.chords, this.motion);
      this.answer(need.startsWith("press") ? `${text}; ${need}` : text, "bad");
    } else if (kind === "motion" && row.chord.does !== "debug") {
      this.answer(`taken: ${text}`, "good");
    } else if (kind === "motion_service" && row.chord.does === "debug") {
      this.answer(text, "good");
    }
  }

  draw({ chord, button, note, said, level, until, need }) {
    const fresh = performance.now() < until;
    setText(note, fresh ? said : need ?? "");
    setClass(note, `note-line ${fresh ? level : ""}`);
    button.dataset.keys = keysOf(chord);
  }

  // Those that the present state does not know are pale, and say what they need. Where the same keys do
  // something else now, they cannot be pressed.
  showStatus({ motion }) {
    this.motion = motion;
    const on = motion.service !== "";
    const doNow = doingNow(this.chords, motion);
    for (const row of this.rows) {
      const { chord, button } = row;
      const now = doNow.get(keysOf(chord));
      const other = now !== undefined && !sameDeed(now, chord);
      row.need = other ? `${keysOf(chord)} is ${now.name} now` : needOf(chord, this.chords, motion);
      setClass(button, `chord ${row.need ? "pale" : ""}`);
      button.disabled = other;
      button.title = this.titleOf(chord, row.need);
      this.draw(row);
    }
    setText(byId("chords-state"), on ? `${motion.service}: ${motion.name} (${motion.state})` : NO_SERVICE);
    this.askState();
  }

  // Where no event has said what came of a click, the state does; it may still change.
  askState() {
    if (!this.clicked) return;
    const { row, before, until } = this.clicked;
    const { name, state, service } = this.motion;
    if (state !== before.state && service === before.service) {
      this.answer(`taken: ${name} (${state})`, "good");
    } else if (performance.now() > until) {
      this.clicked.until = Infinity;
      this.tell(row, `pressed; the state stays ${name} (${state})`, "");
    }
  }

  titleOf(chord, need) {
    const works = chord.effects.map(({ from }) => this.names.get(from)).filter(Boolean);
    const where = works.length ? `works in ${works.join(", ")}` : "";
    return [need, need && where].filter(Boolean).join("; ");
  }
}
