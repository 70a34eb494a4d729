// The way that a point has gone, as a line.
import * as THREE from "./vendor/three/build/three.module.js";

const MOST = 2000; // points
const STEP = 0.01; // m between two of them; *assumed*
const KEPT = 60; // s of simulated time

export class Trail {
  constructor(scene, colour) {
    this.points = []; // [time, x, y, z]
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(3 * MOST), 3));
    geometry.setDrawRange(0, 0);
    this.line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ color: colour, depthTest: false }));
    this.line.frustumCulled = false;
    this.line.renderOrder = 1;
    this.visible = false;
    scene.add(this.line);
  }

  set visible(on) {
    this.line.visible = on;
  }

  get visible() {
    return this.line.visible;
  }

  // Goes on to there, also while it is not seen. A time before the last begins anew.
  push(time, [x, y, z]) {
    const { points } = this;
    const last = points[points.length - 1];
    if (last && time < last[0]) points.length = 0;
    else if (last && Math.hypot(x - last[1], y - last[2], z - last[3]) < STEP) return;
    points.push([time, x, y, z]);
    const old = points.findIndex(([at]) => at >= time - KEPT);
    points.splice(0, Math.max(old, points.length - MOST));
    const { position } = this.line.geometry.attributes;
    points.forEach(([, ...at], i) => position.setXYZ(i, ...at));
    position.needsUpdate = true;
    this.line.geometry.setDrawRange(0, points.length);
  }
}
