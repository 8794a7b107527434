"""The loss functions of the networks, and how positions are read from the maps."""
import torch
from torch import Tensor
from torch.nn import functional

from examples import CROP_DEPTH, MAP_OFFSET, MAP_STEP, Examples

_LABEL_WEIGHTS = (1.0, 1.5, 1.5, 1.5)  # weights of background, hand, arm and object in the label loss
_PALM_RADIUS = 25.0  # standard deviation of a palm's bell curve in the full network's map [mm]


def soft_argmax(maps: Tensor) -> tuple[Tensor, Tensor]:
    """The distributions [B, N, h, w] that the logits [B, N, h, w] define: their mean column and row [B, N, 2], and the
    distributions themselves."""
    share = maps.flatten(2).softmax(-1).reshape(maps.shape)
    columns = torch.arange(maps.shape[3], device=maps.device, dtype=maps.dtype)
    rows = torch.arange(maps.shape[2], device=maps.device, dtype=maps.dtype)
    return torch.stack([(share.sum(2) * columns).sum(-1), (share.sum(3) * rows).sum(-1)], -1), share


def _bumps(cells: Tensor, width: Tensor, like: Tensor) -> Tensor:
    """Bell curves [B, N, h, w] of height 1 around `cells` [B, N, 2] with the standard deviations `width` [B]."""
    columns = torch.arange(like.shape[3], device=like.device, dtype=like.dtype)
    rows = torch.arange(like.shape[2], device=like.device, dtype=like.dtype)
    square = (columns - cells[..., 0, None, None]) ** 2 + (rows[:, None] - cells[..., 1, None, None]) ** 2
    return torch.exp(-square / (2 * width ** 2)[:, None, None, None])


def _label_loss(logits: Tensor, label: Tensor) -> Tensor:
    """The cross entropy of the labels, which the network computes for every second row and column."""
    weights = torch.tensor(_LABEL_WEIGHTS, device=logits.device)
    return functional.cross_entropy(logits, label[:, ::2, ::2], weight=weights)


def full_loss(output: tuple[Tensor, ...], truth: Examples) -> Tensor:
    """Loss of the full network: its map should show a bell curve at each palm and 0 otherwise; plus the label loss."""
    maps, labels, _ = (part.float() for part in output)
    width = (_PALM_RADIUS / truth.mm / MAP_STEP).clamp(0.8, 4)
    bumps = _bumps((truth.uv[:, :, 0] - MAP_OFFSET) / MAP_STEP, width, maps) * truth.seen[:, :, None, None]
    bump = bumps.amax(1)
    miss = functional.binary_cross_entropy_with_logits(maps[:, 0], bump, reduction="none")
    return 5 * (miss * (1 + 20 * bump)).mean() + _label_loss(labels, truth.label)


def hand_loss(output: tuple[Tensor, ...], truth: Examples) -> Tensor:
    """Loss of the log odds of a hand; windows that show next to nothing of their hand do not count."""
    seen, absent = truth.seen[:, 0], truth.scenes.pixels[:, 0] == 0
    misses = functional.binary_cross_entropy_with_logits(output[3][:, 0].float(), seen.float(), reduction="none")
    return (misses * (seen | absent)).sum() / (seen | absent).sum().clamp_min(1)


def crop_loss(output: tuple[Tensor, ...], truth: Examples) -> Tensor:
    """Loss of the crop network: joints of right hands in the image and in depth, maps with narrow peaks, labels,
    side, whether it is a hand."""
    maps, labels, side, _ = (part.float() for part in output)
    logits, depths = maps.chunk(2, 1)
    cells, share = soft_argmax(logits)
    target = (truth.uv[:, 0] - MAP_OFFSET) / MAP_STEP

    # Give no weight to joints outside the window and to hands that are not seen.
    inside = ((target > -1) & (target < logits.shape[3])).all(-1)
    weight = (inside & (truth.seen[:, 0] & truth.right)[:, None]).float()
    mean = lambda values: (values * weight).sum() / weight.sum().clamp_min(1)
    across = mean(functional.smooth_l1_loss(cells, target, reduction="none", beta=0.5).sum(-1))
    ahead = mean(functional.smooth_l1_loss((share * depths).sum((2, 3)), truth.depth[:, 0], reduction="none", beta=0.1))
    bumps = _bumps(target, torch.ones(len(target), device=maps.device), logits)
    bumps = bumps / bumps.sum((2, 3), keepdim=True).clamp_min(1e-6)
    peaked = mean(-(bumps * (share + 1e-9).log()).sum((2, 3)))

    # Compute the loss of left against right hands; left hands are rarer, so they get a larger weight. Without a hand the
    # network should be undecided: the program takes a decided side as evidence of a hand.
    seen = truth.seen[:, 0]
    rarer = torch.where(truth.right | ~seen, 0.25, 1.0)
    target = torch.where(seen, truth.right.float(), torch.full_like(rarer, 0.5))
    sides = functional.binary_cross_entropy_with_logits(side[:, 0], target, reduction="none")
    sides = (sides * rarer).sum() / rarer.sum().clamp_min(1)
    return across + 4 * ahead + 0.1 * peaked + _label_loss(labels, truth.label) + 0.3 * sides + 0.3 * hand_loss(output, truth)


LOSSES = {"full": full_loss, "crop": crop_loss}


def joint_errors_mm(maps: Tensor, truth: Examples) -> Tensor:
    """Distances [B, 21] of the joints in a crop network's maps [B, 42, h, w] from the true joints [mm]."""
    logits, depths = maps.float().chunk(2, 1)
    cells, share = soft_argmax(logits)
    pixels = cells * MAP_STEP + MAP_OFFSET - truth.uv[:, 0]
    ahead = 1e3 * CROP_DEPTH * ((share * depths).sum((2, 3)) - truth.depth[:, 0])
    return torch.cat([pixels * truth.mm[:, None, None], ahead[..., None]], -1).norm(dim=-1)
