// Draws the uncertainty of the proximal end of every segment as an ellipsoid of two standard deviations.
import * as THREE from "/three/build/three.module.js";

const kSigmas = 2;

// The Cholesky factor L (L L^T = C) of the upper left 3x3 block C of a 6x6 covariance; L maps the unit ball to the
// ellipsoid of one standard deviation.
function cholesky(c) {
  const at = (i, j) => c[6 * i + j];
  const root = (x) => Math.sqrt(Math.max(x, 1e-12));
  const a = root(at(0, 0)), b = at(1, 0) / a, d = at(2, 0) / a;
  const e = root(at(1, 1) - b * b), f = (at(2, 1) - d * b) / e;
  return [a, b, e, d, f, root(at(2, 2) - d * d - f * f)];
}

export class Ellipsoids {
  constructor(root) {
    const ball = new THREE.SphereBufferGeometry(1, 14, 10);
    this.material = new THREE.MeshBasicMaterial({color: 0x7c3aed, transparent: true, opacity: 0.4, depthTest: false});
    this.balls = Array.from({length: 16}, () => {
      const mesh = new THREE.Mesh(ball, this.material);
      mesh.matrixAutoUpdate = false;
      mesh.visible = mesh.frustumCulled = false;
      mesh.renderOrder = 2;
      root.add(mesh);
      return mesh;
    });
  }

  // Shows the ellipsoids of `segments`; null hides all.
  set(segments, smoothed) {
    this.balls.forEach((ball, s) => {
      ball.visible = segments !== null;
      if (!segments) return;
      const [a, b, e, d, f, g] = cholesky(segments[s].covariance).map((x) => kSigmas * x);
      const p = smoothed ? segments[s].smoothed_position : segments[s].position;
      ball.matrix.set(a, 0, 0, p[0], b, e, 0, p[1], d, f, g, p[2], 0, 0, 0, 1);
    });
  }
}
