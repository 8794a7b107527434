"""Images of hands that move quickly: some pixels show the hand where it was a moment ago."""
import torch
from torch import Tensor

from .chance import Chance
from .sensors import smooth
from .shapes import FAR

_SHARE = 0.12  # of the scenes have a moving hand


def seen_in_motion(chance: Chance, layers: Tensor, farthest: Tensor) -> tuple[Tensor, Tensor]:
    """The nearest depth [B, H, W] and the index of its layer [B, H, W]. Layer 0 of `layers` [B, N, H, W] stands still;
    in some scenes the others move by up to `farthest` [B, pixels] while the image is taken."""
    depth, winner = layers.min(1)
    mine = chance.flag(_SHARE, len(layers)).nonzero()[:, 0]
    count, rows, columns = len(mine), *layers.shape[2:]
    if count == 0:
        return depth, winner
    still, (front, which) = layers[mine, 0], layers[mine, 1:].min(1)
    turn, length = chance.uniform(0, 6.3, count, 1, 1), farthest[mine, None, None] * chance.uniform(0.15, 1, count, 1, 1)
    row, column = torch.arange(rows, device=depth.device)[:, None], torch.arange(columns, device=depth.device)

    # Two moments of the motion; neighbouring pixels see about the same one.
    seen = []
    for _ in range(2):
        moment = (2.5 * smooth(chance.normal(1, count, rows, columns), 5)).clamp(-0.5, 0.5) * length
        v = (row + torch.sin(turn) * moment).round().long().clamp(0, rows - 1)
        u = (column + torch.cos(turn) * moment).round().long().clamp(0, columns - 1)
        place = (v * columns + u).flatten(1)
        moved, layer = (values.flatten(1).gather(1, place).reshape_as(still) for values in (front, which))
        seen.append((torch.minimum(moved, still), torch.where(moved < still, layer + 1, torch.zeros_like(layer))))

    # Some sensors, such as those that measure time of flight, mix the depths of both moments.
    (first, layer), (second, _) = seen
    mixed = chance.flag(0.5, count)[:, None, None] & (torch.maximum(first, second) < FAR)
    depth[mine], winner[mine] = torch.where(mixed, 0.5 * (first + second), first), layer
    return depth, winner
