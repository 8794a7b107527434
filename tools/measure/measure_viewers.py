#!/usr/bin/env python3
"""Measures what those who watch cost the tracker, which follows a simulated hand at 640x480 and 30 Hz. Writes the figures as
JSON and prints every block.
  tests/lcm/with_multicast.sh tools/measure/measure_viewers.py browsers --json FILE [--pairs 20] [--seconds 5]
  ... foxglove                   viewers of Foxglove's protocol instead of browsers
  ... nobody                     what the server costs while nobody watches
Needs the Python package of the clients: PYTHONPATH=build/release/clients/python.
In one run of the tracker, a quick client and three stuck ones are connected in every other block. The time from capture to
publication of every frame is that of its message on LCM, by the kernel's time stamp. `barehand` is taken from PATH."""
import argparse
import glob
import json
import os
import re
import socket
import statistics
import struct
import subprocess
import sys
import threading
import time

import view_clients

GROUP, LCM_PORT = "239.255.76.67", 7667
SO_TIMESTAMPNS = 35  # of Linux; the socket module does not name it
STUCK = 3
SETTLE = 1  # seconds after clients have come or gone that are not counted
WARM_UP = 10  # seconds, in which the hand is found and the hand's size is verified


class Listener(threading.Thread):
    """Collects (time of capture, time from capture to publication) of every frame on the LCM network [s]."""

    def __init__(self):
        super().__init__(daemon=True)
        self.frames = []
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # the tracker binds the port, too
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self.socket.bind((GROUP, LCM_PORT))
        membership = socket.inet_aton(GROUP) + socket.inet_aton("127.0.0.1")
        self.socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, membership)

    def run(self):
        while True:
            packet, (about, *_), *_ = self.socket.recvmsg(65536, 64)
            magic, _, channel = *struct.unpack_from(">II", packet), packet[8:packet.index(b"\0", 8)]
            if magic == 0x4c433032 and channel == b"HAND_STATE":
                seconds, nanoseconds = struct.unpack("qq", about[2])
                utime, = struct.unpack_from(">q", packet, 8 + len(channel) + 1 + 8)  # after the hash of the type
                self.frames.append((utime * 1e-6, seconds + nanoseconds * 1e-9 - utime * 1e-6))

    def between(self, begin, end):
        return [latency for capture, latency in self.frames if begin <= capture < end]


class Tracker:
    """The tracker with the page, and the processor time of its threads."""

    def __init__(self):
        command = ["barehand", "track", "--source", "sim:grasp_ball,live=true,loop=true", "--view=0", "--lcm-url",
                   f"udpm://{GROUP}:{LCM_PORT}?ttl=0"]
        # In a session of its own, as a service: Linux shares the processor between sessions, so that the clients here do
        # not take what is the share of the tracker.
        self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT, text=True, start_new_session=True)
        for line in self.process.stdout:
            if found := re.search(r"open http://localhost:(\d+)", line):
                self.port = int(found[1])
                break
        else:
            sys.exit("the tracker did not start")
        self.said = []
        self.listener = threading.Thread(target=lambda: self.said.extend(self.process.stdout))
        self.listener.start()

    def seconds(self):
        """Its processor time so far."""
        with open(f"/proc/{self.process.pid}/stat", encoding="ascii") as file:
            return sum(map(int, file.read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")

    def server_seconds(self):
        """Processor time so far of the threads of the web server."""
        total = 0
        for task in glob.glob(f"/proc/{self.process.pid}/task/*"):
            with open(task + "/comm", encoding="ascii") as name, open(task + "/schedstat", encoding="ascii") as times:
                if name.read().startswith("civetweb"):
                    total += int(times.read().split()[0]) * 1e-9
        return total

    def stop(self):
        """Ends it; returns its closing report."""
        self.process.terminate()
        self.process.wait()
        self.listener.join()
        return "".join(self.said)


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def block(tracker, listener, seconds, kind):
    """One block of the run, watched by clients of a kind; None: by none."""
    begin, busy, clients = time.time(), tracker.seconds(), None
    if kind:
        clients = view_clients.watch(tracker.port, 1, STUCK, seconds, kind)
    else:
        time.sleep(seconds)
    end, busy = time.time(), tracker.seconds() - busy
    time.sleep(0.5)  # the clients leave, and the last frames are published
    latencies = listener.between(begin + SETTLE, end)
    result = {"frames": len(latencies), "p50": 1e3 * percentile(latencies, 0.5), "p99": 1e3 * percentile(latencies, 0.99),
              "cores": busy / (end - begin), "latencies": latencies}
    print("watched" if kind else "alone  ", *(f"{name} {result[name]:.2f}" for name in ("frames", "p50", "p99", "cores")),
          clients or "", flush=True)
    return result, clients


def watched_in_turn(tracker, listener, kind, pairs, seconds):
    """The times from capture to publication without clients and with them [ms]: the 99 % quantile over all frames of the
    blocks of a kind, and the median over pairs of blocks of its ratio. The frames a second that were tracked while clients
    watched, and that the quick client received."""
    alone, watched, received = [], [], []
    for pair in range(pairs):
        for watching in [None, kind] if pair % 2 == 0 else [kind, None]:
            result, clients = block(tracker, listener, seconds, watching)
            (watched if watching else alone).append(result)
            received += clients["received_a_second"] if watching else []
    dropped = re.search(r"dropped by .*\bview (\d+)", tracker.stop())
    all_of = [[1e3 * latency for one in blocks for latency in one["latencies"]] for blocks in (alone, watched)]
    return {"alone": percentile(all_of[0], 0.99), "watched": percentile(all_of[1], 0.99),
            "median_alone": percentile(all_of[0], 0.5), "median_watched": percentile(all_of[1], 0.5),
            "ratio": statistics.median(w["p99"] / a["p99"] for a, w in zip(alone, watched)),
            "tracked": statistics.median(one["frames"] for one in watched) / (seconds - SETTLE),
            "received": statistics.median(received), "dropped": int(dropped[1]) if dropped else 0}


def watched_by_nobody(tracker, seconds):
    """The share of a core that the server takes without clients [%]: its threads, and its stage in the pipeline."""
    server = tracker.server_seconds()
    time.sleep(seconds)
    server = (tracker.server_seconds() - server) / seconds
    frames, mean_ms = re.search(r"^ +view +(\d+) +([\d.]+)", tracker.stop(), re.MULTILINE).groups()
    return {"server": 100 * (server + int(frames) * float(mean_ms) * 1e-3 / (WARM_UP + seconds))}


def main(words):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("who", choices=["browsers", "foxglove", "nobody"])
    parser.add_argument("--json", required=True, metavar="FILE", help="file to write")
    parser.add_argument("--pairs", type=int, default=20, help="pairs of blocks, default 20")
    parser.add_argument("--seconds", type=float, default=5, help="length of a block, default 5")
    options = parser.parse_args(words)

    # Let the hand be found first.
    listener, tracker = Listener(), Tracker()
    listener.start()
    time.sleep(WARM_UP)

    # Measure.
    if options.who == "nobody":
        figures = watched_by_nobody(tracker, options.seconds)
    else:
        kind = {"browsers": view_clients.Browser, "foxglove": view_clients.Viewer}[options.who]
        figures = watched_in_turn(tracker, listener, kind, options.pairs, options.seconds)
    with open(options.json, "w", encoding="utf-8") as file:
        json.dump({"viewers": figures}, file, indent=1)
    print(json.dumps(figures, indent=1))


main(sys.argv[1:])
