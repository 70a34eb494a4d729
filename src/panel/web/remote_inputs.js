// Where the remote controller's keys and sticks come from besides the picture of it: the keyboard
// and gamepads. Plain tables and functions. The same keys as in `understudy remote`, but for
// SELECT: in a browser Tab goes from control to control.

// By KeyboardEvent.key in lower case: letters are the keys of that name.
export const KEYBOARD = {
  a: "A", b: "B", x: "X", y: "Y", q: "L1", w: "L2", p: "R1", o: "R2",
  enter: "START", backspace: "SELECT", 1: "F1", 2: "F2",
  arrowup: "UP", arrowdown: "DOWN", arrowleft: "LEFT", arrowright: "RIGHT",
};

export const KEYBOARD_STICKS = {
  e: ["ly", 1], d: ["ly", -1], s: ["lx", -1], f: ["lx", 1],
  i: ["ry", 1], k: ["ry", -1], j: ["rx", -1], l: ["rx", 1],
};

// The "standard" mapping of the W3C's Gamepad API, by the index of a button.
const GAMEPAD = [
  "A", "B", "X", "Y", "L1", "R1", "L2", "R2", "SELECT", "START", "F1", "F2",
  "UP", "DOWN", "LEFT", "RIGHT",
];
const AXES = ["lx", "ly", "rx", "ry"];
const DEAD = 0.1; // of a stick's way; *assumed*

const NONE = { lx: 0, ly: 0, rx: 0, ry: 0 };

// {keys: Set, lx, ly, rx, ry} of the keys that are down; `half`: sticks go half the way.
export function fromKeyboard(down, half) {
  const wish = { keys: new Set(), ...NONE };
  for (const key of down) {
    if (key in KEYBOARD) wish.keys.add(KEYBOARD[key]);
    if (key in KEYBOARD_STICKS) {
      const [axis, by] = KEYBOARD_STICKS[key];
      wish[axis] += half ? by / 2 : by;
    }
  }
  return wish;
}

// Round, so that a direction stays that direction; full deflection stays full.
function beyondDeadZone(x, y) {
  const length = Math.hypot(x, y);
  if (!(length > DEAD)) return [0, 0];
  const scale = (length - DEAD) / (1 - DEAD) / length;
  return [x, y].map((part) => Math.max(-1, Math.min(1, part * scale)));
}

// Of a Gamepad, whose sticks point down where the robot's point forward.
export function fromGamepad({ buttons, axes }) {
  const wish = { keys: new Set(), ...NONE };
  GAMEPAD.forEach((key, i) => {
    if (buttons[i]?.pressed) wish.keys.add(key);
  });
  const [lx, ly] = beyondDeadZone(axes[0] ?? 0, axes[1] ?? 0);
  const [rx, ry] = beyondDeadZone(axes[2] ?? 0, axes[3] ?? 0);
  return { ...wish, lx, ly: 0 - ly, rx, ry: 0 - ry };
}

// All of them at once: every key that anybody presses; the input that moves a stick furthest has it.
export function together(wishes) {
  const all = { keys: new Set(), ...NONE };
  for (const wish of wishes) {
    for (const key of wish.keys) all.keys.add(key);
    for (const axis of AXES) {
      if (Math.abs(wish[axis]) > Math.abs(all[axis])) all[axis] = wish[axis];
    }
  }
  return all;
}

// What the request remote.set takes: keys joined by "+", sticks in hundredths so that noise sends nothing.
export function valuesOf(wish) {
  const values = { keys: [...wish.keys].sort().join("+") };
  for (const axis of AXES) values[axis] = Math.round(wish[axis] * 100) / 100;
  return values;
}
