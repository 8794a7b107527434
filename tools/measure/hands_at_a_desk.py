#!/usr/bin/env python3
"""Makes recordings of hands that hold things on a desk, in colour and depth, from public repositories without a licence:
for measuring alone. Neither has time stamps; 30 frames per second are assumed.
  git clone https://github.com/agpetit/RGBDTracking RECORDINGS/RGBDTracking
  tools/measure/hands_at_a_desk.py toys RECORDINGS/RGBDTracking/examples/images/imagesInteraction OUT
  git clone https://github.com/daihangpku/FoundationPose-plus-plus RECORDINGS/FoundationPose-plus-plus
  git -C RECORDINGS/FoundationPose-plus-plus checkout bc23325    # a later commit removes cup-test
  tools/measure/hands_at_a_desk.py mug RECORDINGS/FoundationPose-plus-plus/cup-test OUT"""
import glob
import json
import os
import sys

import cv2
import numpy as np

# A structured-light sensor; the focal length is that of a scene file of the repository (Tracking_RGBD_FEMDef.scn).
TOYS = {"width": 320, "height": 240, "fx": 275.0, "fy": 275.0, "cx": 160.0, "cy": 120.0}
# The colour camera of an Intel RealSense D4xx, to which depth is aligned (cam_K.txt).
MUG = {"width": 1280, "height": 720, "fx": 913.0486, "fy": 913.0863, "cx": 638.3958, "cy": 373.0506}


def toys(folder):
    """Pairs of depth [m], not finite where there is none, and colour. A depth file holds type, width and height."""
    for path in sorted(glob.glob(f"{folder}/depthfile*.txt")):
        width, height = np.fromfile(path, "<i4", 3)[1:]
        number = os.path.basename(path)[9:15]
        yield (np.fromfile(path, "<f4", offset=12).reshape(height, width), cv2.imread(f"{folder}/img1{number}.png"))


def mug(folder):
    """The same; where there is no depth, it is 65.535 m."""
    for path in sorted(glob.glob(f"{folder}/depth/*.npz")):
        name = os.path.basename(path)[:-4]
        yield np.load(path)["depth"], cv2.imread(f"{folder}/rgb/{name}.png")


def main(kind, folder, out):
    pairs, camera = {"toys": (toys, TOYS), "mug": (mug, MUG)}[kind]
    for part in "depth", "rgb":
        os.makedirs(f"{out}/{part}")
    with open(f"{out}/camera.json", "w", encoding="utf-8") as file:
        json.dump({**camera, "depth_units_per_metre": 1000, "fps": 30}, file)
    with open(f"{out}/depth.txt", "w", encoding="utf-8") as depth_list, \
         open(f"{out}/rgb.txt", "w", encoding="utf-8") as rgb_list:
        for i, (depth, colour) in enumerate(pairs(folder)):
            measured = np.isfinite(depth) & (depth > 0) & (depth < 8)
            cv2.imwrite(f"{out}/depth/{i:06d}.png", np.round(1000 * np.where(measured, depth, 0)).astype(np.uint16))
            cv2.imwrite(f"{out}/rgb/{i:06d}.png", colour)
            print(f"{i / 30:.6f} depth/{i:06d}.png", file=depth_list)
            print(f"{i / 30:.6f} rgb/{i:06d}.png", file=rgb_list)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
