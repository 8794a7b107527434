// Prints what a log that `barehand view` serves says to viewers, received with @foxglove/ws-protocol.
//   node read_live.mjs PORT SUBPROTOCOL FRAMES
import {EventEmitter, once} from "node:events";
import protocol from "@foxglove/ws-protocol";
import WebSocket from "ws";
import {decode, print} from "./decode.mjs";

const [port, subprotocol, frames] = process.argv.slice(2);
const heard = new EventEmitter(), channels = new Map(), wanted = new Map();
let messages = new Map();  // of the frame that is shown, by topic

const viewer = new protocol.FoxgloveClient({ws: new WebSocket(`ws://127.0.0.1:${port}`, [subprotocol])});
viewer.on("error", (error) => { throw error; });
viewer.on("status", (status) => { throw new Error(status.message); });
viewer.on("advertise", (added) => {
  for (const channel of added) {
    channels.set(channel.id, channel);
    wanted.set(viewer.subscribe(channel.id), channel);
  }
});
viewer.on("message", ({subscriptionId, timestamp, data}) => {
  const {topic, schema} = wanted.get(subscriptionId);
  messages.set(topic, {time: timestamp, message: decode(schema, data)});
  if (topic === "/diagnostics") heard.emit("frame");  // the last topic of each frame
});

// Shows a frame through the connection of a page, and waits until the viewer has it.
const player = new WebSocket(`ws://127.0.0.1:${port}/live`);
await once(player, "open");
player.send(JSON.stringify({type: "pause"}));
function shown() {
  const hand = messages.get("/diagnostics")?.message.status[0];
  return Number(hand?.values.find(({key}) => key === "frame_number")?.value ?? -1);
}
async function show(frame) {
  messages = new Map();
  player.send(JSON.stringify({type: "seek", value: frame}));
  while (shown() !== frame) await once(heard, "frame");
}

// Topics are told of when they first have something to say, so the first round only subscribes.
for (const round of ["subscribe", "read"])
  for (let frame = 0; frame < Number(frames); ++frame) {
    await show(frame);
    if (round === "read")
      for (const [topic, {time, message}] of messages) print(topic, time, frame, message);
  }
viewer.close();
player.close();
