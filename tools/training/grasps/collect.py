#!/usr/bin/env python3
"""Tracks simulated grasps, and keeps of each what the training and `barehand eval --grasps` read.

    tools/training/grasps/collect.py OUT --first 0 --count 68          # for training
    tools/training/grasps/collect.py OUT --first 1000000 --count 68    # for testing: other objects, other hands

Successive seeds show successive classes; after all 17, the simulated sensor changes. OUT/SEED.lcmlog holds the states, and
OUT/SEED.csv the truth as in grasps.csv of a recording (docs/formats.md). Sequences that are there already are left as
they are. The same seeds give the same files.
"""
import argparse
import subprocess
import sys
from pathlib import Path

CLASSES = ("wrap", "index_extension", "thumb_along", "ring", "sphere_3", "sphere_4", "extension", "adduction",
           "tripod_variation", "lateral_tripod", "lateral", "pinch", "tripod", "quadpod", "five_fingers",
           "parallel_extension", "writing_tripod")
NOISES = ("kinect", "tof")
SECONDS, GRASPED, RELEASING = 5.3, 1.9, 4.2  # times of the sequence `grasp` (drivers/synthetic/grasps/varied_grasp.cpp)


def collect(a, seed):
    """Makes the files of one sequence."""
    grasp, noise = CLASSES[seed % len(CLASSES)], NOISES[seed // len(CLASSES) % len(NOISES)]
    log, truth = a.out / f"{seed}.lcmlog", a.out / f"{seed}.csv"
    if truth.exists() and log.exists():
        return
    source = f"sim:grasp,grasp={grasp},seed={seed},noise={noise},fps={a.fps}"
    command = [a.barehand, "track", "--source", source, "--no-publish", "--overwrite", "--states-log", str(log), *a.track]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"collect.py: {' '.join(command)}\n{done.stderr}")

    # Write the truth, which is known without rendering the sequence once more.
    with open(truth, "w", encoding="ascii") as table:
        table.write("utime,grasp\n")
        for frame in range(int(SECONDS * a.fps) + 1):
            time = frame / a.fps
            table.write(f"{1_000_000 + round(frame * 1e6 / a.fps)},{grasp if GRASPED < time < RELEASING else 'none'}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--first", type=int, required=True, help="first seed")
    parser.add_argument("--count", type=int, required=True, help="number of sequences")
    parser.add_argument("--fps", type=int, default=15, help="frames per second")
    parser.add_argument("--barehand", default="build/release/src/app/barehand", help="the program")
    parser.add_argument("--track", nargs=argparse.REMAINDER, default=[], help="further options of barehand track")
    a = parser.parse_args()
    a.out.mkdir(parents=True, exist_ok=True)
    for seed in range(a.first, a.first + a.count):
        collect(a, seed)


if __name__ == "__main__":
    main()
