"""What the networks are trained for, and how the maps are read as positions."""
import torch
from torch import Tensor
from torch.nn import functional

from examples import CROP_DEPTH, MAP_OFFSET, MAP_STEP, Examples

_LABEL_WEIGHTS = (1.0, 1.5, 1.5, 1.5)
_PALM_RADIUS = 25.0  # mm: how wide a palm is in the full network's map


def soft_argmax(maps: Tensor) -> tuple[Tensor, Tensor]:
    """Mean column and row [B, N, 2] of the distributions that the logits [B, N, h, w] stand for, and these."""
    share = maps.flatten(2).softmax(-1).reshape(maps.shape)
    columns = torch.arange(maps.shape[3], device=maps.device, dtype=maps.dtype)
    rows = torch.arange(maps.shape[2], device=maps.device, dtype=maps.dtype)
    return torch.stack([(share.sum(2) * columns).sum(-1), (share.sum(3) * rows).sum(-1)], -1), share


def _bumps(cells: Tensor, width: Tensor, like: Tensor) -> Tensor:
    """[B, N, h, w] bell curves of height 1 around `cells` [B, N, 2] with standard deviations `width` [B]."""
    columns = torch.arange(like.shape[3], device=like.device, dtype=like.dtype)
    rows = torch.arange(like.shape[2], device=like.device, dtype=like.dtype)
    square = (columns - cells[..., 0, None, None]) ** 2 + (rows[:, None] - cells[..., 1, None, None]) ** 2
    return torch.exp(-square / (2 * width ** 2)[:, None, None, None])


def _label_loss(logits: Tensor, label: Tensor) -> Tensor:
    weights = torch.tensor(_LABEL_WEIGHTS, device=logits.device)
    return functional.cross_entropy(logits, label[:, ::2, ::2], weight=weights)


def full_loss(output: tuple[Tensor, Tensor, Tensor], truth: Examples) -> Tensor:
    """Palms as bumps, nothing elsewhere; labels."""
    maps, labels, _ = (part.float() for part in output)
    width = (_PALM_RADIUS / truth.mm / MAP_STEP).clamp(0.8, 4)
    bumps = _bumps((truth.uv[:, :, 0] - MAP_OFFSET) / MAP_STEP, width, maps) * truth.seen[:, :, None, None]
    bump = bumps.amax(1)
    miss = functional.binary_cross_entropy_with_logits(maps[:, 0], bump, reduction="none")
    return 5 * (miss * (1 + 20 * bump)).mean() + _label_loss(labels, truth.label)


def crop_loss(output: tuple[Tensor, Tensor, Tensor], truth: Examples) -> Tensor:
    """Joints of right hands in the image and in depth, peaked maps, labels, side."""
    maps, labels, side = (part.float() for part in output)
    logits, depths = maps.chunk(2, 1)
    cells, share = soft_argmax(logits)
    target = (truth.uv[:, 0] - MAP_OFFSET) / MAP_STEP

    # Joints outside of the window and hands that are not seen do not count.
    inside = ((target > -1) & (target < logits.shape[3])).all(-1)
    weight = (inside & (truth.seen[:, 0] & truth.right)[:, None]).float()
    mean = lambda values: (values * weight).sum() / weight.sum().clamp_min(1)
    across = mean(functional.smooth_l1_loss(cells, target, reduction="none", beta=0.5).sum(-1))
    ahead = mean(functional.smooth_l1_loss((share * depths).sum((2, 3)), truth.depth[:, 0], reduction="none", beta=0.1))
    bumps = _bumps(target, torch.ones(len(target), device=maps.device), logits)
    bumps = bumps / bumps.sum((2, 3), keepdim=True).clamp_min(1e-6)
    peaked = mean(-(bumps * (share + 1e-9).log()).sum((2, 3)))

    seen = truth.seen[:, 0].float()
    rarer = torch.where(truth.right, 0.25, 1.0) * seen
    sides = functional.binary_cross_entropy_with_logits(side[:, 0], truth.right.float(), reduction="none")
    sides = (sides * rarer).sum() / rarer.sum().clamp_min(1)
    return across + 4 * ahead + 0.1 * peaked + _label_loss(labels, truth.label) + 0.3 * sides


LOSSES = {"full": full_loss, "crop": crop_loss}


def joint_errors_mm(maps: Tensor, truth: Examples) -> Tensor:
    """[B, 21] distances of the joints that a crop network's maps [B, 42, h, w] say from the true ones [mm]."""
    logits, depths = maps.float().chunk(2, 1)
    cells, share = soft_argmax(logits)
    pixels = cells * MAP_STEP + MAP_OFFSET - truth.uv[:, 0]
    ahead = 1e3 * CROP_DEPTH * ((share * depths).sum((2, 3)) - truth.depth[:, 0])
    return torch.cat([pixels * truth.mm[:, None, None], ahead[..., None]], -1).norm(dim=-1)
