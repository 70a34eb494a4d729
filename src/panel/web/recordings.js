// The recordings beside which the robot was started, and one of them played in the page: its states
// come in stretches of seconds as they are needed.
import { byId, element, number, setText } from "./dom.js";
import { instantOf } from "./playback.js";

const STRETCH = 2; // s that one reply has
const HZ = 30; // poses a second
const AHEAD = 1; // s of wall time before the end of what is there at which more is asked for

export class Recordings {
  // show(instant or null): what is to be seen (playback.js), or that it is the live robot again;
  // say(text): what went wrong.
  constructor(link, show, say) {
    Object.assign(this, { link, show, say });
    this.playing = null; // {name, from, to, now, runs, stretches: Map}
    byId("recordings-read").addEventListener("click", () => this.list());
    byId("recording-run").addEventListener("click", () => this.run(!this.playing.runs));
    byId("recording-live").addEventListener("click", () => this.close());
    byId("recording-at").addEventListener("input", () => this.seek(Number(byId("recording-at").value)));
    let last = performance.now();
    const tick = (now) => {
      requestAnimationFrame(tick);
      this.advance((now - last) / 1000);
      last = now;
    };
    requestAnimationFrame(tick);
    byId("recording-loop").addEventListener("click", () => {
      const on = byId("recording-loop").getAttribute("aria-pressed") !== "true";
      byId("recording-loop").setAttribute("aria-pressed", on);
    });
  }

  get speed() {
    return Number(byId("recording-speed").value);
  }

  get loops() {
    return byId("recording-loop").getAttribute("aria-pressed") === "true";
  }

  // ---- the list

  async list() {
    let told;
    try {
      told = await this.ask("/recordings");
    } catch (error) {
      return this.say(error.message);
    }
    setText(byId("recordings-note"), told.folder);
    byId("recordings-none").hidden = told.recordings.length > 0;
    byId("recordings-list").replaceChildren(...told.recordings.map(({ name, bytes, written, why_not: whyNot }) => {
      const play = element("button", {
        type: "button", text: "Play", "aria-label": `Play ${name}`, disabled: Boolean(whyNot),
      });
      play.addEventListener("click", () => this.open(name));
      return element("li", {}, play, element("span", { class: "name", text: name }),
        element("span", { class: "num muted", text: `${number(bytes / 1e6, 1)} MB` }),
        element("span", { class: "num muted", text: new Date(written * 1000).toLocaleString() }),
        ...(whyNot ? [element("p", { class: "muted", text: whyNot })] : []));
    }));
  }

  // ---- playing

  async ask(path) {
    const reply = await fetch(path, { headers: this.link.authorization(), cache: "no-store" });
    const told = await reply.json();
    if (!reply.ok) throw new Error(told.error);
    return told;
  }

  async open(name) {
    try {
      const { from, to } = await this.ask(`/recordings/${name}`);
      this.playing = { name, from, to, now: from, runs: true, stretches: new Map() };
      Object.assign(byId("recording-at"), { min: from, max: to, value: from });
      byId("player").hidden = false;
      setText(byId("recording-name"), name);
      this.run(true);
    } catch (error) {
      this.say(error.message);
    }
  }

  close() {
    this.playing = null;
    byId("player").hidden = true;
    this.show(null);
  }

  run(on) {
    if (on && this.playing.now >= this.playing.to) this.playing.now = this.playing.from;
    this.playing.runs = on;
    setText(byId("recording-run"), on ? "Stop" : "Play");
  }

  seek(time) {
    if (!this.playing) return;
    this.playing.now = time;
    this.draw();
  }

  // The stretch with that time, which is asked for where it is not there yet.
  stretchAt(time) {
    const { playing } = this;
    const number = Math.floor((time - playing.from) / STRETCH);
    const from = playing.from + number * STRETCH;
    if (from > playing.to) return null;
    if (!playing.stretches.has(number)) {
      playing.stretches.set(number, null);
      const query = `from=${from}&to=${Math.min(from + STRETCH, playing.to)}&hz=${HZ}`;
      this.ask(`/recordings/${playing.name}?${query}`)
        .then((told) => playing.stretches.set(number, told), (error) => this.say(error.message));
    }
    return playing.stretches.get(number);
  }

  // Waits where the next stretch has not come.
  advance(seconds) {
    const { playing } = this;
    if (!playing) return;
    if (playing.runs && this.stretchAt(playing.now)) {
      playing.now = Math.min(playing.to, playing.now + this.speed * seconds);
      this.stretchAt(playing.now + AHEAD * this.speed);
      if (playing.now >= playing.to && this.loops) playing.now = playing.from;
      else if (playing.now >= playing.to) this.run(false);
    }
    this.draw();
  }

  draw() {
    const { playing } = this;
    byId("recording-at").value = playing.now;
    setText(byId("recording-time"), `${number(playing.now, 1)} of ${number(playing.to, 1)} s`);
    const stretch = this.stretchAt(playing.now);
    if (!stretch?.times.length) return;
    const instant = instantOf(stretch, playing.now);
    if (instant.time === playing.drawn) return;
    playing.drawn = instant.time;
    this.show(instant);
  }
}
