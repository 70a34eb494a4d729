// The services of the robot: which of their apis were called how often, what was answered last and
// why not, and a form to call one.
import { byId, element, number, setClass, setText } from "./dom.js";
import { Search } from "./search.js";

const MOST = 500; // rows of calls; services have some two hundred apis in all
// The vendor's RPC layer; codes of a service itself have no words here, the reason of a refusal has.
const CODES = { 0: "ok", 3102: "not sent", 3104: "timeout", 3202: "internal error",
                3203: "unknown api", 3204: "bad parameter", 3205: "lease denied",
                3206: "no such lease", 3207: "lease taken" };

// The call that an event reports: {service, api, code, calls, why}; null for other events.
export function callOf({ kind, detail }) {
  if (kind === "call") {
    return { service: detail.service, api: detail.api, code: detail.code, calls: detail.count ?? 1, why: "" };
  }
  if (kind !== "call_refused") return null;
  const [, service = detail.call, api] = /^(\S+) (\d+)/.exec(detail.call) ?? [];
  return { service, api: api === undefined ? NaN : Number(api), code: detail.code, calls: 0,
           refused: detail.calls ?? 1, why: detail.reason };
}

export class Services {
  // request(name, values) sends and reports a refusal.
  constructor(request) {
    this.request = request;
    this.calls = new Map(); // "service api" -> what has come of it
    this.apis = new Map(); // "service api" -> {service, id, name, does}
    this.search = new Search(byId("services-search"), () => this.draw());
    byId("services-all").addEventListener("change", () => this.draw());
    byId("service-form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.call();
    });
    byId("service-name").addEventListener("change", () => this.offerApis());
    byId("service-api").addEventListener("change", () => this.showWhat());
    this.drawn = 0;
  }

  setServices(services) {
    this.apis = new Map(services.flatMap(({ name: service, apis }) =>
      apis.map((api) => [`${service} ${api.id}`, { service, ...api }])));
    byId("service-name").replaceChildren(...services.filter(({ apis }) => apis.length)
      .map(({ name }) => element("option", { text: name })));
    this.offerApis();
    this.draw();
  }

  offerApis() {
    const service = byId("service-name").value;
    byId("service-api").replaceChildren(...[...this.apis.values()].filter((api) => api.service === service)
      .map(({ id, name }) => element("option", { value: id, text: `${id} ${name}` })));
    this.showWhat();
  }

  showWhat() {
    const api = this.apis.get(`${byId("service-name").value} ${byId("service-api").value}`);
    setText(byId("service-does"), api?.does ?? "");
  }

  call() {
    const parameter = byId("service-parameter").value.trim();
    this.request("service.call", { service: byId("service-name").value,
                                   api: Number(byId("service-api").value),
                                   ...(parameter && { parameter }) });
  }

  // One event, of any kind. A refused call is two of them: the call, and why.
  show(event) {
    const call = callOf(event);
    if (!call) return;
    const key = `${call.service} ${call.api}`;
    const known = this.calls.get(key) ?? { service: call.service, api: call.api, calls: 0, refused: 0 };
    known.calls += call.calls;
    known.refused += call.refused ?? 0;
    if (call.why || call.code !== known.code) known.why = call.why;
    Object.assign(known, { code: call.code, at: event.time });
    this.calls.delete(key);
    this.calls.set(key, known); // the newest last
    if (this.calls.size > MOST) this.calls.delete(this.calls.keys().next().value);
    this.later();
  }

  // Calls come in bursts: one picture for all of them.
  later() {
    if (this.drawn) return;
    this.drawn = requestAnimationFrame(() => {
      this.drawn = 0;
      this.draw();
    });
  }

  draw() {
    const called = [...this.calls.values()].reverse();
    const rest = byId("services-all").checked
      ? [...this.apis.values()].filter(({ service, id }) => !this.calls.has(`${service} ${id}`))
        .map(({ service, id }) => ({ service, api: id, calls: 0, refused: 0 })) : [];
    const rows = [...called, ...rest].filter((one) => this.search.matches(
      `${one.service} ${one.api} ${this.nameOf(one)} ${one.why ?? ""}`));
    byId("services-rows").replaceChildren(...rows.map((one) => this.rowOf(one)));
    byId("services-none").hidden = rows.length > 0;
    setText(byId("services-none"), called.length ? "No api has all of these words."
      : "No service has been called yet; “all apis” shows what there is.");
    const sum = (field) => called.reduce((total, one) => total + one[field], 0);
    setText(byId("services-note"), `${sum("calls")} calls, ${sum("refused")} refused`);
  }

  nameOf({ service, api }) {
    return this.apis.get(`${service} ${api}`)?.name ?? (api === 1 ? "api version" : "");
  }

  rowOf(one) {
    const { service, api, calls, refused, code, why, at } = one;
    const never = at === undefined;
    const answer = never ? "" : code === -1 ? "none" : `${code} ${CODES[code] ?? ""}`.trim();
    const level = why ? "warn" : "";
    return element("tr", { class: never ? "off" : false },
      element("th", { scope: "row", text: service }),
      element("td", { class: "num", text: Number.isNaN(api) ? "–" : String(api) }),
      element("td", { class: "who", text: this.nameOf(one) }),
      element("td", { class: "num", text: never ? "" : String(Math.max(calls, refused)) }),
      element("td", { class: `who ${level}`, text: [answer, why].filter(Boolean).join(", ") }),
      element("td", { class: "num muted", text: never ? "" : `${number(at, 2)} s` }));
  }
}
