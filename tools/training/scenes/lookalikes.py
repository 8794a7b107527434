"""Depths of things that are mistaken for hands: feet, heads, cloth, plants, cables, and the legs of furniture. Camera
frame, metres. All but the cloth consist of capsules."""
import torch
from torch import Tensor

from .chance import Chance
from .rotations import about, apply, frame_along, unit
from .shapes import FAR, hit_capsules, hit_plane

KINDS = {"feet": 0.4, "head": 0.2, "cloth": 0.1, "plant": 0.12, "cables": 0.08, "furniture": 0.1}  # with probabilities
FEET = list(KINDS).index("feet")

# A right foot of 25 cm: x towards the big toe, y up, z towards the toes. A row is one capsule: start, its radius, end,
# its radius. The leg is the first one, the toes are the last five.
_FOOT = [[0, .085, .03, .036, 0, .45, .03, .055], [0, .032, 0, .032, 0, .085, .03, .036],
         [0, .06, .05, .034, .028, .024, .185, .022], [0, .065, .05, .034, 0, .022, .18, .019],
         [-.008, .034, .02, .03, -.032, .017, .16, .016],
         [.028, .018, .185, .016, .026, .013, .24, .0125], [.009, .014, .185, .0105, .010, .009, .24, .0085],
         [-.006, .013, .18, .0095, -.006, .0085, .23, .008], [-.02, .012, .172, .009, -.022, .008, .215, .0075],
         [-.033, .011, .16, .009, -.037, .008, .197, .0075]]

# A head: x to the side, y down, z out of its back. Skull, jaw, cheeks, brow, nose, lips, ears, neck, shoulders.
_HEAD = [[0, -.03, .03, .088, 0, -.02, -.015, .078], [0, .04, 0, .062, 0, .085, -.05, .028],
         [-.03, .02, -.045, .035, .03, .02, -.045, .035], [-.03, -.025, -.075, .018, .03, -.025, -.075, .018],
         [0, -.01, -.09, .01, 0, .025, -.115, .015], [-.015, .055, -.085, .012, .015, .055, -.085, .012],
         [-.08, -.01, .01, .012, -.085, .03, 0, .008], [.08, -.01, .01, .012, .085, .03, 0, .008],
         [0, .08, .03, .055, 0, .2, .05, .06], [-.17, .24, .06, .07, .17, .24, .06, .07]]


def lookalikes(chance: Chance, rays: Tensor, place: Tensor, kind: Tensor) -> Tensor:
    """Depth of a thing of `kind` [B] (index into KINDS; -1: none) at each `place` [B, 3]."""
    depth = torch.full(rays.shape[:3], FAR, device=rays.device)
    makers = {"feet": _feet, "head": _head, "plant": _plant, "cables": _cables, "furniture": _furniture}
    for index, name in enumerate(KINDS):
        mine = (kind == index).nonzero()[:, 0]
        if len(mine) == 0:
            continue
        if name == "cloth":
            depth[mine] = _cloth(chance, rays[mine], place[mine])
        else:
            depth[mine] = hit_capsules(rays[mine], makers[name](chance, place[mine]))
    return depth


def _capsules(table: list[list[float]], like: Tensor) -> tuple[Tensor, Tensor]:
    """Both ends [B, K, 2, 3] and radii [B, K, 2] of a table of capsules, for as many samples as `like` has."""
    ends = torch.tensor(table, device=like.device).reshape(-1, 2, 4).repeat(len(like), 1, 1, 1)
    return ends[..., :3], ends[..., 3]


def _placed(ends: Tensor, radius: Tensor, rotation: Tensor, place: Tensor) -> Tensor:
    """Capsules [B, K, 2, 4] (point and radius of both ends), rotated and then shifted by `place` [B, 3]."""
    ends = torch.einsum("bij,bkej->bkei", rotation, ends) + place[:, None, None]
    return torch.cat([ends, radius[..., None]], -1)


def _feet(chance: Chance, place: Tensor) -> Tensor:
    """A foot, bare or in a sock, with its lower leg, and mostly a second one beside it: seen from its front, by its
    owner (from above, or with the legs stretched out), or from anywhere."""
    count, device = len(place), place.device
    view = chance.choice([0.35, 0.4, 0.25], count)[:, None, None]
    front = torch.tensor([[1.0, 0, 0], [0, -1, 0], [0, 0, -1]], device=device)
    above = torch.tensor([[-1.0, 0, 0], [0, 0, -1], [0, -1, 0]], device=device)
    turn = about("z", chance.normal(0.4, count)) @ about("x", chance.normal(0.45, count)) @ about("y", chance.normal(0.4, count))
    rotation = torch.where(view == 2, chance.rotation(count), turn @ torch.where(view == 0, front, above))
    scale = chance.uniform(0.72, 1.15, count, 1) * torch.exp(chance.normal(0.08, count, 3))
    sock, both = chance.flag(0.25, count), chance.flag(0.65, count)
    first = torch.where(chance.flag(0.5, count), 1.0, -1.0)  # a right or a left one
    apart = first * chance.uniform(-0.35, -0.09, count)

    feet = []
    for foot in range(2):
        ends, radius = _capsules(_FOOT, place)

        # Bend the ankle and the toes; a sock makes one thing of the toes.
        shin = ends[:, 0, 1] - ends[:, 0, 0]
        ends[:, 0, 1] = ends[:, 0, 0] + apply(about("x", chance.normal(0.4, count).clamp(-0.9, 0.6)), shin)
        together = chance.normal(1, count, 1, 3) + chance.normal(0.6, count, 5, 3)
        ends[:, 5:, 1] += together * torch.tensor([0.003, 0.006, 0.004], device=device)
        ends[:, 5:, 1, 0] *= chance.uniform(0.9, 1.3, count, 1)
        radius[:, 5:] *= torch.where(sock, 1.5, 1.0)[:, None, None]

        # Put it down with the middle of its front half at `place`; a foot that is not there goes behind the camera.
        ends = (ends - torch.tensor([0.0, 0.03, 0.15], device=device)) * scale[:, None, None]
        radius = radius * scale.mean(1)[:, None, None]
        mirror = first if foot == 0 else -first
        ends = ends * torch.stack([mirror, torch.ones_like(mirror), torch.ones_like(mirror)], 1)[:, None, None]
        own, where = rotation, place
        if foot == 1:
            own = rotation @ about("y", chance.normal(0.25, count)) @ about("x", chance.normal(0.2, count))
            aside = torch.stack([apart, chance.normal(0.02, count), chance.normal(0.05, count)], 1)
            where = place + apply(rotation, aside)
            where = torch.where(both[:, None], where, torch.tensor([0.0, 0, -9], device=device))
        feet.append(_placed(ends, radius, own, where))
    return torch.cat(feet, 1)


def _head(chance: Chance, place: Tensor) -> Tensor:
    """A head on its shoulders, mostly with the face towards the camera."""
    count = len(place)
    ends, radius = _capsules(_HEAD, place)
    scale = 0.95 * torch.exp(chance.normal(0.08, count, 3))
    back = torch.where(chance.flag(0.15, count), torch.pi, 0.0)
    rotation = about("z", chance.normal(0.2, count)) @ about("x", chance.normal(0.3, count)) @ about("y", chance.normal(0.6, count) + back)
    ends = ends * scale[:, None, None] + chance.normal(0.05, count, 1, 1, 3)
    return _placed(ends, radius * scale.mean(1)[:, None, None], rotation, place)


def _plant(chance: Chance, place: Tensor, stems: int = 12) -> Tensor:
    """Stems and narrow leaves that leave one lump, mostly upwards."""
    count, device = len(place), place.device
    lump = chance.uniform(0.005, 0.05, count, 1)
    up = torch.tensor([0.0, -1, 0], device=device) + chance.normal(0.4, count, 1, 3)
    way = unit(unit(up) + chance.uniform(0.2, 0.7, count, 1, 1) * chance.normal(1, count, stems, 3))
    start = 0.8 * lump[..., None] * chance.normal(0.6, count, stems, 3).clamp(-1, 1)
    end = start + way * chance.uniform(0.04, 0.22, count, 1, 1) * chance.uniform(0.5, 1.3, count, stems, 1)
    thick = chance.log_uniform(0.002, 0.012, count, 1) * chance.uniform(0.7, 1.4, count, stems)
    radius = torch.stack([thick, thick * chance.uniform(0.3, 1.2, count, 1)], -1)

    # The last capsule is the lump, or the trunk below it.
    start[:, -1], end[:, -1] = 0, up[:, 0] * -chance.uniform(0.01, 0.2, count, 1)
    radius[:, -1] = lump
    return torch.cat([torch.stack([start, end], 2) + place[:, None, None], radius[..., None]], -1)


def _cables(chance: Chance, place: Tensor, cables: int = 5, pieces: int = 4) -> Tensor:
    """A bundle of cables that bend together and come apart a little."""
    count, device = len(place), place.device
    way = frame_along(chance.direction(count))
    along = torch.linspace(-1, 1, pieces + 1, device=device) * 0.25
    curve = chance.normal(0.05, count, 1, pieces + 1, 3) + chance.normal(0.012, count, cables, pieces + 1, 3)
    curve = torch.cat([curve[..., :1] * 0.3 + along[:, None], curve[..., 1:]], -1)
    points = torch.einsum("bij,bkpj->bkpi", way, curve) + place[:, None, None]
    ends = torch.stack([points[:, :, :-1], points[:, :, 1:]], 3).flatten(1, 2)
    thick = chance.log_uniform(0.002, 0.01, count, 1, 1).expand(-1, cables * pieces, 2)
    return torch.cat([ends, thick[..., None]], -1)


def _furniture(chance: Chance, place: Tensor) -> Tensor:
    """The legs of a chair or a table with the bars between them, or the star of a swivel chair's base."""
    count, device = len(place), place.device
    corner = torch.tensor([[-1.0, -1], [1, -1], [1, 1], [-1, 1], [0, 0], [0, 0]], device=device)
    wide = chance.uniform(0.1, 0.25, count, 1, 2)
    foot = torch.cat([corner * wide, torch.zeros(count, 6, 1, device=device)], 2)[..., [0, 2, 1]]
    top = foot * chance.uniform(0.7, 1, count, 1, 1)
    top[..., 1] = -chance.uniform(0.3, 0.7, count, 1)
    bars = torch.stack([top[:, :4], top[:, [1, 2, 3, 0]]], 2)
    legs = torch.cat([torch.stack([foot[:, :4], top[:, :4]], 2), bars], 1)

    # The star: five arms around a column.
    angle = torch.arange(5, device=device) * (2 * torch.pi / 5)
    arm = torch.stack([torch.cos(angle), torch.zeros_like(angle), torch.sin(angle)], 1) * chance.uniform(0.15, 0.32, count, 1, 1)
    hub = torch.zeros_like(arm)
    hub[..., 1] = -0.05
    column = torch.tensor([[0.0, -0.05, 0], [0, -0.4, 0]], device=device).expand(count, 3, 2, 3)
    star = torch.cat([torch.stack([hub, arm], 2), column], 1)

    is_star = chance.flag(0.4, count)[:, None, None]
    ends = torch.where(is_star[..., None], star, legs)
    thick = chance.uniform(0.009, 0.028, count, 1, 1)
    radius = torch.cat([thick, thick * torch.where(is_star, 0.55, 1.0)], 2).expand(-1, 8, 2)
    rotation = about("x", chance.normal(0.3, count) + 0.35) @ about("y", chance.uniform(0, 6.3, count)) @ about("z", chance.normal(0.15, count))

    # Let some point of the first leg or arm be at `place`.
    share = chance.uniform(0, 1, count, 1)
    shift = ends[:, 0, 0] + share * (ends[:, 0, 1] - ends[:, 0, 0])
    return _placed(ends - shift[:, None, None], radius, rotation, place)


def _cloth(chance: Chance, rays: Tensor, place: Tensor) -> Tensor:
    """A wavy sheet through `place` that is at most 1 m wide."""
    count = len(place)
    normal = unit(chance.normal(0.5, count, 3) - unit(place))
    axes = frame_along(normal)[:, :, 1:] @ about("x", chance.uniform(0, 6.3, count))[:, 1:, 1:]
    half = chance.log_uniform(0.06, 0.5, count, 1, 1, 2)
    length = chance.log_uniform(0.03, 0.3, count, 1, 1, 3)
    height = length * chance.uniform(0.02, 0.14, count, 1, 1, 3)
    phase, slant = chance.uniform(0, 6.3, count, 1, 1, 3), chance.normal(0.3, count, 1, 1, 3)

    # The waves change the depth at which a ray meets the sheet; three steps of a fixed-point iteration suffice.
    slope = (rays * normal[:, None, None]).sum(-1).clamp_max(-0.05)
    level = (place * normal).sum(1)[:, None, None]
    depth = hit_plane(rays, place, normal)
    for _ in range(3):
        flat = torch.einsum("bhwi,bij->bhwj", rays * depth.clamp_max(9)[..., None] - place[:, None, None], axes)
        waves = height * torch.sin(6.28 / length * (flat[..., :1] + slant * flat[..., 1:]) + phase)
        seen = (flat.abs() < half + waves[..., :2]).all(-1) & (depth < FAR)
        depth = torch.where(depth < FAR, (level + waves.sum(-1)) / slope, depth)
    return torch.where(seen & (depth > 0.1), depth, torch.full_like(depth, FAR))
