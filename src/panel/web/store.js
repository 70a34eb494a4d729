// What the page remembers of a robot of that name, for as long as the browser does. A window
// that may store nothing, such as a private one, forgets.
let prefix = "understudy.";

export function setRobot(name) {
  prefix = `understudy.${name}.`;
}

export function remember(key, value) {
  try {
    localStorage.setItem(prefix + key, JSON.stringify(value));
  } catch {
    // Then it is forgotten.
  }
}

// undefined where nothing is known.
export function recall(key) {
  try {
    return JSON.parse(localStorage.getItem(prefix + key)) ?? undefined;
  } catch {
    return undefined;
  }
}
