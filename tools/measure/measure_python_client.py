#!/usr/bin/env python3
"""Measures whether the Python client receives every frame. lcm-logplayer sends the frames of a log of hand states by
UDP, repeatedly and at a given rate; a client evaluates every outlet of every hand. Prints the numbers of frames that
were sent, received and lost, and the client's processor time.
  measure_python_client.py STATES.lcmlog [RATE] [SECONDS]      a log of `barehand track --states-log`; 60 Hz, 60 s
Needs the Python package (PYTHONPATH=build/release/clients/python), lcm-logplayer and a multicast route."""
import os
import subprocess
import sys
import tempfile
import time

import barehand
from barehand import log
from barehand.counts import Counts

URL = f"udpm://239.255.76.67:{20000 + os.getpid() % 40000}?ttl=0"
OUTLETS = ("openxr26", "webxr25", "mano21", "glove22", "joint_angles", "confidence")


def frames_of(path):
    """The messages of each frame of a log, [(channel, bytes), ...]. Messages of one frame have the same time stamp."""
    frames = {}
    for stamp, channel, data in log.events(path, Counts()):
        if channel.endswith((b"HAND_STATE", b"GLOVE_STATE", b"HAND_JOINTS")):
            frames.setdefault(stamp, []).append((channel, data))
    return list(frames.values())


def write_repeated(frames, path, rate, seconds):
    """Writes a log in which the frames repeat at the given rate; returns the number of frames."""
    count = round(rate * seconds)
    with open(path, "wb") as file:
        for number in range(count):
            for channel, data in frames[number % len(frames)]:
                log.write_event(file, number, round(1e6 * number / rate), channel, data)
    return count


def main(path, rate=60.0, seconds=60.0):
    rate, seconds = float(rate), float(seconds)
    with tempfile.TemporaryDirectory() as folder:
        sent = write_repeated(frames_of(path), f"{folder}/repeated.lcmlog", rate, seconds)
        with barehand.hands(URL, timeout=10) as live:
            player = subprocess.Popen(["lcm-logplayer", "-l", URL, f"{folder}/repeated.lcmlog"], stdout=subprocess.DEVNULL)
            start, busy, heard, hands_heard = time.monotonic(), time.process_time(), 0, 0
            try:
                for heard, hands in enumerate(live, 1):
                    for hand in hands:
                        for outlet in OUTLETS:
                            getattr(hand, outlet)()
                        hands_heard += 1
                    if heard == sent:
                        break
            except barehand.Error as error:  # timeout: frames were lost, so the expected number is never reached
                print(error)
            wall, busy = time.monotonic() - start, time.process_time() - busy
            player.wait()
        print(f"sent {sent} frames at {rate:g} Hz, heard {heard} with {hands_heard} hands in {wall:.1f} s; "
              f"not heard: {live.counts.trouble() or 'nothing'}; {1e3 * busy / heard:.2f} ms of processor time a frame")


main(*sys.argv[1:])
