// Draws the room if the program knows the camera's pose in it: gravity points down, a grid lies on the floor, and a
// small pyramid shows the position and the field of view of the sensor.
import * as THREE from "/three/build/three.module.js";

const kFloor = 4, kCell = 0.1;  // size of the floor's grid and of its cells [m]
const kSensor = 0.06;           // length of the sensor's pyramid [m]
const kLineColours = {light: [0x8b97a1, 0xc4ccd3], dark: [0x56626c, 0x2b333a]};  // middle lines, other lines

// Rotation from the world frame, where up is z, to the frame of three.js, where up is y.
const kThreeFromWorld = new THREE.Matrix4().set(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);
// Rotation from a camera of three.js, which looks along -z with y up, to the sensor's frame (z forward, y down).
const kSensorFromCamera = new THREE.Matrix4().makeScale(1, -1, -1);

// The pose of the camera frame in the scene. `numbers`: T_world_camera, row-major; null: unknown.
export function placeOf(numbers) {
  return numbers ? kThreeFromWorld.clone().multiply(new THREE.Matrix4().set(...numbers)) : kSensorFromCamera.clone();
}

export class Room {
  constructor(scene) {
    this.scene = scene;
    this.floor = null;
    this.sensor = null;
    this.wanted = true;
  }

  // `place`: pose of the camera frame in the scene; `known`: whether it is known; `header`: header of a frame, which
  // gives the sensor's field of view.
  set(place, known, header) {
    this.known = known;
    if (this.sensor) this.scene.remove(this.sensor);
    this.sensor = null;
    if (known && header && header.fx > 0) this.scene.add(this.sensor = this.outline(place, header));
    this.apply();
  }

  // A pyramid from the sensor to the corners of its image. `h`: header of a frame.
  outline(place, h) {
    const corner = (u, v) => new THREE.Vector3((u - h.cx) / h.fx, (v - h.cy) / h.fy, 1).multiplyScalar(kSensor);
    const corners = [corner(0, 0), corner(h.width, 0), corner(h.width, h.height), corner(0, h.height)];
    const eye = new THREE.Vector3(), lines = [];
    corners.forEach((c, i) => lines.push(eye, c, c, corners[(i + 1) % 4]));
    const made = new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints(lines),
                                        new THREE.LineBasicMaterial({color: 0x0f9488}));
    made.matrixAutoUpdate = false;
    made.matrix.copy(place);
    return made;
  }

  setTheme(theme) {
    if (this.floor) this.scene.remove(this.floor);
    this.floor = new THREE.GridHelper(kFloor, Math.round(kFloor / kCell), ...kLineColours[theme]);
    this.scene.add(this.floor);
    this.apply();
  }

  show(wanted) {
    this.wanted = wanted;
    this.apply();
  }

  apply() {
    for (const part of [this.floor, this.sensor]) if (part) part.visible = this.wanted && this.known === true;
  }
}
