// Runs the JavaScript of the example for browsers against a server, and prints what it would show, as JSON lines. Ends with
// the last frame, or where the example has something to complain about.
//   node browser_example.mjs PORT FRAMES
import {once} from "node:events";
import WS from "ws";

// The WebSocket of a browser whose page was loaded from this origin.
globalThis.WebSocket = class extends WS {
  constructor(url) { super(url, {origin: "http://localhost:8000"}); }
};
const {connect, rows} = await import("../../clients/javascript/live_hands.mjs");

const [port, frames] = process.argv.slice(2);
const player = new WS(`ws://127.0.0.1:${port}/live`);
await once(player, "open");
player.send('{"type": "pause"}');

let wanted = 0;
const seek = () => player.send(JSON.stringify({type: "seek", value: wanted}));
function finish() {
  end();
  player.close();
}
const end = connect(`ws://127.0.0.1:${port}/live`, (hands) => {
  if (hands[0].frame !== wanted) return;
  console.log(JSON.stringify({hands, rows: rows(hands)}));
  if (++wanted < Number(frames)) seek();
  else finish();
}, (news) => {
  if (!news) return;
  console.error(news);
  finish();
});
seek();
