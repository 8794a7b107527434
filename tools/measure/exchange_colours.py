#!/usr/bin/env python3
"""Copies a recording with red and blue exchanged, as a program does that sends BGR for RGB: skin is blue then.
  tools/measure/exchange_colours.py RECORDING OUT      RECORDING: a folder"""
import os
import shutil
import sys

import cv2


def main(recording, out):
    shutil.copytree(recording, out)
    for folder, _, names in os.walk(os.path.join(out, "rgb")):
        for name in names:
            path = os.path.join(folder, name)
            image = cv2.imread(path, cv2.IMREAD_COLOR)
            os.remove(path)
            cv2.imwrite(path, image[:, :, ::-1])


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
