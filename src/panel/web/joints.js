// Sliders for the joints of a clamped robot that no program commands. What a slider has moved is
// held there until the sliders are switched off, another tab is chosen or the page goes.
import { byId, element, number, setText } from "./dom.js";
import { lapse } from "./link.js";
import { shortName } from "./signals.js";

const RENEW = 150; // ms; the robot lets go of what is not renewed
const AT_ONCE = 0.0001; // s: the shortest time that a joint may be moved

export class Joints {
  // send(name, values) resolves to {status, error}; speed() is how fast simulated time is meant to
  // go; say(text) complains.
  constructor(send, speed, say) {
    this.send = send;
    this.speed = speed;
    this.say = say;
    this.on = false;
    this.why = "the robot is not clamped";
    this.sliders = [];
    byId("joints-on").addEventListener("click", () => this.turn(!this.on));
    document.addEventListener("visibilitychange", () => document.hidden && this.turn(false));
    window.addEventListener("pagehide", () => this.turn(false));
    setInterval(() => this.renew(), RENEW);
    this.draw();
  }

  // The motors of the body; hands have topics of their own.
  setMotors(motors) {
    this.turn(false);
    this.sliders = motors.filter(({ hand }) => !hand).map((motor, index) => this.make(motor, index));
    byId("joint-sliders").replaceChildren(...this.sliders.map(({ node }) => node));
  }

  make(motor, index) {
    const [min, max] = motor.range ?? [-Math.PI, Math.PI];
    const name = shortName(motor);
    const input = element("input", { type: "range", min, max, step: 0.001, "aria-label": `${name}, rad` });
    const output = element("output", { class: "num" });
    const slider = { joint: motor.name, index, input, output, moved: false,
                     node: element("label", { class: "joint", title: motor.name },
                                   element("span", { text: name }), input, output) };
    input.addEventListener("input", () => {
      slider.moved = true;
      this.draw();
      this.tell(slider);
    });
    return slider;
  }

  turn(on) {
    if (on === this.on) return;
    if (!on) {
      for (const slider of this.sliders.filter(({ moved }) => moved)) {
        slider.moved = false;
        this.send("joint", { joint: slider.joint, angle: Number(slider.input.value), for: AT_ONCE });
      }
    }
    this.on = on && this.why === "";
    this.draw();
  }

  renew() {
    if (!this.on) return;
    if (!byId("rig").offsetParent) return this.turn(false);
    for (const slider of this.sliders) if (slider.moved) this.tell(slider);
  }

  async tell({ joint, input }) {
    if (!this.on) return;
    const values = { joint, angle: Number(input.value), for: lapse(this.speed()) };
    const { status, error } = await this.send("joint", values);
    if (status === 200 || !this.on) return;
    this.say(error ?? `joint: ${status}`);
    for (const slider of this.sliders) slider.moved = false;
    this.turn(false);
  }

  showStatus({ clamped, power, commands }) {
    this.why = !clamped ? "the robot is not clamped" : power === "off" ? "the robot is switched off"
      : commands.state === "following" ? "a program commands the motors" : "";
    if (this.why && this.on) this.turn(false);
    this.draw();
  }

  // Where a joint is, until its slider is moved.
  show({ motors }) {
    if (!byId("rig").offsetParent) return;
    for (const { index, input, output, moved } of this.sliders) {
      const q = motors[index].q;
      if (!moved) input.value = q;
      setText(output, `${number(moved ? Number(input.value) : q, 3)} rad`);
    }
  }

  draw() {
    const held = this.sliders.filter(({ moved }) => moved).length;
    const button = byId("joints-on");
    button.setAttribute("aria-pressed", this.on);
    button.disabled = this.why !== "" && !this.on;
    setText(button, this.on ? "Release all joints" : "Move joints");
    button.classList.toggle("damp", this.on);
    setText(byId("joints-state"), this.why ? `off: ${this.why}`
      : !this.on ? "off" : held ? `this page holds ${held} of ${this.sliders.length} joints`
        : "on: a slider moves its joint at 1 rad/s and holds it");
    byId("joint-sliders").hidden = !this.on;
  }
}
