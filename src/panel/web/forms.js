// Forms for requests, made of their rows in GET /requests.
import { element } from "./dom.js";

// What takes the value of a field: one input, or three for a vector. `bodies` are the model's.
function inputsOf({ key, kind, range: [min, max] = [], words, required, default: value }, bodies) {
  const called = { "aria-label": key, required };
  const number = (axis) => element("input", {
    ...called, "aria-label": `${key} ${axis}`.trim(), type: "number", min, max,
    step: kind === "whole" ? 1 : "any", value, placeholder: axis });
  const choice = (names) => element("select", called,
    ...["", ...names].map((name) => element("option", { text: name })));
  switch (kind) {
    case "number": case "whole": case "speed": return [number("")];
    case "vector": return ["x", "y", "z"].map(number);
    case "switch":
      return [element("select", called, ...["Off", "On"].map((text) =>
        element("option", { text, selected: (value > 0) === (text === "On") })))];
    case "word": return [choice(words)];
    case "body": return [choice(bodies)];
    default: return [element("input", called)];
  }
}

// What stands in the inputs, undefined where nothing does: JSON leaves that out. Of a vector an
// empty part is 0.
function valueOf({ kind }, inputs) {
  if (kind === "switch") return inputs[0].value === "On";
  const texts = inputs.map(({ value }) => value);
  if (texts.every((text) => text === "")) return undefined;
  if (kind === "vector") return texts.map(Number);
  return inputs[0].type === "number" ? Number(texts[0]) : texts[0];
}

// A form that sends the request of a row by request(name, values).
export function makeForm({ name, does, fields }, bodies, request) {
  const parts = fields.map((field) => ({ field, inputs: inputsOf(field, bodies) }));
  const form = element("form", { class: "row", "aria-label": name },
    ...parts.map(({ field, inputs }) => element("span", { class: "field", title: field.does },
      `${field.key} `, ...inputs, field.unit ? ` ${field.unit}` : "")),
    element("button", { text: name.split(".").pop().replace("_", " "), title: does }));
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    request(name, Object.fromEntries(
      parts.map(({ field, inputs }) => [field.key, valueOf(field, inputs)])));
  });
  return form;
}
