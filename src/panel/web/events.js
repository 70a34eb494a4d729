// What happened, newest first.
import { byId, element, number, setText } from "./dom.js";
import { Search } from "./search.js";

const MOST = 200; // lines

// What the status says of who moves the motors: a short word, and what it means.
export function ownerOf(status) {
  if (status.motion.service) {
    return { word: status.motion.name, level: "",
             text: `motion service ${status.motion.service}, state ${status.motion.state}` };
  }
  switch (status.commands.state) {
    case "following":
      return { word: "your program", level: "good", text: "motors follow LowCmd" };
    case "start":
      return { word: "nobody", level: "warn", text: "no LowCmd yet" };
    case "damping":
      return { word: "nobody", level: "warn", text: "LowCmd stopped: damping" };
    case "limp":
      return { word: "nobody", level: "warn", text: "limp, as the remote controller asked" };
    default:
      return { word: status.commands.state, level: "", text: "" };
  }
}

// Of all topics and services.
const refusedOf = (status) =>
  [status.commands, status.arm_sdk, status.user_lowcmd, status.hand_sdk, ...status.hands, status.services]
    .flatMap(({ refused }) => Object.values(refused)).reduce((sum, count) => sum + count, 0);

const CLASSES = { warning: "warn", error: "bad" }; // by level
const TOLD_ELSEWHERE = new Set(["motion", "remote"]); // too many for a list

// What all late ticks so far come to, after one more event of them.
export function lateSoFar(sum, { detail, time }) {
  return { count: (sum?.count ?? 0) + detail.count, worst: Math.max(sum?.worst ?? 0, detail.worst ?? 0),
           from: sum?.from ?? time };
}

const lateText = ({ count, worst, from }) =>
  `${count} ${count === 1 ? "tick" : "ticks"} began late since ${number(from, 1)} s, the worst by ` +
  `${number(1000 * worst, 1)} ms`;

export class Events {
  constructor() {
    this.next = 0; // number of the next event
    this.late = null; // what the late ticks in the list come to, and its line
    byId("events-clear").addEventListener("click", () => {
      byId("event-list").replaceChildren();
      this.late = null;
    });
    this.search = new Search(byId("events-search"), () => {
      for (const line of byId("event-list").children) line.hidden = !this.search.matches(line.textContent);
    });
  }

  showStatus(status) {
    setText(byId("refused"), String(refusedOf(status)));
    setText(byId("accepted"), String(status.commands.accepted));
  }

  // One event of /events, which sends those before again to a page that comes back.
  show(event) {
    const { number, kind, level, text, time } = event;
    if (number < this.next) return;
    this.next = number + 1;
    if (kind === "overrun") this.addLate(event);
    else if (!TOLD_ELSEWHERE.has(kind)) this.add(text, CLASSES[level] ?? "", time);
  }

  // A busy machine would fill the list with late ticks: they are one line, at the last of them.
  addLate(event) {
    const sum = lateSoFar(this.late?.sum, event);
    this.late?.line.remove();
    this.late = { sum, line: this.add(lateText(sum), "muted", event.time) };
  }

  // One line, which it returns; `time`: simulated seconds.
  add(text, level, time) {
    const list = byId("event-list");
    const line = element("li", { class: level || false },
      element("time", { class: "num", text: Number.isFinite(time) ? `${number(time, 2)} s` : "" }),
      element("span", { text }));
    line.hidden = !this.search.matches(line.textContent);
    list.prepend(line);
    while (list.children.length > MOST) list.lastChild.remove();
    return line;
  }
}
