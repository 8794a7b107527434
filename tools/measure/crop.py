#!/usr/bin/env python3
"""Crops a recording so that the border of its image cuts the hand: of all ends of segments in all frames, a quarter lies
beyond the border on that side.
  tools/measure/crop.py RECORDING left|right|top|bottom OUT      RECORDING: a folder with truth.csv"""
import csv
import json
import os
import shutil
import sys

import cv2
import numpy as np

BEYOND = 0.25  # share of the ends of segments beyond the border


def region(recording, side, camera):
    """First and last column and row of the region to keep, the last ones excluded."""
    with open(f"{recording}/truth.csv", encoding="utf-8") as file:
        ends = np.array([[float(row[key]) for key in ("dx", "dy", "dz")] for row in csv.DictReader(file)])
    u = camera["fx"] * ends[:, 0] / ends[:, 2] + camera["cx"]
    v = camera["fy"] * ends[:, 1] / ends[:, 2] + camera["cy"]
    border = int(np.quantile(u if side in ("left", "right") else v, BEYOND if side in ("left", "top") else 1 - BEYOND))
    whole = {"left": 0, "right": camera["width"], "top": 0, "bottom": camera["height"]}
    return {**whole, side: border}


def main(recording, side, out):
    with open(f"{recording}/camera.json", encoding="utf-8") as file:
        camera = json.load(file)
    kept = region(recording, side, camera)
    os.makedirs(out)
    for kind in "depth", "rgb":
        shutil.copy(f"{recording}/{kind}.txt", out)
        os.makedirs(f"{out}/{kind}")
        with open(f"{recording}/{kind}.txt", encoding="utf-8") as file:
            names = [line.split()[1] for line in file if not line.startswith("#")]
        for name in names:
            image = cv2.imread(f"{recording}/{name}", cv2.IMREAD_UNCHANGED)
            cv2.imwrite(f"{out}/{name}", image[kept["top"]:kept["bottom"], kept["left"]:kept["right"]])

    # The camera's principal point moves with the image; the truth does not.
    camera["width"], camera["height"] = kept["right"] - kept["left"], kept["bottom"] - kept["top"]
    camera["cx"], camera["cy"] = camera["cx"] - kept["left"], camera["cy"] - kept["top"]
    with open(f"{out}/camera.json", "w", encoding="utf-8") as file:
        json.dump(camera, file)
    for name in "truth.csv", "hand.json":
        shutil.copy(f"{recording}/{name}", out)


if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[2] not in ("left", "right", "top", "bottom"):
        sys.exit(__doc__)
    main(*sys.argv[1:])
