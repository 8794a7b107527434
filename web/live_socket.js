// A WebSocket to the program that connects again by itself. The program says something twice a second, so that silence
// means that it, its machine or the network is gone, even where the connection does not end.
const kRetryMs = 1000;
const kDone = 1000;  // code of a connection that the server ends because all is sent
const kSilentMs = 10000;  // the longest silence, and the longest time until a connection is established

export class LiveSocket {
  // `handlers` has onOpen(), onMessage(text or ArrayBuffer) and onClose(reason, done). The reason is a sentence, or "" if there
  // is no server, or none that says why. `done`: the server has nothing more to send, so that no new connection is tried.
  constructor(url, handlers) {
    this.url = url;
    this.handlers = handlers;
    this.open();
  }

  open() {
    this.socket = new WebSocket(this.url);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = () => this.handlers.onOpen();
    this.socket.onmessage = ({data}) => { this.wait(); this.handlers.onMessage(data); };
    this.socket.onclose = ({code, reason}) => this.lose(reason, code === kDone);
    this.socket.onerror = () => {};  // onclose follows
    this.wait();
  }

  // Waits for the next message.
  wait() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.lose(`Nothing has come for ${kSilentMs / 1000} s.`), kSilentMs);
  }

  lose(reason, done = false) {
    this.close();
    if (!done) this.timer = setTimeout(() => this.open(), kRetryMs);
    this.handlers.onClose(reason, done);
  }

  // Sends an object as JSON if there is a connection.
  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  // Ends the connection for good.
  close() {
    clearTimeout(this.timer);
    this.socket.onopen = this.socket.onmessage = this.socket.onclose = null;
    this.socket.close();
  }
}
