"""An LCM network: UDP multicast through the standard library."""
import errno
import os
import select
import socket
import struct
import time
from urllib.parse import parse_qs, urlsplit

from .datagrams import LARGEST_MESSAGE, LONGEST_CHANNEL, Assembler, encode
from .error import Error

DEFAULT_URL = "udpm://239.255.76.67:7667"
_LARGEST_DATAGRAM = 65536
_RECEIVE_BUFFER = 2 << 20   # requested size of the socket's buffer, bytes, as in the tracker; the kernel may limit it
_ROUTE = "add a multicast route: sudo ip link set lo up; sudo ip route add 224.0.0.0/4 dev lo"


def parse_url(url=None):
    """(group, port, ttl, receive buffer in bytes) of udpm://GROUP:PORT?ttl=0&recv_buf_size=BYTES. If `url` is None: the
    environment variable LCM_DEFAULT_URL, or LCM's default. The default ttl is 0: nothing leaves this machine."""
    url = url or os.environ.get("LCM_DEFAULT_URL") or DEFAULT_URL
    example = "URLs look like udpm://239.255.76.67:7667?ttl=0"
    try:
        parts = urlsplit(url)
        options = parse_qs(parts.query, strict_parsing=bool(parts.query))
        group, port = parts.hostname or "239.255.76.67", parts.port or 7667
        ttl, buffer = (int(options.get(name, [value])[0])
                       for name, value in (("ttl", 0), ("recv_buf_size", _RECEIVE_BUFFER)))
        multicast = 224 <= socket.inet_aton(group)[0] <= 239
    except (ValueError, OSError) as error:
        raise Error(f"is no address of an LCM network: {error}", url, example) from None
    if parts.scheme != "udpm":
        raise Error("the Python client knows networks (udpm), live pages (ws) and logs only", url, example)
    if not multicast or not 0 <= ttl <= 255:
        raise Error("is no multicast address with a ttl of 0 to 255", url, example)
    if not 0 < buffer < 2**31:
        raise Error("has a receive buffer that is not between 0 and 2 GiB", url, example)
    return group, port, ttl, buffer


class Network:
    """Sends and receives messages as liblcm does. Not thread-safe."""

    ended = False  # a network never ends
    #: What to do if nothing comes.
    remedy = "start `barehand track` with the same LCM URL and channel prefix; `barehand listen` shows what it sends"

    def __init__(self, url=None, counts=None):
        """Connects for sending and, if `counts` (counts.Counts) is given, for receiving."""
        group, port, ttl, buffer = parse_url(url)
        self.url = f"udpm://{group}:{port}?ttl={ttl}"
        self._address, self._number = (group, port), 0
        self._assembler = Assembler(counts) if counts is not None else None
        self._receiver = self._sender = None
        try:
            self._sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
            self._sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, ttl)
            self._sender.connect(self._address)  # fails without a route
            if self._assembler:
                self._listen(group, port, buffer)
        except OSError as error:
            self.close()
            raise self._error(error) from None

    def _listen(self, group, port, buffer):
        self._receiver = receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # other programs may listen on this port, too
        receiver.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer)
        receiver.bind((group, port))  # to the group, so that messages of other groups on this port are not received
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                            struct.pack("4sI", socket.inet_aton(group), socket.INADDR_ANY))
        receiver.setblocking(False)

    def _error(self, error):
        if error.errno in (errno.ENETUNREACH, errno.ENODEV, errno.EHOSTUNREACH):
            return Error("there is no multicast route", self.url, _ROUTE)
        if error.errno == errno.EADDRINUSE:
            return Error("the port is taken by a program that does not share it", self.url,
                         "end that program (ss -ulpn shows it), or use another port on both sides")
        return Error(f"cannot connect to LCM: {os.strerror(error.errno or 0)}", self.url)

    def send(self, channel, data):
        """Sends `data` (bytes) on `channel` (str). Raises Error if that is not possible. As always with LCM, it is no
        error if no one receives the message or a datagram is lost on its way."""
        name = channel.encode()
        if not 1 <= len(name) <= LONGEST_CHANNEL or b"\0" in name:
            raise Error("channel names have 1 to 63 bytes", channel)
        if len(data) > LARGEST_MESSAGE:
            raise Error(f"a message of {len(data)} bytes is too large for LCM, which carries {LARGEST_MESSAGE}", channel,
                        "compress it more, or send smaller images")
        try:
            for datagram in encode(name, data, self._number):
                self._sender.send(datagram)
        except ConnectionRefusedError:
            pass
        except OSError as error:
            raise self._error(error) from None
        self._number = (self._number + 1) & 0xFFFFFFFF

    def receive(self, timeout=None):
        """Waits for the next message and returns (channel, data), both bytes; None if none arrives within `timeout`
        [s]. `timeout=0` does not wait, None waits without limit."""
        end = None if timeout is None else time.monotonic() + timeout
        while True:
            try:
                message = self._assembler.add(*self._receiver.recvfrom(_LARGEST_DATAGRAM))
                if message:
                    return message
                continue
            except BlockingIOError:
                pass
            except OSError as error:
                raise self._error(error) from None
            left = None if end is None else end - time.monotonic()
            if left is not None and left <= 0:
                return None
            select.select([self._receiver], [], [], left)

    def close(self):
        for one in (self._sender, self._receiver):
            if one:
                one.close()
