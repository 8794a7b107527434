// Draws the depth image as points. Each point has the size of the cell of the image that it represents.
import * as THREE from "/three/build/three.module.js";

const kVertex = `
  attribute vec3 tint;
  uniform float scale;  // size of a cell on the screen if the eye is as far from it as the sensor [px]
  varying vec3 vTint;
  void main() {
    vTint = tint;
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    gl_PointSize = clamp(scale * position.z / max(-seen.z, 0.01), 1.0, 24.0);
    gl_Position = projectionMatrix * seen;
  }`;
const kFragment = `varying vec3 vTint; void main() { gl_FragColor = vec4(vTint, 1.0); }`;

// Colour of a point by its depth, from near (warm) to far (cool), for frames without colour.
function depthTint(z, out, at) {
  const far = Math.min(Math.max((z - 0.3) / 0.9, 0), 1);
  out[at] = 0.85 - 0.55 * far;
  out[at + 1] = 0.62 - 0.1 * far;
  out[at + 2] = 0.45 + 0.3 * far;
}

export class Cloud {
  constructor(root) {
    this.geometry = new THREE.BufferGeometry();
    this.material = new THREE.ShaderMaterial({vertexShader: kVertex, fragmentShader: kFragment, uniforms: {scale: {value: 1}}});
    this.points = new THREE.Points(this.geometry, this.material);
    this.points.frustumCulled = false;
    this.points.visible = false;
    this.capacity = 0;
    this.cell = 0;  // angle between neighbouring points, seen from the sensor [rad]
    root.add(this.points);
  }

  reserve(count) {
    if (count <= this.capacity) return;
    this.capacity = count;
    this.position = new THREE.BufferAttribute(new Float32Array(3 * count), 3).setUsage(THREE.DynamicDrawUsage);
    this.tint = new THREE.BufferAttribute(new Float32Array(3 * count), 3).setUsage(THREE.DynamicDrawUsage);
    this.geometry.setAttribute("position", this.position);
    this.geometry.setAttribute("tint", this.tint);
  }

  set(cloud, camera) {
    this.points.visible = cloud !== null && camera.fx > 0;
    if (!this.points.visible) return;
    this.reserve(cloud.depth.length);
    const position = this.position.array, tint = this.tint.array;
    let n = 0;
    for (let j = 0, i = 0; j < cloud.rows; ++j) {
      for (let k = 0; k < cloud.columns; ++k, ++i) {
        if (cloud.depth[i] === 0) continue;
        const z = cloud.depth[i] * cloud.unit;
        position[3 * n] = (cloud.u + k * cloud.step - camera.cx) / camera.fx * z;
        position[3 * n + 1] = (cloud.v + j * cloud.step - camera.cy) / camera.fy * z;
        position[3 * n + 2] = z;
        const c = cloud.colour ? cloud.colour[i] : 0;
        if (c === 0) depthTint(z, tint, 3 * n);
        else tint.set([(c >> 11) / 31, ((c >> 5) & 63) / 63, (c & 31) / 31], 3 * n);
        ++n;
      }
    }
    this.geometry.setDrawRange(0, n);
    this.position.needsUpdate = this.tint.needsUpdate = true;
    this.cell = cloud.step / camera.fx;
  }

  // `pixelsPerRadian`: resolution of the view.
  setScale(pixelsPerRadian) { this.material.uniforms.scale.value = 0.9 * this.cell * pixelsPerRadian; }
}
