"""What structured light, time-of-flight and stereo sensors make of exact depth."""
import torch
from torch import Tensor
from torch.nn.functional import avg_pool2d, max_pool2d

from .chance import Chance
from .shapes import FAR
from .views import View

KINDS = ("structured light", "time of flight", "stereo", "clean")
_SHARES = (0.33, 0.3, 0.27, 0.1)


def _smooth(image: Tensor, size: int) -> Tensor:
    """Moving mean over size x size pixels."""
    return avg_pool2d(image[:, None], size, 1, size // 2, count_include_pad=False)[:, 0]


def _edges(depth: Tensor, least: float = 0.03) -> tuple[Tensor, Tensor, Tensor]:
    """Pixels beside a step in depth of more than `least` [m], and the nearest and farthest depth around each pixel."""
    highest, lowest = max_pool2d(depth[:, None], 3, 1, 1)[:, 0], -max_pool2d(-depth[:, None], 3, 1, 1)[:, 0]
    return highest - lowest > least, lowest, highest


def _structured_light(chance: Chance, depth: Tensor, view: View) -> tuple[Tensor, Tensor]:
    """Depth in steps of disparity, and where there is none: in the projector's shadow and at ragged edges."""
    count = len(depth)
    base = chance.uniform(0.03, 0.09, count)[:, None, None] * view.focal[:, None, None]  # pixels times metres
    disparity = base / depth
    reach = min(24, depth.shape[2] // 4)
    shadow = torch.zeros_like(depth, dtype=torch.bool)
    for shift in range(1, reach):
        nearer = torch.roll(disparity, shift, 2) - disparity > shift
        nearer[:, :, :shift] = False
        shadow |= nearer
    step = chance.log_uniform(0.0003, 0.003, count)[:, None, None]  # m at 1 m
    noise = step * depth ** 2
    jagged = _edges(depth)[0] & chance.flag(0.4, *depth.shape)
    measured = depth + noise * (_smooth(chance.normal(1, *depth.shape), 3) * 2 + chance.normal(0.4, *depth.shape))
    inverse = (1 / measured.clamp_min(0.05) / step).round() * step
    return 1 / inverse.clamp_min(1e-3), shadow | jagged


def _time_of_flight(chance: Chance, depth: Tensor) -> tuple[Tensor, Tensor]:
    """Flying pixels between the two sides of an edge, a smooth error by multiple reflections, noise that grows."""
    count = len(depth)
    edge, lowest, highest = _edges(depth)
    flying = edge & (chance.uniform(0, 1, *depth.shape) < chance.uniform(0, 0.6, count)[:, None, None])
    between = lowest + (highest.clamp_max(3) - lowest).clamp_min(0) * chance.uniform(0, 1, *depth.shape)
    reflected = chance.uniform(0, 0.25, count)[:, None, None] * (_smooth(depth.clamp_max(3), 9) - depth).clamp(-0.05, 0.05)
    deviation = chance.uniform(0.0005, 0.004, count)[:, None, None] * (0.3 + depth.clamp_max(4) ** 2)
    measured = torch.where(flying, between, depth + reflected) + deviation * chance.normal(1, *depth.shape)
    return measured, edge & chance.flag(0.12, *depth.shape)


def _stereo(chance: Chance, depth: Tensor) -> tuple[Tensor, Tensor]:
    """Foreground that grows over its edges, surfaces that wobble like blobs, holes of any size."""
    count = len(depth)
    fat = -max_pool2d(-depth[:, None], 3, 1, 1)[:, 0]
    grown = torch.where((chance.uniform(0, 1, count) < 0.6)[:, None, None] & chance.flag(0.8, *depth.shape), fat, depth)
    wobble = _smooth(_smooth(chance.normal(1, *depth.shape), 7), 7) * 11
    measured = grown + chance.uniform(0.001, 0.006, count)[:, None, None] * depth.clamp_max(3) ** 1.5 * wobble
    blobs = _smooth(_smooth(chance.normal(1, *depth.shape), 7), 5)
    holes = blobs > chance.uniform(0.14, 0.4, count)[:, None, None]
    return measured, holes | (_edges(depth)[0] & chance.flag(0.25, *depth.shape))


def _coarse(chance: Chance, depth: Tensor) -> Tensor:
    """Pixels that several pixels of the view look at, as those of a coarse sensor or of a far hand."""
    rows, columns = depth.shape[1:]
    kept = depth
    kind = chance.choice([0.6, 0.25, 0.15], len(depth))
    for step in (2, 3):
        v = (torch.arange(rows, device=depth.device) // step * step + step // 2).clamp_max(rows - 1)
        u = (torch.arange(columns, device=depth.device) // step * step + step // 2).clamp_max(columns - 1)
        kept = torch.where((kind == step - 1)[:, None, None], depth[:, v][:, :, u], kept)
    return kept


def measure(chance: Chance, depth: Tensor, view: View) -> tuple[Tensor, Tensor]:
    """What the sensors say [B, H, W, m; 0: nothing] of exact `depth` (FAR: nothing), and their kinds [B] (see KINDS)."""
    count = len(depth)
    kind = chance.choice(_SHARES, count)
    flat = depth.clamp_max(8.0)
    measured, missing = flat.clone(), torch.zeros_like(depth, dtype=torch.bool)
    for index, (own, lost) in enumerate((_structured_light(chance, flat, view), _time_of_flight(chance, flat), _stereo(chance, flat))):
        mine = (kind == index)[:, None, None]
        measured, missing = torch.where(mine, own, measured), torch.where(mine, lost, missing)

    # Range, units of a millimetre or of a tenth, and a sensor's resolution.
    farthest = chance.uniform(1.2, 6, count)[:, None, None]
    nearest = torch.where(chance.flag(0.3, count), chance.uniform(0.1, 0.25, count), torch.zeros(count, device=depth.device))
    missing |= (depth >= FAR) | (measured > farthest) | (measured < nearest[:, None, None].clamp_min(0.02))
    unit = torch.where(chance.flag(0.7, count), 1e-3, 1e-4)[:, None, None]
    measured = (measured / unit).round() * unit
    return _coarse(chance, torch.where(missing, torch.zeros_like(measured), measured)), kind
