// What happened, newest first.
import { byId, element, number, setText } from "./dom.js";
import { Search } from "./search.js";

const MOST = 200; // lines

// What the status says of who moves the motors: a short word, and what it means.
export function ownerOf(status) {
  if (status.motion.service) {
    return { word: status.motion.service, level: "",
             text: `motion service: ${status.motion.name} (${status.motion.state})` };
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
  [status.commands, status.arm_sdk, status.user_lowcmd, ...status.hands, status.services]
    .flatMap(({ refused }) => Object.values(refused)).reduce((sum, count) => sum + count, 0);

const CLASSES = { warning: "warn", error: "bad" }; // by level
const TOLD_ELSEWHERE = new Set(["motion", "remote"]); // too many for a list

export class Events {
  constructor() {
    this.next = 0; // number of the next event
    byId("events-clear").addEventListener("click", () => byId("event-list").replaceChildren());
    this.search = new Search(byId("events-search"), () => {
      for (const line of byId("event-list").children) line.hidden = !this.search.matches(line.textContent);
    });
  }

  showStatus(status) {
    setText(byId("refused"), String(refusedOf(status)));
    setText(byId("accepted"), String(status.commands.accepted));
  }

  // One event of /events, which sends those before again to a page that comes back.
  show({ number, kind, level, text, time }) {
    if (number < this.next) return;
    this.next = number + 1;
    if (!TOLD_ELSEWHERE.has(kind)) this.add(text, CLASSES[level] ?? "", time);
  }

  // One line; `time`: simulated seconds.
  add(text, level, time) {
    const list = byId("event-list");
    const line = element("li", { class: level || false },
      element("time", { class: "num", text: Number.isFinite(time) ? `${number(time, 2)} s` : "" }),
      element("span", { text }));
    line.hidden = !this.search.matches(line.textContent);
    list.prepend(line);
    while (list.children.length > MOST) list.lastChild.remove();
  }
}
