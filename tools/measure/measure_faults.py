#!/usr/bin/env python3
"""Injects the faults of docs/reliability.md into the virtual OpenNI2 sensor while `barehand track` runs, and prints the
table: how many frames were tracked during each fault and how long it took until the hand was tracked again.
  tools/measure/measure_faults.py BUILD      BUILD: a build folder with tests, for example build/release"""
import csv
import os
import subprocess
import sys
import tempfile
import threading
import time

SCENE = {"sim": "grasp_ball,noise=kinect", "frames": "45"}
FAULT_SECONDS, PAUSE = 5.0, 5.0
FAULTS = [  # name, settings of the sensor during the fault, settings after it
    ("unplugged, re-plugged into another port", {"plugged": "0"}, {"plugged": "1", "uri": "virtual/2"}),
    ("stalls until it is opened again", {"fault": "stall", "cured_by_reopen": "1"},
     {"fault": "none", "cured_by_reopen": "0"}),
    ("stalls without an error", {"fault": "stall"}, {"fault": "none"}),
    ("cannot be opened after a re-plug", {"plugged": "0", "fault": "open"}, {"plugged": "1", "fault": "none"}),
    ("noise instead of depth", {"fault": "garbage"}, {"fault": "none"}),
    ("incomplete depth images", {"fault": "short"}, {"fault": "none"}),
    ("frozen picture", {"fault": "frozen"}, {"fault": "none"}),
    ("black depth and colour", {"fault": "black"}, {"fault": "none"}),
    ("colour stops", {"fault": "no_colour"}, {"fault": "none"}),
    ("black colour", {"fault": "black_colour"}, {"fault": "none"}),
    ("sensor's clock set forward by 1 h", {"clock_offset_us": "3600000000"}, {}),
    ("sensor's clock set back by 1 h", {"clock_offset_us": "0"}, {}),
    ("5 Hz", {"fps": "5"}, {"fps": "30"}),
    ("120 Hz", {"fps": "120"}, {"fps": "30"}),
]


class Sensor:
    def __init__(self, folder):
        self.path = os.path.join(folder, "control")
        self.settings = dict(SCENE)
        self.set({})

    def set(self, changes):
        self.settings.update(changes)
        with open(self.path + ".draft", "w") as file:
            file.writelines(f"{key}={value}\n" for key, value in self.settings.items())
        os.replace(self.path + ".draft", self.path)


def first_after(times, start):
    return next((t - start for t in times if t >= start), None)


def run(build, folder):
    sensor = Sensor(folder)
    table = os.path.join(folder, "result.csv")
    environment = dict(os.environ, BAREHAND_VIRTUAL_OPENNI2=sensor.path,
                       LD_LIBRARY_PATH=os.path.join(build, "tests/openni2/sdk"))
    track = subprocess.Popen(
        [os.path.join(build, "src/app/barehand"), "track", "--source", "openni2", "--no-publish", "--result", table],
        env=environment, stderr=subprocess.PIPE, text=True)
    said = []

    def listen():
        for line in track.stderr:
            said.append((time.time(), line.strip()))

    listener = threading.Thread(target=listen)
    listener.start()
    while not any("opened" in line for _, line in said):
        time.sleep(0.1)
    time.sleep(8)
    marks = []
    for name, during, afterwards in FAULTS:
        begin = time.time()
        sensor.set(during)
        time.sleep(FAULT_SECONDS)
        end = time.time()
        sensor.set(afterwards)
        time.sleep(PAUSE)
        marks.append((name, begin, end))
    stopped = time.time()
    track.terminate()
    code = track.wait()
    listener.join()
    ended = time.time() - stopped
    with open(table) as file:
        tracked = sorted({float(row["timestamp"]) for row in csv.DictReader(file)})
    return marks, tracked, said, code, ended


def main():
    build = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        marks, tracked, said, code, ended = run(build, folder)
    print("| fault, for 5 s | tracked frames meanwhile | said after [s] | tracked again after its end [s] |")
    print("|---|---|---|---|")
    for name, begin, end in marks:
        # Count frames only from a little later on: the sensor polls its control file, so that frames which were already
        # exposed still arrive.
        meanwhile = sum(begin + 0.1 <= t < end for t in tracked)
        words = first_after([t for t, line in said if line.startswith(("warning", "info: openni2"))], begin)
        words = f"{words:.1f}" if words is not None and words < FAULT_SECONDS else "-"
        print(f"| {name} | {meanwhile} | {words} | {first_after(tracked, end):.2f} |")
    print(f"\nexit code {code}, {ended:.2f} s after SIGTERM")
    print("\n".join(line for _, line in said[-12:]))


if __name__ == "__main__":
    main()
