"""Images in which only what has the colour of skin is left: the program looks for hands in such images, too (keep_skin
in stages/detection/depth_view.h)."""
from typing import Sequence

import torch
from torch import Tensor

from .chance import Chance
from .sensors import smooth

FAR_AWAY = 3.0  # depth of everything else, as in the program [m]
_SHARE = 0.25  # probability that an image is such a one


def keep_skin(chance: Chance, depth: Tensor, surface: Tensor, probabilities: Sequence[float]) -> tuple[Tensor, Tensor]:
    """`depth` [B, H, W, m], in some images with all else at FAR_AWAY, and what was moved there [B, H, W]. `surface` [B, H,
    W]: index of what is seen into the `probabilities` that it has the colour of skin. Patches and single pixels of what has
    it miss it, and others have it."""
    count = len(depth)
    only_skin = chance.flag(_SHARE, count)[:, None, None]
    skin = torch.zeros_like(only_skin)
    for kind, probability in enumerate(probabilities):
        skin = skin | (surface == kind) & chance.flag(probability, count)[:, None, None]
    missing = _speckles(chance, depth, 0.8, 0.12)
    false = _speckles(chance, depth, 1.0, 0.04)
    gone = only_skin & ~torch.where(skin, ~missing, false) & (depth > 0)
    return torch.where(gone, torch.full_like(depth, FAR_AWAY), depth), gone


def _speckles(chance: Chance, like: Tensor, least: float, most: float) -> Tensor:
    """Patches, where smooth noise of deviation 1 exceeds a threshold from `least` to 3, and up to the share `most` of all
    pixels [B, H, W]."""
    count = len(like)
    noise = smooth(smooth(chance.normal(1, *like.shape), 9), 9)
    patches = noise / noise.std() > chance.uniform(least, 3, count)[:, None, None]
    return patches | (chance.uniform(0, 1, *like.shape) < chance.uniform(0, most, count)[:, None, None])
