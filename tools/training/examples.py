"""Examples for the networks: scenes as inputs of a network, with the outputs that it should give. The program prepares
its inputs in the same way in stages/detection/networks.cpp."""
from dataclasses import dataclass, fields, is_dataclass
from typing import Any, Callable, Sequence

import torch
from torch import Tensor

from scenes.chance import Chance
from scenes.scene import Generator, Scenes

MAP_STEP, MAP_OFFSET = 4, 1.5  # the centre of cell i of a map is pixel i * MAP_STEP + MAP_OFFSET
CROP_DEPTH = 0.15  # a window shows depths up to this far in front of and behind the palm [m]
_LEAST_PIXELS = {"full": 25, "crop": 150}  # smallest number of pixels of a hand that counts as seen


@dataclass
class Examples:
    """B examples with two hands each, of which the first one is the hand in question. `image` [B, 2, H, W]; `label` [B,
    H, W]; `uv` [B, 2, N, 2, pixels] and `depth` [B, 2, N] of the N joints (crop) or of the palm (full) of both hands;
    `seen` [B, 2]: whether a hand has enough pixels to count; `right` [B]: whether the first hand looks like a right one
    in the image; `mm` [B]: millimetres per pixel at the palm."""
    image: Tensor
    label: Tensor
    uv: Tensor
    depth: Tensor
    seen: Tensor
    right: Tensor
    mm: Tensor
    scenes: Scenes


def full_input(depth: Tensor) -> Tensor:
    """The input [B, 2, H, W] (depth, validity) for whole frames [B, H, W, m; 0: no depth]."""
    valid = depth > 0
    return torch.stack([torch.where(valid, (depth - 1).clamp(-1, 1.5), torch.full_like(depth, 1.5)), valid.float()], 1)


def crop_input(depth: Tensor, middle: Tensor) -> Tensor:
    """The input [B, 2, H, W] (depth, validity) for windows around palms at the depths `middle` [B, m]."""
    valid = depth > 0
    near = ((depth - middle[:, None, None]) / CROP_DEPTH).clamp(-1, 1)
    return torch.stack([torch.where(valid, near, torch.ones_like(depth)), valid.float()], 1)


def make_examples(generator: Generator, name: str, count: int) -> Examples:
    """A batch of `count` examples for the network `name`."""
    with torch.no_grad():
        return _full(generator, count) if name == "full" else _crop(generator, count)


def _full(generator: Generator, count: int) -> Examples:
    scenes = generator.frames(count)
    palms = scenes.palms()
    uv = scenes.view.project(palms)[:, :, None]
    inside = ((uv[:, :, 0] > -4) & (uv[:, :, 0] < uv.new_tensor([164.0, 124.0]))).all(-1)
    return Examples(full_input(scenes.depth), scenes.label, uv, palms[..., 2:], (scenes.pixels >= _LEAST_PIXELS["full"]) & inside,
                    scenes.right[:, 0], 1e3 * palms[:, 0, 2] / scenes.view.focal, scenes)


def _crop(generator: Generator, count: int) -> Examples:
    """Windows in which the hand looks like a right one: windows of left hands are mirrored. 15 % show a left hand
    instead, so that the network learns to distinguish the sides."""
    scenes, chance = generator.windows(count), generator.chance
    mirror = torch.where(chance.flag(0.15, count), scenes.right[:, 0], ~scenes.right[:, 0])
    image = crop_input(scenes.depth, scenes.middle[:, 2])
    image = torch.where(mirror[:, None, None, None], image.flip(3), image)
    label = torch.where(mirror[:, None, None], scenes.label.flip(2), scenes.label)
    u = torch.where(mirror[:, None, None], image.shape[3] - 1 - scenes.uv[..., 0], scenes.uv[..., 0])
    depth = (scenes.joints[..., 2] - scenes.middle[:, None, None, 2]) / CROP_DEPTH
    return Examples(image, label, torch.stack([u, scenes.uv[..., 1]], -1), depth, scenes.pixels >= _LEAST_PIXELS["crop"],
                    scenes.right[:, 0] != mirror, 1e3 * scenes.middle[:, 2] / scenes.view.focal, scenes)


def drawn(groups: Sequence[Examples], size: int) -> Examples:
    """`size` examples of up to four of the groups. PyTorch's own generator of random numbers draws them."""
    chosen = [groups[i] for i in torch.randperm(len(groups))[:4].tolist()]
    shares = [(size + i) // len(chosen) for i in range(len(chosen))]
    return _each([_rows(group, torch.randperm(len(group.image))[:share]) for group, share in zip(chosen, shares)], torch.cat)


def _rows(examples: Examples, rows: Tensor) -> Examples:
    return _each([examples], lambda values: values[0][rows])


def _each(values: Sequence[Any], function: Callable[[Sequence[Tensor]], Tensor]) -> Any:
    """The `function` of equally named tensors of dataclasses; what is no tensor is taken from the first one."""
    if isinstance(values[0], Tensor):
        return function(values)
    if is_dataclass(values[0]):
        return type(values[0])(*(_each([getattr(value, field.name) for value in values], function)
                                 for field in fields(values[0])))
    return values[0]


def generator_for(seed: int, device: str, mesh, points: int, **options: Any) -> Generator:
    """A generator of scenes with its own stream of random numbers. `points`: number of skin points per hand."""
    return Generator(Chance(seed, device), mesh, points, **options)
