// The panels with text and numbers: the states of the hands, the health of the pipeline, and notices over the view.
import {kGraspKinds, kGraspNames, kSegmentNames, kSideNames, kStatusNames, kTouching} from "./lcm.js";

const byId = (id) => document.getElementById(id);
const kChip = {searching: "warn", tracking: "good", holding: "warn", lost: "lost"};

function element(tag, text, attributes = {}) {
  const made = document.createElement(tag);
  made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

// What a hand holds and where it touches something, in words; "" without contacts.
function touchesOf(state, contacts, objects) {
  const contact = contacts.find((c) => c.hand_id === state.hand_id);
  if (!contact) return "";
  const touching = (list) => list.flatMap((c, s) => c.state === kTouching ? [kSegmentNames[s] + (c.inferred ? " (inferred)" : "")] : []);
  const held = objects.filter((object) => object.held && object.hand_id === state.hand_id);
  const parts = held.map((object) => `Holds object ${object.object_id}.`);
  for (const [list, what] of [[contact.object, "an object"], [contact.own, "the hand itself"], [contact.other_hand, "the other hand"]]) {
    const names = touching(list);
    if (names.length > 0) parts.push(`Touches ${what}: ${names.join(", ")}.`);
  }
  return parts.join(" ");
}

// How a hand grasps, in words; "" if that is not known.
function graspOf(state, grasps) {
  const grasp = grasps.find((g) => g.hand_id === state.hand_id);
  if (!grasp || grasp.grasp < 0) return "";
  const percent = (probability) => `${Math.round(probability * 100)} %`;
  const opening = `thumb ${Math.round(grasp.aperture * 1e3)} mm from the fingers`;
  if (grasp.grasp === 0) return `No grasp (${percent(grasp.probability)}), ${opening}.`;
  return `Grasp: ${kGraspNames[grasp.grasp]} (${percent(grasp.probability)}), ${kGraspKinds[grasp.kind]} ` +
         `(${percent(grasp.kind_probability)}), ${opening}.`;
}

// Whose skin is drawn, in words; "" if it is that of the tracked hand. `drawn`: of the status; `log`: whether a log is played.
function skinOf(state, drawn, log) {
  if (!drawn || !state.has_pose) return "";
  const name = drawn[state.handedness];
  if (name !== "") return `Drawn with the skin of ${name}.`;
  return `${log ? "The log does not hold" : "Trackers do not send"} the person's skin: an average hand is drawn in this ` +
    "pose, with its lengths and thickness. With --hand hand.json it is the person's.";
}

// `frame`: the frame that is shown; null: there is none. `drawn` and `log`: as for skinOf().
export function showHands(frame, drawn, log) {
  const box = byId("hands");
  if (!frame || frame.states.length === 0) { box.textContent = "Not known."; return; }
  const {contacts, grasps, objects} = frame;
  box.replaceChildren(...frame.states.map((state) => {
    const status = kStatusNames[state.status] || "?", side = kSideNames[state.handedness];
    const row = element("div", "", {class: "hand"});
    row.append(element("b", `${side[0].toUpperCase()}${side.slice(1)} hand`),
               element("span", status, {class: "chip", "data-state": kChip[status]}), element("span", ""));
    const mean = state.segments.reduce((sum, s) => sum + s.confidence, 0) / 16;
    const seen = state.segments.filter((s) => s.seen).length;
    row.append(element("span", state.has_pose
      ? `${seen} of 16 segments seen, mean confidence ${mean.toFixed(2)}, mismatch ${(state.score * 1e3).toFixed(1)} mm`
      : "No pose.", {class: "numbers"}));
    const grasp = graspOf(state, grasps);
    if (grasp) row.append(element("span", grasp, {class: "numbers grasp"}));
    const touches = touchesOf(state, contacts, objects);
    if (touches) row.append(element("span", touches, {class: "numbers touches"}));
    const skin = skinOf(state, drawn, log);
    if (skin) row.append(element("span", skin, {class: "numbers skin"}));
    return row;
  }));
}

function table(head, rows) {
  const made = document.createElement("table"), top = document.createElement("tr");
  head.forEach((text) => top.append(element("th", text)));
  made.append(top);
  for (const row of rows) {
    const line = document.createElement("tr");
    row.forEach((cell) => line.append(element("td", cell.text ?? cell, cell.warn ? {class: "warn"} : {})));
    made.append(line);
  }
  return made;
}

const ms = (seconds) => seconds === null ? "–" : (seconds * 1e3).toFixed(1);

export function showHealth(status) {
  const health = status.health;
  if (!health) { byId("health").textContent = "Not known."; return; }
  const warn = (count) => ({text: String(count), warn: count > 0});
  const counts = [String(health.captured), String(health.published), warn(health.dropped), warn(health.failed)];
  const rows = health.stages.map((stage) => [stage.name, ms(stage.time.p50), ms(stage.time.p99), warn(stage.failed)]);
  if (health.latency.count > 0) rows.push(["latency", ms(health.latency.p50), ms(health.latency.p99), ""]);
  byId("health").replaceChildren(
    table(["frames", "captured", "published", "dropped", "failed"], [["", ...counts]]),
    table(["time", "median ms", "p99 ms", "failed"], rows),
    table(["queue", "waiting", "holds", "dropped"],
          health.queues.map((q) => [q.name, String(q.depth), String(q.capacity), q.name === "view" ? String(q.dropped) : warn(q.dropped)])));
}

// Shows a sentence over the view; "" hides it.
export function notice(text) {
  byId("notice").hidden = text === "";
  byId("notice").textContent = text;
}

export function showConnection(state, text) {
  byId("connection").dataset.state = state;
  byId("connection").textContent = text;
}

// Measures the rate of the frames that the page shows, and the latency from the depth image to the sending of the frame.
export class Meter {
  constructor() { this.times = []; }
  add(header, live, now) {
    this.times.push(now);
    while (this.times.length > 1 && now - this.times[0] > 2000) this.times.shift();
    if (live && header.sent > header.utime) this.latency = (header.sent - header.utime) / 1000;
  }
  show(live, now) {
    while (this.times.length > 0 && now - this.times[0] > 2000) this.times.shift();
    byId("rate").textContent = (this.times.length / 2).toFixed(0);
    const known = live && this.latency !== undefined && this.latency < 10000;
    byId("latency").parentElement.hidden = !known;
    if (known) byId("latency").textContent = this.latency.toFixed(0);
  }
}
