// Draws the skin of one hand. The vertex shader poses it by the hand's 16 segments (linear blend of two neighbours). It
// is coloured by confidence, and hatched where a segment is inferred.
import * as THREE from "/three/build/three.module.js";

const kVertex = `
  uniform mat4 bones[16];
  uniform vec2 states[16];  // for each segment, its confidence, and 1 if it is seen, otherwise 0
  attribute vec3 inB, normalInA;
  attribute vec3 binding;  // the vertex's segments a and b, and the skinning weight of b
  varying vec3 vNormal;
  varying vec2 vState;
  const float kLift = 0.008;  // distance by which the skin is moved towards the eye [m]
  void main() {
    int a = int(binding.x + 0.5), b = int(binding.y + 0.5);
    vec4 posed = mix(bones[a] * vec4(position, 1.0), bones[b] * vec4(inB, 1.0), binding.z);
    vNormal = normalMatrix * mat3(bones[a]) * normalInA;
    vState = mix(states[a], states[b], binding.z);
    // Move the skin slightly towards the eye, so that the points measured on it do not hide it.
    vec4 seen = modelViewMatrix * posed;
    seen.xyz *= 1.0 - kLift / length(seen.xyz);
    gl_Position = projectionMatrix * seen;
  }`;

const kFragment = `
  uniform float opacity, hatch;
  uniform vec3 ground;
  varying vec3 vNormal;
  varying vec2 vState;
  const vec3 kLow = vec3(0.851, 0.282, 0.059), kMiddle = vec3(0.949, 0.714, 0.196), kHigh = vec3(0.114, 0.604, 0.561);
  void main() {
    float c = clamp(vState.x, 0.0, 1.0);
    vec3 colour = c < 0.5 ? mix(kLow, kMiddle, 2.0 * c) : mix(kMiddle, kHigh, 2.0 * c - 1.0);
    vec3 n = normalize(gl_FrontFacing ? vNormal : -vNormal);
    float light = 0.42 + 0.48 * max(dot(n, vec3(0.35, 0.6, 0.72)), 0.0) + 0.18 * max(n.z, 0.0);
    vec3 lit = colour * light;
    bool stripe = mod(gl_FragCoord.x + gl_FragCoord.y, hatch) < 0.45 * hatch;
    if (vState.y < 0.5 && stripe) lit = mix(lit, ground, 0.65);
    gl_FragColor = vec4(lit, opacity);
  }`;

export class HandMesh {
  constructor(root) {
    this.root = root;
    this.mesh = null;
    this.uniforms = {
      bones: {value: Array.from({length: 16}, () => new THREE.Matrix4())},
      states: {value: Array.from({length: 16}, () => new THREE.Vector2())},
      opacity: {value: 1}, hatch: {value: 8}, ground: {value: new THREE.Color(1, 1, 1)},
    };
    this.material = new THREE.ShaderMaterial({uniforms: this.uniforms, vertexShader: kVertex, fragmentShader: kFragment,
                                              side: THREE.DoubleSide, transparent: true});
  }

  setSkin(skin) {
    const binding = new Float32Array(3 * skin.a.length);
    skin.a.forEach((a, i) => binding.set([a, skin.b[i], skin.weight[i]], 3 * i));
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(skin.inA, 3));
    geometry.setAttribute("inB", new THREE.BufferAttribute(skin.inB, 3));
    geometry.setAttribute("normalInA", new THREE.BufferAttribute(skin.normal, 3));
    geometry.setAttribute("binding", new THREE.BufferAttribute(binding, 3));
    geometry.setIndex(new THREE.BufferAttribute(skin.triangles, 1));
    if (this.mesh) {
      this.mesh.geometry.dispose();
      this.mesh.geometry = geometry;
    } else {
      this.mesh = new THREE.Mesh(geometry, this.material);
      this.mesh.frustumCulled = false;  // three.js would cull by the bounds of the unposed vertices
      this.mesh.visible = false;
      this.root.add(this.mesh);
    }
  }

  // `poses`: Matrix4 of every segment; null hides the hand. `shares`: a value in [0, 1] for each segment,
  // shown as its colour in place of its confidence; null: show the confidence.
  setPose(poses, segments, shares) {
    if (!this.mesh) return;
    this.mesh.visible = poses !== null;
    if (!poses) return;
    poses.forEach((pose, s) => {
      this.uniforms.bones.value[s].copy(pose);
      this.uniforms.states.value[s].set(shares ? shares[s] : segments[s].confidence, segments[s].seen ? 1 : 0);
    });
  }

  setLook(opacity, ground, pixelRatio) {
    this.uniforms.opacity.value = opacity;
    this.uniforms.ground.value.copy(ground);
    this.uniforms.hatch.value = 9 * pixelRatio;
    this.material.depthWrite = true;
  }
}
