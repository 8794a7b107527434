"""MCAP files of `barehand track --mcap`, which hold the messages of the hands as barehand_msgs/LcmMessage (docs/mcap.md).

A record consists of its kind (1 byte), the length of its content (8 bytes) and the content; numbers are little endian
(https://mcap.dev/spec). Messages are in chunks that zstd has compressed, for which libzstd is loaded; Debian always has it.
"""
import ctypes
import ctypes.util
import functools
import struct
import zlib
from collections import Counter

from .counts import Counts
from .error import Error, warn

MAGIC = b"\x89MCAP0\r\n"
_FOOTER, _SCHEMA, _CHANNEL, _MESSAGE, _CHUNK, _DATA_END = 2, 3, 4, 5, 6, 15
_TYPE = b"barehand_msgs/msg/LcmMessage"
_RECORD = struct.Struct("<BQ")
_FOOTER_SIZE = _RECORD.size + 20
_ZSTD = b"\4\0\0\0zstd"                      # the name of the compression in a chunk,
_BEFORE_ZSTD = _RECORD.size + 8 + 8 + 8 + 4  # and the number of bytes before it
_DAMAGED = "damaged"
_LARGEST_CHUNK = 256 << 20  # bytes


class Damaged(ValueError):
    """The error for a record that cannot be read; its text says why, as the end of a sentence."""


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
            raise Damaged(_DAMAGED)
        self._at += size
        return bytes(self._data[self._at - size:self._at])

    def rest(self):
        return bytes(self._data[self._at:])


def events(data, path, counts):
    """An iterator over the LCM messages in `data`, the content of the file `path`: (time [us], channel, data), the last two
    as bytes. Damaged parts are left out, counted in `counts.damaged`, and at the end described in warnings, in the words of
    src/io/mcap/mcap_reader.cpp. Raises Error without libzstd."""
    view = memoryview(data)  # whose parts are no copies: a damaged length may be that of the whole file
    file, at, lost, ended, left_out = _File(view), len(MAGIC), 0, False, Counter()
    while at < len(view) and not ended:
        record = _record(view, at)
        if not record:
            found = _next_chunk(data, at + 1)
            lost += found - at
            counts.damaged += 1
            at = found
            continue
        kind, content = record
        at += _RECORD.size + len(content)
        ended = kind == _DATA_END
        try:
            yield from file.messages(kind, content, path, counts)
        except Damaged as error:
            counts.damaged += 1
            left_out[str(error)] += 1

    # Say what was left out.
    if lost:
        warn(f"{lost} bytes are damaged or cut off; every complete chunk is used", path)
    elif not ended:
        counts.damaged += 1
        warn("it was not finished, as by a recorder that was killed; every complete chunk is used", path)
    for reason, number in left_out.items():
        warn(("a chunk is left out, " if number == 1 else f"{number} chunks are left out, ") + reason, path)


class _File:
    """What the records so far have said of the file."""

    def __init__(self, view):
        self._types = {}        # of schemas, by their number
        self._channels = set()  # numbers of those with LCM messages

        # The summary repeats them, where the records before it are damaged.
        for kind, content in _summary(view):
            if kind in (_SCHEMA, _CHANNEL):
                list(self._message(kind, content, Counts()))

    def messages(self, kind, content, path, counts):
        """The LCM messages in a record of the file. Raises Damaged if it is a chunk that cannot be read."""
        if kind != _CHUNK:
            yield from self._message(kind, content, counts)
            return
        for record in _records(_unpacked(_Fields(content), path), 0):
            yield from self._message(*record, counts)

    def _message(self, kind, content, counts):
        try:
            if message := self._take(kind, _Fields(content)):
                yield message
        except Damaged:
            counts.damaged += 1

    def _take(self, kind, fields):
        """(time [us], channel, data) if the record is an LCM message; otherwise None."""
        if kind == _SCHEMA:
            number = fields.number("H")
            self._types.setdefault(number, fields.bytes())
        elif kind == _CHANNEL:
            number, schema = fields.number("H"), fields.number("H")
            if self._types.get(schema) == _TYPE:
                self._channels.add(number)
        elif kind == _MESSAGE and fields.number("H") in self._channels:
            _, time, _ = fields.number("I"), fields.number("Q"), fields.number("Q")
            return (time // 1000, *_lcm_message(fields.rest()))
        return None


def _record(data, at):
    """(kind, content) of the record at `at`; None if there is no whole one."""
    if at + _RECORD.size > len(data):
        return None
    kind, size = _RECORD.unpack_from(data, at)
    end = at + _RECORD.size + size
    return (kind, data[end - size:end]) if kind and end <= len(data) else None


def _records(data, at):
    """The whole records from `at` on, one after the other."""
    while record := _record(data, at):
        yield record
        at += _RECORD.size + len(record[1])


def _summary(view):
    """The records of the summary at the end of a finished file."""
    footer = len(view) - len(MAGIC) - _FOOTER_SIZE
    end = _record(view, footer) if footer > 0 else None
    if end and end[0] == _FOOTER and len(end[1]) == _FOOTER_SIZE - _RECORD.size:
        yield from _records(view[:footer], int.from_bytes(end[1][:8], "little") or footer)


def _next_chunk(data, at):
    """The position from `at` on at which a chunk that zstd has compressed seems to begin; the end if there is none."""
    view, sign = memoryview(data), data.find(_ZSTD, at + _BEFORE_ZSTD)
    while sign >= 0:
        start = sign - _BEFORE_ZSTD
        if view[start] == _CHUNK and _record(view, start):
            return start
        sign = data.find(_ZSTD, sign + 1)
    return len(data)


def _unpacked(chunk, path):
    chunk.bytes(16)  # first and last time
    size, checksum, compression, packed = chunk.number("Q"), chunk.number("I"), chunk.bytes(), chunk.bytes(chunk.number("Q"))
    if size > _LARGEST_CHUNK:
        raise Damaged("which would take more than 256 MiB")
    if compression not in (b"zstd", b""):
        raise Damaged(f"packed with {compression.decode(errors='replace')}, which is not read: repack the file with "
                      "`mcap compress --compression zstd`")
    data = packed if compression == b"" else _unzstd(packed, size, path)
    if len(data) != size or (checksum and checksum != zlib.crc32(data)):
        raise Damaged(_DAMAGED)
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
        raise Damaged(_DAMAGED)
    at = 12  # after the marks of CDR and the time stamp
    parts = []
    for _ in ("frame_id", "channel", "data"):
        at += -at % 4
        size = int.from_bytes(data[at:at + 4], "little")
        at += 4 + size
        if at > len(data):
            raise Damaged(_DAMAGED)
        parts.append(data[at - size:at])
    return parts[1][:-1], parts[2]
