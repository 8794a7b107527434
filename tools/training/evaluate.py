#!/usr/bin/env python3
"""Measures how good networks are on scenes and people that were not part of the training.

  evaluate.py FOLDER           measures full.onnx and crop.onnx of a folder with OpenCV (Debian package python3-opencv)
"""
import argparse
import json
from pathlib import Path
from typing import Callable

import torch
from torch import Tensor

from examples import MAP_OFFSET, MAP_STEP, Examples, generator_for, make_examples
from export import opencv_network
from hands_folder import add_hands_option, right_hand
from losses import joint_errors_mm
from network import LABELS
from scenes.lookalikes import FEET
from scenes.scene import Generator
from scenes.sensors import KINDS

UNSEEN_SEED = 1_000_004  # seed whose people and scenes are in no batch of the training
_LEAST_PALM = 0.2  # the program ignores palms with a smaller value in the map (its default configuration)
_HAND_KEYS = ("log odds of a hand", "shows a hand", "shows none")  # kept for each window
_APART = 60.0  # a peak farther than this from every palm is a false one [mm]


def evaluate(network: Callable[[Tensor], tuple], name: str, generator: Generator, batches: int,
             size: int) -> dict[str, float]:
    """Figures of a network over batches * size scenes on the generator's device: percentages unless their names say
    mm."""
    parts: list[dict[str, torch.Tensor]] = []
    for _ in range(batches):
        truth = make_examples(generator, name, size)
        with torch.no_grad():
            output = network(truth.image)
        parts.append({**(_palms if name == "full" else _joints)(output, truth), **_labels(output, truth)})
    together = {key: torch.cat([part[key] for part in parts]).float() for key in parts[0]}
    told = _told(*(together.pop(key) for key in _HAND_KEYS)) if name == "crop" else {}
    return {key: _figure(key, values) for key, values in together.items()} | told


def _told(odds: Tensor, hand: Tensor, none: Tensor) -> dict[str, float]:
    """Which hands have higher log odds than nearly all windows without one."""
    return {f"hands told with {100 * false:g} % of other windows":
            round(100 * (odds[hand > 0] > odds[none > 0].quantile(1 - false)).float().mean().item(), 2) for false in (0.01, 0.05)}


def _figure(key: str, values: torch.Tensor) -> float:
    """The figure `key` of the values of all scenes: their median, 90th percentile or mean."""
    values = values[~values.isnan()]
    if len(values) == 0:
        return float("nan")
    if "median" in key:
        return round(values.median().item(), 2)
    if "90 %" in key:
        return round(values.kthvalue(max(1, round(0.9 * len(values)))).values.item(), 2)
    return round(values.mean().item() * (1 if "mm" in key else 100), 2)


def _labels(output: tuple, truth: Examples) -> dict[str, torch.Tensor]:
    """Intersection over union of each label, for every scene with at least 20 pixels of it."""
    predicted, true = output[1].argmax(1), truth.label[:, ::2, ::2]
    figures = {}
    for label, meaning in zip(range(1, LABELS), ("hand", "arm", "object")):
        ours, theirs = (predicted == label).flatten(1), (true == label).flatten(1)
        overlap = (ours & theirs).sum(1) / (ours | theirs).sum(1).clamp_min(1)
        figures[f"overlap of {meaning}"] = overlap[theirs.sum(1) >= 20]
    return figures


def _palms(output: tuple, truth: Examples) -> dict[str, torch.Tensor]:
    """Which palms were found, and which frames have a false palm."""
    maps = output[0][:, 0].sigmoid()
    count, rows, columns = maps.shape
    cell = torch.arange(rows * columns, device=maps.device)
    place = torch.stack([cell % columns, cell // columns], -1) * MAP_STEP + MAP_OFFSET
    distance = (place[None, None] - truth.uv).norm(dim=-1) * truth.mm[:, None, None]  # [B, 2, cells]
    near = (distance < _APART) & truth.seen[..., None]

    # A palm is found if the map is high near it; far from all palms, the map should be low.
    heat = maps.flatten(1)
    found = (heat[:, None] * near).amax(2)[truth.seen] > _LEAST_PALM
    far = (heat * ~near.any(1)).amax(1) > _LEAST_PALM
    none = truth.scenes.pixels.sum(1) == 0
    feet = none & (truth.scenes.lookalike == FEET)
    return {"palms found": found, "frames with a false palm": far, "frames without a hand with a false palm": far[none],
            "frames of feet with a false palm": far[feet]}


def _joints(output: tuple, truth: Examples) -> dict[str, torch.Tensor]:
    """Errors of the joints of right hands, whether the side is correct in each window, and false hands."""
    usable = truth.seen[:, 0] & truth.right
    errors = joint_errors_mm(output[0], truth)[usable]
    sensor, grasp = truth.scenes.sensor[usable], truth.scenes.grasp[usable]
    side = (output[2][:, 0] > 0) == truth.right
    hand = (output[1].argmax(1) == 1).flatten(1).float().mean(1)
    figures = {"joints, mm": errors.flatten(), "joints, median mm": errors.flatten(), "joints, 90 % mm": errors.flatten(),
               "joints of free hands, mm": errors[~grasp].flatten(), "joints in grasps, mm": errors[grasp].flatten()}
    for index, kind in enumerate(KINDS):
        figures[f"joints, {kind}, mm"] = errors[sensor == index].flatten()
    figures["sides right"] = side[truth.seen[:, 0]]
    figures |= dict(zip(_HAND_KEYS, (output[3][:, 0], truth.seen[:, 0], truth.scenes.pixels[:, 0] == 0)))
    figures["share of a window without a hand that is labelled as hand"] = hand[truth.scenes.pixels[:, 0] == 0]
    return figures


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--scenes", type=int, default=256, help="of each kind (default: 256)")
    add_hands_option(parser)
    options = parser.parse_args()
    torch.set_num_threads(1)
    figures = {}
    for name in ("crop", "full"):
        generator = generator_for(UNSEEN_SEED, "cpu", right_hand(options.hands), 12000)
        network = opencv_network(name, options.folder)
        figures[name] = evaluate(network, name, generator, max(1, options.scenes // 32), 32)
    print(json.dumps(figures, indent=1))


if __name__ == "__main__":
    main()
