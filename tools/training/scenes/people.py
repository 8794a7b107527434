"""Depths of arms with and without sleeves, of trunks and of heads. Camera frame (x right, y down, z forward),
metres."""
from dataclasses import dataclass

import torch
from torch import Tensor

from .chance import Chance
from .rotations import about, apply, frame_along, unit
from .shapes import hit_capsule, hit_ellipsoid, only


@dataclass
class Stance:
    """How B hands are held: `rotation` [B, 3, 3] from the hand's to the camera's frame; `egocentric` [B]: whether the
    camera sees what the hand's owner sees."""
    rotation: Tensor
    egocentric: Tensor


def stances(chance: Chance, count: int) -> Stance:
    """Hands of three kinds: in front of a camera, mostly with the fingers up; of the person who wears the camera; in
    any orientation."""
    device = chance.device
    upright = torch.tensor([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]], device=device)
    turn = torch.where(chance.flag(0.5, count), torch.full((count,), torch.pi, device=device), torch.zeros(count, device=device))
    facing = about("z", chance.normal(1, count)) @ about("x", chance.normal(0.5, count))
    facing = facing @ about("y", turn + chance.normal(0.6, count)) @ upright

    # For a camera that the person wears, let the forearm come from below and from behind the camera.
    back = unit(torch.stack([chance.normal(0.4, count), 0.45 + chance.normal(0.25, count), -chance.uniform(0.3, 1, count)], 1))
    own = frame_along(back)[:, :, [1, 2, 0]] @ about("z", chance.uniform(0, 6.3, count)) @ about("x", chance.normal(0.35, count))

    kind = chance.choice([0.5, 0.22, 0.28], count)
    rotation = torch.where((kind == 0)[:, None, None], facing, torch.where((kind == 1)[:, None, None], own, chance.rotation(count)))
    return Stance(rotation, kind == 1)


def arms(chance: Chance, rays: Tensor, stance: Stance, wrist: Tensor, size: Tensor) -> tuple[Tensor, Tensor]:
    """Depth of forearm, upper arm and sleeve, and the position of the shoulder [B, 3]. `wrist` [B, 3]: its position;
    `size` [B]: the hand's size relative to a mean hand."""
    count = len(wrist)
    bend = about("x", chance.normal(0.45, count).clamp(-1.1, 1.1)) @ about("y", chance.normal(0.25, count).clamp(-0.5, 0.5))
    back = (stance.rotation @ bend)[:, :, 2]
    elbow = wrist + back * (size * chance.uniform(0.21, 0.29, count))[:, None]

    # Place the shoulder farther away than the elbow or, if the person wears the camera, nearer.
    away = unit(back + chance.normal(0.9, count, 3))
    depth = torch.where(stance.egocentric, -away[:, 2].abs(), away[:, 2].abs())
    shoulder = elbow + torch.stack([away[:, 0], away[:, 1], depth], 1) * (size * chance.uniform(0.2, 0.32, count))[:, None]

    thin, thick = 0.026 * size * chance.uniform(0.85, 1.25, count), 0.042 * size * chance.uniform(0.85, 1.3, count)
    arm = hit_capsule(rays, wrist + 0.012 * back, elbow, thin, thick)
    arm = torch.minimum(arm, hit_capsule(rays, elbow, shoulder, 0.95 * thick, 0.055 * size * chance.uniform(0.9, 1.3, count)))

    # Let a sleeve begin anywhere between the heel of the hand and the elbow; wide sleeves hang down.
    begin = wrist + back * (chance.uniform(-0.03, 0.2, count) * size)[:, None]
    wide = chance.uniform(1.1, 1.9, count)
    hang = torch.stack([torch.zeros_like(wide), 0.02 * (wide - 1), torch.zeros_like(wide)], 1)
    sleeve = hit_capsule(rays, begin, elbow + hang, 1.15 * thin * wide, thick * (0.3 + 0.7 * wide))
    sleeve = torch.minimum(sleeve, hit_capsule(rays, elbow, shoulder, thick * wide, 0.065 * size * wide.clamp_max(1.4)))
    arm = torch.minimum(arm, only(chance.flag(0.5, count), sleeve))

    # Leave out arms that would pass through the camera, unless the person wears it. Also leave out some other arms, as
    # if they were in dark cloth, of which sensors measure no depth.
    through = (elbow[:, 2] < 0.12) & ~stance.egocentric
    return only(~through & ~chance.flag(0.05, count), arm), shoulder


def bodies(chance: Chance, rays: Tensor, shoulder: Tensor) -> Tensor:
    """Depth of trunk, shoulders, neck and head of people who have one of their shoulders at `shoulder` [B, 3]."""
    count, device = len(shoulder), shoulder.device
    side = torch.where(chance.flag(0.5, count), torch.ones(count, device=device), -torch.ones(count, device=device))
    tilt = about("y", chance.normal(0.4, count)) @ about("z", chance.normal(0.1, count)) @ about("x", chance.normal(0.12, count))
    half_width = chance.uniform(0.15, 0.22, count)

    def at(x: Tensor, y: float, z: float) -> Tensor:
        offset = torch.stack([x, torch.full_like(x, y), torch.full_like(x, z)], 1)
        return shoulder + apply(tilt, offset)

    centre = half_width * side
    other = at(2 * centre, 0, 0)
    half = torch.stack([half_width * chance.uniform(0.85, 1.1, count), chance.uniform(0.28, 0.4, count), chance.uniform(0.1, 0.17, count)], 1)
    body = hit_ellipsoid(rays, at(centre, 0.22, 0.02), tilt, half)
    body = torch.minimum(body, hit_capsule(rays, shoulder, other, *[chance.uniform(0.06, 0.09, count)] * 2))

    # Add the neck, and a head with skull, chin and nose.
    face = tilt @ about("y", chance.normal(0.5, count)) @ about("x", chance.normal(0.25, count))
    skull = at(centre, -0.26, -0.02)
    on_face = lambda y, z: skull + apply(face, torch.tensor([0.0, y, z], device=device).expand(count, 3))
    ball = torch.stack([chance.uniform(0.068, 0.085, count), chance.uniform(0.09, 0.12, count), chance.uniform(0.085, 0.105, count)], 1)
    body = torch.minimum(body, hit_capsule(rays, at(centre, -0.02, 0), skull, *[chance.uniform(0.05, 0.065, count)] * 2))
    body = torch.minimum(body, hit_ellipsoid(rays, skull, face, ball))
    body = torch.minimum(body, hit_ellipsoid(rays, on_face(0.07, -0.045), face, 0.55 * ball))
    nose = chance.uniform(0.012, 0.02, count)
    return torch.minimum(body, hit_capsule(rays, on_face(-0.01, -0.09), on_face(0.025, -0.115), 0.6 * nose, nose))
