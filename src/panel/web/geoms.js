// MuJoCo's geoms as three.js geometries, each in the geom's own frame: z up, sizes are halves.
import * as THREE from "./vendor/three/build/three.module.js";

const ROUND = 24; // segments of a full turn
const LOWEST_TINT = 0.5; // of a height field's colour, at its lowest; 1.5 at its highest; *assumed*
const GRID = 0.5; // m between lines on a height field, as the tiles of a floor
const LINE_TINT = 0.72; // of a line, as a share of the tint beside it; *assumed*
const HALF_PI = Math.PI / 2;

function capsule(radius, half) {
  const points = [];
  const cap = ROUND / 4;
  for (let i = 0; i <= cap; ++i) {
    const angle = -HALF_PI + (HALF_PI * i) / cap;
    points.push(new THREE.Vector2(radius * Math.cos(angle), radius * Math.sin(angle) - half));
  }
  for (let i = 0; i <= cap; ++i) {
    const angle = (HALF_PI * i) / cap;
    points.push(new THREE.Vector2(radius * Math.cos(angle), radius * Math.sin(angle) + half));
  }
  return new THREE.LatheBufferGeometry(points, ROUND).rotateX(HALF_PI);
}

function primitive(type, [a, b, c]) {
  switch (type) {
    case "sphere":
      return new THREE.SphereBufferGeometry(a, ROUND, ROUND / 2);
    case "ellipsoid":
      return new THREE.SphereBufferGeometry(1, ROUND, ROUND / 2).scale(a, b, c);
    case "capsule":
      return capsule(a, b);
    case "cylinder":
      return new THREE.CylinderBufferGeometry(a, a, 2 * b, ROUND).rotateX(HALF_PI);
    case "box":
      return new THREE.BoxBufferGeometry(2 * a, 2 * b, 2 * c);
    default:
      return null;
  }
}

// What GET /scene/mesh/N sends: two u32 counts, vertices, faces; then float32 x y z of each vertex
// and u32 corners of each face.
export function meshGeometry(buffer) {
  const [vertices, faces] = new Uint32Array(buffer, 0, 2);
  const corners = new Uint32Array(buffer, 8 + 12 * vertices, 3 * faces);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute(
    "position", new THREE.BufferAttribute(new Float32Array(buffer, 8, 3 * vertices), 3));
  geometry.setIndex(new THREE.BufferAttribute(corners, 1));
  geometry.computeVertexNormals();
  return geometry;
}

// What GET /scene/hfield/N sends: two u32 counts, rows, columns; then float32 heights, 0 to 1, row
// by row. `size` is MuJoCo's: half x, half y, full height [m].
export function heightFieldGeometry(buffer, size) {
  const [rows, columns] = new Uint32Array(buffer, 0, 2);
  const heights = new Float32Array(buffer, 8, rows * columns);
  const geometry = new THREE.PlaneBufferGeometry(2 * size[0], 2 * size[1], columns - 1, rows - 1);
  const position = geometry.attributes.position;
  const tint = new Float32Array(3 * rows * columns); // high is light: else relief is hardly seen
  // Lines that bend with the ground, of its vertices; none where these are too far apart.
  const lines = (count, side) => {
    const cell = (2 * side) / (count - 1);
    const on = new Uint8Array(count);
    for (let at = 0; at <= 2 * side + cell / 2; at += GRID) on[Math.round(at / cell)] = 1;
    return cell < GRID / 3 ? on : new Uint8Array(count);
  };
  const [across, along] = [lines(columns, size[0]), lines(rows, size[1])];
  for (let row = 0; row < rows; ++row) {
    for (let column = 0; column < columns; ++column) {
      // MuJoCo's first row is the one of least y, three.js's that of most.
      const vertex = (rows - 1 - row) * columns + column;
      const height = heights[row * columns + column];
      position.setZ(vertex, height * size[2]);
      const line = across[column] || along[row] ? LINE_TINT : 1;
      tint.fill((LOWEST_TINT + height) * line, 3 * vertex, 3 * vertex + 3);
    }
  }
  geometry.setAttribute("color", new THREE.BufferAttribute(tint, 3));
  geometry.computeVertexNormals();
  return geometry;
}

// Makes the meshes of a scene. Geometries and materials that are equal are shared.
export class GeomFactory {
  constructor(scene, load) {
    this.scene = scene;
    this.load = load; // path -> Promise<ArrayBuffer>
    this.geometries = new Map();
    this.materials = new Map();
  }

  // Promise of a THREE.Mesh, placed in its body's frame; null for a plane, which is the floor's.
  // `shiny`: a robot is, the ground is not.
  async make(geom, shiny) {
    const geometry = await this.geometry(geom);
    if (!geometry) return null;
    const mesh = new THREE.Mesh(geometry, this.material(geom, shiny));
    mesh.position.fromArray(geom.pos);
    const [w, x, y, z] = geom.quat;
    mesh.quaternion.set(x, y, z, w);
    mesh.castShadow = mesh.receiveShadow = true;
    return mesh;
  }

  geometry(geom) {
    const key = `${geom.type} ${geom.mesh} ${geom.hfield} ${geom.size}`;
    if (!this.geometries.has(key)) this.geometries.set(key, this.newGeometry(geom));
    return this.geometries.get(key);
  }

  async newGeometry(geom) {
    if (geom.type === "mesh") return meshGeometry(await this.load(`/scene/mesh/${geom.mesh}`));
    if (geom.type === "hfield") {
      const field = this.scene.hfields[geom.hfield];
      return heightFieldGeometry(await this.load(`/scene/hfield/${geom.hfield}`), field.size);
    }
    return primitive(geom.type, geom.size);
  }

  material(geom, shiny) {
    const flat = geom.type === "mesh" || geom.type === "hfield";
    const tinted = geom.type === "hfield";
    const key = `${geom.rgba} ${flat} ${shiny} ${tinted}`;
    if (!this.materials.has(key)) {
      const [r, g, b, alpha] = geom.rgba;
      const looks = {
        // A scene's colours are meant to be taken times a texture's, which are not known here.
        color: new THREE.Color(r, g, b).convertSRGBToLinear().multiplyScalar(shiny ? 1 : 0.45),
        flatShading: flat,
        vertexColors: tinted ? THREE.VertexColors : THREE.NoColors,
        transparent: alpha < 1,
        opacity: alpha,
      };
      this.materials.set(key, shiny
        ? new THREE.MeshStandardMaterial({ ...looks, roughness: 0.55, metalness: 0.05 })
        : new THREE.MeshPhongMaterial({ ...looks, specular: 0 }));
    }
    return this.materials.get(key);
  }
}
