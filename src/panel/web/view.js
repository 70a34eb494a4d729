// The robot and its scene in 3-D, as the newest snapshot has them.
import * as THREE from "./vendor/three/build/three.module.js";
import { OrbitControls } from "./vendor/three/examples/jsm/controls/OrbitControls.js";
import { Arrows } from "./arrows.js";
import { GeomFactory } from "./geoms.js";
import { drawnInSoftware, Quality, WITHOUT_SHADOWS } from "./quality.js";
import { Stage } from "./stage.js";
import { Trail } from "./trail.js";

const FIRST_COLLISION_GROUP = 3; // as in MuJoCo's viewer: groups 0 to 2 are what one sees
// m from what is looked at, for a robot 1 m tall: from ahead, and from behind where uneven ground lies ahead.
const AHEAD = [1.5, -1.7, 0.75];
const BEHIND = [-1.7, -1.5, 0.9];
// Where one may look from, in the base's heading: x ahead, y to its left.
const PLACES = {
  front: [2.3, 0, 0.3], back: [-2.3, 0, 0.3], left: [0, 2.3, 0.3], right: [0, -2.3, 0.3],
  top: [-0.01, 0, 2.6],
};

export class View {
  constructor(canvas) {
    this.canvas = canvas;
    const software = drawnInSoftware();
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !software });
    this.renderer.gammaOutput = true;
    this.renderer.gammaFactor = 2.2;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.02, 80);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false; // keys are the remote controller's
    this.controls.maxPolarAngle = Math.PI / 2 - 0.02;
    this.controls.minDistance = 0.2;
    this.controls.maxDistance = 20;
    this.controls.addEventListener("change", () => this.invalidate());
    this.following = true;
    this.bodies = [];
    this.base = 0;
    this.snapshot = null;
    this.dirty = true;
    this.drawn = 0; // pictures since the start
    this.stage = new Stage(this.scene, this.renderer);
    this.quality = new Quality(this.renderer, this.stage.sun, software ? WITHOUT_SHADOWS : 0);
    this.addOverlays();
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.resize();
    const draw = (now) => {
      requestAnimationFrame(draw); // the browser stops this while the page is hidden
      this.draw(now);
    };
    requestAnimationFrame(draw);
  }

  addOverlays() {
    this.contacts = new Arrows(this.scene, "#e8590c", 64, 0.003);
    this.pushes = new Arrows(this.scene, "#1c7ed6", 16, 0.003);
    const ball = new THREE.SphereBufferGeometry(0.022, 16, 12);
    this.com = new THREE.Mesh(ball, new THREE.MeshBasicMaterial(
      { color: "#7048e8", depthTest: false, transparent: true, opacity: 0.85 }));
    this.com.visible = false;
    const line = new THREE.BufferGeometry();
    line.setAttribute("position", new THREE.BufferAttribute(new Float32Array(6), 3));
    this.tether = new THREE.Line(line, new THREE.LineBasicMaterial({ color: "#868e96" }));
    this.tether.frustumCulled = false;
    this.tether.visible = false;
    this.scene.add(this.com, this.tether);
    this.trail = new Trail(this.scene, "#0b8f6a");
  }

  // Builds what GET /scene describes; `load` brings meshes and height fields.
  // Resolves whether there is nothing of the robot but what collides, which is shown then.
  async setScene(description, load) {
    for (const body of this.bodies) this.scene.remove(body);
    for (const { mesh } of this.stage.floors.splice(0)) this.scene.remove(mesh);
    this.base = description.base;
    this.bodies = description.bodies.map((body, id) => {
      const group = new THREE.Group();
      group.userData = { name: body.name, id };
      group.visible = id === 0; // until a snapshot says where it is
      this.scene.add(group);
      return group;
    });
    // The base and what hangs on it; a body's parent comes before it.
    this.ofRobot = [];
    description.bodies.forEach(({ parent }, id) => {
      this.ofRobot.push(id === this.base || (id > 0 && this.ofRobot[parent]));
    });
    const factory = new GeomFactory(description, load);
    await Promise.all(description.geoms.map(async (geom) => {
      if (geom.type === "plane") return this.stage.addFloor(geom);
      const mesh = await factory.make(geom, this.ofRobot[geom.body]);
      if (!mesh) return;
      mesh.userData.collision = geom.group >= FIRST_COLLISION_GROUP;
      mesh.visible = this.ofRobot[geom.body] || !mesh.userData.collision;
      this.bodies[geom.body].add(mesh);
    }));
    const bare = this.robotBodies().every(
      ({ children }) => children.every((mesh) => mesh.userData.collision));
    this.showCollisions(bare);
    this.uneven = description.geoms.some(({ body, type }) => !this.ofRobot[body] && type !== "plane");
    return bare;
  }

  robotBodies() {
    return this.bodies.filter((_, id) => this.ofRobot[id]);
  }

  showCollisions(on) {
    for (const body of this.robotBodies()) {
      for (const mesh of body.children) mesh.visible = mesh.userData.collision === on;
    }
    this.invalidate();
  }

  show(snapshot) {
    this.snapshot = snapshot;
    this.invalidate();
  }

  invalidate() {
    this.dirty = true;
  }

  setTheme(dark) {
    this.stage.setTheme(dark);
    this.invalidate();
  }

  // Looks at the base from its right, from as far as the robot is tall, and on uneven ground.
  home() {
    this.look(this.uneven ? BEHIND : AHEAD);
  }

  // Looks at the base from one of PLACES, whichever way it faces.
  lookFrom(place) {
    if (!this.snapshot || !PLACES[place]) return;
    const [, , , w, x, y, z] = this.snapshot.bodies[this.base];
    const yaw = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
    const [ahead, left, up] = PLACES[place];
    this.look([ahead * Math.cos(yaw) - left * Math.sin(yaw), ahead * Math.sin(yaw) + left * Math.cos(yaw), up]);
  }

  look(from) {
    if (!this.snapshot) return;
    const base = this.snapshot.bodies[this.base];
    const size = Math.max(0.7, this.robotHeight()) / (1 - this.covered());
    this.controls.target.set(base[0], base[1], base[2] - 0.08 * size);
    this.camera.position.fromArray(from).multiplyScalar(size).add(this.controls.target);
    this.controls.update();
    this.invalidate();
  }

  // The share of the view's height on which something lies, above and below the robot.
  covered() {
    const over = [...this.canvas.parentElement.querySelectorAll(".tools, .overlay")];
    const height = over.reduce((sum, one) => sum + one.offsetHeight, 0);
    return Math.min(0.5, height / Math.max(1, this.canvas.clientHeight));
  }

  robotHeight() {
    let low = Infinity;
    let high = -Infinity;
    this.snapshot.bodies.forEach((pose, id) => {
      if (!this.ofRobot[id]) return;
      low = Math.min(low, pose[2]);
      high = Math.max(high, pose[2]);
    });
    return high - low;
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / Math.max(clientHeight, 1);
    this.camera.updateProjectionMatrix();
    this.invalidate();
  }

  draw(now) {
    if (!this.dirty) return this.quality.rest();
    this.dirty = false;
    if (this.snapshot) this.place(this.snapshot);
    this.renderer.render(this.scene, this.camera);
    ++this.drawn;
    if (this.quality.drew(now)) this.invalidate();
  }

  place(snapshot) {
    const first = this.placed === undefined;
    snapshot.bodies.forEach(([x, y, z, qw, qx, qy, qz], id) => {
      const group = this.bodies[id];
      if (!group) return;
      group.position.set(x, y, z);
      group.quaternion.set(qx, qy, qz, qw);
      group.visible = true;
    });
    const base = snapshot.bodies[this.base];
    if (this.following && !first) {
      const moved = new THREE.Vector3().fromArray(base).sub(this.placed);
      this.controls.target.add(moved);
      this.camera.position.add(moved);
    }
    this.placed = (this.placed ?? new THREE.Vector3()).fromArray(base);
    if (first) this.home();
    this.trail.push(snapshot.time, base);
    this.stage.follow(base);
    this.contacts.show(snapshot.contacts);
    this.pushes.show(snapshot.pushes);
    this.com.position.fromArray(snapshot.com);
    this.placeTether(snapshot.crane);
  }

  placeTether({ attached, hook, top }) {
    this.tether.visible = attached;
    if (!attached) return;
    const position = this.tether.geometry.attributes.position;
    position.setXYZ(0, ...hook);
    position.setXYZ(1, ...top);
    position.needsUpdate = true;
  }

  // What of the robot is under a place of the canvas [px]: {body, point, local} or null.
  pick(x, y) {
    const ray = this.ray(x, y);
    const visible = [];
    for (const body of this.robotBodies()) {
      for (const mesh of body.children) if (mesh.visible) visible.push(mesh);
    }
    const [hit] = ray.intersectObjects(visible);
    if (!hit) return null;
    const body = hit.object.parent;
    const local = body.worldToLocal(hit.point.clone());
    return { body: body.userData.name, point: hit.point, local };
  }

  ray(x, y) {
    const at = new THREE.Vector2(
      (2 * x) / this.canvas.clientWidth - 1, 1 - (2 * y) / this.canvas.clientHeight);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, this.camera);
    return ray;
  }

  // Where a place of the canvas meets the plane through `point` that faces the camera.
  onPlane(x, y, point) {
    const normal = this.camera.getWorldDirection(new THREE.Vector3());
    const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, point);
    return this.ray(x, y).ray.intersectPlane(plane, new THREE.Vector3());
  }
}
