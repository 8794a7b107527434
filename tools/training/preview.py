#!/usr/bin/env python3
"""Draws examples of the training data, depth above labels: preview.py OUT.png [--kind frames|windows] [--seed 1]"""
import argparse
from pathlib import Path

import numpy as np

from hands_folder import add_hands_option, right_hand
from scenes.chance import Chance
from scenes.scene import Generator

# Colours (BGR) of the labels background, hand, arm, object.
_COLOURS = np.array([[40, 40, 40], [60, 200, 60], [200, 120, 60], [60, 60, 220]], np.uint8)


def main() -> None:
    import cv2  # Debian package python3-opencv

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("out", type=Path)
    parser.add_argument("--kind", choices=("frames", "windows"), default="windows")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=12)
    add_hands_option(parser)
    options = parser.parse_args()

    generator = Generator(Chance(options.seed), right_hand(options.hands))
    scenes = getattr(generator, options.kind)(options.count)
    tiles = []
    for i in range(options.count):
        depth, middle = scenes.depth[i].numpy(), scenes.middle[i, 2].item()
        grey = np.clip((depth - middle + 0.3) / 0.7, 0, 1) if options.kind == "windows" else np.clip(depth / 2, 0, 1)
        picture = cv2.applyColorMap((255 * (1 - grey)).astype(np.uint8), cv2.COLORMAP_BONE)
        picture[depth == 0] = (60, 0, 0)
        picture, labels = (cv2.resize(x, None, fx=2, fy=2, interpolation=cv2.INTER_NEAREST)
                           for x in (picture, _COLOURS[scenes.label[i].numpy()]))
        for hand in range(2):
            for u, v in scenes.uv[i, hand].numpy() * (scenes.pixels[i, hand].item() > 0):
                cv2.circle(picture, (int(2 * u), int(2 * v)), 2, (0, 255, 255) if hand == 0 else (255, 0, 255), -1)
        tiles.append(np.vstack([picture, labels]))
    row = max(1, (options.count + 1) // 2)
    tiles += [np.zeros_like(tiles[0])] * (-len(tiles) % row)
    cv2.imwrite(str(options.out), np.vstack([np.hstack(tiles[k:k + row]) for k in range(0, len(tiles), row)]))


if __name__ == "__main__":
    main()
