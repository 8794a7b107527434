"""The second hand of a scene: somewhere beside the first one, or gripping it."""
from dataclasses import dataclass

import torch
from torch import Tensor

from .chance import Chance
from .people import Stance, stances
from .poses import free_poses
from .rotations import about, apply

_CLASPED = 0.2  # share of second hands that grip the first one or its wrist


@dataclass
class Partner:
    """Second hands of B scenes: `angles` [B, 21, rad], whether it is a right hand [B], and where its palm is [B, 3]."""
    angles: Tensor
    right: Tensor
    stance: Stance
    place: Tensor


def partners(chance: Chance, stance: Stance, right: Tensor, place: Tensor) -> Partner:
    """Second hands for first ones of these stances, sides and palms' centres [B, 3]."""
    count = len(place)
    rotation = torch.where(chance.flag(0.5, count)[:, None, None], stances(chance, count).rotation, mirrored(stance.rotation))
    angles, where = free_poses(chance, count), place + beside(chance, place)

    # A clasp: palm on palm, palm on the back of the hand, or around the wrist.
    kind = chance.choice([0.5, 0.25, 0.25], count)
    over = torch.where(kind == 0, -1.0, torch.where(chance.flag(0.5, count) | (kind == 1), 1.0, -1.0))
    local = about("y", chance.uniform(-1.9, 1.9, count)) @ about("z", torch.where(over < 0, torch.pi, 0.0) + chance.normal(0.2, count))
    offset = torch.stack([chance.normal(0.012, count), over * chance.uniform(0.028, 0.048, count),
                          torch.where(kind == 2, chance.uniform(0.05, 0.11, count), chance.normal(0.02, count))], 1)
    clasped = chance.flag(_CLASPED, count)[:, None]
    where = torch.where(clasped, place + apply(stance.rotation, offset), where)
    rotation = torch.where(clasped[..., None], stance.rotation @ local, rotation)
    angles = torch.where(clasped, _gripping(chance, count), angles)
    return Partner(angles, torch.where(chance.flag(0.85, count), ~right, right), Stance(rotation, stance.egocentric), where)


def _gripping(chance: Chance, count: int) -> Tensor:
    """Angles [B, 21] of hands that close around something as thick as a hand."""
    closed = chance.uniform(0.3, 0.9, count, 1) + chance.normal(0.08, count, 4)
    finger = torch.stack([1.1 * closed, chance.normal(0.08, count, 4), 1.3 * closed, 0.7 * closed], -1).flatten(1)
    thumb = torch.tensor([0.3, 0.1, 0.3, 0.0, 0.4], device=chance.device) + chance.normal(0.15, count, 5)
    return torch.cat([thumb, finger], 1)


def mirrored(rotation: Tensor) -> Tensor:
    """The rotation of the other hand when both are held symmetrically: mirrored in the camera's and in the hand's x."""
    flip = torch.tensor([-1.0, 1.0, 1.0], device=rotation.device)
    return flip[:, None] * rotation * flip


def beside(chance: Chance, place: Tensor, least: float = 0.07) -> Tensor:
    """The vector [B, 3] from one palm to the other: `least` to 0.5 m long, mostly across the view."""
    count = len(place)
    turn = chance.uniform(0, 6.3, count)
    way = torch.stack([torch.cos(turn), 0.6 * torch.sin(turn), chance.normal(0.35, count)], 1)
    return torch.nn.functional.normalize(way, dim=1) * chance.log_uniform(least, 0.5, count, 1)
