#!/usr/bin/env python3
"""Makes a recording of depth images of a real person that lie in a public repository (MIT licence): each image stands
still for a third of a second, so that the hand leaps from one to the next. Their fingertips were labelled by eye.
  git clone https://github.com/LadaOndris/hand-recognition RECORDINGS/hand-recognition
  tools/measure/stills_of_a_person.py RECORDINGS/hand-recognition/datasets/custom/20210326-230536 OUT"""
import csv
import json
import os
import shutil
import sys

FRAMES = 10  # of each image, at 30 per second; the last one is labelled
# An Intel RealSense SR305 as the repository describes it (datasets/custom/readme.txt): pixels, and 0.125 mm of depth.
CAMERA = {"width": 640, "height": 480, "fx": 476.007, "fy": 476.007, "cx": 313.683, "cy": 242.755,
          "depth_units_per_metre": 8000, "fps": 30}
LABELS = os.path.splitext(__file__)[0] + ".csv"


def main(stills, out):
    sequence = os.path.basename(stills.rstrip("/"))
    images = sorted((name for name in os.listdir(stills) if name.endswith(".png")), key=lambda name: int(name[:-4]))
    with open(LABELS, encoding="utf-8") as file:
        labels = [row for row in csv.DictReader(line for line in file if line[0] != "#") if row["sequence"] == sequence]
    os.makedirs(f"{out}/depth")
    for name in images:
        shutil.copy(f"{stills}/{name}", f"{out}/depth/{name}")
    with open(f"{out}/camera.json", "w", encoding="utf-8") as file:
        json.dump(CAMERA, file)
    with open(f"{out}/depth.txt", "w", encoding="utf-8") as file:
        for frame in range(FRAMES * len(images)):
            print(f"{frame / CAMERA['fps']:.6f} depth/{images[frame // FRAMES]}", file=file)
    with open(f"{out}/fingertips_2d.csv", "w", encoding="utf-8") as file:
        print("frame,finger,u,v,visible", file=file)
        for label in labels:
            frame = FRAMES * images.index(f"{label['image']}.png") + FRAMES - 1
            print(f"{frame},{label['finger']},{label['u']},{label['v']},1", file=file)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
