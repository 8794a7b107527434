"""LCM's protocol over UDP: splits messages into datagrams and assembles them again.

All numbers are big endian. A small message is one datagram: the magic number LC02, the sender's message number, the
channel with a final zero byte, and the data. A large message is split into fragments, one per datagram: the magic
number LC03, the message number, the size of all data, the offset of this fragment in them, the index of the fragment,
the number of fragments and, in the first fragment, the channel; then the data
(https://lcm-proj.github.io/lcm/content/udp-multicast-protocol.html).
"""
import struct
from collections import OrderedDict

SHORT, FRAGMENT = 0x4C433032, 0x4C433033
LONGEST_CHANNEL = 63        # longest name of a channel [bytes]
LARGEST_MESSAGE = 4 << 20   # largest message that Barehand sends [bytes]; larger ones are unreliable over UDP
_SHORT_HEADER = struct.Struct(">II")
_FRAGMENT_HEADER = struct.Struct(">IIIIHH")
_LARGEST_DATAGRAM = 65507   # largest payload of UDP over IPv4 [bytes]
_MOST_SENDERS = 64          # number of senders that are remembered


def encode(channel, data, number):
    """The datagrams of a message. `channel` and `data` are bytes; `number` counts the messages of this sender."""
    name = channel + b"\0"
    if _SHORT_HEADER.size + len(name) + len(data) <= _LARGEST_DATAGRAM:
        return [_SHORT_HEADER.pack(SHORT, number) + name + data]
    room = _LARGEST_DATAGRAM - _FRAGMENT_HEADER.size
    cuts = [0, *range(room - len(name), len(data), room), len(data)]
    return [_FRAGMENT_HEADER.pack(FRAGMENT, number, len(data), start, i, len(cuts) - 1) +
            (b"" if i else name) + data[start:end] for i, (start, end) in enumerate(zip(cuts, cuts[1:]))]


class _Partial:
    """A large message of which some fragments have arrived."""

    def __init__(self, number, size, count):
        self.number, self.count = number, count
        self.channel, self.data, self.seen, self.filled = None, bytearray(size), set(), 0


class _Sender:
    """The state of one sender, which is identified by its address and port."""

    def __init__(self):
        self.last = None     # number of the sender's newest message
        self.partial = None  # its incomplete message (_Partial), if any
        self.whole = None    # number of its last complete large message


class Assembler:
    """Assembles messages from datagrams. Like liblcm, it keeps one incomplete message per sender. Counts losses."""

    def __init__(self, counts):
        self._counts, self._senders = counts, OrderedDict()

    def add(self, datagram, address):
        """Returns (channel, data), both bytes, if `datagram` completes a message; otherwise None."""
        magic, = struct.unpack_from(">I", datagram) if len(datagram) >= _SHORT_HEADER.size else (0,)
        if magic == SHORT:
            return self._short(datagram, address)
        if magic == FRAGMENT and len(datagram) >= _FRAGMENT_HEADER.size:
            return self._fragment(datagram, address)
        self._counts.damaged += 1
        return None

    def _sender(self, address, number):
        """Returns the sender at `address`, after counting the messages that were lost before its message `number`."""
        sender = self._senders.setdefault(address, _Sender())
        self._senders.move_to_end(address)
        if len(self._senders) > _MOST_SENDERS:
            self._senders.popitem(last=False)

        # Count lost messages. If the number decreases, datagrams arrived out of order or the sender was restarted, so
        # nothing is lost.
        step = (number - sender.last) & 0xFFFFFFFF if sender.last is not None else 1
        if 1 <= step < 1 << 31:
            self._counts.lost += step - 1
            sender.last = number
        elif step:
            sender.last = number
        return sender

    def _short(self, datagram, address):
        end = datagram.find(b"\0", _SHORT_HEADER.size, _SHORT_HEADER.size + LONGEST_CHANNEL + 1)
        if end < 0:
            self._counts.damaged += 1
            return None
        self._sender(address, _SHORT_HEADER.unpack_from(datagram)[1])
        return datagram[_SHORT_HEADER.size:end], datagram[end + 1:]

    def _fragment(self, datagram, address):
        _, number, size, offset, index, count = _FRAGMENT_HEADER.unpack_from(datagram)
        sender = self._sender(address, number)
        if sender.whole == number and not sender.partial:  # a duplicate of a fragment
            return None

        # Give up an incomplete message when a fragment of another message arrives: its other fragments are lost.
        partial = sender.partial
        if not partial or (partial.number, len(partial.data), partial.count) != (number, size, count):
            self._counts.fragments += partial is not None
            believed = index < count and 0 < size <= LARGEST_MESSAGE
            partial = sender.partial = _Partial(number, size, count) if believed else None

        # Read the channel, with which the first fragment begins.
        start, end = _FRAGMENT_HEADER.size, None
        if partial and index == 0:
            end = datagram.find(b"\0", start, start + LONGEST_CHANNEL + 1)
            partial.channel, start = datagram[start:end], end + 1
        piece = datagram[start:]
        if not partial or end == -1 or index >= count or offset + len(piece) > size:
            self._counts.damaged += 1
            sender.partial = None
            return None

        # Insert the data; return the message if it is complete.
        if index not in partial.seen:
            partial.data[offset:offset + len(piece)] = piece
            partial.filled += len(piece)
            partial.seen.add(index)
        if len(partial.seen) < count:
            return None
        sender.partial, sender.whole = None, number
        if partial.filled != size:  # all fragments have arrived, but they do not cover all data
            self._counts.damaged += 1
            return None
        return partial.channel, bytes(partial.data)
