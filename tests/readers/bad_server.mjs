// Connects the example for browsers to a server that is full at first, then silent, then sends a message of another type, and
// then is well. Prints what the example says of it, one line each.
import WS, {WebSocketServer} from "ws";

globalThis.WebSocket = WS;
const setRealTimeout = globalThis.setTimeout;
globalThis.setTimeout = (call, ms) => setRealTimeout(call, ms / 50);  // so that nobody waits for seconds of silence
const {connect} = await import("../../clients/javascript/live_hands.mjs");

// A frame of the page with one LCM message.
function frame(channel, message) {
  const payload = Buffer.concat([Buffer.from([channel.length]), Buffer.from(channel), message]);
  const head = Buffer.alloc(8);
  head.write("L");
  head.writeUInt32LE(payload.length, 4);
  return Buffer.concat([head, payload, Buffer.alloc((4 - payload.length % 4) % 4)]);
}

const status = JSON.stringify({type: "status", trouble: ""});
const server = new WebSocketServer({port: 0, host: "127.0.0.1"});
let connections = 0;
server.on("connection", (socket) => {
  ++connections;
  if (connections === 1) socket.close(1013, "It is full.");
  if (connections < 3) return;
  socket.send(frame("GLOVE_STATE", Buffer.alloc(100)));
  socket.send(status);
  socket.send(frame("A_LATER_TYPE", Buffer.alloc(100)));
  socket.send(status);
});
server.on("listening", () => {
  const end = connect(`ws://127.0.0.1:${server.address().port}`, () => {}, (news) => {
    console.log(news);
    if (news) return;
    end();
    server.close();
  });
});
