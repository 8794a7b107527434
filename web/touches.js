// Draws a ball wherever a hand touches something: orange on objects, blue on the other hand or another segment;
// translucent where the touch is inferred, not seen.
import * as THREE from "/three/build/three.module.js";
import {kTouching} from "./lcm.js";

const kRadius = 0.005;  // of a ball [m]
const kObject = 0xf97316, kHand = 0x3b82f6;
const kMost = 3 * 16 * 2;  // contacts of two hands

export class Touches {
  constructor(root) {
    const ball = new THREE.SphereBufferGeometry(kRadius, 14, 10);
    const material = (color, opacity) => new THREE.MeshBasicMaterial({color, opacity, transparent: true, depthTest: false});
    this.materials = {object: [material(kObject, 0.95), material(kObject, 0.4)], hand: [material(kHand, 0.95), material(kHand, 0.4)]};
    this.balls = Array.from({length: kMost}, () => {
      const mesh = new THREE.Mesh(ball, this.materials.object[0]);
      mesh.visible = false;
      mesh.renderOrder = 3;
      root.add(mesh);
      return mesh;
    });
  }

  // `contacts`: decoded contact_state_t of all hands.
  set(contacts) {
    let used = 0;
    const add = (contact, kind) => {
      if (contact.state !== kTouching || !contact.point.every(Number.isFinite)) return;
      const ball = this.balls[used++];
      ball.material = this.materials[kind][contact.inferred ? 1 : 0];
      ball.position.set(...contact.point);
      ball.visible = true;
    };
    for (const hand of contacts.slice(0, 2)) {
      hand.object.forEach((contact) => add(contact, "object"));
      [...hand.own, ...hand.other_hand].forEach((contact) => add(contact, "hand"));
    }
    for (; used < kMost; ++used) this.balls[used].visible = false;
  }
}
