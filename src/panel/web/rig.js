// What holds or pushes the robot besides a hand: crane, clamp, and a form for every request that no
// other control makes.
import { byId, element, number, setText } from "./dom.js";
import { makeForm } from "./forms.js";

// Requests with controls of their own, here, in the bar, in the view and on the remote controller.
const ELSEWHERE =
  /^(pause|resume|step|speed|reset|drag|let_go|clamp|joint|set|fault|crane\.(attach|release)|(record|remote|service)\..*)$/;

export class Rig {
  // request(name, values) sends and reports a refusal.
  constructor(request) {
    this.request = request;
    const on = (id, act) => byId(id).addEventListener("click", act);
    on("crane-hook", () => request(this.attached ? "crane.release" : "crane.attach"));
    on("clamp", () => request("clamp", { on: !this.clamped }));
  }

  // `rows` are those of GET /requests.
  setScene(scene, rows) {
    const bodies = scene.bodies.slice(1).map(({ name }) => name).filter(Boolean);
    const forms = rows.filter(({ name, from }) => from !== "script" && !ELSEWHERE.test(name))
      .map((row) => ({ row, form: makeForm(row, bodies, this.request) }));
    const ofCrane = ({ row }) => row.name.startsWith("crane.");
    byId("crane-forms").replaceChildren(...forms.filter(ofCrane).map(({ form }) => form));
    byId("forms").replaceChildren(...forms.filter((one) => !ofCrane(one)).map(({ row, form }) =>
      element("div", { class: "rig-row" }, element("h3", { text: row.name }),
        element("span", { class: "muted", text: row.does }), form)));
  }

  show(status) {
    const { attached, length, tension } = status.crane;
    this.attached = attached;
    this.clamped = status.clamped;
    setText(byId("crane-state"), attached
      ? `hangs by ${number(length, 2)} m of tether, ${number(tension, 0)} N` : "not attached");
    setText(byId("crane-hook"), attached ? "Release" : "Attach");
    setText(byId("clamp-state"), status.clamped ? "the base is held" : "the base is free");
    setText(byId("clamp"), status.clamped ? "Let go" : "Clamp");
    byId("crane-forms").hidden = !attached;
  }
}
