"""Simulates how structured-light, time-of-flight and stereo sensors measure exact depth."""
import torch
from torch import Tensor
from torch.nn.functional import avg_pool2d, max_pool2d

from .chance import Chance
from .shapes import FAR
from .views import View

KINDS = ("structured light", "time of flight", "stereo", "clean")
_SHARES = (0.33, 0.3, 0.27, 0.1)  # probabilities of the KINDS


def smooth(image: Tensor, size: int) -> Tensor:
    """The mean over size x size pixels around every pixel."""
    return avg_pool2d(image[:, None], size, 1, size // 2, count_include_pad=False)[:, 0]


def _edges(depth: Tensor, least: float = 0.03) -> tuple[Tensor, Tensor, Tensor]:
    """Whether a pixel is next to a step in depth of more than `least` [m], and the nearest and the farthest depth
    around it."""
    highest, lowest = max_pool2d(depth[:, None], 3, 1, 1)[:, 0], -max_pool2d(-depth[:, None], 3, 1, 1)[:, 0]
    return highest - lowest > least, lowest, highest


def _structured_light(chance: Chance, depth: Tensor, view: View) -> tuple[Tensor, Tensor]:
    """The depth, quantised in steps of disparity, and the pixels without depth: in the projector's shadow and at ragged
    edges."""
    count = len(depth)
    base = chance.uniform(0.03, 0.09, count)[:, None, None] * view.focal[:, None, None]  # baseline * focal [m px]
    disparity = base / depth
    reach = min(24, depth.shape[2] // 4)
    shadow = torch.zeros_like(depth, dtype=torch.bool)
    for shift in range(1, reach):
        nearer = torch.roll(disparity, shift, 2) - disparity > shift
        nearer[:, :, :shift] = False
        shadow |= nearer
    step = chance.log_uniform(0.0003, 0.003, count)[:, None, None]  # step of depth at a distance of 1 m [m]
    noise = step * depth ** 2
    jagged = _edges(depth)[0] & chance.flag(0.4, *depth.shape)
    measured = depth + noise * (smooth(chance.normal(1, *depth.shape), 3) * 2 + chance.normal(0.4, *depth.shape))
    inverse = (1 / measured.clamp_min(0.05) / step).round() * step
    return 1 / inverse.clamp_min(1e-3), shadow | jagged


def _time_of_flight(chance: Chance, depth: Tensor) -> tuple[Tensor, Tensor]:
    """The depth, and the pixels without depth. There are flying pixels between the two sides of an edge, a smooth error
    by multiple reflections, and noise that grows with the distance."""
    count = len(depth)
    edge, lowest, highest = _edges(depth)
    flying = edge & (chance.uniform(0, 1, *depth.shape) < chance.uniform(0, 0.6, count)[:, None, None])
    between = lowest + (highest.clamp_max(3) - lowest).clamp_min(0) * chance.uniform(0, 1, *depth.shape)
    reflected = chance.uniform(0, 0.25, count)[:, None, None] * (smooth(depth.clamp_max(3), 9) - depth).clamp(-0.05, 0.05)
    deviation = chance.uniform(0.0005, 0.004, count)[:, None, None] * (0.3 + depth.clamp_max(4) ** 2)
    measured = torch.where(flying, between, depth + reflected) + deviation * chance.normal(1, *depth.shape)
    return measured, edge & chance.flag(0.12, *depth.shape)


def _stereo(chance: Chance, depth: Tensor) -> tuple[Tensor, Tensor]:
    """The depth, and the pixels without depth. The foreground extends beyond its edges, surfaces have smooth bumps, and
    there are holes of any size."""
    count = len(depth)
    fat = -max_pool2d(-depth[:, None], 3, 1, 1)[:, 0]
    grown = torch.where((chance.uniform(0, 1, count) < 0.6)[:, None, None] & chance.flag(0.8, *depth.shape), fat, depth)
    wobble = smooth(smooth(chance.normal(1, *depth.shape), 7), 7) * 11
    measured = grown + chance.uniform(0.001, 0.006, count)[:, None, None] * depth.clamp_max(3) ** 1.5 * wobble
    blobs = smooth(smooth(chance.normal(1, *depth.shape), 7), 5)
    holes = blobs > chance.uniform(0.14, 0.4, count)[:, None, None]
    return measured, holes | (_edges(depth)[0] & chance.flag(0.25, *depth.shape))


def _coarse(chance: Chance, depth: Tensor) -> Tensor:
    """Lowers the resolution of some images: blocks of 2 x 2 or 3 x 3 pixels get the same depth, as from a coarse sensor
    or of a distant hand."""
    rows, columns = depth.shape[1:]
    kept = depth
    kind = chance.choice([0.6, 0.25, 0.15], len(depth))
    for step in (2, 3):
        v = (torch.arange(rows, device=depth.device) // step * step + step // 2).clamp_max(rows - 1)
        u = (torch.arange(columns, device=depth.device) // step * step + step // 2).clamp_max(columns - 1)
        kept = torch.where((kind == step - 1)[:, None, None], depth[:, v][:, :, u], kept)
    return kept


def measure(chance: Chance, depth: Tensor, view: View) -> tuple[Tensor, Tensor]:
    """The depth that the sensors measure [B, H, W, m; 0: no depth], given the exact `depth` (FAR: no surface), and the
    kinds of the sensors [B] (indices into KINDS)."""
    count = len(depth)
    kind = chance.choice(_SHARES, count)
    flat = depth.clamp_max(8.0)
    measured, missing = flat.clone(), torch.zeros_like(depth, dtype=torch.bool)
    for index, (own, lost) in enumerate((_structured_light(chance, flat, view), _time_of_flight(chance, flat), _stereo(chance, flat))):
        mine = (kind == index)[:, None, None]
        measured, missing = torch.where(mine, own, measured), torch.where(mine, lost, missing)

    # Apply the sensor's range, its unit (1 or 0.1 mm) and its resolution.
    farthest = chance.uniform(1.2, 6, count)[:, None, None]
    nearest = torch.where(chance.flag(0.3, count), chance.uniform(0.1, 0.25, count), torch.zeros(count, device=depth.device))
    missing |= (depth >= FAR) | (measured > farthest) | (measured < nearest[:, None, None].clamp_min(0.02))
    unit = torch.where(chance.flag(0.7, count), 1e-3, 1e-4)[:, None, None]
    measured = (measured / unit).round() * unit
    return _coarse(chance, torch.where(missing, torch.zeros_like(measured), measured)), kind


def cut(chance: Chance, view: View) -> Tensor:
    """The pixels [B, H, W] of windows that lie beyond the border of the sensor's image: up to two fifths of every eighth
    window."""
    rows, columns = view.size
    count, device = len(view.focal), view.focal.device
    u = torch.linspace(0, 1, columns, device=device).expand(rows, columns)
    v = torch.linspace(0, 1, rows, device=device)[:, None].expand(rows, columns)
    border = torch.stack([u, 1 - u, v, 1 - v])[chance.choice([1, 1, 1, 1], count)]
    beyond = chance.uniform(0.03, 0.4, count) * chance.flag(0.125, count)
    return border < beyond[:, None, None]
