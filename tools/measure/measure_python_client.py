#!/usr/bin/env python3
"""Measures whether the Python client receives every frame. The frames of a log in which all its hands have a pose are sent
repeatedly and at a given rate, by lcm-logplayer over UDP, or by `barehand view` over its WebSocket; a client evaluates every outlet of every
hand. Prints the numbers of frames that were sent, received and lost, and the client's processor time.
  measure_python_client.py [--page] [--json FILE] STATES.lcmlog [RATE] [SECONDS]
A log of `barehand track --states-log`; 60 Hz, 60 s. Needs the Python package (PYTHONPATH=build/release/clients/python), and
lcm-logplayer and a multicast route, or barehand."""
import argparse
import json
import os
import re
import struct
import subprocess
import sys
import tempfile
import time

import barehand
from barehand import log
from barehand.counts import Counts

URL = f"udpm://239.255.76.67:{20000 + os.getpid() % 40000}?ttl=0"
START = 1_700_000_000_000_000  # time of the first frame, microseconds
OUTLETS = ("openxr26", "webxr25", "mano21", "glove22", "joint_angles", "confidence")


def frames_of(path):
    """The messages of each frame of a log, [(channel, bytes), ...], without the frames in which fewer hands have a pose than
    in others. Messages of one frame have the same time stamp."""
    poses = {hands.utime: len(hands) for hands in barehand.hands(path)}
    frames = {}
    for stamp, channel, data in log.events(path, Counts()):
        if channel.endswith((b"HAND_STATE", b"GLOVE_STATE", b"HAND_JOINTS")):
            frames.setdefault(stamp, []).append((channel, data))
    most = max(poses.values())
    return [frame for stamp, frame in frames.items() if poses[stamp] == most]


def write_repeated(frames, path, rate, seconds):
    """Writes a log in which the frames repeat at the given rate, each with a time and a number of its own, with which every
    message begins; returns the number of frames."""
    count = round(rate * seconds)
    with open(path, "wb") as file:
        for number in range(count):
            time_us = round(1e6 * number / rate)
            for channel, data in frames[number % len(frames)]:
                data = data[:8] + struct.pack(">qq", START + time_us, number) + data[24:]
                log.write_event(file, number, time_us, channel, data)
    return count


def start_network(path):
    """Plays the log on LCM. Returns (stream, player)."""
    live = barehand.hands(URL, timeout=10)
    return live, subprocess.Popen(["lcm-logplayer", "-l", URL, path], stdout=subprocess.DEVNULL)


def start_page(path):
    """Plays the log on a live page; it begins when the client connects. Returns (stream, player)."""
    server = subprocess.Popen(["barehand", "view", path, "--port", "0"], stderr=subprocess.PIPE, text=True)
    port = re.search(r"http://[^ ]*:(\d+)", server.stderr.readline())[1]
    return barehand.hands(f"ws://localhost:{port}", timeout=10), server


def listen(live, sent):
    """Takes every outlet of every hand until all frames are heard, or none comes any more. Returns (frames, hands)."""
    heard, hands_heard = set(), 0
    try:
        for hands in live:
            for hand in hands:
                for outlet in OUTLETS:
                    getattr(hand, outlet)()
                hands_heard += 1
            heard.add(hands.frame_number)
            if len(heard) == sent:
                break
    except barehand.Error as error:  # frames were lost, so the expected number is never reached
        print(error)
    return len(heard), hands_heard


def main(options):
    with tempfile.TemporaryDirectory() as folder:
        path = f"{folder}/repeated.lcmlog"
        sent = write_repeated(frames_of(options.states), path, options.rate, options.seconds)
        live, player = (start_page if options.page else start_network)(path)
        start, busy = time.monotonic(), time.process_time()
        heard, hands_heard = listen(live, sent)
        wall, busy = time.monotonic() - start, 1e3 * (time.process_time() - busy) / max(heard, 1)
        live.close()
        player.terminate()
        player.wait()
    print(f"sent {sent} frames at {options.rate:g} Hz, heard {heard} with {hands_heard} hands in {wall:.1f} s; "
          f"not heard: {live.counts.trouble() or 'nothing'}; {busy:.2f} ms of processor time a frame")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump({"client": {"sent": sent, "heard": heard, "hands": hands_heard, "cpu_ms_per_frame": busy}}, file)


def options_of_command_line():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("states", metavar="STATES.lcmlog")
    parser.add_argument("rate", metavar="RATE", type=float, nargs="?", default=60, help="frames a second")
    parser.add_argument("seconds", metavar="SECONDS", type=float, nargs="?", default=60)
    parser.add_argument("--page", action="store_true", help="over the WebSocket instead of LCM")
    parser.add_argument("--json", metavar="FILE", help="file for the figures")
    return parser.parse_args()


main(options_of_command_line())
