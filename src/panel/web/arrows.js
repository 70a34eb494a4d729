// Many arrows in two draw calls: forces, in the world's frame.
import * as THREE from "./vendor/three/build/three.module.js";

const UP = new THREE.Vector3(0, 1, 0);

export class Arrows {
  // `metres_per_newton`: how long an arrow is; no arrow is longer than 1 m.
  constructor(parent, color, capacity, metres_per_newton) {
    this.capacity = capacity;
    this.scale = metres_per_newton;
    const material = new THREE.MeshBasicMaterial(
      { color: new THREE.Color(color).convertSRGBToLinear() });
    const shaft = new THREE.CylinderBufferGeometry(0.005, 0.005, 1, 8).translate(0, 0.5, 0);
    const head = new THREE.ConeBufferGeometry(0.014, 0.04, 12).translate(0, 0.02, 0);
    this.shafts = new THREE.InstancedMesh(shaft, material, capacity);
    this.heads = new THREE.InstancedMesh(head, material, capacity);
    for (const mesh of [this.shafts, this.heads]) {
      mesh.frustumCulled = false;
      mesh.count = 0;
      parent.add(mesh);
    }
    this.pose = new THREE.Object3D();
    this.along = new THREE.Vector3();
  }

  set visible(on) {
    this.shafts.visible = this.heads.visible = on;
  }

  // Shows these alone: [{at: [x, y, z], force: [x, y, z]}, ...].
  show(forces) {
    let count = 0;
    for (const { at, force } of forces) {
      if (count === this.capacity) break;
      this.along.fromArray(force);
      const length = Math.min(this.along.length() * this.scale, 1);
      if (!(length > 0.01)) continue; // a NaN too
      this.place(count++, at, length);
    }
    for (const mesh of [this.shafts, this.heads]) {
      mesh.count = count;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  place(index, at, length) {
    const { pose, along } = this;
    pose.position.fromArray(at);
    pose.quaternion.setFromUnitVectors(UP, along.normalize());
    pose.scale.set(1, length, 1);
    pose.updateMatrix();
    this.shafts.setMatrixAt(index, pose.matrix);
    pose.position.addScaledVector(along, length);
    pose.scale.setScalar(1);
    pose.updateMatrix();
    this.heads.setMatrixAt(index, pose.matrix);
  }
}
