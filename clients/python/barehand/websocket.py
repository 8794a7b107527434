"""A client of the WebSocket protocol (RFC 6455) through the standard library: no encryption, no extensions."""
import base64
import hashlib
import os
import select
import socket
import struct
import time

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10
_CONTINUATION = 0
_GUID = "258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
_LARGEST_MESSAGE = 64 << 20  # bytes
_LARGEST_ANSWER = 1 << 16    # of the server to the handshake, bytes
# These notice a machine that is gone; the last one [ms] also while something that was sent is not acknowledged.
_KEEPALIVE = (("TCP_KEEPIDLE", 5), ("TCP_KEEPINTVL", 2), ("TCP_KEEPCNT", 3), ("TCP_USER_TIMEOUT", 11_000))


class Closed(ConnectionError):
    """The server has closed the connection. `code` is that of RFC 6455; 0: the server gave none."""

    def __init__(self, code, reason):
        super().__init__("the server closed the connection" + (f": {reason}" if reason else ""))
        self.code = code


def _connected(host, port, end, receive_buffer):
    """A socket that is connected to one of the addresses of the host until the time `end`."""
    found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    failure = OSError("the host has no address")
    for i, (family, kind, protocol, _, address) in enumerate(found):
        one = socket.socket(family, kind, protocol)
        try:
            if receive_buffer is not None:
                one.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)  # before a connection grants a window
            one.settimeout(max(1e-3, (end - time.monotonic()) / (len(found) - i)))  # an address that is silent leaves time
            one.connect(address)
            one.settimeout(max(1e-3, end - time.monotonic()))
            return one
        except OSError as error:
            failure = error
            one.close()
    raise failure


class WebSocket:
    """A connection. Errors of the network, and of the protocol, are OSError; after one, the connection is useless. Not
    thread-safe."""

    def __init__(self, host, port, path, timeout, protocol="", receive_buffer=None):
        """Connects within `timeout` seconds, beside the time in which the system looks up the host's name. Later, sending may
        take as long. `protocol`: the subprotocol to ask for, if any. `receive_buffer`: size of the kernel's buffer [bytes]."""
        self._buffer, self._parts, self._kind = bytearray(), bytearray(), None
        end = time.monotonic() + timeout
        self._socket = _connected(host, port, end, receive_buffer)
        try:
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
            for name, value in _KEEPALIVE:
                if hasattr(socket, name):  # not every system has all of them
                    self._socket.setsockopt(socket.IPPROTO_TCP, getattr(socket, name), value)
            self._shake_hands(f"[{host}]:{port}" if ":" in host else f"{host}:{port}", path, protocol, end)
            self._socket.settimeout(timeout)  # for sending; receive() waits by itself
        except BaseException:
            self.close()
            raise

    def _shake_hands(self, host, path, protocol, end):
        key = base64.b64encode(os.urandom(16)).decode()
        wish = f"Sec-WebSocket-Protocol: {protocol}\r\n" if protocol else ""
        self._socket.sendall((f"GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                              f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: {key}\r\n{wish}\r\n").encode())
        while b"\r\n\r\n" not in self._buffer:
            if len(self._buffer) > _LARGEST_ANSWER or not self._read(end - time.monotonic()):
                raise ConnectionError("no answer to the request for a WebSocket")
        answer, _, self._buffer = self._buffer.partition(b"\r\n\r\n")
        status, *lines = answer.decode("latin-1").split("\r\n")
        headers = {name.strip().lower(): value.strip() for name, _, value in (line.partition(":") for line in lines)}
        expected = base64.b64encode(hashlib.sha1((key + _GUID).encode()).digest()).decode()
        if status.split(" ")[1:2] != ["101"] or headers.get("sec-websocket-accept") != expected:
            raise ConnectionError(f'the answer is "{status[:80]}", not a WebSocket')
        if headers.get("sec-websocket-protocol", "") != protocol:
            raise ConnectionError(f'the server does not agree on the subprotocol "{protocol}"')

    def send(self, data, kind=TEXT):
        """Sends a message of bytes, masked as the protocol demands of clients."""
        size, mask = len(data), os.urandom(4)
        length = bytes([0x80 | size]) if size < 126 else struct.pack(">BH", 0xFE, size) if size < 1 << 16 else \
            struct.pack(">BQ", 0xFF, size)
        self._socket.sendall(bytes([0x80 | kind]) + length + mask + bytes(c ^ mask[i % 4] for i, c in enumerate(data)))

    def receive(self, timeout=None):
        """Waits for the next message and returns (TEXT or BINARY, bytes); None if none is complete within `timeout` [s].
        `timeout=0` does not wait, None waits without limit."""
        end = None if timeout is None else time.monotonic() + timeout
        while True:
            while frame := self._take_frame():
                if message := self._handle(*frame):
                    return message
            if not self._read(None if end is None else end - time.monotonic()):
                return None

    def _read(self, timeout):
        """Reads what has arrived; False if nothing arrives within `timeout`."""
        if not select.select([self._socket], [], [], timeout if timeout is None else max(0, timeout))[0]:
            return False
        piece = self._socket.recv(1 << 20)
        if not piece:
            raise ConnectionError("the server closed the connection")
        self._buffer += piece
        return True

    def _take_frame(self):
        """(whether it is the last of its message, opcode, payload) of the next frame; None if it is not complete."""
        if len(self._buffer) < 2:
            return None
        first, size = self._buffer[0], self._buffer[1]
        if first & 0x70 or size & 0x80:
            raise ConnectionError("the server breaks the WebSocket protocol")

        # A length of 126 or 127 means that the length follows in 2 or 8 bytes.
        start = 2 + {126: 2, 127: 8}.get(size, 0)
        if len(self._buffer) < start:
            return None
        if start > 2:
            size = int.from_bytes(self._buffer[2:start], "big")
        if size + len(self._parts) > _LARGEST_MESSAGE:
            raise ConnectionError(f"the server sends a message of more than {_LARGEST_MESSAGE} bytes")
        if len(self._buffer) < start + size:
            return None
        payload = bytes(self._buffer[start:start + size])
        del self._buffer[:start + size]
        return bool(first & 0x80), first & 15, payload

    def _handle(self, last, opcode, payload):
        """The message that this frame completes, or None."""
        if opcode == PING:
            self.send(payload, PONG)
        elif opcode == CLOSE:  # after a code of 2 bytes the server may say why
            raise Closed(int.from_bytes(payload[:2], "big"), payload[2:].decode(errors="replace"))
        elif opcode in (TEXT, BINARY, _CONTINUATION):
            if (opcode == _CONTINUATION) != (self._kind is not None):
                raise ConnectionError("the server breaks the WebSocket protocol")
            self._kind = self._kind or opcode
            self._parts += payload
            if last:
                message = self._kind, bytes(self._parts)
                self._kind, self._parts = None, bytearray()
                return message
        return None

    def close(self):
        self._socket.close()
