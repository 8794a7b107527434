// The room in which the camera stands, where the program knows it: gravity points down, a grid lies on the floor, and a
// small frame shows where the sensor is and what it looks at.
import * as THREE from "/three/build/three.module.js";

const kFloor = 4, kCell = 0.1;  // m
const kSensor = 0.06;           // m, length of the sensor's frame
const kLineColours = {light: [0x8b97a1, 0xc4ccd3], dark: [0x56626c, 0x2b333a]};  // middle lines, others

// The world's z is up, three.js's y.
const kThreeFromWorld = new THREE.Matrix4().set(1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1);
// three.js's cameras look along -z with y up, the sensor along z with y down.
const kSensorFromCamera = new THREE.Matrix4().makeScale(1, -1, -1);

// Where the camera frame lies in the scene. `numbers`: T_world_camera, row by row; null: the room is not known.
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

  // `header`: of a frame, for the sensor's field of view.
  set(place, known, header) {
    this.known = known;
    if (this.sensor) this.scene.remove(this.sensor);
    this.sensor = null;
    if (known && header && header.fx > 0) this.scene.add(this.sensor = this.outline(place, header));
    this.apply();
  }

  // A pyramid from the sensor to the corners of its picture.
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
