// The bar at the top: what runs, how time goes, who moves the motors; pause, step, speed, reset.
import { byId, element, number, setClass, setText } from "./dom.js";
import { ownerOf } from "./events.js";
import { LOW } from "./sensor_table.js";

const POSE_WORDS = { "": "start pose" };
const SETTLE = 1000; // ms after a speed was chosen in which snapshots may still have the one before

export class Bar {
  // request(name, values) sends and reports a refusal.
  constructor(request) {
    this.paused = false;
    byId("pause").addEventListener("click", () => request(this.paused ? "resume" : "pause"));
    byId("step").addEventListener("click", (event) => {
      request("step", { steps: event.shiftKey ? 10 : 1, wait: false });
    });
    byId("record").addEventListener("click", () => {
      request(byId("record").getAttribute("aria-pressed") === "true" ? "record.stop" : "record.start");
    });
    this.chosenAt = -Infinity;
    byId("speed").addEventListener("change", () => {
      this.chosenAt = performance.now();
      request("speed", { speed: Number(byId("speed").value) || "max" });
    });
    byId("reset").addEventListener("click", () => {
      const pose = byId("pose").value;
      request("reset", pose ? { pose } : {});
    });
  }

  get speed() {
    return this.snapshotSpeed ?? 1;
  }

  // The robots of the world, each with its panel: choosing one goes there.
  setRobots(robots) {
    const list = byId("robots");
    list.parentElement.hidden = robots.length === 0;
    list.replaceChildren(...robots.map(({ name, url }) => {
      const here = url !== "" && new URL(url).port === location.port;
      return element("option", { value: url, text: name, selected: here, disabled: url === "" });
    }));
    list.onchange = () => {
      const url = new URL(list.value);
      url.hostname = location.hostname; // as this page is reached
      location.assign(url);
    };
  }

  setScene(scene) {
    setText(byId("robot"), scene.name ?? scene.robot);
    document.title = `${scene.name ?? scene.robot} · Understudy`;
    byId("pose").replaceChildren(...["", ...(scene.poses ?? [])].map((pose) =>
      element("option", { value: pose, text: POSE_WORDS[pose] ?? pose })));
  }

  showSnapshot(snapshot) {
    setText(byId("time"), `${number(snapshot.time, 2)} s`);
    this.paused = snapshot.paused;
    this.snapshotSpeed = snapshot.speed;
    setText(byId("pause"), snapshot.paused ? "Resume" : "Pause");
    byId("pause").setAttribute("aria-pressed", snapshot.paused);
    byId("step").disabled = !snapshot.paused;
    if (performance.now() - this.chosenAt > SETTLE) this.chooseSpeed(snapshot.speed);
  }

  chooseSpeed(value) {
    const speed = byId("speed");
    if (Number(speed.value) === value) return;
    if (![...speed.options].some((option) => Number(option.value) === value)) {
      speed.append(element("option", { value: String(value), text: `${value}×` }));
    }
    speed.value = String(value);
  }

  // A recording plays: what it does not have is blank. null: the live robot is shown again.
  showRecorded(recording) {
    document.body.classList.toggle("replaying", recording !== null);
    if (recording === null) return;
    setText(byId("time"), `${number(recording.time, 2)} s`);
    for (const id of ["factor", "late", "battery"]) {
      setText(byId(id), "–");
      byId(id).title = "not in a recording";
    }
    setText(byId("owner"), "recording");
    setClass(byId("owner"), "");
    setText(byId("owner-text"), recording.name);
    setText(byId("line"), "recording");
    setClass(byId("line"), "");
  }

  showStatus(status) {
    const { pace } = status;
    setText(byId("factor"), this.paused ? "paused" : `${number(pace.real_time_factor, 2)}×`);
    const behind = !this.paused && status.speed > 0 && pace.real_time_factor < 0.97 * status.speed;
    setClass(byId("factor"), `num ${behind ? "warn" : ""}`);
    byId("factor").title = "";
    setText(byId("late"), String(pace.overruns));
    byId("late").title = `worst ${number(1000 * pace.worst_lateness, 2)} ms late`;
    this.showRecording(status.recording);
    const owner = ownerOf(status);
    setText(byId("owner"), owner.word);
    setClass(byId("owner"), owner.level);
    setText(byId("owner-text"), owner.text);
  }

  showRecording({ state, file, bytes }) {
    const on = state !== "off";
    byId("record").setAttribute("aria-pressed", on);
    setClass(byId("record"), state === "failed" ? "bad" : "");
    byId("record").title = on ? `${state === "failed" ? "failed: " : ""}${file}, ` +
      `${number(bytes / 1e6, 1)} MB; click to stop` :
      "Record from now on, to a file where the robot was started";
  }

  showBattery({ soc, voltage }) {
    setText(byId("battery"), `${number(100 * soc, 0)} %`);
    byId("battery").title = `${number(voltage, 2)} V`;
    setClass(byId("battery"), `num ${soc < LOW ? "warn" : ""}`);
  }

  // state: live, silent or lost; or connecting, before anything is known.
  showLine(state, why) {
    setClass(byId("line"), state);
    setText(byId("line"), { live: "live", silent: "silent", lost: "lost" }[state]);
    byId("line").title = why ?? "";
  }
}
