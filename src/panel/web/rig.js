// What holds or pushes the robot besides a hand: crane, clamp, a push by numbers.
import { byId, element, number, setText } from "./dom.js";

export class Rig {
  // request(name, values) sends and reports a refusal.
  constructor(request) {
    const on = (id, act) => byId(id).addEventListener("click", act);
    const metres = () => ({ by: Number(byId("crane-by").value) });
    on("crane-up", () => request("crane.raise", metres()));
    on("crane-down", () => request("crane.lower", metres()));
    on("crane-hook", () => request(this.attached ? "crane.release" : "crane.attach"));
    on("clamp", () => request("clamp", { on: !this.clamped }));
    byId("push-form").addEventListener("submit", (event) => {
      event.preventDefault();
      request("push", {
        body: byId("push-body").value,
        force: ["x", "y", "z"].map((axis) => Number(byId(`push-${axis}`).value)),
        for: Number(byId("push-seconds").value),
      });
    });
  }

  setScene(scene) {
    byId("push-body").replaceChildren(...scene.bodies.slice(1).filter(({ name }) => name)
      .map(({ name }) => element("option", { text: name })));
    const base = scene.bodies[scene.base]?.name;
    if (base) byId("push-body").value = base;
  }

  show(status) {
    const { attached, length, tension } = status.crane;
    this.attached = attached;
    this.clamped = status.clamped;
    setText(byId("crane-state"), attached
      ? `hangs by ${number(length, 2)} m of tether, ${number(tension, 0)} N` : "off the hook");
    setText(byId("crane-hook"), attached ? "Release" : "Attach");
    setText(byId("clamp-state"), status.clamped ? "the base is held" : "the base is free");
    setText(byId("clamp"), status.clamped ? "Let go" : "Clamp");
    byId("crane-up").disabled = byId("crane-down").disabled = !attached;
  }
}
