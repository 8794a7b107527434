#!/usr/bin/env python3
"""Checks that the file of `track --mcap` agrees with the messages on LCM (joint states, transforms) and with the frames
(depth, colour, intrinsics). It is read by code that is independent of the program. First checks that a changed value is
found.
  agreement.py BAREHAND LCMTYPES CONFIG"""
import glob
import json
import math
import os
import struct
import subprocess
import sys
import tempfile

import cv2
import numpy

from ros_mcap import McapFile

TOLERANCE = 1e-6
LOSSY = 3  # mean difference that JPEG may make, of 255
SEGMENTS = ["palm", "thumb_metacarpal", "thumb_proximal", "thumb_distal"] + [
    f"{finger}_{part}" for finger in ["index", "middle", "ring", "little"] for part in ["proximal", "intermediate", "distal"]]


def events(path):
    """(channel, message) of an LCM log."""
    with open(path, "rb") as file:
        data = file.read()
    at = 0
    while at < len(data):
        sync, _, _, name, size = struct.unpack_from(">IQQII", data, at)
        assert sync == 0xEDA1DA01
        at += 28
        yield data[at:at + name].decode(), data[at + name:at + name + size]
        at += name + size


def close(a, b):
    return abs(a - b) <= TOLERANCE


def disagreements(mcap, states, gloves):
    """Descriptions of all differences. `states`, `gloves`: LCM messages by time and side."""
    joints = {(time, side): message for side in ["right", "left"]
              for time, _, message in mcap.of_topic(f"/{side}_hand/joint_states")}
    transforms = {time: {t["child_frame_id"]: t for t in message["transforms"]} for time, _, message in mcap.of_topic("/tf")}
    for (time, side), state in states.items():
        if not state.has_pose:
            if (time, side) in joints:
                yield f"{time}: a hand that is not tracked has joints"
            continue
        known = dict(zip(joints[time, side]["name"], joints[time, side]["position"]))
        for name, angle in zip(gloves[time, side].joint_name, gloves[time, side].joint_angle):
            if not math.isnan(angle) and not close(known.get(f"{side}_{name}", math.inf), angle):
                yield f"{time}: {side}_{name}"
        for name, segment in zip(SEGMENTS, state.segments):
            transform = transforms[time][f"{side}_{name}"]["transform"]
            position, turn = transform["translation"], transform["rotation"]
            if not all(close(position[axis], p) for axis, p in zip("xyz", segment.smoothed_position)):
                yield f"{time}: position of {side}_{name}"
            if not all(close(turn[part], q) for part, q in zip("wxyz", segment.smoothed_orientation)):
                yield f"{time}: orientation of {side}_{name}"


def image_disagreements(mcap, folder, live=False):
    """Descriptions of all differences to the images in `folder`, the recording that was tracked. `live`: colour is
    lossy, and the unit of depth is not stated."""
    with open(folder + "/depth.txt") as file:
        lines = [line.split() for line in file if not line.startswith("#")]
    depth = {round(float(time) * 1e6) * 1000: name for time, name in lines}
    with open(folder + "/camera.json") as file:
        camera = json.load(file)
    frames, seen = len(depth), {"colour": 0, "camera_info": 0}
    for time, _, image in mcap.of_topic("/camera/depth"):
        pixels = numpy.frombuffer(image["data"], "<u2").reshape(image["height"], image["width"])
        stored = cv2.imread(f"{folder}/{depth.pop(time)}", cv2.IMREAD_UNCHANGED)
        if image["encoding"] != "16UC1" or not numpy.array_equal(pixels, stored):
            yield f"{time}: depth"
    for time, number, image in mcap.of_topic("/camera/colour"):
        pixels = cv2.imdecode(numpy.frombuffer(image["data"], numpy.uint8), cv2.IMREAD_COLOR)
        stored = cv2.imread(f"{folder}/rgb/{number:06d}.png", cv2.IMREAD_COLOR)
        difference = cv2.absdiff(pixels, stored) if pixels is not None and pixels.shape == stored.shape else None
        if difference is None or (difference.mean() > LOSSY if live else difference.any()):
            yield f"{time}: colour"
        seen["colour"] += 1
    for time, _, info in mcap.of_topic("/camera/camera_info"):
        k = info["k"]
        if (info["width"], info["height"], k[0], k[4], k[2], k[5]) != tuple(
                camera[key] for key in ["width", "height", "fx", "fy", "cx", "cy"]):
            yield f"{time}: intrinsics"
        seen["camera_info"] += 1
    if depth or set(seen.values()) != {frames}:
        yield f"of {frames} frames {len(depth)} have no depth; there are {seen}"
    if not live and not close(float(mcap.topics()["/camera/depth"][1]["depth_unit"]), 1 / camera["depth_units_per_metre"]):
        yield "the unit of depth differs"


def track(barehand, lcmtypes, config, here, frames):
    """Records simulated hands into the folder `take` in `here`, tracks them, and writes hands.mcap. Returns the LCM messages
    (states, gloves) by their time and side."""
    def run(*command):
        subprocess.run(command, check=True, cwd=here, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    run("lcm-gen", "-p", *glob.glob(lcmtypes + "/*.lcm"))
    sys.path.insert(0, here)
    import barehand as lcm

    run(barehand, "record", "--source", "sim:two_hands,width=320,height=240", "--frames", str(frames), "--out", "take")
    run(barehand, "track", "--source", "folder:take", "--hand", "both", "--config", config, "--no-publish",
        "--states-log", "states.lcmlog", "--mcap", "hands.mcap")
    states, gloves = {}, {}
    for channel, data in events(here + "/states.lcmlog"):
        if channel in ("HAND_STATE", "GLOVE_STATE"):
            kind, into = (lcm.hand_state_t, states) if channel == "HAND_STATE" else (lcm.glove_state_t, gloves)
            message = kind.decode(data)
            into[message.utime * 1000, "left" if message.handedness == 0 else "right"] = message
    tracked = sum(state.has_pose for state in states.values())
    assert tracked >= 4, f"only {tracked} hands are tracked: nothing to compare"
    return states, gloves


def check_that_changes_are_noticed(mcap, states, gloves):
    before = len(list(disagreements(mcap, states, gloves)))
    key = next(key for key, state in states.items() if state.has_pose)
    angles = gloves[key].joint_angle
    gloves[key].joint_angle = [*angles[:4], angles[4] + 1e-5, *angles[5:]]
    assert len(list(disagreements(mcap, states, gloves))) == before + 1, "the check itself is broken"
    gloves[key].joint_angle = angles


def main(barehand, lcmtypes, config):
    with tempfile.TemporaryDirectory() as here:
        states, gloves = track(barehand, lcmtypes, config, here, 8)
        mcap = McapFile(here + "/hands.mcap")
        check_that_changes_are_noticed(mcap, states, gloves)
        problems = list(disagreements(mcap, states, gloves)) + list(image_disagreements(mcap, os.path.join(here, "take")))
        print("\n".join(problems) or f"{len(states)} states and {len(states) // 2} frames agree")
        sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main(*sys.argv[1:])
