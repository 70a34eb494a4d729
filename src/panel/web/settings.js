// Settings that can change while the robot runs: one is chosen, its value and what it may be are
// seen, another is given.
import { byId, element, setText } from "./dom.js";

export class Settings {
  // request(name, values) sends and reports a refusal.
  constructor(link, request) {
    this.link = link;
    this.settings = [];
    byId("setting-key").addEventListener("change", () => this.draw());
    byId("settings-form").addEventListener("submit", async (event) => {
      event.preventDefault();
      const text = byId("setting-value").value.trim();
      const value = text !== "" && Number.isFinite(Number(text)) ? Number(text) : text;
      await request("set", { key: byId("setting-key").value, value });
      this.read();
    });
  }

  async read() {
    try {
      this.settings = (await this.link.json("/settings")).settings;
    } catch {
      return; // the lost line says it
    }
    const chosen = byId("setting-key").value;
    byId("setting-key").replaceChildren(
      ...this.settings.map(({ key }) => element("option", { text: key, selected: key === chosen })));
    this.draw();
  }

  draw() {
    const setting = this.settings.find(({ key }) => key === byId("setting-key").value);
    if (!setting) return;
    byId("setting-value").value = String(setting.value);
    setText(byId("setting-unit"), setting.unit);
    const stands = setting.stands_for === undefined ? "" : `; ${setting.value} is ${setting.stands_for} here`;
    setText(byId("setting-does"), `${setting.does}: ${setting.takes}${stands}`);
  }
}
