// Hands from the live page of `barehand track --view` or `barehand view`, in a browser or wherever else WebSocket is.
import {LiveSocket} from "../../web/live_socket.js";
import {decodeFrame} from "../../web/messages.js";
import {kSideNames, kStatusNames} from "../../web/lcm.js";

const kDegrees = 180 / Math.PI;

// A hand with its angles in degrees by name; none at all while it has no pose, and never zeros instead.
function handOf(glove, state) {
  const angles = {};
  if (state?.has_pose)
    glove.joint_name.forEach((name, i) => {
      if (Number.isFinite(glove.joint_angle[i])) angles[name] = glove.joint_angle[i] * kDegrees;
    });
  return {side: kSideNames[glove.handedness], status: kStatusNames[glove.status] ?? "?", frame: glove.frame_number, angles};
}

// Calls onHands(list of hands) for every frame, and onNews(sentence, "" where all is well) when the connection or what the
// tracker says of itself changes. Connects again when the server comes back, unless it said that a recording is over. Returns a
// function that ends it.
// `url`: such as "ws://localhost:8765/live".
export function connect(url, onHands, onNews) {
  let trouble = "", leftOut = "";  // what the tracker says, and what is wrong with its messages
  function hear(data) {
    if (typeof data === "string") {
      trouble = JSON.parse(data).trouble ?? "";
      return onNews(trouble || leftOut);
    }
    try {
      const {states, gloves, damage} = decodeFrame(data);
      leftOut = damage.length > 0 ? `Messages are left out: ${damage[0]}.` : "";
      onHands(gloves.map((glove) => handOf(glove, states.find((state) => state.hand_id === glove.hand_id))));
    } finally {
      // A slow browser then gets fewer frames instead of late ones. An error must not end the stream.
      socket.send({type: "ack"});
    }
  }
  const socket = new LiveSocket(url, {
    onOpen: () => socket.send({type: "want", window: 1}),
    onMessage: hear,
    onClose: (reason) => onNews(reason ||
      `No connection to ${url}. Does barehand track --view run, and does it invite this page (--view-origin)?`),
  });
  return () => socket.close();
}

// The hands as the rows of a table, lists of texts: first their names, then one joint a row, one hand a column.
export function rows(hands) {
  const names = [...new Set(hands.flatMap((hand) => Object.keys(hand.angles)))];
  return [["", ...hands.map((hand) => `${hand.side}, ${hand.status}`)],
          ...names.map((name) => [name, ...hands.map((hand) => hand.angles[name]?.toFixed(1) ?? "")])];
}
