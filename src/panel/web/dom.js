// Small words for the document.

export const byId = (id) => document.getElementById(id);

// element("td", {class: "num", text: "3"}, child, ...): attributes by name, `text` its text.
export function element(tag, { text, ...attributes } = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === false || value === undefined) continue;
    made.setAttribute(name, value === true ? "" : value);
  }
  if (text !== undefined) made.textContent = text;
  made.append(...children);
  return made;
}

// Touches the document only where something changed: layout is what costs.
export function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

export function setClass(node, name) {
  if (node.className !== name) node.className = name;
}

// A number with so many digits behind the point and a proper minus; a dash for what is none.
export function number(value, digits) {
  if (!Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace("-", "") : text.replace("-", "−");
}

// Whether a key that goes down now belongs to what has the focus: text, a list, a button's Space,
// the arrows of what can be scrolled.
export function focusWants(event) {
  const focus = document.activeElement;
  if (!focus || focus === document.body) return false;
  if (focus.matches("select, textarea, input:not([type=checkbox])")) return true;
  if (focus.matches("[role=tab], .scroll") && event.key.startsWith("Arrow")) return true;
  return focus.matches("button, input, summary, a") && (event.key === " " || event.key === "Enter");
}
