// Connects the parts of the page: passes messages of the program to the view and the panels, and the user's commands to
// the program.
import {Connection} from "./connection.js";
import {Meter, notice, showConnection, showHands, showHealth} from "./panels.js";
import {Picture} from "./picture.js";
import {Plots} from "./plots.js";
import {Recorder} from "./recorder.js";
import {coverage, showScan} from "./scan.js";
import {Timeline} from "./timeline.js";

const byId = (id) => document.getElementById(id);
const kPictures = ["colour", "depth", "none"], kClouds = ["hand", "scene", "none"];
const kSlowFrameMs = 3000;  // time without a frame after which the page reports it
const kHintMs = 10000;      // how long the answer to a button is shown
const kNoContacts = "Nothing tells what the hand touches, because contacts are off in the tracker: its " +
  "configuration needs contact.enabled: true.";

const state = {view: "follow", cloud: "hand", ellipsoids: false, touches: true, smoothed: false, floor: true, freeze: false, picture: "colour", plot: "joints"};
const plots = new Plots(byId("plots")), picture = new Picture(byId("picture"), byId("no_picture")), meter = new Meter();
const skins = [];  // skins that arrived before the 3D view was ready
let scene = null, sceneProblem = "", latest = null, shown = null, unacknowledged = 0, frameAt = -1e9, status = null, open = false, closed = "", ended = false;
let hint = "", hintUntil = 0;  // the answer to a button, and until when it is shown
let decoding = Promise.resolve();  // chain of promises that decodes images one after the other

// Starts the 3D view. If three.js is missing or the browser lacks WebGL, the rest of the page works without it.
async function startScene() {
  try {
    const {Scene} = await import("./scene.js");
    scene = new Scene(byId("scene"));
    skins.forEach((skin) => scene.setSkin(skin));
    applyTheme();
    applyRoom();
    applyState();
  } catch (error) {
    console.warn(error);
    sceneProblem = String(error).includes("WebGL") ? "This browser draws nothing in 3D: WebGL is off or not supported."
      : "The 3D view could not be loaded. Is three.js installed beside Barehand (package libjs-three)?";
  }
}

const connection = new Connection({
  onOpen() { open = true; showConnection("good", "connected"); },
  onClose(reason, done) {
    open = false;
    closed = reason;
    ended = done;
    unacknowledged = 0;
    recorder.show(null);
    if (ended) return showConnection("quiet", "ended");  // the last frame stays
    latest = null;
    showConnection("lost", "no connection");
    showHands(null);
  },
  onError(text) { recorder.say(text, "lost"); },
  onStatus(message) {
    status = message;
    byId("source").textContent = message.source;
    showHealth(message);
    timeline.show(message.log);
    timeline.place(shown);
    applyRoom();
    recorder.show(message.record);
    showScan(message.scan || null);
    const paused = message.log !== null && !message.log.playing;
    if (scene) Object.assign(scene.options, {coverage: coverage(message.scan), paused});
  },
  async onFrame(frame) {
    for (const skin of frame.skins) scene ? scene.setSkin(skin) : skins[skin.side] = skin;
    frameAt = performance.now();
    if (!state.freeze) {
      await (decoding = decoding.then(() => picture.decode(frame)));  // so that hand, image and plots show the same frame
      plots.add(frame);
      if (latest) picture.release(latest);  // the previous frame was never shown
      latest = frame;
    }
    ++unacknowledged;
  },
});
const timeline = new Timeline((message) => connection.send(message));
const recorder = new Recorder((message) => connection.send(message));

// Called once for every refresh of the display.
function loop(now) {
  const isNew = latest !== null;
  if (isNew) {
    if (shown) picture.release(shown);
    shown = latest;
    latest = null;
    if (scene) scene.show(shown);
    showPicture(shown);
    meter.add(shown.header, status && status.live, performance.now());
  }
  if (scene) scene.draw(now);
  for (; unacknowledged > 0; --unacknowledged) connection.acknowledge();
  const slow = now - (loop.slowAt || 0) > 100;
  if (slow || (isNew && timeline.active)) tell();  // live, texts that change with every frame could not be read
  if (slow) {
    loop.slowAt = now;
    plots.draw(theme());
    meter.show(status && status.live, performance.now());
    showContacts();
  }
  requestAnimationFrame(loop);
}

// Shows all texts about the frame that is shown, together, so that they agree.
function tell() {
  if (shown && (open || ended)) showHands(shown, status && status.drawn, timeline.active);
  timeline.place(shown);
  notice(problem());
}

function showPicture(frame) {
  picture.explain(state.picture, frame);
  picture.show(frame, state.smoothed, state.view === "camera");
  if (scene) scene.setPicture(state.view === "camera" && frame.picture ? picture.plain : null);
}

// The most important problem, as a sentence for the user; "": there is none.
function problem() {
  const scan = status && status.scan ? status.scan.phase : "";
  if (ended) return `${closed} The page keeps what came last until you leave it. To see more, start the command again, and then load this page anew.`;
  if (!open) return `${closed || "No connection to Barehand. Is it still running?"} The page connects again by itself.`;
  if (performance.now() < hintUntil) return hint;
  if (status && status.trouble) return status.trouble;
  if (shown && shown.damage.length > 0) return `The program sends messages that this page does not know. Load the page anew. (${shown.damage[0]})`;
  if (sceneProblem) return sceneProblem;
  if (state.freeze || scan === "measuring" || scan === "done") return "";
  const paused = status && status.log && !status.log.playing;
  if (!shown || (performance.now() - frameAt > kSlowFrameMs && !paused)) return "Waiting for frames.";
  if (shown.states.some((s) => s.has_pose)) return "";
  if (status && status.log)
    return status.log.lost.length === 0 ? "The log holds no states of hands. barehand track makes them from its images."
      : "No hand in this frame of the log.";
  const lost = shown.states.some((s) => s.status === 3);
  return lost ? "The hand is lost. Show it again, open, to the sensor." : "No hand in view. Hold an open hand before the sensor.";
}

// Whether the tracker, or the log, says what the hands touch.
function hasContacts() { return shown !== null && shown.contacts.length > 0; }
function showContacts() {
  document.querySelector("[data-toggle=touches]").setAttribute("aria-pressed", String(state.touches && hasContacts()));
}
function toggleContacts() {
  if (hasContacts()) return toggle("touches");
  if (shown === null) return;
  hint = kNoContacts;
  hintUntil = performance.now() + kHintMs;
}

// Shows the room if the program knows the camera's pose in it.
function applyRoom() {
  const room = status && status.T_world_camera || null;
  byId("floor").hidden = room === null;
  if (scene) scene.setRoom(room);
}

function theme() { return document.documentElement.dataset.theme; }
function applyTheme() {
  if (scene) scene.setTheme(getComputedStyle(document.documentElement).getPropertyValue("--stage").trim(), theme());
  timeline.mark();
}
function setTheme(name) {
  document.documentElement.dataset.theme = name;
  applyTheme();
}
// The page has the system's theme, also when that changes, until the user chooses one.
const dark = matchMedia("(prefers-color-scheme: dark)");
const systemTheme = () => setTheme(dark.matches ? "dark" : "light");
function changeTheme() {
  dark.onchange = null;
  setTheme(theme() === "dark" ? "light" : "dark");
}

function applyState() {
  const press = (selector, name, value) => document.querySelectorAll(selector).forEach((button) =>
    button.setAttribute("aria-pressed", String(value(button.dataset[name]))));
  press("[data-view]", "view", (view) => view === state.view);
  press("[data-toggle]", "toggle", (name) => state[name]);
  showContacts();
  press("[data-cloud]", "cloud", (kind) => kind === state.cloud);
  press("[data-picture]", "picture", (kind) => kind === state.picture);
  press("[data-plot]", "plot", (kind) => kind === state.plot);
  byId("frozen").hidden = !state.freeze;
  plots.kind = state.plot;
  connection.want({cloud: state.cloud, picture: state.picture, large: state.view === "camera"});
  if (!scene) return;
  if (scene.view !== state.view) scene.setView(state.view);
  Object.assign(scene.options, {smoothed: state.smoothed, ellipsoids: state.ellipsoids, touches: state.touches, floor: state.floor});
  if (!shown) return;
  showPicture(shown);
  scene.show(state.cloud === "none" ? {...shown, cloud: null} : shown);
}
function set(change) { Object.assign(state, change); applyState(); }
const next = (kinds, kind) => kinds[(kinds.indexOf(kind) + 1) % kinds.length];
const toggle = (name) => set({[name]: !state[name]});

async function saveScreenshot() {
  if (!scene) return;
  const link = document.createElement("a");
  link.href = URL.createObjectURL(await scene.screenshot());
  link.download = `barehand-${shown ? shown.header.number : "view"}.png`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function onKey(event) {
  if (event.ctrlKey || event.altKey || event.metaKey || event.target.tagName === "SELECT") return;
  if (event.key === " " && event.target.tagName === "BUTTON") return;  // the browser presses the focused button
  const keys = {
    "1": () => set({view: "follow"}), "2": () => set({view: "orbit"}), "3": () => set({view: "camera"}),
    c: () => set({cloud: next(kClouds, state.cloud)}), e: () => toggle("ellipsoids"), k: toggleContacts, m: () => toggle("smoothed"), g: () => toggle("floor"), f: () => toggle("freeze"),
    p: () => set({picture: next(kPictures, state.picture)}),
    h: () => { plots.side = 1 - plots.side; },
    s: saveScreenshot, v: () => recorder.press(), t: changeTheme,
    "?": () => byId("shortcuts").showModal(),
    " ": () => timeline.active ? timeline.toggle() : toggle("freeze"),
    ArrowLeft: () => timeline.active && (event.shiftKey ? timeline.lost(-1) : timeline.step(-1)),
    ArrowRight: () => timeline.active && (event.shiftKey ? timeline.lost(1) : timeline.step(1)),
  };
  const action = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
  if (!action) return;
  event.preventDefault();
  action();
}

document.querySelectorAll("[data-view]").forEach((b) => { b.onclick = () => set({view: b.dataset.view}); });
document.querySelectorAll("[data-toggle]").forEach((b) => { b.onclick = () => toggle(b.dataset.toggle); });
document.querySelector("[data-toggle=touches]").onclick = toggleContacts;
document.querySelectorAll("[data-cloud]").forEach((b) => { b.onclick = () => set({cloud: b.dataset.cloud}); });
document.querySelectorAll("[data-picture]").forEach((b) => { b.onclick = () => set({picture: b.dataset.picture}); });
document.querySelectorAll("[data-plot]").forEach((b) => { b.onclick = () => set({plot: b.dataset.plot}); });
byId("screenshot").onclick = saveScreenshot;
byId("theme").onclick = changeTheme;
byId("help").onclick = () => byId("shortcuts").showModal();
window.addEventListener("keydown", onKey);

dark.onchange = systemTheme;
systemTheme();
applyState();
startScene();
requestAnimationFrame(loop);
