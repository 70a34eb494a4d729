// What was refused and what changed, newest first.
import { byId, element, number, setText } from "./dom.js";

const MOST = 200; // lines

// What the status says of who moves the motors: a short word, and what it means.
export function ownerOf(status) {
  if (status.motion.service) {
    return { word: status.motion.service, level: "",
             text: `motion service, state ${status.motion.state}` };
  }
  switch (status.commands.state) {
    case "following":
      return { word: "your program", level: "good", text: "motors follow LowCmd" };
    case "start":
      return { word: "nobody", level: "warn", text: "no LowCmd yet" };
    case "damping":
      return { word: "nobody", level: "warn", text: "LowCmd stopped: damping" };
    case "limp":
      return { word: "nobody", level: "warn", text: "limp, on the remote controller's wish" };
    default:
      return { word: status.commands.state, level: "", text: "" };
  }
}

// What is news between two statuses: lines of {level, text}.
export function changes(before, now) {
  const news = [];
  const say = (text, level = "") => news.push({ text, level });
  const owner = ownerOf(now);
  if (ownerOf(before).text !== owner.text) say(`motors: ${owner.word}, ${owner.text}`, owner.level);
  if (before.crane.attached !== now.crane.attached) {
    say(now.crane.attached ? "on the crane" : "off the crane");
  }
  if (before.clamped !== now.clamped) say(now.clamped ? "clamped" : "unclamped");
  if (now.divergences > before.divergences) say("the physics diverged", "bad");
  if (!before.silenced && now.silenced) say("another robot speaks: we are silent", "bad");
  if (now.commands.timeouts > before.commands.timeouts) say("commands stopped", "warn");
  const told = before.requests.at(-1)?.number ?? -1;
  for (const { number, text } of now.requests) if (number > told) say(text);
  if (now.pace.overruns >= before.pace.overruns + 10) {
    say(`${now.pace.overruns - before.pace.overruns} late ticks`, "warn");
  }
  if (now.steps < before.steps) say("started anew");
  return news;
}

// Of all topics.
const refusedOf = (status) =>
  [status.commands, status.arm_sdk, status.user_lowcmd, ...status.hands]
    .flatMap(({ refused }) => Object.values(refused)).reduce((sum, count) => sum + count, 0);

const keyOf = ({ topic, reason, since }) => `${topic} ${reason} ${since}`;

export class Events {
  // refusals(): Promise of what GET /refusals answers.
  constructor(refusals) {
    this.refusals = refusals;
    this.before = null;
    this.known = new Map(); // refusals by what they have in common, with their lines
    byId("events-clear").addEventListener("click", () => byId("event-list").replaceChildren());
  }

  show(status) {
    const { before } = this;
    this.before = status;
    if (before && before.pid === status.pid) {
      for (const { text, level } of changes(before, status)) this.add(text, level, status.time);
    }
    setText(byId("refused"), String(refusedOf(status)));
    setText(byId("accepted"), String(status.commands.accepted));
    if (refusedOf(status) !== (before ? refusedOf(before) : 0)) this.fetchRefusals();
  }

  async fetchRefusals() {
    try {
      const { refusals } = await this.refusals();
      for (const refusal of refusals) this.showRefusal(refusal);
      const kept = new Set(refusals.map(keyOf));
      for (const key of this.known.keys()) if (!kept.has(key)) this.known.delete(key);
    } catch {
      // The line broke; it says so elsewhere.
    }
  }

  // Equal ones in a row are one line, whose count grows.
  showRefusal(refusal) {
    const { time, count, topic, reason, text } = refusal;
    const key = keyOf(refusal);
    const known = this.known.get(key);
    if (known?.count === count) return;
    const many = count > 1 ? `${count} times ` : "";
    known?.line.remove();
    this.known.set(key, {
      count, line: this.add(`refused ${many}${topic} (${reason}): ${text}`, "warn", time),
    });
  }

  // One line; `time`: simulated seconds.
  add(text, level, time) {
    const list = byId("event-list");
    const line = element("li", { class: level || false },
      element("time", { class: "num", text: Number.isFinite(time) ? `${number(time, 2)} s` : "" }),
      element("span", { text }));
    list.prepend(line);
    while (list.children.length > MOST) list.lastChild.remove();
    return line;
  }
}
