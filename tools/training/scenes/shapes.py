"""Intersections of rays with solids, and signed distances from solids. Camera frame, metres.

`rays` [B, H, W, 3] start at the origin and have z = 1. Each `hit_` function gives the depth z [B, H, W] of the nearest
surface in front of the camera, or FAR if the ray hits nothing.
"""
from functools import wraps
from typing import Callable

import torch
from torch import Tensor

from .rotations import apply

FAR = 1e3  # depth of a ray that hits nothing [m]
NEAR = 0.05  # surfaces nearer to the camera than this are not seen [m]


def _fused(function: Callable[..., Tensor]) -> Callable[..., Tensor]:
    """The `function` of rays, compiled on a GPU, where each of its many steps would otherwise read and write whole
    images."""
    compiled: list[Callable[..., Tensor]] = []

    @wraps(function)
    def call(rays: Tensor, *rest: Tensor) -> Tensor:
        if not rays.is_cuda:
            return function(rays, *rest)
        if not compiled:
            compiled.append(torch.compile(function, dynamic=True))
        return compiled[0](rays, *rest)

    return call


def _seen(hit: Tensor, t: Tensor) -> Tensor:
    return torch.where(hit & (t > NEAR), t, torch.full_like(t, FAR))


def only(mask: Tensor, depth: Tensor) -> Tensor:
    """`depth` for those samples of the batch for which `mask` [B] is true, FAR for the others."""
    return torch.where(mask[:, None, None], depth, torch.full_like(depth, FAR))


def _dot(rays: Tensor, vector: Tensor) -> Tensor:
    """The dot products [B, H, W] of the rays with `vector` [B, 3]."""
    x, y, z = vector[:, :, None, None].unbind(1)
    return rays[..., 0] * x + rays[..., 1] * y + z


@_fused
def hit_capsule(rays: Tensor, start: Tensor, end: Tensor, start_radius: Tensor, end_radius: Tensor) -> Tensor:
    """A capsule from `start` to `end` [B, 3] whose radius [B] changes linearly between them."""
    along, scalar = end - start, lambda values: values[:, None, None]
    start_radius, end_radius = scalar(start_radius), scalar(end_radius)
    aa, sa, ss = scalar((along * along).sum(1)), scalar((start * along).sum(1)), scalar((start * start).sum(1))
    rr, ra, rs = rays[..., 0] ** 2 + rays[..., 1] ** 2 + 1, _dot(rays, along), _dot(rays, start)

    def ball(share: Tensor) -> tuple[Tensor, Tensor, Tensor]:
        """Intersects the rays with the ball around the point at the fraction `share` of the axis. Returns, in units of
        the ray: the middle of the chord, its squared half length (negative: a miss), and the point where the ray
        enters."""
        radius = start_radius + share.clamp(0, 1) * (end_radius - start_radius)
        middle = (rs + share * ra) / rr
        chord = (radius * radius - ss - share * (2 * sa + share * aa)) / rr + middle * middle
        return middle, chord, middle - torch.sqrt(chord.clamp_min(0))

    # Find the rays that hit: those that hit the ball around the point of the axis that is nearest to the ray.
    nearest = (ra * rs - rr * sa) / (rr * aa - ra * ra).clamp_min(1e-9)
    _, chord, t = ball(nearest.clamp(0, 1))
    hit = chord > 0

    # Find where a slanting ray enters, which is earlier: through the lateral surface, or through the ball at an end.
    # Two steps of a fixed-point iteration suffice.
    middle, chord, _ = ball(nearest)
    slant = (1 - ra * ra / (rr * aa)).clamp_min(1e-3)
    entry = middle - torch.sqrt(chord.clamp_min(0) / slant)
    for _ in range(2):
        _, chord, earlier = ball(((entry * ra - sa) / aa).clamp(0, 1))
        t = torch.where(chord > 0, torch.minimum(t, earlier), t)
        entry = t
    return _seen(hit, t)


def hit_capsules(rays: Tensor, capsules: Tensor) -> Tensor:
    """K capsules [B, K, 2, 4] per sample: point and radius of both ends."""
    samples, (rows, columns) = capsules.shape[:2], rays.shape[1:3]
    many = rays[:, None].expand(-1, samples[1], -1, -1, -1).reshape(-1, rows, columns, 3)
    start, end = capsules.flatten(0, 1).unbind(1)
    return hit_capsule(many, start[:, :3], end[:, :3], start[:, 3], end[:, 3]).reshape(*samples, rows, columns).amin(1)


@_fused
def hit_box(rays: Tensor, centre: Tensor, rotation: Tensor, half: Tensor) -> Tensor:
    """A box with half edges `half` [B, 3] along the columns of `rotation` [B, 3, 3]."""
    origin = -apply(rotation.transpose(1, 2), centre)[:, None, None]
    slope = torch.einsum("bji,bhwj->bhwi", rotation, rays)
    inverse = 1 / torch.where(slope.abs() < 1e-6, torch.full_like(slope, 1e-6), slope)
    half = half[:, None, None]
    first, second = (-half - origin) * inverse, (half - origin) * inverse
    enter, leave = torch.minimum(first, second).amax(-1), torch.maximum(first, second).amin(-1)
    return _seen(enter < leave, enter)


@_fused
def hit_ellipsoid(rays: Tensor, centre: Tensor, rotation: Tensor, half: Tensor) -> Tensor:
    """An ellipsoid with half axes `half` [B, 3] along the columns of `rotation`."""
    origin = (-apply(rotation.transpose(1, 2), centre) / half)[:, None, None]
    slope = torch.einsum("bji,bhwj->bhwi", rotation, rays) / half[:, None, None]
    a, b, c = (slope * slope).sum(-1), (slope * origin).sum(-1), (origin * origin).sum(-1) - 1
    root = b * b - a * c
    return _seen(root > 0, (-b - torch.sqrt(root.clamp_min(0))) / a)


@_fused
def hit_plane(rays: Tensor, point: Tensor, normal: Tensor) -> Tensor:
    """A plane through `point` [B, 3], visible only from the side to which `normal` [B, 3] points."""
    slope = (rays * normal[:, None, None]).sum(-1)
    return _seen(slope < -1e-3, (point * normal).sum(1)[:, None, None] / slope.clamp_max(-1e-3))


def hit_cylinder(rays: Tensor, centre: Tensor, rotation: Tensor, half: Tensor) -> Tensor:
    """A cylinder with flat ends along the first column of `rotation`: half its length is half[:, 0], its radius half[:,
    1]."""
    origin = -apply(rotation.transpose(1, 2), centre)[:, None, None]
    slope = torch.einsum("bji,bhwj->bhwi", rotation, rays)

    # The ray is inside the round surface between two depths, and between the flat ends as in a box.
    a, b = (slope[..., 1:] ** 2).sum(-1).clamp_min(1e-9), (slope[..., 1:] * origin[..., 1:]).sum(-1)
    c = (origin[..., 1:] ** 2).sum(-1) - half[:, None, None, 1] ** 2
    root = b * b - a * c
    width = torch.sqrt(root.clamp_min(0))
    inverse = 1 / torch.where(slope[..., 0].abs() < 1e-6, torch.full_like(b, 1e-6), slope[..., 0])
    ends = [(side * half[:, None, None, 0] - origin[..., 0]) * inverse for side in (-1, 1)]
    enter = torch.maximum((-b - width) / a, torch.minimum(*ends))
    leave = torch.minimum((-b + width) / a, torch.maximum(*ends))
    return _seen((root > 0) & (enter < leave), enter)


def _hit_bar(rays: Tensor, centre: Tensor, rotation: Tensor, half: Tensor) -> Tensor:
    """A capsule along the first column of `rotation` with the radius half[:, 1]."""
    end = rotation[:, :, 0] * (half[:, :1] - half[:, 1:2]).clamp_min(1e-3)
    return hit_capsule(rays, centre - end, centre + end, half[:, 1], half[:, 1])


BOX, ELLIPSOID, CAPSULE, CYLINDER, NOTHING = range(5)


def hit_solid(rays: Tensor, kind: Tensor, centre: Tensor, rotation: Tensor, half: Tensor) -> Tensor:
    """One solid per sample, of `kind` [B]: box, ellipsoid, capsule or cylinder (both along the first axis, with radius
    half[:, 1]), or nothing."""
    depth = torch.full(rays.shape[:3], FAR, device=rays.device)
    for index, hit in enumerate((hit_box, hit_ellipsoid, _hit_bar, hit_cylinder)):
        mine = (kind == index).nonzero()[:, 0]
        depth[mine] = hit(rays[mine], centre[mine], rotation[mine], half[mine])
    return depth


def distance_to_solid(points: Tensor, kind: Tensor, centre: Tensor, rotation: Tensor, half: Tensor) -> Tensor:
    """Signed distances [B, N] of `points` [B, N, 3] from the solids of hit_solid(), FAR from nothing; the distance from
    an ellipsoid is a first-order approximation."""
    local = torch.einsum("bji,bnj->bni", rotation, points - centre[:, None])
    half = half[:, None]

    over = local.abs() - half
    box = over.clamp_min(0).norm(dim=-1) + over.amax(-1).clamp_max(0)
    scaled = (local / half).norm(dim=-1).clamp_min(1e-6)
    ellipsoid = scaled * (scaled - 1) / (local / half ** 2).norm(dim=-1).clamp_min(1e-6)
    reach = (half[..., 0] - half[..., 1]).clamp_min(1e-3)
    nearest = torch.maximum(torch.minimum(local[..., 0], reach), -reach)
    aside = torch.stack([local[..., 0] - nearest, local[..., 1], local[..., 2]], -1)
    capsule = aside.norm(dim=-1) - half[..., 1]
    over = torch.stack([over[..., 0], local[..., 1:].norm(dim=-1) - half[..., 1]], -1)
    cylinder = over.clamp_min(0).norm(dim=-1) + over.amax(-1).clamp_max(0)

    every = torch.stack([box, ellipsoid, capsule, cylinder, torch.full_like(box, FAR)], 1)
    return every[torch.arange(len(kind), device=kind.device), kind]
