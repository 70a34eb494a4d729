// What the robot's lidar sees, as points in the view, while it is looked at: nothing is cast for nobody.
import * as THREE from "./vendor/three/build/three.module.js";
import { byId } from "./dom.js";

const EVERY = 100; // ms between two questions, *assumed*: a cloud comes every 67 to 100 ms
const NAMES = ["cloud", "heights"]; // of views, and of their buttons
// By height over the ground [m], as in reports: the least of each class but the first.
const BANDS = [0.1, 0.25, 0.5, 1.0, 1.8];
const COLOURS = ["#b9c2cc", "#4c9ed9", "#35a46f", "#d9a51f", "#d9622b", "#9a4fb0"]
  .map((colour) => new THREE.Color(colour).convertSRGBToLinear());
const LOWEST = 0.02; // share of points that may lie below the ground

const wait = (ms) => new Promise((over) => setTimeout(over, ms));

function makeCloud(scene) {
  const points = new THREE.Points(new THREE.BufferGeometry(), new THREE.PointsMaterial(
    { size: 3, sizeAttenuation: false, vertexColors: THREE.VertexColors }));
  points.frustumCulled = false;
  points.matrixAutoUpdate = false;
  points.visible = false;
  scene.add(points);
  return points;
}

// The colours of points, of which each has a height.
function coloursOf(heights) {
  const ground = Float32Array.from(heights).sort()[Math.floor(LOWEST * heights.length)];
  const colours = new Float32Array(3 * heights.length);
  heights.forEach((height, i) => {
    const band = BANDS.filter((least) => height - ground >= least).length;
    COLOURS[band].toArray(colours, 3 * i);
  });
  return colours;
}

export class Sight {
  // say(text) tells why there is nothing.
  constructor(link, view, say) {
    this.link = link;
    this.view = view;
    this.say = say;
    this.bodies = {}; // of views, by name: whose frame the points have
    this.on = {};
    this.paused = false; // a recording is shown, not the live robot
    this.clouds = Object.fromEntries(NAMES.map((name) => [name, makeCloud(view.scene)]));
    this.asks = false;
  }

  async setScene(description) {
    const { views } = await this.link.json("/lidar");
    this.bodies = {};
    for (const { name, body } of views) {
      this.bodies[name] = description.bodies.findIndex((one) => one.name === body);
    }
    for (const name of NAMES) byId(name).hidden = !(this.bodies[name] >= 0);
    this.look();
  }

  choose(name, on) {
    this.on[name] = on;
    if (!on) this.hide(name);
    this.look();
  }

  pause(on) {
    this.paused = on;
    if (on) NAMES.forEach((name) => this.hide(name));
  }

  hide(name) {
    this.clouds[name].visible = false;
    this.view.invalidate();
  }

  chosen() {
    return NAMES.filter((name) => this.on[name] && this.bodies[name] >= 0);
  }

  async look() {
    if (this.asks) return;
    this.asks = true;
    try {
      while (this.chosen().length > 0) {
        if (!document.hidden && !this.paused) await Promise.all(this.chosen().map((name) => this.ask(name)));
        await wait(EVERY);
      }
    } catch (error) {
      this.say(error.message);
      NAMES.forEach((name) => byId(name).getAttribute("aria-pressed") === "true" && byId(name).click());
    }
    this.asks = false;
  }

  async ask(name) {
    const reply = await fetch(`/lidar/${name}`, { headers: this.link.authorization(), cache: "no-store" });
    if (!reply.ok) throw new Error((await reply.json()).error);
    this.show(name, new Float32Array(await reply.arrayBuffer()));
  }

  // Points stay where they were seen until the next come.
  show(name, xyz) {
    if (!this.on[name] || this.paused) return; // meanwhile
    const cloud = this.clouds[name];
    const body = this.view.bodies[this.bodies[name]];
    body.updateMatrixWorld();
    cloud.matrix.copy(body.matrixWorld);
    const m = cloud.matrix.elements; // column by column
    const heights = new Float32Array(xyz.length / 3)
      .map((_, i) => m[2] * xyz[3 * i] + m[6] * xyz[3 * i + 1] + m[10] * xyz[3 * i + 2] + m[14]);
    cloud.geometry.dispose();
    cloud.geometry = new THREE.BufferGeometry();
    cloud.geometry.setAttribute("position", new THREE.BufferAttribute(xyz, 3));
    cloud.geometry.setAttribute("color", new THREE.BufferAttribute(coloursOf(heights), 3));
    cloud.matrixWorldNeedsUpdate = true;
    cloud.visible = heights.length > 0;
    this.view.invalidate();
  }
}
