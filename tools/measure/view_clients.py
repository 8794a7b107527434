#!/usr/bin/env python3
"""Connects clients to the live page for some time, to measure what they cost the tracker. READING clients request
everything, read it and acknowledge it; STUCK clients request everything and never read. Prints as JSON what the reading
clients received, and the frames dropped for all clients since the start of the program, where a client was told.
  view_clients.py PORT READING STUCK SECONDS [--foxglove]      --foxglove: clients as Foxglove instead of browsers"""
import json
import os
import socket
import struct
import sys
import threading
import time

SMALL_BUFFER = 1 << 16  # bytes; so that a client that does not read is stuck at once


class Client:
    """One WebSocket connection."""

    def __init__(self, port, path, more=""):
        self.socket = socket.socket()
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, SMALL_BUFFER)
        self.socket.connect(("localhost", port))
        self.socket.sendall((f"GET {path} HTTP/1.1\r\nHost: localhost:{port}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
                             f"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n{more}\r\n").encode())
        self.stream = self.socket.makefile("rb")
        status = self.stream.readline()
        if b" 101 " not in status:
            raise SystemExit(f"the connection was refused: {status.decode().strip()}")
        while self.stream.readline().strip():
            pass
        self.frames = self.size = self.dropped = 0

    def send(self, message):
        text, mask = json.dumps(message).encode(), os.urandom(4)
        length = bytes([0x80 | len(text)]) if len(text) < 126 else bytes([0xfe]) + struct.pack(">H", len(text))
        self.socket.sendall(b"\x81" + length + mask + bytes(c ^ mask[i % 4] for i, c in enumerate(text)))

    def close(self):
        self.socket.shutdown(socket.SHUT_RDWR)
        self.stream.close()
        self.socket.close()

    def receive(self):
        """Reads the next WebSocket frame; returns (opcode, payload)."""
        first, length = self.stream.read(2)
        if length == 126:
            length, = struct.unpack(">H", self.stream.read(2))
        elif length == 127:
            length, = struct.unpack(">Q", self.stream.read(8))
        return first & 15, self.stream.read(length)


class Browser(Client):
    """Asks for what the page asks for."""

    def __init__(self, port, reads):
        super().__init__(port, "/live")
        self.send({"type": "want", "cloud": "hand", "picture": "colour", "window": 2 if reads else 0})

    def read_once(self):
        opcode, payload = self.receive()
        if opcode == 2:
            self.frames, self.size = self.frames + 1, self.size + len(payload)
            self.send({"type": "ack"})
        elif opcode == 1 and (health := json.loads(payload).get("health")):
            self.dropped = next(queue["dropped"] for queue in health["queues"] if queue["name"] == "view")


class Viewer(Client):
    """Subscribes to every topic, as Foxglove may."""

    def __init__(self, port, reads):
        super().__init__(port, "/", "Sec-WebSocket-Protocol: foxglove.websocket.v1\r\n")
        self.channels = 0
        while not reads and self.channels == 0:
            self.read_once()

    def read_once(self):
        opcode, payload = self.receive()
        if opcode == 2:
            self.size += len(payload)
            self.frames += payload[1] == self.first  # messages of one topic
        elif opcode == 1 and (message := json.loads(payload))["op"] == "advertise":
            ids = [channel["id"] for channel in message["channels"]]
            self.first = ids[0] if self.channels == 0 else self.first
            self.channels += len(ids)
            self.send({"op": "subscribe", "subscriptions": [{"id": one, "channelId": one} for one in ids]})


def read_until(client, end):
    while time.time() < end:
        client.read_once()
    client.close()


def watch(port, reading, stuck, seconds, kind):
    """Connects clients of a kind for some time, and returns what they received."""
    stuck_clients = [kind(port, False) for _ in range(stuck)]
    clients, end = [kind(port, True) for _ in range(reading)], time.time() + seconds
    threads = [threading.Thread(target=read_until, args=(client, end)) for client in clients]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    time.sleep(max(0, end - time.time()))
    for client in stuck_clients:
        client.close()
    return {"received_a_second": [client.frames / seconds for client in clients],
            "kilobytes_a_frame": [client.size / max(client.frames, 1) / 1000 for client in clients],
            "dropped": max([client.dropped for client in clients], default=0)}


if __name__ == "__main__":
    arguments = [word for word in sys.argv[1:] if word != "--foxglove"]
    print(json.dumps(watch(int(arguments[0]), int(arguments[1]), int(arguments[2]), float(arguments[3]),
                           Viewer if "--foxglove" in sys.argv else Browser)))
