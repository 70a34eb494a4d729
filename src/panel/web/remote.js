// The remote controller: drawn, and held by mouse, touch, keyboard or gamepad.
import { byId, focusWants, setText } from "./dom.js";
import { lapse } from "./link.js";
import {
  fromGamepad, fromKeyboard, KEYBOARD, KEYBOARD_STICKS, together, valuesOf,
} from "./remote_inputs.js";

const EVERY = 33; // ms between looks at all inputs
const RENEW = 150; // ms; what is held is sent again, or the robot lets go of it
const TAP = 80; // ms that a key stays down at least, counted from the message to the robot; *assumed*

export class Remote {
  // request(name, values) sends; speed() is how fast simulated time is meant to go, 0 for unbounded.
  constructor(request, speed) {
    this.request = request;
    this.speed = speed;
    this.root = byId("remote");
    this.drawn = { keys: new Set(), lx: 0, ly: 0, rx: 0, ry: 0 };
    this.down = new Map(); // of the keyboard: event.code -> what it meant when it went down
    this.half = false; // Shift is down
    this.latched = new Set();
    this.tapped = new Map(); // keys that went down a moment ago -> when the robot was sent them, or null
    this.press = Math.floor(Math.random() * 9e7); // number of the last press
    this.told = new Set(); // the keys that were sent last
    this.sent = "";
    this.sentAt = 0;
    this.enabled = false;
    this.keys = new Map();
    for (const button of this.root.querySelectorAll("[data-key]")) this.addKey(button);
    const sticks = [...this.root.querySelectorAll("[data-stick]")];
    this.sticks = sticks.map((node) => this.addStick(node));
    byId("remote-off").addEventListener("click", () => this.request("remote.off"));
    byId("latch").addEventListener("change", () => this.latched.clear());
    this.listenToKeyboard();
    window.addEventListener("blur", () => this.letGo());
    document.addEventListener("visibilitychange", () => document.hidden && this.putDown());
    setInterval(() => this.poll(), EVERY);
  }

  setEnabled(on) {
    this.enabled = on;
    if (!on) this.putDown();
  }

  addKey(button) {
    const key = button.dataset.key;
    this.keys.set(key, button);
    const press = () => {
      if (byId("latch").checked) {
        if (!this.latched.delete(key)) this.latched.add(key);
      } else {
        this.drawn.keys.add(key);
        this.tap(key);
      }
      this.poll();
    };
    const release = () => this.drawn.keys.delete(key);
    button.addEventListener("pointerdown", (event) => {
      button.setPointerCapture(event.pointerId);
      press();
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
      button.addEventListener(end, release);
    }
    button.addEventListener("contextmenu", (event) => event.preventDefault());
    // From the keyboard a drawn key is pressed for as long as Space or Enter is.
    button.addEventListener("keydown", (event) => {
      if ((event.key === " " || event.key === "Enter") && !event.repeat) press();
    });
    button.addEventListener("keyup", release);
    button.addEventListener("blur", release);
  }

  addStick(node) {
    const [x, y] = node.dataset.stick.split(" ");
    const knob = node.querySelector(".knob");
    const move = (event) => {
      const box = node.getBoundingClientRect();
      const reach = box.width / 2 - knob.offsetWidth / 4;
      let right = (event.clientX - box.left - box.width / 2) / reach;
      let up = -(event.clientY - box.top - box.height / 2) / reach;
      const length = Math.hypot(right, up);
      if (length > 1) [right, up] = [right / length, up / length];
      this.drawn[x] = right;
      this.drawn[y] = up;
    };
    const centre = () => (this.drawn[x] = this.drawn[y] = 0);
    node.addEventListener("pointerdown", (event) => {
      node.setPointerCapture(event.pointerId);
      move(event);
    });
    node.addEventListener("pointermove", (event) => {
      if (node.hasPointerCapture(event.pointerId)) move(event);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
      node.addEventListener(end, centre);
    }
    return { x, y, node, knob };
  }

  listenToKeyboard() {
    window.addEventListener("keydown", (event) => {
      this.half = event.shiftKey;
      const key = event.key.toLowerCase();
      if (!(key in KEYBOARD || key in KEYBOARD_STICKS)) return;
      if (!this.enabled || !byId("keyboard").checked || focusWants(event)) return;
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      event.preventDefault();
      this.down.set(event.code, key);
      if (!event.repeat && key in KEYBOARD) this.tap(KEYBOARD[key]);
      this.poll();
    });
    window.addEventListener("keyup", (event) => {
      this.half = event.shiftKey;
      this.down.delete(event.code);
    });
  }

  // Out of sight nothing stays down: browsers call us too seldom there to renew it in time.
  putDown() {
    this.letGo();
    this.latched.clear();
    this.tapped.clear();
  }

  // However slow the page is: a key that went down is sent, and only then may it go up again.
  tap(key) {
    this.press += 1;
    this.tapped.set(key, null);
  }

  letGo() {
    this.down.clear();
    this.drawn = { keys: new Set(), lx: 0, ly: 0, rx: 0, ry: 0 };
  }

  gamepads() {
    const all = [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad !== null);
    const known = all.filter(({ mapping }) => mapping === "standard");
    const name = (pad) => pad.id.replace(/ *\(.*/, "");
    const text = known.length ? `gamepad: ${name(known[0])}`
      : all.length ? `${name(all[0])}: a layout that the browser does not know` : "no gamepad";
    setText(byId("gamepad"), text);
    return document.hidden ? [] : known.map(fromGamepad);
  }

  // Sends what is held when it changes, and again before the robot would let go of it.
  poll() {
    const latched = { ...this.drawn, keys: this.latched };
    const typed = fromKeyboard(this.down.values(), this.half);
    const now = performance.now();
    for (const [key, at] of this.tapped) if (at !== null && now - at >= TAP) this.tapped.delete(key);
    const tapped = { ...this.drawn, keys: new Set(this.tapped.keys()) };
    const wish = together([this.drawn, latched, tapped, typed, ...this.gamepads()]);
    const held = valuesOf(wish);
    const text = JSON.stringify(held);
    const idle = !held.keys && !held.lx && !held.ly && !held.rx && !held.ry;
    this.draw(wish);
    if (!this.enabled || (text === this.sent && (idle || now - this.sentAt < RENEW))) return;
    if (idle && !this.sent) return;
    this.sent = idle ? "" : text;
    this.sentAt = now;
    for (const [key, at] of this.tapped) this.tapped.set(key, at ?? now);
    // The robot may have let go meanwhile: a renewal, which has the number of its press, is no other.
    if ([...wish.keys].some((key) => !this.told.has(key))) this.press += 1;
    this.told = wish.keys;
    this.request("remote.set", { ...held, for: lapse(this.speed()), press: this.press });
  }

  draw(wish) {
    for (const [key, button] of this.keys) {
      const on = wish.keys.has(key);
      if (button.classList.contains("down") === on) continue;
      button.classList.toggle("down", on);
      button.setAttribute("aria-pressed", on);
    }
    for (const { x, y, knob } of this.sticks) {
      knob.style.transform = `translate(${wish[x] * 34}px, ${-wish[y] * 34}px)`;
    }
  }

  // What the robot says that it receives.
  show({ keys, lx, ly, rx, ry }) {
    const sticks = [lx, ly, rx, ry].some((value) => value !== 0)
      ? ` · sticks ${[lx, ly, rx, ry].map((value) => value.toFixed(2)).join(" ")}` : "";
    setText(byId("received"), (keys || "no key") + sticks);
  }
}
