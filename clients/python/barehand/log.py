"""Logs: MCAP files (mcap.py), and LCM's event logs, which lcm-logger, `barehand record` and `barehand track --states-log`
write.

An event consists of a sync word, its number, its time [us] and the lengths of channel and data (4, 8, 8, 4, 4 bytes,
big endian), then the channel and the data (https://lcm-proj.github.io/lcm/content/log-file-format.html).
"""
import mmap
import os
import struct

from . import mcap
from .datagrams import LONGEST_CHANNEL
from .error import Error

_SYNC = b"\xED\xA1\xDA\x01"
_HEADER = struct.Struct(">IqqII")


def events(path, counts):
    """An iterator over all complete events of a log, or over the LCM messages of an MCAP file: (time [us], channel, data),
    the last two as bytes. Damaged or truncated parts are skipped up to the next event and counted in `counts.damaged`.
    Raises Error if the file is no log."""
    data = _map(path)  # here, so that a missing file is reported at once
    return mcap.events(data, path, counts) if data[:len(mcap.MAGIC)] == mcap.MAGIC else _scan(data, path, counts)


def _scan(bytes_, path, counts):
    at, found = 0, False
    while at < len(bytes_):
        end = _end(bytes_, at)

        # If no event follows this one, it may have been cut off, with later events written inside its stated length.
        if end and not _may_follow(bytes_, end):
            inner = _whole_event(bytes_, at + 1, end)
            if inner:
                counts.damaged += 1
                at = inner
                continue
        if not end:
            counts.damaged += 1
            at = _next_sync(bytes_, at + 1)
            continue
        _, _, time, channel_size, _ = _HEADER.unpack_from(bytes_, at)
        start = at + _HEADER.size
        yield time, bytes_[start:start + channel_size], bytes_[start + channel_size:end]
        found, at = True, end
    if not found:
        raise Error("holds no LCM event", path,
                    "logs are written by barehand track --states-log, barehand record, or lcm-logger")


def write_event(file, number, time, channel, data):
    """Appends an event to a log; `file` must be open for writing in binary mode, `time` is in microseconds."""
    file.write(_SYNC + _HEADER.pack(0, number, time, len(channel), len(data))[4:] + channel + data)


def _map(path):
    try:
        with open(path, "rb") as file:
            if os.fstat(file.fileno()).st_size == 0:
                raise Error("the log is empty", path)
            return mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
    except (OSError, ValueError) as error:
        reason = os.strerror(error.errno) if isinstance(error, OSError) and error.errno else str(error)
        raise Error(f"cannot read the log: {reason}", path, "give the name of one log") from None


def _end(bytes_, at):
    """The position at which the event at `at` ends; None if no complete event begins there."""
    if bytes_[at:at + 4] != _SYNC or at + _HEADER.size > len(bytes_):
        return None
    _, _, _, channel_size, size = _HEADER.unpack_from(bytes_, at)
    end = at + _HEADER.size + channel_size + size
    return end if 1 <= channel_size <= LONGEST_CHANNEL and end <= len(bytes_) else None


def _may_follow(bytes_, at):
    return _SYNC.startswith(bytes_[at:at + 4])


def _next_sync(bytes_, at):
    found = bytes_.find(_SYNC, at)
    return found if found >= 0 else len(bytes_)


def _whole_event(bytes_, start, end):
    """The position of the first complete event in [start, end) that another event may follow; None if there is none."""
    at = _next_sync(bytes_, start)
    while at < end:
        own_end = _end(bytes_, at)
        if own_end and _may_follow(bytes_, own_end):
            return at
        at = _next_sync(bytes_, at + 1)
    return None
