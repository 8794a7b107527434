#!/usr/bin/env python3
"""Connects clients to the live page for some time, to measure what they cost the tracker. READING clients request
everything, read it and acknowledge it; STUCK clients request everything and never read. Prints what each reading client
received.
  view_clients.py PORT READING STUCK SECONDS"""
import json
import os
import socket
import struct
import sys
import threading
import time

WANT = {"type": "want", "cloud": "hand", "picture": "colour", "window": 2}


def connect(port):
    client = socket.create_connection(("localhost", port))
    client.sendall((f"GET /live HTTP/1.1\r\nHost: localhost:{port}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                    "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n").encode())
    answer = b""
    while b"\r\n\r\n" not in answer:
        answer += client.recv(1)
    assert b" 101 " in answer, answer
    return client


def send(client, message):
    text, mask = json.dumps(message).encode(), os.urandom(4)
    client.sendall(bytes([0x81, 0x80 | len(text)]) + mask + bytes(c ^ mask[i % 4] for i, c in enumerate(text)))


def receive(stream):
    """Reads the next WebSocket frame; returns (opcode, payload)."""
    first, length = stream.read(2)
    if length == 126:
        length, = struct.unpack(">H", stream.read(2))
    elif length == 127:
        length, = struct.unpack(">Q", stream.read(8))
    return first & 15, stream.read(length)


def read(client, end, result):
    stream, frames, size = client.makefile("rb"), 0, 0
    while time.time() < end:
        opcode, payload = receive(stream)
        if opcode == 2:
            frames, size = frames + 1, size + len(payload)
            send(client, {"type": "ack"})
    result.append(f"{frames} frames, {frames / float(sys.argv[4]):.1f} a second, {size / max(frames, 1) / 1000:.0f} kB each")


def main(port, reading, stuck, seconds):
    end, results, threads = time.time() + seconds, [], []
    kept = [connect(port) for _ in range(stuck)]
    for client in kept:
        send(client, {**WANT, "window": 0})
    for _ in range(reading):
        client = connect(port)
        send(client, WANT)
        threads.append(threading.Thread(target=read, args=(client, end, results)))
        threads[-1].start()
    for thread in threads:
        thread.join()
    time.sleep(max(0, end - time.time()))
    print("\n".join(results))


main(int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4]))
