"""Reads MCAP files of ROS 2 messages. It is implemented from the specifications alone (https://mcap.dev/spec, OMG's
CDR) and takes the fields of messages from the schemas in the file, so it is independent of the program that wrote
them."""
import ctypes
import struct
import zlib

MAGIC = b"\x89MCAP0\r\n"
PRIMITIVES = {"bool": "?", "byte": "B", "uint8": "B", "int8": "b", "uint16": "H", "int16": "h", "uint32": "I", "int32": "i",
              "uint64": "Q", "int64": "q", "float32": "f", "float64": "d"}


def unzstd(packed, size):
    library = ctypes.CDLL("libzstd.so.1")
    library.ZSTD_decompress.restype = ctypes.c_size_t
    library.ZSTD_decompress.argtypes = [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t]
    out = ctypes.create_string_buffer(size)
    got = library.ZSTD_decompress(out, size, packed, len(packed))
    assert got == size, f"zstd gave {got} of {size} bytes"
    return out.raw


class Fields:
    """Reads the fields of a record one after the other."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, size):
        assert self.at + size <= len(self.data), "a record ends early"
        self.at += size
        return self.data[self.at - size:self.at]

    def number(self, code):
        return struct.unpack("<" + code, self.take(struct.calcsize(code)))[0]

    def text(self):
        return self.take(self.number("I")).decode()

    def rest(self):
        return self.take(len(self.data) - self.at)

    def pairs(self, key, value):
        inner, pairs = Fields(self.take(self.number("I"))), []
        while inner.at < len(inner.data):
            pairs.append((key(inner), value(inner)))
        return pairs


def records(data, start=0):
    at = start
    while at < len(data):
        kind, size = struct.unpack_from("<BQ", data, at)
        assert at + 9 + size <= len(data), f"record {kind} at {at} ends early"
        yield kind, at, Fields(data[at + 9:at + 9 + size])
        at += 9 + size


class Schema:
    """The fields of a message by the text of its definition (ros2msg)."""

    def __init__(self, name, text):
        parts = text.split("=" * 80 + "\n")
        package, _, kind = name.split("/")
        self.root, self.types = f"{package}/{kind}", {}
        for part in ["MSG: " + self.root + "\n" + parts[0]] + parts[1:]:
            head, *lines = part.strip().split("\n")
            self.types[head.removeprefix("MSG: ")] = [line.split() for line in lines if line.strip()]

    def decode(self, data):
        assert data[:4] == b"\0\1\0\0", "no plain CDR, little endian"
        self.data, self.at = data[4:], 0
        message = self.message(self.root)
        assert self.at == len(self.data), f"{len(self.data) - self.at} bytes follow {self.root}"
        return message

    def message(self, kind):
        return {name: self.field(of) for of, name in self.types[kind]}

    def number(self, code):
        size = struct.calcsize(code)
        self.at += -self.at % size
        self.at += size
        return struct.unpack_from("<" + code, self.data, self.at - size)[0]

    def field(self, of):
        if of.endswith("]"):
            of, count = of[:-1].split("[")
            count = int(count) if count else self.number("I")
            if of == "uint8":
                self.at += count
                return self.data[self.at - count:self.at]
            return [self.field(of) for _ in range(count)]
        if of == "string":
            size = self.number("I")
            self.at += size
            return self.data[self.at - size:self.at - 1].decode()
        return self.number(PRIMITIVES[of]) if of in PRIMITIVES else self.message(of)


class McapFile:
    """All messages of a finished file. Its index, counts and checksums are checked when it is opened."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.data = file.read()
        assert self.data.startswith(MAGIC) and self.data.endswith(MAGIC), "no whole MCAP file"
        self.schemas, self.channels, self.messages, chunks = {}, {}, [], {}
        for kind, at, fields in records(self.data[:-len(MAGIC)], len(MAGIC)):
            if kind == 1:
                self.profile = fields.text()
            elif kind == 6:
                chunks[at] = self.chunk(fields)
            elif kind == 7:
                self.check_index(fields, list(chunks.values())[-1])
            elif kind == 15:
                assert fields.number("I") == zlib.crc32(self.data[:at]), "the check sum of the data"
            elif kind == 8:
                fields.take(16)
                assert fields.number("Q") in chunks, "a chunk that is not there"
                fields.take(8)
                self.check_offsets(fields.pairs(lambda f: f.number("H"), lambda f: f.number("Q")))
            elif kind == 11:
                assert fields.number("Q") == len(self.messages), "the number of messages"
                assert (fields.number("H"), fields.number("I")) == (len(self.schemas), len(self.channels))
                fields.take(8)
                assert fields.number("I") == len(chunks), "the number of chunks"
            elif kind == 14:
                group, start = fields.number("B"), fields.number("Q")
                assert self.data[start] == group, "a group of records that is not there"
            elif kind == 2:
                start, offsets, crc = fields.number("Q"), fields.number("Q"), fields.number("I")
                assert self.data[offsets] == 14
                assert crc == zlib.crc32(self.data[start:at + 9 + 16]), "the check sum of the summary"
            else:
                self.define(kind, fields)

    def define(self, kind, fields):
        if kind == 3:
            number, name, encoding = fields.number("H"), fields.text(), fields.text()
            assert encoding == "ros2msg"
            self.schemas[number] = (name, Schema(name, fields.text()))
        elif kind == 4:
            number, schema, topic, encoding = fields.number("H"), fields.number("H"), fields.text(), fields.text()
            assert encoding == "cdr"
            self.channels[number] = (topic, schema, dict(fields.pairs(Fields.text, Fields.text)))
        else:
            raise AssertionError(f"an unexpected record of kind {kind}")

    def chunk(self, fields):
        first, last, size, crc = fields.number("Q"), fields.number("Q"), fields.number("Q"), fields.number("I")
        assert fields.text() == "zstd"
        packed = fields.take(fields.number("Q"))
        content = unzstd(packed, size)
        assert crc == zlib.crc32(content), "the check sum of a chunk"
        where = {}
        for kind, at, message in records(content):
            assert kind == 5
            channel, sequence, time, sent = (message.number(code) for code in "HIQQ")
            assert first <= time <= last and sent == time
            where.setdefault(channel, []).append((time, at))
            self.messages.append((channel, sequence, time, message.rest()))
        return where

    @staticmethod
    def check_index(fields, where):
        channel = fields.number("H")
        assert fields.pairs(lambda f: f.number("Q"), lambda f: f.number("Q")) == where[channel], "an index of messages"

    def check_offsets(self, pairs):
        for channel, offset in pairs:
            assert self.data[offset] == 7 and struct.unpack_from("<H", self.data, offset + 9)[0] == channel

    def of_topic(self, topic):
        """(time [ns], frame number, message) of every message, in order."""
        for channel, sequence, time, data in self.messages:
            if self.channels[channel][0] == topic:
                yield time, sequence, self.schemas[self.channels[channel][1]][1].decode(data)

    def topics(self):
        return {topic: (self.schemas[schema][0], metadata) for topic, schema, metadata in self.channels.values()}
