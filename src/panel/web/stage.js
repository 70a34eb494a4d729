// What stands around a robot: ground, light, haze, in the colours of the page.
import * as THREE from "./vendor/three/build/three.module.js";

const COLOURS = {
  light: { sky: "#e9edf0", floor: "#dfe4e8", tile: "#dae0e4", line: "#c3cbd2",
           shadow: 0.2, fill: 0.85, rim: 0.25 },
  dark: { sky: "#12161a", floor: "#1d2227", tile: "#1a1f24", line: "#30383f",
          shadow: 0.5, fill: 1.1, rim: 0.7 },
};
const TILES = 4; // a side of the picture of the ground; one tile is half a metre

function groundPicture({ floor, tile, line }) {
  const side = 512;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = side;
  const context = canvas.getContext("2d");
  const step = side / TILES;
  for (let i = 0; i < TILES; ++i) {
    for (let j = 0; j < TILES; ++j) {
      context.fillStyle = (i + j) % 2 ? floor : tile;
      context.fillRect(i * step, j * step, step, step);
    }
  }
  context.strokeStyle = line;
  context.lineWidth = 2;
  context.strokeRect(0, 0, side / 2, side / 2);
  context.strokeRect(side / 2, side / 2, side / 2, side / 2);
  return canvas;
}

export class Stage {
  constructor(scene, renderer) {
    this.scene = scene;
    this.fill = new THREE.HemisphereLight("#ffffff", "#767b82", 0.8);
    this.sun = new THREE.DirectionalLight("#ffffff", 0.7);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.bias = -0.0004;
    this.sun.shadow.radius = 3;
    const reach = 1.6;
    Object.assign(this.sun.shadow.camera,
      { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.5, far: 9 });
    this.rim = new THREE.DirectionalLight("#cfe0ff", 0.25);
    scene.add(this.fill, this.sun, this.sun.target, this.rim, this.rim.target);

    this.picture = new THREE.CanvasTexture(document.createElement("canvas"));
    this.picture.wrapS = this.picture.wrapT = THREE.RepeatWrapping;
    this.picture.anisotropy = renderer.capabilities.getMaxAnisotropy();
    this.picture.encoding = THREE.sRGBEncoding;
    // The ground has the page's own colours in any light; shadows lie on a second sheet.
    this.floorMaterial = new THREE.MeshBasicMaterial({ map: this.picture });
    this.shadowMaterial = new THREE.ShadowMaterial();
    this.floors = [];
  }

  // A plane of MuJoCo's: `size` 0 0 is endless, which is 60 m here, and then haze.
  addFloor(geom) {
    const width = geom.size[0] > 0 ? 2 * geom.size[0] : 60;
    const depth = geom.size[1] > 0 ? 2 * geom.size[1] : 60;
    const geometry = new THREE.PlaneBufferGeometry(width, depth);
    const metres = TILES / 2;
    const uv = geometry.attributes.uv;
    for (let i = 0; i < uv.count; ++i) {
      uv.setXY(i, (uv.getX(i) - 0.5) * (width / metres), (uv.getY(i) - 0.5) * (depth / metres));
    }
    const floor = new THREE.Mesh(geometry, this.floorMaterial);
    floor.position.fromArray(geom.pos);
    const [w, x, y, z] = geom.quat;
    floor.quaternion.set(x, y, z, w);
    const shadow = new THREE.Mesh(geometry, this.shadowMaterial);
    shadow.position.z = 0.001;
    shadow.receiveShadow = true;
    floor.add(shadow);
    this.floors.push({ mesh: floor, endless: geom.size[0] === 0 && geom.size[1] === 0, geom });
    this.scene.add(floor);
    return floor;
  }

  setTheme(dark) {
    const colours = COLOURS[dark ? "dark" : "light"];
    // Sky and haze come after the conversion from light to the screen's colours.
    this.scene.background = new THREE.Color(colours.sky);
    this.scene.fog = new THREE.Fog(colours.sky, 5, 24);
    this.fill.intensity = colours.fill;
    this.shadowMaterial.opacity = colours.shadow;
    this.rim.intensity = colours.rim;
    this.picture.image = groundPicture(colours);
    this.picture.needsUpdate = true;
  }

  // Keeps light, shadow and endless ground where the robot is.
  follow([x, y, z]) {
    this.sun.target.position.set(x, y, z);
    this.sun.position.set(x + 1.6, y - 1.4, z + 4.2);
    this.rim.target.position.set(x, y, z);
    this.rim.position.set(x - 3, y + 2, z + 2);
    const whole = (value) => Math.round(value / (TILES / 2)) * (TILES / 2); // of the picture
    for (const { mesh, endless, geom } of this.floors) {
      if (!endless || geom.quat[0] < 0.9999) continue;
      mesh.position.set(whole(x), whole(y), geom.pos[2]);
    }
  }
}
