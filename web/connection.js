// The connection to the program over a WebSocket. It reconnects automatically, requests the parts of a frame that are
// needed, and acknowledges frames that were shown, so that a slow browser gets fewer frames instead of late ones.
import {decodeFrame} from "./messages.js";

const kRetryMs = 1000;
const kWindow = 2;  // maximum number of unacknowledged frames

export class Connection {
  // `handlers` has onFrame(frame), onStatus(status), onError(text), onOpen() and onClose().
  constructor(handlers) {
    this.handlers = handlers;
    this.wish = {};
    this.connect();
  }

  connect() {
    this.socket = new WebSocket(`ws://${location.host}/live`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => { this.handlers.onOpen(); this.sendWish(); };
    this.socket.onmessage = (event) => this.hear(event.data);
    this.socket.onclose = () => { this.handlers.onClose(); setTimeout(() => this.connect(), kRetryMs); };
  }

  hear(data) {
    if (typeof data !== "string") return this.handlers.onFrame(decodeFrame(data));
    const message = JSON.parse(data);
    if (message.type === "status") this.handlers.onStatus(message);
    if (message.type === "error") this.handlers.onError(message.text);
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
  sendWish() { this.send({type: "want", window: kWindow, ...this.wish}); }
  want(wish) { this.wish = wish; this.sendWish(); }
  acknowledge() { this.send({type: "ack"}); }
}
