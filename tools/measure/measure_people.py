#!/usr/bin/env python3
"""Tracks the simulated scenes with people, with `--hand both` and the mean hands, and prints the tables of
docs/accuracy_robustness.md: how soon, how often and how accurately the hand is tracked, and how often a hand is
reported in scenes without one. Even seeds show a left hand or, in scenes without a hand, have the noise of a
time-of-flight camera.
  tools/measure/measure_people.py BAREHAND OUT FIRST_SEED LAST_SEED [--recording FOLDER ...] [SCENE ...]
A recording, for example one from which cut_hand.py has removed the hand, counts as a scene without a hand."""
import csv
import math
import os
import statistics
import struct
import subprocess
import sys

WITH_HAND, WITHOUT_HAND = ["person", "desk", "egocentric"], ["empty_person", "empty_desk", "faces", "feet"]
TRACKING, EARLY = 1, 5
# Settings of scenes without a hand: frames per second (few, since they change slowly), and the noise models for even
# and for odd seeds.
RATE, NOISE = 2.5, ("tof", "kinect")
SEGMENT, CONFIDENCE = 64 * 8 + 1, 62 * 8  # size of a segment_state_t, and offset of its confidence [bytes]


def states(path):
    """Yields (frame, whether it is a right hand, status, highest confidence of a segment) for every hand state in an
    LCM log."""
    data, at = open(path, "rb").read(), 0
    while at < len(data):
        _, _, _, name_size, size = struct.unpack(">IqqII", data[at:at + 28])
        name, body = data[at + 28:at + 28 + name_size].decode(), data[at + 28 + name_size:at + 28 + name_size + size]
        at += 28 + name_size + size
        if not name.endswith("HAND_STATE"):
            continue
        frame, sensor_size = struct.unpack(">qi", body[16:28])
        side, status = struct.unpack(">bb", body[32 + sensor_size:34 + sensor_size])
        first = 59 + sensor_size  # offset of the segments, after has_pose, pose_utime, score and joint_gap [bytes]
        sure = [struct.unpack(">d", body[first + k * SEGMENT + CONFIDENCE:first + k * SEGMENT + CONFIDENCE + 8])[0]
                for k in range(16)]
        yield frame, side == 1, status, max(sure)


def run(*command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)


def track(barehand, source, out):
    run(barehand, "track", "--source", source, "--hand", "both", "--no-publish", "--threads", "1", "--overwrite",
        "--result", out + ".csv", "--states-log", out + ".lcmlog", "--log-decisions", out + ".decisions.csv")
    return list(states(out + ".lcmlog"))


def table(path):
    """The ends of all segments (proximal x, y, z, distal x, y, z) in each frame of a result table."""
    frames = {}
    for row in csv.DictReader(open(path)):
        frames.setdefault(int(row["frame"]), []).append([float(row[a + axis]) for a in "pd" for axis in "xyz"])
    return frames


def errors(result, truth, select):
    """Distances [mm] between result and truth of the ends chosen by `select`: a list for each frame that both have."""
    return [[1000 * math.dist(p[at:at + 3], q[at:at + 3]) for p, q, at in select(result[f], truth[f])]
            for f in sorted(result) if f in truth]


def both_ends(p, q):
    return [(a, b, at) for a, b in zip(p, q) for at in (0, 3)]


def tips(p, q):
    return [(p[k], q[k], 3) for k in (3, 6, 9, 12, 15)]


def hand_scene(barehand, out, scene, seed):
    """Simulates and tracks one seed of a scene with a hand; returns its figures."""
    left = seed % 2 == 0
    folder = f"{out}/{scene}_{seed}"
    run(barehand, "sim", scene, "--seed", str(seed), "--noise", "kinect", "--hand", "left" if left else "right", "--out",
        folder, "--overwrite")
    seen = track(barehand, "folder:" + folder, folder)
    truth = table(folder + "/truth.csv")
    tracked = {True: [], False: []}
    for frame, right, status, _ in seen:
        if status == TRACKING:
            tracked[right].append(frame)
    first = min(tracked[True] + tracked[False], default=None)
    result = table(folder + ("_left.csv" if left else ".csv"))
    mean = [statistics.fmean(e) for e in errors(result, truth, both_ends)]
    return {"start": first, "right_side": first is not None and first in tracked[not left],
            "other": len(tracked[left]), "tracked": len(tracked[not left]), "frames": len(truth), "mean": mean,
            "tips": [e for frame in errors(result, truth, tips) for e in frame]}


def print_hands(scene, runs):
    frames, mean = sum(r["frames"] for r in runs), [e for r in runs for e in r["mean"]]
    every_tip = sorted(e for r in runs for e in r["tips"])
    print(f"| `{scene}` | {len(runs)} | {' '.join('-' if r['start'] is None else str(r['start']) for r in runs)} "
          f"| {sum(r['start'] is not None and r['start'] <= EARLY for r in runs)} "
          f"| {sum(r['right_side'] for r in runs)} | {100 * sum(r['tracked'] for r in runs) / frames:.1f} % "
          f"| {100 * sum(r['other'] for r in runs) / frames:.1f} % | {statistics.median(mean) if mean else math.nan:.1f} "
          f"| {statistics.median(every_tip) if every_tip else math.nan:.1f} "
          f"| {every_tip[int(0.9 * len(every_tip))] if every_tip else math.nan:.1f} "
          f"| {100 * sum(e > 20 for e in mean) / max(1, len(mean)):.1f} % |", flush=True)


def print_empty(name, runs):
    """Prints the table row of a scene without a hand. runs: the hand states of every run."""
    frames = sum(len({s[0] for s in states_of}) for states_of in runs)
    tracked = sum(len({s[0] for s in states_of if s[2] == TRACKING}) for states_of in runs)
    sure = sum(len({s[0] for s in states_of if s[2] == TRACKING and s[3] > 0.5}) for states_of in runs)
    started = sum(any(s[2] == TRACKING for s in states_of) for states_of in runs)
    print(f"| `{name}` | {len(runs)} | {frames} | {started} | {tracked} | {sure} |", flush=True)


def main():
    barehand, out, first, last, *rest = sys.argv[1:]
    os.makedirs(out, exist_ok=True)
    seeds = range(int(first), int(last) + 1)
    recordings = [rest[i + 1] for i, word in enumerate(rest) if word == "--recording"]
    chosen = [w for i, w in enumerate(rest) if w != "--recording" and (i == 0 or rest[i - 1] != "--recording")]
    scenes = chosen or ([] if recordings else WITH_HAND + WITHOUT_HAND)

    print("scene, runs, first tracked frame of each, by frame 5, side right, tracked, other side tracked, mean error [mm], "
          "tips median, tips 90 %, frames off by more than 20 mm")
    for scene in WITH_HAND:
        if scene in scenes:
            print_hands(scene, [hand_scene(barehand, out, scene, seed) for seed in seeds])
    print("scene, runs, frames, runs in which a hand is seen, frames tracked, of them with a segment that is surer than 0.5")
    for scene in WITHOUT_HAND:
        if scene in scenes:
            print_empty(scene, [track(barehand, f"sim:{scene},noise={NOISE[seed % 2]},seed={seed},fps={RATE}", f"{out}/{scene}_{seed}")
                                for seed in seeds])
    for folder in recordings:
        name = os.path.basename(os.path.normpath(folder))
        print_empty(name, [track(barehand, "folder:" + folder, f"{out}/{name}")])


if __name__ == "__main__":
    main()
