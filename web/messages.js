// Decodes the binary messages of the WebSocket (docs/view_protocol.md lists their chunks).
import {decodeContactState, decodeGloveState, decodeGraspState, decodeHandState, decodeObjectState} from "./lcm.js";

const kDecoders = {HAND_STATE: ["states", decodeHandState], GLOVE_STATE: ["gloves", decodeGloveState],
                   CONTACT_STATE: ["contacts", decodeContactState], GRASP_STATE: ["grasps", decodeGraspState],
                   OBJECT_STATE: ["objects", decodeObjectState]};

function lcmMessage(view, frame) {
  const length = view.getUint8(0);
  const channel = new TextDecoder().decode(new Uint8Array(view.buffer, view.byteOffset + 1, length));
  const message = new DataView(view.buffer, view.byteOffset + 1 + length, view.byteLength - 1 - length);
  if (!Object.hasOwn(kDecoders, channel)) return;
  const [list, decode] = kDecoders[channel];
  try {
    frame[list].push(decode(message));
  } catch (error) {
    frame.damage.push(`${channel}: ${error.message}`);
  }
}

function header(view) {
  const double = (i) => view.getFloat64(24 + 8 * i, true);
  return {utime: Number(view.getBigInt64(0, true)), number: Number(view.getBigInt64(8, true)),
          sent: Number(view.getBigInt64(16, true)), fx: double(0), fy: double(1), cx: double(2), cy: double(3),
          width: view.getInt32(56, true), height: view.getInt32(60, true)};
}

function skin(view, side) {
  const n = view.getUint32(0, true), m = view.getUint32(4, true);
  let at = 8;
  const floats = (count) => { at += 4 * count; return new Float32Array(view.buffer, view.byteOffset + at - 4 * count, count); };
  const inA = floats(3 * n), inB = floats(3 * n), normal = floats(3 * n), weight = floats(n);
  const triangles = new Uint32Array(view.buffer, view.byteOffset + at, 3 * m);
  at += 12 * m;
  const a = new Uint8Array(view.buffer, view.byteOffset + at, n);
  const b = new Uint8Array(view.buffer, view.byteOffset + at + n, n);
  return {side, inA, inB, normal, weight, triangles, a, b};
}

function cloud(view, coloured) {
  const [columns, rows, step, u, v] = [0, 2, 4, 6, 8].map((at) => view.getUint16(at, true));
  const count = columns * rows, at = view.byteOffset + 16;
  return {columns, rows, step, u, v, unit: view.getFloat32(12, true), depth: new Uint16Array(view.buffer, at, count),
          colour: coloured ? new Uint16Array(view.buffer, at + 2 * count, count) : null};
}

// Decodes a message to {header, place, states, gloves, contacts, grasps, objects, skins, cloud, picture, damage}; header,
// place (in a log), cloud and picture are null if missing. `damage` says of each LCM message that was left out why.
export function decodeFrame(buffer) {
  const frame = {header: null, place: null, states: [], gloves: [], contacts: [], grasps: [], objects: [], skins: [], cloud: null,
                 picture: null, damage: []};
  const whole = new DataView(buffer);
  for (let at = 0; at + 8 <= buffer.byteLength;) {
    const kind = String.fromCharCode(whole.getUint8(at)), index = whole.getUint8(at + 1);
    const length = whole.getUint32(at + 4, true);
    const view = new DataView(buffer, at + 8, length);
    if (kind === "F") frame.header = header(view);
    if (kind === "T") frame.place = {position: Number(view.getBigInt64(0, true)), at: view.getFloat64(8, true)};
    if (kind === "L") lcmMessage(view, frame);
    if (kind === "S") frame.skins.push(skin(view, index));
    if (kind === "D") frame.cloud = cloud(view, index === 1);
    if (kind === "P") frame.picture = {kind: index === 1 ? "colour" : "depth",
                                       jpeg: new Blob([new Uint8Array(buffer, at + 8, length)], {type: "image/jpeg"})};
    at += 8 + length + (4 - length % 4) % 4;
  }
  return frame;
}
