#!/usr/bin/env python3
"""Connects clients to the live page for some time, to measure what they cost the tracker. READING clients request
everything, read it and acknowledge it; STUCK clients request everything and never read. Prints as JSON what the reading
clients received, and the frames dropped for all clients since the start of the program, where a client was told.
  PYTHONPATH=build/release/clients/python view_clients.py PORT READING STUCK SECONDS [--foxglove]
--foxglove: clients as Foxglove instead of browsers"""
import argparse
import json
import time
from concurrent.futures import ThreadPoolExecutor

from barehand.websocket import BINARY, TEXT, WebSocket

SMALL_BUFFER = 1 << 16  # bytes; so that a client that does not read is stuck at once
PATIENCE = 10           # seconds in which the tracker must answer


class Client:
    """A connection that counts what it receives."""

    def __init__(self, port, path, protocol=""):
        self.socket = WebSocket("localhost", port, path, PATIENCE, protocol, SMALL_BUFFER)
        self.frames = self.size = self.dropped = 0

    def send(self, message):
        self.socket.send(json.dumps(message).encode())

    def read_until(self, end):
        """Reads until a time of the monotonic clock, and leaves."""
        while (left := end - time.monotonic()) > 0:
            if message := self.socket.receive(left):
                self.take(*message)
        self.socket.close()


class Browser(Client):
    """Asks for what the page asks for."""

    def __init__(self, port, reads):
        super().__init__(port, "/live")
        self.send({"type": "want", "cloud": "hand", "picture": "colour", "window": 2 if reads else 0})

    def take(self, kind, payload):
        if kind == BINARY:
            self.frames, self.size = self.frames + 1, self.size + len(payload)
            self.send({"type": "ack"})
        elif kind == TEXT and (health := json.loads(payload).get("health")):
            self.dropped = next(queue["dropped"] for queue in health["queues"] if queue["name"] == "view")


class Viewer(Client):
    """Subscribes to every topic, as Foxglove may. The messages of the first topic are counted as frames."""

    def __init__(self, port, reads):
        super().__init__(port, "/", "foxglove.websocket.v1")
        self.first = None
        while not reads and self.first is None:
            message = self.socket.receive(PATIENCE)
            if not message:
                raise ConnectionError(f"no topics within {PATIENCE} s")
            self.take(*message)

    def take(self, kind, payload):
        if kind == BINARY:
            self.size += len(payload)
            self.frames += int.from_bytes(payload[1:5], "little") == self.first  # the number of the subscription
        elif (message := json.loads(payload))["op"] == "advertise":
            ids = [channel["id"] for channel in message["channels"]]
            self.first = ids[0] if self.first is None else self.first
            self.send({"op": "subscribe", "subscriptions": [{"id": one, "channelId": one} for one in ids]})


def watch(port, reading, stuck, seconds, kind):
    """Connects clients of a kind for some time, and returns what they received."""
    stuck_clients = [kind(port, False) for _ in range(stuck)]
    clients, end = [kind(port, True) for _ in range(reading)], time.monotonic() + seconds
    with ThreadPoolExecutor(max(1, reading)) as pool:
        list(pool.map(lambda client: client.read_until(end), clients))  # raises what a client raised
    time.sleep(max(0, end - time.monotonic()))
    for client in stuck_clients:
        client.socket.close()
    return {"received_a_second": [client.frames / seconds for client in clients],
            "kilobytes_a_frame": [client.size / max(client.frames, 1) / 1000 for client in clients],
            "dropped": max([client.dropped for client in clients], default=0)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, type_ in (("port", int), ("reading", int), ("stuck", int), ("seconds", float)):
        parser.add_argument(name, metavar=name.upper(), type=type_)
    parser.add_argument("--foxglove", action="store_true")
    options = parser.parse_args()
    kind = Viewer if options.foxglove else Browser
    print(json.dumps(watch(options.port, options.reading, options.stuck, options.seconds, kind)))


if __name__ == "__main__":
    main()
