// Prints the angles of the index finger from a running `barehand track`, frame by frame:
//   node angles.mjs [LINES]
// Needs Node.js 18 or later and no packages. LCM_DEFAULT_URL names the network. Browsers have no UDP; there, the same
// decoders read the messages on the WebSocket of `barehand track --view` (docs/view_protocol.md).
import dgram from "node:dgram";
import {decodeGloveState, kSideNames, kStatusNames} from "../../web/lcm.js";

const kShortMessage = 0x4c433032;  // "LC02": a message in one datagram; hand states always fit into one
const kUnobservable = 2;           // glove_state_t.UNOBSERVABLE
const kIndexFinger = [4, 5, 6];    // channels INDEX_MPJ, INDEX_PIJ, INDEX_DIJ
const kExample = "udpm://239.255.76.67:7667";
const kRoute = "is there a multicast route? sudo ip link set lo up; sudo ip route add 224.0.0.0/4 dev lo";
const url = process.env.LCM_DEFAULT_URL || kExample;
const [, group, port] = url.match(/^udpm:\/\/([\d.]+):(\d+)/) ?? giveUp(`${url} is no LCM network; they look like ${kExample}`);
let lines = Number(process.argv[2] ?? Infinity);

function giveUp(why) {
  console.error(why);
  process.exit(1);
}

function print(glove) {
  const words = ["frame", glove.frame_number, kSideNames[glove.handedness], kStatusNames[glove.status] ?? "?"];
  // Without a pose, every angle is NaN and flagged as unobservable.
  if (glove.channel_flag[kIndexFinger[0]] !== kUnobservable)
    words.push(...kIndexFinger.map((channel) => (glove.channel[channel] * 180 / Math.PI).toFixed(1)));
  console.log(words.join(" "));
  if (--lines <= 0) socket.close();
}

// Handles a datagram with a short message: magic number and message number (4 bytes each), channel, a zero byte, data.
function receive(datagram) {
  if (lines <= 0 || datagram.length < 8 || datagram.readUInt32BE(0) !== kShortMessage) return;
  const end = datagram.indexOf(0, 8);
  if (datagram.toString("latin1", 8, end) !== "GLOVE_STATE") return;
  const data = new DataView(datagram.buffer, datagram.byteOffset + end + 1, datagram.length - end - 1);
  try {
    print(decodeGloveState(data));
  } catch (error) {
    console.error(`left out a message on GLOVE_STATE: ${error.message}`);
  }
}

const socket = dgram.createSocket({type: "udp4", reuseAddr: true});
socket.on("message", receive);
socket.on("error", (error) => giveUp(`cannot connect to ${url} (${error.message}); ${kRoute}`));
socket.bind(Number(port), group, () => {
  try {
    socket.addMembership(group);
  } catch (error) {
    socket.emit("error", error);
  }
});
