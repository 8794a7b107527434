// The page's connection to the program. It requests the parts of a frame that are needed, and acknowledges frames that were
// shown, so that a slow browser gets fewer frames instead of late ones.
import {LiveSocket} from "./live_socket.js";
import {decodeFrame} from "./messages.js";

const kWindow = 2;  // maximum number of unacknowledged frames

export class Connection {
  // `handlers` has onFrame(frame), onStatus(status), onError(text), onOpen() and onClose(reason, done: all was sent). onOpen is called
  // with the first message, since a program that has no place for the page accepts it only to say so.
  constructor(handlers) {
    this.handlers = handlers;
    this.wish = {};
    this.heard = false;
    this.socket = new LiveSocket(`ws://${location.host}/live`, {
      onOpen: () => this.sendWish(),
      onMessage: (data) => this.hear(data),
      onClose: (reason, done) => { this.heard = false; handlers.onClose(reason, done); },
    });
  }

  hear(data) {
    if (!this.heard) this.handlers.onOpen();
    this.heard = true;
    if (typeof data !== "string") return this.handlers.onFrame(decodeFrame(data));
    const message = JSON.parse(data);
    if (message.type === "status") this.handlers.onStatus(message);
    if (message.type === "error") this.handlers.onError(message.text);
  }

  send(message) { this.socket.send(message); }
  sendWish() { this.send({type: "want", window: kWindow, ...this.wish}); }
  want(wish) { this.wish = wish; this.sendWish(); }
  acknowledge() { this.send({type: "ack"}); }
}
