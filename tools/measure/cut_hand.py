#!/usr/bin/env python3
"""Removes the hand from a recording: depth that a tracked hand explains becomes "no measurement". The result shows an
arm, but no hand. Frames in which no hand was tracked are left out.
  tools/measure/cut_hand.py RECORDING RESULT.csv OUT      RESULT.csv: from `barehand track --result` on RECORDING"""
import csv
import json
import math
import os
import shutil
import struct
import sys
import zlib

FINGER, PALM = 0.025, 0.055  # distance from a segment's axis up to which pixels are removed [m]
SIGNATURE = b"\x89PNG\r\n\x1a\n"


def read_depth(path):
    """Reads a 16-bit grey PNG; returns (width, height, rows of numbers)."""
    data = open(path, "rb").read()
    assert data[:8] == SIGNATURE, path + " is no PNG"
    position, packed = 8, b""
    while position < len(data):
        length, kind = struct.unpack(">I4s", data[position:position + 8])
        chunk = data[position + 8:position + 8 + length]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">IIBBBBB", chunk)
            assert (depth, colour, interlaced) == (16, 0, 0), path + " is no plain 16-bit grey PNG"
        elif kind == b"IDAT":
            packed += chunk
        position += 12 + length

    # Undo the PNG filter of each row byte by byte; the row begins with the number of its filter.
    raw, stride, above, rows = zlib.decompress(packed), 2 * width, bytes(2 * width), []
    for v in range(height):
        kind, row = raw[v * (stride + 1)], bytearray(raw[v * (stride + 1) + 1:(v + 1) * (stride + 1)])
        for i in range(stride) if kind else ():
            left, up, corner = (row[i - 2], above[i], above[i - 2]) if i > 1 else (0, above[i], 0)
            if kind == 4:
                guess = left + up - corner
                row[i] = (row[i] + min((left, up, corner), key=lambda x: abs(guess - x))) & 255
            else:
                row[i] = (row[i] + (0, left, up, (left + up) // 2)[kind]) & 255
        above = row
        rows.append(list(struct.unpack(f">{width}H", row)))
    return width, height, rows


def write_depth(path, width, height, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    raw = b"".join(b"\0" + struct.pack(f">{width}H", *row) for row in rows)
    header = struct.pack(">IIBBBBB", width, height, 16, 0, 0, 0, 0)
    with open(path, "wb") as out:
        out.write(SIGNATURE + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def cut(rows, camera, segments):
    """Sets pixels to 0 whose points are within `radius` of a segment's axis; segments: (from, to, radius) [m]."""
    unit, height, width = camera["depth_units_per_metre"], len(rows), len(rows[0])
    for a, b, radius in segments:
        ab = [q - p for p, q in zip(a, b)]
        square = max(sum(x * x for x in ab), 1e-12)
        pixels = [(camera["fx"] * p[0] / p[2] + camera["cx"], camera["fy"] * p[1] / p[2] + camera["cy"]) for p in (a, b)]
        reach = 1 + camera["fx"] * radius / min(a[2], b[2])
        (u0, u1), (v0, v1) = [(min(p[i] for p in pixels) - reach, max(p[i] for p in pixels) + reach) for i in (0, 1)]
        for v in range(max(0, int(v0)), min(height, math.ceil(v1) + 1)):
            for u in range(max(0, int(u0)), min(width, math.ceil(u1) + 1)):
                z = rows[v][u] / unit
                if not z:
                    continue
                ap = [(u - camera["cx"]) / camera["fx"] * z - a[0], (v - camera["cy"]) / camera["fy"] * z - a[1], z - a[2]]
                t = min(1, max(0, sum(x * y for x, y in zip(ap, ab)) / square))
                if sum((x - t * y) ** 2 for x, y in zip(ap, ab)) < radius * radius:
                    rows[v][u] = 0


def main():
    recording, result, out = sys.argv[1:]
    camera = json.load(open(os.path.join(recording, "camera.json")))
    hands = {}
    for row in csv.DictReader(open(result)):
        ends = [tuple(float(row[a + axis]) for axis in "xyz") for a in "pd"]
        hands.setdefault(int(row["frame"]), []).append((*ends, PALM if row["segment"] == "palm" else FINGER))

    # Write every frame in which the hand was tracked.
    os.makedirs(os.path.join(out, "depth"))
    shutil.copy(os.path.join(recording, "camera.json"), out)
    frames = [line.split() for line in open(os.path.join(recording, "depth.txt")) if not line.startswith("#")]
    with open(os.path.join(out, "depth.txt"), "w") as listed:
        for number, (stamp, name) in enumerate(frames):
            if number not in hands:
                continue
            width, height, rows = read_depth(os.path.join(recording, name))
            cut(rows, camera, hands[number])
            write_depth(os.path.join(out, name), width, height, rows)
            listed.write(f"{stamp} {name}\n")


if __name__ == "__main__":
    main()
