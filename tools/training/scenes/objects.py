"""Objects to hold, made of up to three solids: mugs, tools, sticks, books, bottles, bags, and simple ones. Their long
axis is x; the hand takes them at the origin. Metres."""
from dataclasses import dataclass

import torch
from torch import Tensor

from .chance import Chance
from .rotations import about, apply
from .shapes import BOX, CAPSULE, CYLINDER, ELLIPSOID, NOTHING, distance_to_solid

PARTS = 3
KINDS = {"simple": 0.4, "mug": 0.12, "tool": 0.1, "stick": 0.1, "flat": 0.13, "bottle": 0.09, "bag": 0.06}  # with probabilities


@dataclass
class Solids:
    """One object for each of B hands: `kind` [B, 3] of its parts (see shapes.py), `centre` [B, 3], `rotation` [B, 3,
    3]; `offset` [B, 3, 3], `turn` [B, 3, 3, 3] and `half` [B, 3, 3] of its parts in the object's frame."""
    kind: Tensor
    centre: Tensor
    rotation: Tensor
    offset: Tensor
    turn: Tensor
    half: Tensor

    def parts(self) -> list[tuple[Tensor, Tensor, Tensor, Tensor]]:
        """Kind [B], centre [B, 3], rotation [B, 3, 3] and half axes [B, 3] of each part."""
        return [(self.kind[:, k], self.centre + apply(self.rotation, self.offset[:, k]), self.rotation @ self.turn[:, k],
                 self.half[:, k]) for k in range(PARTS)]

    def distance(self, points: Tensor) -> Tensor:
        """Signed distances [B, N] of `points` [B, N, 3] from the nearest part."""
        return torch.stack([distance_to_solid(points, *part) for part in self.parts()], 1).amin(1)

    def repeated(self, times: int) -> "Solids":
        return Solids(*(value.repeat_interleave(times, 0) for value in vars(self).values()))


def objects(chance: Chance, count: int) -> Solids:
    """Objects at the origin, in any orientation."""
    device = chance.device
    kind = torch.full((count, PARTS), NOTHING, device=device)
    offset, half, angle = (torch.zeros(count, PARTS, 3, device=device), torch.full((count, PARTS, 3), 0.01, device=device),
                           torch.zeros(count, PARTS, device=device))
    which = chance.choice(list(KINDS.values()), count)
    for index, make in enumerate((_simple, _mug, _tool, _stick, _flat, _bottle, _bag)):
        mine = (which == index).nonzero()[:, 0]
        if len(mine):
            kind[mine], half[mine], offset[mine], angle[mine] = make(chance, len(mine))
    return Solids(kind, torch.zeros(count, 3, device=device), chance.rotation(count), offset, about("z", angle), half)


def _stacked(*rows: tuple[Tensor, Tensor, Tensor]) -> Tensor:
    """Vectors [B, 3, 3] of the parts, from their components."""
    return torch.stack([torch.stack(row, 1) for row in rows], 1)


def _kinds(count: int, like: Tensor, *kinds: int) -> Tensor:
    return torch.tensor(kinds, device=like.device).repeat(count, 1)


def _simple(chance: Chance, count: int) -> tuple[Tensor, ...]:
    """Boxes, ellipsoids and bars, about 1.4 to 13 cm thick and some of them long, and balls of 3 to 25 cm."""
    thick = chance.log_uniform(0.007, 0.065, count, 1)
    half = thick * chance.uniform(0.8, 1.25, count, 3)
    half[:, 0] *= torch.where(chance.flag(0.5, count), chance.uniform(1, 6, count), torch.ones_like(half[:, 0]))
    half[:, 0] = half[:, 0].clamp_max(0.16)
    ball = chance.flag(0.25, count)
    half = torch.where(ball[:, None], chance.log_uniform(0.015, 0.125, count, 1).expand(-1, 3), half)
    kind = _kinds(count, half, NOTHING, NOTHING, NOTHING)
    kind[:, 0] = torch.tensor([BOX, ELLIPSOID, CAPSULE, CYLINDER], device=half.device)[chance.choice([0.4, 0.2, 0.2, 0.2], count)]
    kind[:, 0] = torch.where(ball, ELLIPSOID, kind[:, 0])
    none = torch.zeros(count, PARTS, 3, device=half.device)
    return kind, half[:, None].expand(-1, PARTS, -1), none, none[..., 0]


def _mug(chance: Chance, count: int) -> tuple[Tensor, ...]:
    """A mug with a handle, at which two of five are held."""
    wide, high, thin = chance.uniform(0.028, 0.046, count), chance.uniform(0.032, 0.06, count), chance.uniform(0.004, 0.008, count)
    away = wide + chance.uniform(0.018, 0.03, count)
    none = torch.zeros_like(wide)
    half = _stacked((high, wide, wide), (0.65 * high, thin, thin), (0.5 * (away - 0.7 * wide), thin, thin))
    offset = _stacked((none, none, none), (none, away, none), (0.55 * high, 0.5 * (away + 0.7 * wide), none))
    offset = offset - offset[:, 1:2] * chance.flag(0.4, count)[:, None, None]
    return _kinds(count, half, CYLINDER, CAPSULE, CAPSULE), half, offset, torch.stack([none, none, none + 1.57], 1)


def _tool(chance: Chance, count: int) -> tuple[Tensor, ...]:
    """Pliers or scissors: two bars that cross."""
    long, wide, thin = chance.uniform(0.06, 0.11, count), chance.uniform(0.004, 0.01, count), chance.uniform(0.002, 0.007, count)
    none, open_by, pivot = torch.zeros_like(long), chance.uniform(0.05, 0.35, count), chance.uniform(0.015, 0.05, count)
    half = _stacked((long, wide, thin), (long, wide, thin), (none, none, none))
    aside = pivot * (1 - torch.cos(open_by))
    offset = _stacked((aside, -pivot * torch.sin(open_by), none), (aside, pivot * torch.sin(open_by), none), (none, none, none))
    return _kinds(count, half, BOX, BOX, NOTHING), half, offset, torch.stack([open_by, -open_by, none], 1)


def _stick(chance: Chance, count: int) -> tuple[Tensor, ...]:
    """Pens, and screwdrivers and brushes, which are thicker at one end."""
    long, thin = chance.uniform(0.05, 0.13, count), chance.log_uniform(0.0035, 0.012, count)
    none, grip = torch.zeros_like(long), chance.uniform(0.3, 0.5, count) * long
    thick = (thin * chance.uniform(1.3, 3, count)).clamp_max(0.02)
    half = _stacked((long, thin, thin), (grip, thick, thick), (none, none, none))
    offset = _stacked((none, none, none), (grip - long, none, none), (none, none, none))
    offset[:, :, 0] += (chance.uniform(-0.3, 0.7, count) * long)[:, None]
    kind = _kinds(count, half, CYLINDER, CYLINDER, NOTHING)
    kind[:, 1] = torch.where(chance.flag(0.5, count), kind[:, 1], NOTHING)
    return kind, half, offset, torch.zeros_like(half[..., 0])


def _flat(chance: Chance, count: int) -> tuple[Tensor, ...]:
    """Phones, books and boxes of up to 25 cm, mostly taken at an edge."""
    half = torch.stack([chance.uniform(0.05, 0.125, count), chance.uniform(0.03, 0.09, count), chance.log_uniform(0.003, 0.025, count)], 1)
    offset = torch.zeros(count, PARTS, 3, device=half.device)
    offset[:, :, 1] = (half[:, 1] * chance.uniform(0.3, 0.9, count) * chance.flag(0.6, count))[:, None]
    return _kinds(count, half, BOX, NOTHING, NOTHING), half[:, None].expand(-1, PARTS, -1), offset, torch.zeros_like(offset[..., 0])


def _bottle(chance: Chance, count: int) -> tuple[Tensor, ...]:
    """A bottle with its shoulders and its neck."""
    wide, high, neck = chance.uniform(0.025, 0.045, count), chance.uniform(0.06, 0.11, count), chance.uniform(0.015, 0.035, count)
    none, thin = torch.zeros_like(wide), wide * chance.uniform(0.3, 0.5, count)
    half = _stacked((high, wide, wide), (wide, wide, wide), (neck, thin, thin))
    offset = _stacked((none, none, none), (high, none, none), (high + 0.8 * wide + neck, none, none))
    offset[:, :, 0] += (chance.uniform(-0.9, 0.4, count) * high)[:, None]
    return _kinds(count, half, CYLINDER, ELLIPSOID, CYLINDER), half, offset, torch.zeros_like(half[..., 0])


def _bag(chance: Chance, count: int) -> tuple[Tensor, ...]:
    """A bag that hangs at its handle."""
    grip, strap = chance.uniform(0.03, 0.06, count), chance.uniform(0.02, 0.06, count)
    none, thin = torch.zeros_like(grip), chance.uniform(0.004, 0.012, count)
    bag = torch.stack([chance.uniform(0.06, 0.15, count), chance.uniform(0.07, 0.15, count), chance.uniform(0.03, 0.09, count)], 1)
    half = torch.cat([_stacked((grip, thin, thin), (strap, thin, thin)), bag[:, None]], 1)
    offset = _stacked((none, none, none), (none, strap, none), (none, 2 * strap + 0.95 * bag[:, 1], none))
    kind = _kinds(count, half, CAPSULE, CAPSULE, BOX)
    kind[:, 2] = torch.where(chance.flag(0.5, count), kind[:, 2], ELLIPSOID)
    return kind, half, offset, torch.stack([none, none + 1.57, none], 1)
