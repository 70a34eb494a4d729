// What a camera of the robot sees, in a corner of the view, while it is chosen.
import { byId, element } from "./dom.js";

const EVERY = 500; // ms between two pictures: each takes a tenth of a second of a processor and more
const NONE_THIS_TIME = 503;

const wait = (ms) => new Promise((over) => setTimeout(over, ms));

export class Eyes {
  // say(text) tells why there is no picture.
  constructor(link, say) {
    this.link = link;
    this.say = say;
    this.looking = false;
    byId("eyes").addEventListener("change", () => this.choose(byId("eyes").value));
    this.list().catch((error) => say(error.message));
  }

  async list() {
    const { cameras } = await (await fetch("/cameras", { cache: "no-store" })).json();
    byId("eyes").append(...cameras.map(({ name }) => element("option", { value: name, text: name })));
    byId("eyes").hidden = cameras.length === 0;
  }

  // "" for none.
  choose(name) {
    byId("eyes").value = name;
    if (!name) byId("seen").hidden = true;
    if (name && !this.looking) this.look();
  }

  async look() {
    this.looking = true;
    try {
      for (let name; (name = byId("eyes").value);) {
        if (!document.hidden) await this.show(name);
        await wait(EVERY);
      }
    } catch (error) {
      this.say(error.message);
      this.choose("");
    }
    this.looking = false;
  }

  async show(name) {
    const reply = await fetch(`/cameras/${name}`, { headers: this.link.authorization(), cache: "no-store" });
    if (reply.status === NONE_THIS_TIME) return;
    if (!reply.ok) throw new Error((await reply.json()).error);
    const picture = await createImageBitmap(await reply.blob());
    if (byId("eyes").value !== name) return; // another was chosen meanwhile
    const seen = byId("seen");
    seen.width = picture.width;
    seen.height = picture.height;
    seen.getContext("2d").drawImage(picture, 0, 0);
    seen.hidden = false;
  }
}
