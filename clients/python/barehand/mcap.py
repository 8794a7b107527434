"""MCAP files of `barehand track --mcap`, which hold the messages of the hands as barehand_msgs/LcmMessage (docs/mcap.md).

A record consists of its kind (1 byte), the length of its content (8 bytes) and the content; numbers are little endian
(https://mcap.dev/spec). Messages are in chunks that zstd has compressed, for which libzstd is loaded; Debian always has it.
"""
import ctypes
import ctypes.util
import functools
import struct
import zlib

from .error import Error

MAGIC = b"\x89MCAP0\r\n"
_SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _DATA_END = 3, 4, 5, 6, 15
_TYPE = b"barehand_msgs/msg/LcmMessage"
_RECORD = struct.Struct("<BQ")
_LARGEST_CHUNK = 256 << 20  # bytes


class Damaged(ValueError):
    """A record ends early, or a check sum is wrong."""


class _Fields:
    """Takes fields from the content of a record."""

    def __init__(self, data):
        self._data, self._at = data, 0

    def number(self, code):
        return struct.unpack("<" + code, self.bytes(struct.calcsize(code)))[0]

    def bytes(self, size=None):
        """`size` bytes, or as many as the number before them (4 bytes) says."""
        size = self.number("I") if size is None else size
        if self._at + size > len(self._data):
            raise Damaged("a field ends early")
        self._at += size
        return bytes(self._data[self._at - size:self._at])

    def rest(self):
        return bytes(self._data[self._at:])


def events(data, path, counts):
    """An iterator over the LCM messages in `data`, the content of the file `path`: (time [us], channel, data), the last two
    as bytes. Damaged parts are left out and counted in `counts.damaged`. Raises Error without libzstd."""
    file = _File()
    for kind, content in _records(data, len(MAGIC)):
        if kind == _DATA_END:
            return
        try:
            inside = _records(_unpacked(_Fields(content), path), 0) if kind == _CHUNK else [(kind, content)]
            for record in inside:
                if message := file.take(*record):
                    yield message
        except Damaged:
            counts.damaged += 1
    counts.damaged += 1  # the end is missing, as after a crash


class _File:
    """What the records so far have said of the file."""

    def __init__(self):
        self._types = {}        # of schemas, by their number
        self._channels = set()  # numbers of those with LCM messages

    def take(self, kind, content):
        """(time [us], channel, data) if the record is an LCM message; otherwise None."""
        fields = _Fields(content)
        if kind == _SCHEMA:
            number = fields.number("H")
            self._types[number] = fields.bytes()
        elif kind == _CHANNEL:
            number, schema = fields.number("H"), fields.number("H")
            if self._types.get(schema) == _TYPE:
                self._channels.add(number)
        elif kind == _MESSAGE and fields.number("H") in self._channels:
            _, time, _ = fields.number("I"), fields.number("Q"), fields.number("Q")
            return (time // 1000, *_lcm_message(fields.rest()))
        return None


def _records(data, at):
    """(kind, content) of the whole records from `at` on."""
    while at + _RECORD.size <= len(data):
        kind, size = _RECORD.unpack_from(data, at)
        at += _RECORD.size + size
        if at > len(data):
            return
        yield kind, data[at - size:at]


def _unpacked(chunk, path):
    chunk.bytes(16)  # first and last time
    size, checksum, compression, packed = chunk.number("Q"), chunk.number("I"), chunk.bytes(), chunk.bytes(chunk.number("Q"))
    if size > _LARGEST_CHUNK or compression not in (b"zstd", b""):
        raise Damaged("a chunk that is not read")
    data = packed if compression == b"" else _unzstd(packed, size, path)
    if len(data) != size or (checksum and checksum != zlib.crc32(data)):
        raise Damaged("the check sum of a chunk")
    return data


@functools.lru_cache(maxsize=None)
def _zstd():
    """The function ZSTD_decompress(out, size of out, packed, size of packed), which returns the size of what it unpacked."""
    unpack = ctypes.CDLL(ctypes.util.find_library("zstd") or "libzstd.so.1").ZSTD_decompress
    unpack.restype, unpack.argtypes = ctypes.c_size_t, [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    return unpack


def _unzstd(packed, size, path):
    try:
        unpack = _zstd()
    except OSError:
        raise Error("MCAP files need the library libzstd", path, "install it, such as Debian's package libzstd1") from None
    out = ctypes.create_string_buffer(max(1, size))
    return out.raw[:size] if unpack(out, size, packed, len(packed)) == size else b""


def _lcm_message(data):
    """(channel, message) of a barehand_msgs/LcmMessage in CDR, little endian: header, channel, data. Every length lies at a
    multiple of 4 bytes."""
    if data[:4] != b"\0\1\0\0":
        raise Damaged("no CDR")
    at = 12  # after the marks of CDR and the time stamp
    parts = []
    for _ in ("frame_id", "channel", "data"):
        at += -at % 4
        size = int.from_bytes(data[at:at + 4], "little")
        at += 4 + size
        if at > len(data):
            raise Damaged("a message ends early")
        parts.append(data[at - size:at])
    return parts[1][:-1], parts[2]
