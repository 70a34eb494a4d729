// Who writes and who reads which topic, how often, with which quality of service, and what cannot
// pass: read while it is looked at.
import { byId, element, number, setText } from "./dom.js";
import { Search } from "./search.js";

const READ_EVERY = 1000; // ms

// Messages a second of wall time between two readings; NaN where there is only one.
export function rateOf(topic, seconds, before) {
  if (!before || !(seconds > 0)) return NaN;
  return Math.max(topic.sent - before.sent, topic.received - before.received) / seconds;
}

// "reliable, volatile", and what is out of the ordinary.
export function qualityOf({ reliable, durable, exclusive, deadline, xcdr1, partition }) {
  return [reliable ? "reliable" : "best effort", durable ? "durable" : "volatile",
          exclusive && "exclusive", deadline && "deadline", !xcdr1 && "no XCDR1",
          partition && `partition ${partition}`].filter(Boolean).join(", ");
}

// "this robot ×2, process 12 (python3)".
function names(endpoints) {
  const counts = new Map();
  for (const { who } of endpoints) counts.set(who, (counts.get(who) ?? 0) + 1);
  return [...counts].map(([who, count]) => (count > 1 ? `${who} ×${count}` : who)).join(", ");
}

const shortType = (type) => type.replace(/::(msg::)?dds_::/, "/");
const foreign = ({ endpoints }) => endpoints.some(({ ours }) => !ours);
// What cannot pass first, then what others have to do with.
const weight = (topic) => (topic.mismatches.length || topic.unserved ? 2 : foreign(topic) ? 1 : 0);

export class Dds {
  constructor(link) {
    this.link = link;
    this.topics = [];
    this.before = null; // the reading before: {at, topics: Map}
    this.open = new Set(); // topics whose endpoints are seen
    this.search = new Search(byId("dds-search"), () => this.draw());
    byId("dds-all").addEventListener("change", () => this.draw());
    setInterval(() => this.read(), READ_EVERY);
  }

  async read() {
    if (document.hidden || !byId("dds").offsetParent) return;
    try {
      this.show(await this.link.json("/bus"));
    } catch {
      // The lost line says it.
    }
  }

  show({ at, topics }) {
    const seconds = this.before ? at - this.before.at : 0;
    if (this.before && seconds === 0) return;
    for (const topic of topics) topic.rate = rateOf(topic, seconds, this.before?.topics.get(topic.topic));
    this.before = { at, topics: new Map(topics.map((topic) => [topic.topic, topic])) };
    this.topics = topics.sort((a, b) => weight(b) - weight(a));
    const bad = topics.filter(({ mismatches }) => mismatches.length).length;
    const others = new Set(topics.flatMap(({ endpoints }) => endpoints)
      .filter(({ ours }) => !ours).map(({ who }) => who));
    setText(byId("dds-note"), `${topics.length} topics, ` +
      `${others.size} other ${others.size === 1 ? "program" : "programs"}`);
    setText(byId("dds-bad"), bad ? `${bad} ${bad === 1 ? "topic does" : "topics do"} not match` : "");
    this.draw();
  }

  draw() {
    const all = byId("dds-all").checked;
    const seen = this.topics.filter((topic) => (all || weight(topic) > 0) &&
      this.search.matches([topic.topic, ...topic.endpoints.map(({ who, type }) => `${who} ${type}`)].join(" ")));
    byId("dds-rows").replaceChildren(...seen.flatMap((topic) => this.rowsOf(topic)));
    byId("dds-none").hidden = seen.length > 0;
    setText(byId("dds-none"), all ? "No topic has all of these words."
      : "No other program writes or reads a topic of this robot; “all topics” shows the robot's own.");
  }

  rowsOf(topic) {
    const open = this.open.has(topic.topic);
    const name = element("button", { type: "button", class: "quiet name", text: topic.topic,
                                     "aria-expanded": String(open), title: "who, with which quality" });
    name.addEventListener("click", () => {
      if (!this.open.delete(topic.topic)) this.open.add(topic.topic);
      this.draw();
    });
    const types = [...new Set(topic.endpoints.map(({ type }) => shortType(type)))];
    const of = (writes) => topic.endpoints.filter((one) => one.writes === writes);
    const row = element("tr", { class: weight(topic) ? false : "off" },
      element("th", { scope: "row" }, name, element("small", { class: "muted", text: types.join(" | ") })),
      element("td", { class: "num", text: topic.rate > 0 || topic.rate === 0 ? number(topic.rate, 0) : "–" }),
      element("td", { class: "who", text: names(of(true)) || "nobody" }),
      element("td", { class: "who", text: names(of(false)) || "nobody" }));
    const more = topic.mismatches.map(({ writer, reader, why }) =>
      element("tr", { class: "more" }, element("td", { colspan: 4, class: "bad",
        text: `nothing passes from ${writer} to ${reader}: ${why}` })));
    if (topic.unserved) {
      more.push(element("tr", { class: "more" }, element("td", { colspan: 4, class: "bad",
        text: `nobody here serves it; on a robot: ${topic.unserved}` })));
    }
    if (!open) return [row, ...more];
    return [row, ...more, ...topic.endpoints.map((one) =>
      element("tr", { class: "more" }, element("td", { colspan: 4, class: "muted",
        text: `${one.who} ${one.writes ? "writes" : "reads"} ${shortType(one.type)}: ${qualityOf(one)}` })))];
  }
}
