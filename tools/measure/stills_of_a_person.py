#!/usr/bin/env python3
"""Makes a recording of depth images of a real person that lie in a public repository: each image stands still for a third
of a second, so that the hand leaps from one to the next. Their fingertips were labelled by eye.
  git clone https://github.com/LadaOndris/hand-recognition RECORDINGS/hand-recognition    # MIT licence
  tools/measure/stills_of_a_person.py RECORDINGS/hand-recognition/datasets/custom/20210326-230536 OUT
  git clone https://github.com/edoRemelli/hadjust RECORDINGS/hadjust                      # no licence: for measuring alone
  tools/measure/stills_of_a_person.py RECORDINGS/hadjust/data/USER1 OUT"""
import csv
import glob
import json
import os
import re
import shutil
import sys

FRAMES = 10  # of each image, at 30 per second; the last one is labelled
# An Intel RealSense SR305 as its repository describes it (datasets/custom/readme.txt): pixels, and 0.125 mm of depth.
SR305 = {"width": 640, "height": 480, "fx": 476.007, "fy": 476.007, "cx": 313.683, "cy": 242.755,
         "depth_units_per_metre": 8000, "fps": 30}
# An Intel RealSense SR300 at half its resolution, as its repository uses it (main/MAIN_CALIBRATE.m).
SR300 = {"width": 320, "height": 240, "fx": 287.26, "fy": 287.26, "cx": 160, "cy": 120, "depth_units_per_metre": 1000,
         "fps": 30}
CAMERAS = {"20210326-230536": SR305, "20210326-231615": SR305, "USER1": SR300}
LABELS = os.path.splitext(__file__)[0] + ".csv"


def images_of(stills):
    """Paths of the depth images by their numbers: of files N.png, or of files N/depth.png."""
    paths = glob.glob(f"{stills}/*.png") or glob.glob(f"{stills}/*/depth.png")
    return dict(sorted((int(re.search(r"(\d+)(?:/depth)?\.png$", path)[1]), path) for path in paths))


def main(stills, out):
    sequence = os.path.basename(stills.rstrip("/"))
    camera, images = CAMERAS[sequence], images_of(stills)
    with open(LABELS, encoding="utf-8") as file:
        labels = [row for row in csv.DictReader(line for line in file if line[0] != "#") if row["sequence"] == sequence]
    os.makedirs(f"{out}/depth")
    for number, path in images.items():
        shutil.copy(path, f"{out}/depth/{number}.png")
    with open(f"{out}/camera.json", "w", encoding="utf-8") as file:
        json.dump(camera, file)
    with open(f"{out}/depth.txt", "w", encoding="utf-8") as file:
        for i, number in enumerate(images):
            for frame in range(FRAMES * i, FRAMES * (i + 1)):
                print(f"{frame / camera['fps']:.6f} depth/{number}.png", file=file)
    with open(f"{out}/fingertips_2d.csv", "w", encoding="utf-8") as file:
        print("frame,finger,u,v,visible", file=file)
        for label in labels:
            frame = FRAMES * list(images).index(int(label["image"])) + FRAMES - 1
            print(f"{frame},{label['finger']},{label['u']},{label['v']},1", file=file)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
