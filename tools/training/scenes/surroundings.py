"""Depths of the hand's surroundings: a desk or a wall, objects near the hand, and objects in front of it."""
import torch
from torch import Tensor

from .chance import Chance
from .rotations import unit
from .shapes import NOTHING, hit_ellipsoid, hit_plane, hit_solid, only


def planes(chance: Chance, rays: Tensor, joints: Tensor) -> Tensor:
    """Depth of desks below and walls behind the hands' joints [B, N, 3]: between 1 cm and 2 m away from the nearest
    joint."""
    count, device = len(joints), joints.device
    pitch = chance.uniform(0.1, 1.5, count)
    desk = torch.stack([chance.normal(0.15, count), -torch.cos(pitch), -torch.sin(pitch)], 1)
    wall = torch.stack([chance.normal(0.4, count), chance.normal(0.4, count), -torch.ones(count, device=device)], 1)
    depth = None
    for normal, share, nearest in ((desk, 0.5, 0.003), (wall, 0.6, 0.02)):
        normal = unit(normal)
        lowest = torch.einsum("bni,bi->bn", joints, normal).amin(1)
        point = normal * (lowest - 0.01 - chance.log_uniform(nearest, 2, count))[:, None]
        plane = only(chance.flag(share, count), hit_plane(rays, point, normal))
        depth = plane if depth is None else torch.minimum(depth, plane)
    return depth


def clutter(chance: Chance, rays: Tensor, centre: Tensor, things: int = 3) -> Tensor:
    """Depth of boxes, ellipsoids and bars that do not touch the hand at `centre` [B, 3]."""
    count, device = len(centre), centre.device
    depth = None
    for _ in range(things):
        half = chance.log_uniform(0.015, 0.16, count, 3)
        offset = chance.normal(1, count, 3) * torch.tensor([0.28, 0.25, 0.3], device=device)
        offset[:, 2] += 0.2
        place = centre + offset
        clear = (offset.norm(dim=1) > 0.15 + half.amax(1)) & (place[:, 2] > 0.1 + half.amax(1))
        kind = chance.choice([0.4, 0.2, 0.2, 0.2], count)
        kind[~(clear & chance.flag(0.4, count))] = NOTHING
        thing = hit_solid(rays, kind, place, chance.rotation(count), half)
        depth = thing if depth is None else torch.minimum(depth, thing)
    return depth


def occluders(chance: Chance, rays: Tensor, centre: Tensor) -> Tensor:
    """Depth of an object that hides a part of the hand at `centre` [B, 3] in a tenth of the scenes."""
    count = len(centre)
    place = centre * chance.uniform(0.7, 0.92, count, 1)
    place = torch.cat([place[:, :2] + chance.normal(0.07, count, 2), place[:, 2:]], 1)
    depth = hit_ellipsoid(rays, place, chance.rotation(count), chance.uniform(0.01, 0.05, count, 3))
    return only(chance.flag(0.1, count), depth)
