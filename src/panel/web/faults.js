// What is wrong with the robot: the faults that there are, and a form for another, which offers of a
// component the faults that it can have.
import { byId, element, number, setText } from "./dom.js";

// Components in groups by what they are; the order of the robot's list.
export function groupsOf(components) {
  const groups = new Map();
  for (const component of components) {
    if (!groups.has(component.of)) groups.set(component.of, []);
    groups.get(component.of).push(component);
  }
  return groups;
}

// As one reads it: "weak 0.25", "hot 60 °C", "off".
const faultText = ({ fault, by, unit }, kind) =>
  [fault, kind?.range ? `${Number(by.toPrecision(4))}` : "", kind?.range ? unit : ""].filter(Boolean).join(" ");

// Faults by component: "none" takes all of one's away.
export function byComponent(faults) {
  const found = new Map();
  for (const one of faults) found.set(one.component, [...(found.get(one.component) ?? []), one]);
  return found;
}

export class Faults {
  // request(name, values) sends and reports a refusal; show() brings the form into sight.
  constructor(link, request, show) {
    Object.assign(this, { link, request });
    this.components = [];
    this.kinds = [];
    this.shown = "";
    byId("fault-component").addEventListener("change", () => this.offerKinds());
    byId("fault-kind").addEventListener("change", () => this.describe());
    byId("fault-badge").addEventListener("click", show);
    byId("faults-clear").addEventListener("click", () => this.remove("all"));
    byId("fault-form").addEventListener("submit", (event) => {
      event.preventDefault();
      this.inject();
    });
  }

  async read() {
    Object.assign(this, await this.link.json("/faults"));
    const groups = [...groupsOf(this.components)].map(([of, members]) => element("optgroup", { label: of },
      ...members.map(({ name }) => element("option", { text: name }))));
    byId("fault-component").replaceChildren(...groups);
    this.offerKinds();
  }

  get component() {
    return this.components.find(({ name }) => name === byId("fault-component").value);
  }

  kindOf(of, fault) {
    return this.kinds.find((kind) => kind.of === of && kind.fault === fault);
  }

  // The chosen fault stays where the next component can have it too.
  offerKinds() {
    const chosen = byId("fault-kind").value;
    const faults = this.component?.faults ?? [];
    byId("fault-kind").replaceChildren(...faults.map((fault) =>
      element("option", { text: fault, selected: fault === chosen })));
    this.describe();
  }

  describe() {
    const kind = this.kindOf(this.component?.of, byId("fault-kind").value);
    if (!kind) return;
    const [min, max] = kind.range ?? [0, 0];
    const by = byId("fault-by");
    by.parentElement.hidden = !kind.range;
    Object.assign(by, { min, max, value: "", placeholder: String(kind.default ?? "") });
    setText(byId("fault-unit"), kind.unit);
    const range = kind.range
      ? `; ${[min, max].map((one) => Number(one.toPrecision(4))).join(" to ")}${kind.unit ? ` ${kind.unit}` : ""}` : "";
    setText(byId("fault-does"), `${kind.does}${range}`);
  }

  inject() {
    const values = { component: byId("fault-component").value, fault: byId("fault-kind").value };
    for (const [key, id] of [["by", "fault-by"], ["for", "fault-for"], ["ramp", "fault-ramp"],
                             ["probability", "fault-probability"]]) {
      const { value, parentElement } = byId(id);
      if (value !== "" && !parentElement.hidden) values[key] = Number(value);
    }
    this.request("fault", values);
  }

  remove(component) {
    this.request("fault", { component, fault: "none" });
  }

  // Makes the list anew only where it changed: a click must not hit a row that is gone.
  show({ faults }) {
    const text = JSON.stringify(faults);
    if (text === this.shown) return;
    this.shown = text;
    const count = `${faults.length} ${faults.length === 1 ? "fault" : "faults"}`;
    byId("fault-badge").hidden = faults.length === 0;
    setText(byId("fault-badge"), count);
    byId("fault-badge").title = faults.map(({ component, fault }) => `${component} ${fault}`).join(", ");
    setText(byId("faults-note"), faults.length ? "" : "nothing is wrong");
    byId("faults-clear").hidden = faults.length < 2;
    byId("fault-list").replaceChildren(...[...byComponent(faults)].map(([name, ones]) => this.row(name, ones)));
  }

  row(name, faults) {
    const { of } = this.components.find((one) => one.name === name) ?? {};
    const remove = element("button", { type: "button", text: "Remove", "aria-label": `Remove from ${name}` });
    remove.addEventListener("click", () => this.remove(name));
    const texts = faults.map((one) => `${faultText(one, this.kindOf(of, one.fault))}, since ${number(one.from, 1)} s`);
    return element("li", {}, element("strong", { text: name }), element("span", { text: texts.join("; ") }), remove);
  }
}
