// Pushing with the pointer: what is grabbed is drawn towards where the pointer is.
import { lapse } from "./link.js";

const EVERY = 33; // ms between requests while the pointer moves
const RENEW = 150; // ms, well within the time after which the robot lets go

export class DragTool {
  // request(name, values) sends; wanted(event): whether this press is to push rather than to orbit;
  // speed() is how fast simulated time is meant to go, 0 for unbounded.
  constructor(view, request, wanted, speed) {
    this.view = view;
    this.request = request;
    this.wanted = wanted;
    this.speed = speed;
    this.grip = null;
    const { canvas } = view;
    // Before OrbitControls, which listens to mouse and touch events, not to these.
    canvas.addEventListener("pointerdown", (event) => this.begin(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
      canvas.addEventListener(end, (event) => this.end(event));
    }
    window.addEventListener("blur", () => this.end());
  }

  begin(event) {
    if (this.grip || event.button !== 0 || !this.wanted(event)) return;
    const hit = this.view.pick(event.offsetX, event.offsetY);
    if (!hit?.body) return;
    this.view.controls.enabled = false;
    this.view.canvas.setPointerCapture(event.pointerId);
    this.view.canvas.classList.add("dragging");
    this.grip = { pointer: event.pointerId, body: hit.body, at: hit.local.toArray(),
                  plane: hit.point.clone(), to: hit.point.toArray(), sent: 0 };
    this.timer = setInterval(() => this.send(), RENEW);
  }

  move(event) {
    if (this.grip?.pointer !== event.pointerId) return;
    const to = this.view.onPlane(event.offsetX, event.offsetY, this.grip.plane);
    if (!to) return;
    this.grip.to = to.toArray();
    if (performance.now() - this.grip.sent > EVERY) this.send();
  }

  send() {
    const { body, at, to } = this.grip;
    this.grip.sent = performance.now();
    this.request("drag", { body, at, to, for: lapse(this.speed()) });
  }

  end(event) {
    if (!this.grip || (event && event.pointerId !== this.grip.pointer)) return;
    clearInterval(this.timer);
    const { body } = this.grip;
    this.grip = null;
    this.view.canvas.classList.remove("dragging");
    this.view.controls.enabled = true;
    this.request("let_go", { body });
  }
}
