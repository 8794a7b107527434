"""Hands from the live page of `barehand track --view` or `barehand view`, where LCM's multicast does not reach."""
import json
import struct
import time
from collections import deque
from urllib.parse import urlsplit

from .error import Error
from .websocket import BINARY, Closed, WebSocket

DEFAULT_PORT = 8765
END_OF_FRAME = (None, b"")  # follows the messages of each frame
_PATIENCE = 5.0             # seconds in which a server must have answered when it is connected to
_RETRY = 1.0                # seconds between attempts to connect again
_DONE = 1000                # code with which a server closes the connection when it has sent all
_CHUNK = struct.Struct("<cBxxI")


def parse_url(url):
    """(host, port, path) of ws://HOST:PORT; the default port is 8765, the default path /live."""
    example = "URLs look like ws://localhost:8765"
    try:
        parts = urlsplit(url)
        (parts.hostname or "").encode("idna")  # as the socket does; an impossible name is a ValueError
        host, port = parts.hostname, parts.port or DEFAULT_PORT
    except ValueError as error:
        raise Error(f"is no address of a live page: {error}", url, example) from None
    if parts.scheme in ("http", "https"):
        raise Error("is the address for browsers", url, f"programs use ws://{parts.netloc}")
    if parts.scheme == "wss":
        raise Error("the live page has no encryption", url, "use ws://, elsewhere through ssh -L 8765:localhost:8765 HOST")
    if parts.scheme != "ws" or not host:
        raise Error("is no address of a live page", url, example)
    return host, port, parts.path if parts.path not in ("", "/") else "/live"


class Page:
    """Receives the messages of the hands from a live page. The first connection must succeed. If it ends later, another
    one is tried every second, unless the page says that it has sent all: then `ended` is True. Not thread-safe."""

    def __init__(self, url, counts, newest=False, timeout=None):
        """Connects within `timeout` [s], 5 s at most. `newest`: the server sends a frame only when it is asked for one, and
        then the newest."""
        self._address = host, port, _ = parse_url(url)
        self._home = f"http://[{host}]:{port}" if ":" in host else f"http://{host}:{port}"
        self.url = url
        self._counts, self._newest = counts, newest
        self._messages = deque()
        self.ended = False
        self._trouble = self._reason = ""  # what the page says; why there is no connection
        self._retry_at = 0.0
        self._connect(timeout)
        if not self._socket:
            raise Error(f"cannot connect to the live page: {self._reason}", url, "start `barehand track --view`; it refuses "
                        "names other than localhost, an address or the machine's own")

    @property
    def remedy(self):
        """What to do if nothing comes."""
        if not self._socket:
            return f"the connection ended and is tried again: {self._reason}"
        return self._trouble or f"{self._home} in a browser shows what the tracker does"

    def receive(self, timeout=None):
        """Waits for the next message and returns (channel, data), both bytes, or END_OF_FRAME; None if none arrives
        within `timeout` [s], connected or not, or if none will come any more (`ended`). `timeout=0` does not wait, None
        waits without limit."""
        end = None if timeout is None else time.monotonic() + timeout
        while not self._messages:
            if self.ended:
                return None
            left = None if end is None else max(0, end - time.monotonic())
            if not self._socket and not self._wait_for_connection(left):
                return None
            try:
                self._acknowledge()
                message = self._socket.receive(None if end is None else max(0, end - time.monotonic()))
            except OSError as error:
                self._drop(error)
                self.ended = isinstance(error, Closed) and error.code == _DONE
                continue
            if not message:
                return None
            self._take(*message)
        return self._messages.popleft()

    def _take(self, kind, payload):
        if kind == BINARY:
            self._owes = self._newest
            self._messages.extend(self._split(payload))
            self._messages.append(END_OF_FRAME)
            return
        try:
            self._trouble = str(json.loads(payload).get("trouble", ""))
        except (ValueError, AttributeError):
            self._counts.damaged += 1

    def _split(self, frame):
        """The messages in a frame of the page: those in its chunks of the kind L (docs/view_protocol.md)."""
        at = 0
        while at < len(frame):
            kind, _, size = _CHUNK.unpack_from(frame, at) if at + _CHUNK.size <= len(frame) else (b"", 0, 0)
            start = at + _CHUNK.size
            name = start + 1 + frame[start] if size and start < len(frame) else 0
            if not kind or start + size > len(frame) or (kind == b"L" and name > start + size):
                self._counts.damaged += 1
                return
            if kind == b"L" and size:
                yield frame[start + 1:name], frame[name:start + size]
            at = start + size + -size % 4

    def _acknowledge(self):
        if self._owes:
            self._owes = False
            try:
                self._socket.send(b'{"type": "ack"}')
            except OSError:
                pass  # what the server sent before it ended can still be read

    def _connect(self, timeout):
        self._socket, self._owes = None, False
        try:
            self._socket = WebSocket(*self._address, _PATIENCE if timeout is None else min(timeout, _PATIENCE))
            self._socket.send(json.dumps({"type": "want", "rate": 1000, "window": 1 if self._newest else 0}).encode())
        except OSError as error:
            self._drop(error)

    def _drop(self, error):
        self.close()
        self._reason, self._retry_at = error.strerror or str(error), time.monotonic() + _RETRY

    def _wait_for_connection(self, timeout):
        """Tries to connect until it succeeds or `timeout` [s] is over; None: without limit. Returns whether it did."""
        end = None if timeout is None else time.monotonic() + timeout
        while not self._socket:
            wait = max(0, self._retry_at - time.monotonic())
            left = None if end is None else end - time.monotonic()
            if left is not None and wait >= left:
                time.sleep(max(0, left))
                return False
            time.sleep(wait)
            self._connect(None if left is None else left - wait)
        return True

    def close(self):
        if self._socket:
            self._socket.close()
        self._socket = None
