// The 3D view. Everything is drawn in the sensor's frame (x right, y down, z forward), which `root` transforms to the
// frame of three.js (y up). If the camera's pose in the room is known, up is opposite to gravity; otherwise up is the
// top of the sensor's image. The view is only drawn when something has changed.
import * as THREE from "/three/build/three.module.js";
import {OrbitControls} from "/three/examples/jsm/controls/OrbitControls.js";
import {Cloud} from "./cloud.js";
import {Ellipsoids} from "./ellipsoids.js";
import {HandMesh} from "./hand_mesh.js";
import {Room, placeOf} from "./room.js";
import {Touches} from "./touches.js";

const kFieldOfView = 45;  // vertical field of view of the free views [degrees]
const kBeside = 0.1, kAbove = 0.12, kBack = 0.38;  // initial offset of the eye from the hand [m]
const kSlowMs = 40;  // if drawing takes longer than this, the resolution is reduced
const kFewestPixels = 0.5;  // smallest number of canvas pixels per CSS pixel in each direction

function poseMatrix(segment, smoothed) {
  const p = smoothed ? segment.smoothed_position : segment.position;
  const [w, x, y, z] = smoothed ? segment.smoothed_orientation : segment.orientation;
  return new THREE.Matrix4().compose(new THREE.Vector3(...p), new THREE.Quaternion(x, y, z, w), new THREE.Vector3(1, 1, 1));
}

// Whether the browser has no GPU to draw with.
function drawsInSoftware() {
  const gl = document.createElement("canvas").getContext("webgl");
  const info = gl && gl.getExtension("WEBGL_debug_renderer_info");
  return info !== null && /swiftshader|llvmpipe|software|basic render/i.test(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
}

export class Scene {
  constructor(canvas) {
    this.canvas = canvas;
    const slow = drawsInSoftware();
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: !slow});
    this.scene = new THREE.Scene();
    this.root = new THREE.Group();
    this.root.matrixAutoUpdate = false;
    this.scene.add(this.root);
    this.room = new Room(this.scene);
    this.hands = [new HandMesh(this.root), new HandMesh(this.root)];
    this.ellipsoids = [new Ellipsoids(this.root), new Ellipsoids(this.root)];
    this.touches = new Touches(this.root);
    this.cloud = new Cloud(this.root);

    this.free = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.02, 20);
    this.sensor = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.02, 20);
    this.controls = new OrbitControls(this.free, canvas);
    this.controls.addEventListener("change", () => this.change());
    this.setRoom(null);

    this.view = "follow";
    this.options = {smoothed: false, ellipsoids: false, touches: true, floor: true, coverage: null, paused: false};
    this.ground = new THREE.Color();
    this.picture = null;  // texture in the background of the view from the sensor
    this.header = null;
    this.anchored = false;
    this.pixelRatio = slow ? 1 : Math.min(window.devicePixelRatio || 1, 2);
    this.interval = 0;
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  change() { this.changed = true; }

  setTheme(ground, theme) {
    this.ground.set(ground);
    this.room.setTheme(theme);
    this.change();
  }

  // `numbers`: T_world_camera, row-major; null: unknown.
  setRoom(numbers) {
    const text = JSON.stringify(numbers);
    if (text === this.roomText) return;
    this.roomText = text;
    this.place = placeOf(numbers);
    this.root.matrix.copy(this.place);
    this.root.updateMatrixWorld(true);
    this.place.clone().multiply(new THREE.Matrix4().makeScale(1, -1, -1))
      .decompose(this.sensor.position, this.sensor.quaternion, this.sensor.scale);
    this.room.set(this.place, numbers !== null, this.header);
    this.moveEye();
    this.anchored = false;
    this.change();
  }

  // Places the eye on the sensor's side of the hand, above it and slightly to the right.
  moveEye() {
    const up = new THREE.Vector3(0, 1, 0);
    const level = (v) => v.applyQuaternion(this.sensor.quaternion).setY(0);
    let back = level(new THREE.Vector3(0, 0, 1));
    if (back.length() < 0.2) back = level(new THREE.Vector3(0, -1, 0));  // for a sensor that looks down or up
    back.normalize();
    this.controls.target.set(0, 0, 0.6).applyMatrix4(this.place);
    this.free.position.copy(this.controls.target).addScaledVector(back, kBack).addScaledVector(up, kAbove)
      .addScaledVector(up.clone().cross(back), kBeside);
    this.controls.update();
  }

  setView(view) {
    this.view = view;
    this.controls.enabled = view !== "camera";
    this.resize();
  }

  resize() {
    const width = this.canvas.clientWidth || 1, height = this.canvas.clientHeight || 1;
    this.renderer.setPixelRatio(this.pixelRatio);
    this.renderer.setSize(width, height, false);
    this.free.aspect = width / height;
    this.free.updateProjectionMatrix();
    this.fitSensor();
    this.change();
  }

  // Sets the projection of the view from the sensor: the sensor's own, with its whole image centred in the view.
  fitSensor() {
    const h = this.header;
    if (!h || !(h.fx > 0)) return;
    const aspect = this.canvas.clientWidth / this.canvas.clientHeight, near = this.sensor.near;
    let [left, right] = [(-0.5 - h.cx) / h.fx, (h.width - 0.5 - h.cx) / h.fx];
    let [top, bottom] = [(h.cy + 0.5) / h.fy, (h.cy + 0.5 - h.height) / h.fy];
    const wide = right - left, high = top - bottom;
    const moreX = Math.max(0, high * aspect - wide) / 2, moreY = Math.max(0, wide / aspect - high) / 2;
    this.sensorPixels = {x: moreX / (wide + 2 * moreX), y: moreY / (high + 2 * moreY)};  // margins, as fractions
    left -= moreX; right += moreX; top += moreY; bottom -= moreY;
    this.sensor.projectionMatrix.makePerspective(left * near, right * near, top * near, bottom * near, near, this.sensor.far);
    this.sensor.projectionMatrixInverse.getInverse(this.sensor.projectionMatrix);
  }

  setSkin(skin) { this.hands[skin.side].setSkin(skin); }
  setPicture(canvas) {
    if (!canvas) { this.picture = null; return; }
    if (!this.picture || this.picture.image !== canvas) this.picture = new THREE.CanvasTexture(canvas);
    this.picture.minFilter = THREE.LinearFilter;
    this.picture.generateMipmaps = false;
    this.picture.needsUpdate = true;
    this.change();
  }

  show(frame) {
    const before = this.header;
    this.header = frame.header;
    if (!before || before.fx !== this.header.fx || before.width !== this.header.width) {
      this.fitSensor();
      this.room.set(this.place, this.room.known, this.header);
    }
    this.cloud.set(frame.cloud, frame.header);
    const centres = [];
    for (const side of [0, 1]) {
      const state = frame.states.find((s) => s.handedness === side && s.has_pose);
      const poses = state ? state.segments.map((s) => poseMatrix(s, this.options.smoothed)) : null;
      this.hands[side].setPose(poses, state && state.segments, this.options.coverage);
      this.ellipsoids[side].set(state && this.options.ellipsoids ? state.segments : null, this.options.smoothed);
      if (state) centres.push(new THREE.Vector3(...state.segments[0].smoothed_distal));
    }
    this.touches.set(this.options.touches ? frame.contacts : []);
    if (centres.length > 0) this.follow(centres);
    this.change();
  }

  // Moves the eye smoothly with the centre of the hands; in the view "orbit", which stays in place, only once. In a paused
  // log no further frame follows, so the eye moves at once.
  follow(centres) {
    const middle = centres.reduce((sum, c) => sum.add(c), new THREE.Vector3()).multiplyScalar(1 / centres.length);
    middle.applyMatrix4(this.place);
    if (this.anchored && this.view === "orbit") return;
    const move = middle.sub(this.controls.target).multiplyScalar(this.anchored && !this.options.paused ? 0.15 : 1);
    this.anchored = true;
    this.controls.target.add(move);
    this.free.position.add(move);
    this.controls.update();
  }

  // Called once for every refresh of the display, at the time `now` [ms].
  draw(now) {
    if (!this.changed) { this.drawnAt = undefined; return; }
    if (this.drawnAt !== undefined) this.adapt(now - this.drawnAt);  // before drawing, since resizing clears the canvas
    this.changed = false;
    this.render();
    this.drawnAt = now;
  }

  render() {
    const fromSensor = this.view === "camera" && this.header && this.header.fx > 0;
    const withPicture = fromSensor && this.picture;
    const height = this.canvas.height;
    const perRadian = fromSensor ? this.sensor.projectionMatrix.elements[5] * height / 2
                                 : height / 2 / Math.tan(kFieldOfView * Math.PI / 360);
    this.cloud.setScale(perRadian);
    for (const hand of this.hands) hand.setLook(withPicture ? 0.75 : 1, this.ground, this.pixelRatio);
    this.renderer.setScissorTest(false);
    this.renderer.setClearColor(this.ground);
    this.renderer.autoClear = false;
    this.renderer.clear();
    if (withPicture) this.renderPicture();
    const cloudShown = this.cloud.points.visible;
    if (withPicture) this.cloud.points.visible = false;
    this.room.show(this.options.floor && !fromSensor);
    this.renderer.render(this.scene, fromSensor ? this.sensor : this.free);
    this.cloud.points.visible = cloudShown;
  }

  // Draws the sensor's image as a rectangle behind everything else.
  renderPicture() {
    if (!this.backdrop) {
      this.backdrop = new THREE.Scene();
      this.backdropCamera = new THREE.OrthographicCamera(0, 1, 1, 0, -1, 1);
      this.plane = new THREE.Mesh(new THREE.PlaneBufferGeometry(1, 1),
                                  new THREE.MeshBasicMaterial({depthTest: false, depthWrite: false}));
      this.plane.position.set(0.5, 0.5, 0);
      this.backdrop.add(this.plane);
    }
    this.plane.material.map = this.picture;
    this.plane.scale.set(1 - 2 * this.sensorPixels.x, 1 - 2 * this.sensorPixels.y, 1);
    this.renderer.render(this.backdrop, this.backdropCamera);
  }

  // Reduces the resolution if drawing is slow, for example without a GPU. `ms`: time since the previous drawing, which
  // was in the refresh before this one.
  adapt(ms) {
    if (ms > 500) return;  // such a long time means that the page was hidden
    this.interval = this.interval ? 0.9 * this.interval + 0.1 * ms : kSlowMs / 2;
    if (this.interval < kSlowMs || this.pixelRatio <= kFewestPixels) return;
    this.pixelRatio = Math.max(kFewestPixels, this.pixelRatio * 0.8);
    this.interval = 0;
    this.resize();
  }

  // The view as a PNG.
  screenshot() {
    this.render();  // the browser clears the drawing buffer after display, so draw again
    return new Promise((done) => this.canvas.toBlob(done, "image/png"));
  }
}
