"""Depth images of whole scenes with their truth, from which both networks learn."""
from dataclasses import dataclass
from pathlib import Path

import torch
from torch import Tensor

from .chance import Chance
from .grasps import grasps
from .hands import Hands, joined
from .lookalikes import KINDS, lookalikes
from .mesh_hand import MeshRig
from .parametric_hand import ParametricRig
from .motion import seen_in_motion
from .objects import Solids
from .pairs import beside, partners
from .people import Stance, arms, bodies, stances
from .poses import free_poses
from .rotations import apply
from .sensors import cut, measure
from .shapes import FAR, NOTHING, hit_solid, only
from .skeleton import MIDDLE_KNUCKLE, WRIST
from .skin import keep_skin
from .surroundings import clutter, occluders, planes
from .views import CROP_ACROSS, View, crop_view, draw_points, full_view

BACKGROUND, HAND, ARM, OBJECT = range(4)
_UPSIDE_DOWN = 0.2  # probability that an image is upside down
_MEAN_PALM = 0.095  # distance from wrist to middle knuckle of a mean hand [m]


@dataclass
class Scenes:
    """B depth images with their truth about two hands: hand 0 is the one in question, hand 1 is another one.

    `depth` [B, H, W, m; 0: no depth]; `label` [B, H, W]; `joints` [B, 2, 21, 3, m, camera frame]; `uv` [B, 2, 21, 2,
    pixels]; `pixels` [B, 2]: number of pixels that show each hand, 0 if there is no such hand; `right` [B, 2]: whether
    it is a right hand; `grasp` [B]: whether hand 0 holds an object; `sensor` [B]: index into sensors.KINDS; `lookalike` [B]:
    which thing that is no hand stands out, as an index into lookalikes.KINDS (-1: none).
    """
    view: View
    depth: Tensor
    label: Tensor
    joints: Tensor
    uv: Tensor
    pixels: Tensor
    right: Tensor
    grasp: Tensor
    sensor: Tensor
    lookalike: Tensor
    middle: Tensor  # the point at the centre of a window; in a whole frame, the palm of hand 0 [B, 3, m]

    def palms(self) -> Tensor:
        """Centres of the palms [B, 2, 3], midway between wrist and middle knuckle."""
        return 0.5 * (self.joints[:, :, WRIST] + self.joints[:, :, MIDDLE_KNUCKLE])


class Generator:
    """Makes scenes. `mesh`: the simulator's right hand (right.glb); None: only the parametric hand is used. `hands`:
    share of the windows that show a hand."""

    def __init__(self, chance: Chance, mesh: Path | None, points: int = 12000, hands: float = 0.86) -> None:
        self.chance, self.hands = chance, hands
        self.rigs = [ParametricRig(points, chance.device)]
        if mesh is not None:
            self.rigs.append(MeshRig(mesh, points, chance.device))

    def people(self, count: int) -> Hands:
        """Hands of `count` people, in equal parts from each rig."""
        shares = [(count + i) // len(self.rigs) for i in range(len(self.rigs))]
        return joined([rig.people(self.chance, share) for rig, share in zip(self.rigs, shares) if share])

    def frames(self, count: int) -> Scenes:
        """Whole frames with hands 0.16 to 1.6 m away; 22 % show no hand."""
        chance = self.chance
        view = full_view(chance.uniform(0.8, 1.15, count))
        rows, columns = view.size
        z = chance.log_uniform(0.16, 1.6, count)
        u, v = chance.uniform(0.03, 0.97, count) * columns, chance.uniform(0.03, 0.97, count) * rows
        place = torch.stack([(u - view.cx) * z / view.focal, (v - view.cy) * z / view.focal, z], 1)
        return self._make(view, place, place, chance.flag(0.78, count), True)

    def windows(self, count: int) -> Scenes:
        """Windows around palms, up to 4.5 cm off centre along each axis; most of those without a hand show something that
        is like one, or an object."""
        chance = self.chance
        z = chance.log_uniform(0.16, 1.6, count)
        place = torch.stack([chance.uniform(-0.5, 0.5, count) * z, chance.uniform(-0.4, 0.4, count) * z, z], 1)
        middle = place + chance.uniform(-0.045, 0.045, count, 3)
        view = crop_view(middle, CROP_ACROSS * chance.uniform(0.9, 1.12, count))
        return self._make(view, place, middle, chance.flag(self.hands, count), False)

    def _make(self, view: View, place: Tensor, middle: Tensor, present: Tensor, whole: bool) -> Scenes:
        """`place` [B, 3]: position of hand 0's palm; `middle` [B, 3]: see Scenes; `present` [B]: whether there are
        hands at all; `whole`: whether these are whole frames."""
        chance, count = self.chance, len(place)
        rays = view.rays()

        # Make hand 0, which holds an object in two of five scenes, and another hand near it.
        hands, stance = self.people(count), stances(chance, count)
        holding, solids, _ = grasps(chance, hands)
        grasp = chance.flag(0.4, count)
        angles = torch.where(grasp[:, None], holding, free_poses(chance, count))
        right = chance.flag(0.5, count)
        skin, joints, origin = _put(hands, angles, right, stance, place)
        other = partners(chance, stance, right, place)
        other_skin, other_joints, _ = _put(self.people(count), other.angles, other.right, other.stance, other.place)
        both = present & chance.flag(0.3, count) & (other.place[:, 2] > 0.12)

        # Make the surfaces. In a window, the other hand counts as background.
        size = (joints[:, MIDDLE_KNUCKLE] - joints[:, WRIST]).norm(dim=1) / _MEAN_PALM
        arm, shoulder = arms(chance, rays, stance, joints[:, WRIST], size)
        other_arm, _ = arms(chance, rays, other.stance, other_joints[:, WRIST], size)
        arm = torch.minimum(arm, only(both, other_arm))
        lookalike = _lookalike_kinds(chance, present)
        arm = only(present | (lookalike < 0) & chance.flag(0.6, count), arm)
        rest = planes(chance, rays, torch.cat([joints, only_joints(both, other_joints, joints)], 1))
        rest = torch.minimum(rest, clutter(chance, rays, place))
        others = lookalikes(chance, rays, place + present[:, None] * beside(chance, place, 0.25), lookalike)
        whose = (chance.flag(0.55, count) & ~stance.egocentric).nonzero()[:, 0]  # bodies take long, and half are not seen
        others[whose] = torch.minimum(others[whose], bodies(chance, rays[whose], shoulder[whose]))
        shown = torch.where(present, grasp, (lookalike < 0) & chance.flag(0.7, count))
        thing = torch.minimum(_held(rays, solids, shown, right, stance, origin), occluders(chance, rays, place))
        # Each layer: depth, label, and the probability that it has the colour of skin.
        layers = [(rest, BACKGROUND, 0.0), (only(present, draw_points(view, skin)), HAND, 1.0),
                  (only(both, draw_points(view, other_skin)), HAND if whole else BACKGROUND, 1.0), (arm, ARM, 0.5),
                  (thing, OBJECT, 0.15), (others, BACKGROUND, 0.5)]
        layer_depths, layer_labels, skin_probabilities = zip(*layers)

        # Find the nearest surface at every pixel, and simulate a sensor. A quick hand moves by up to 3 cm meanwhile. Some
        # sensors hang upside down, or look at a person from above the other side of a desk.
        motion = 0.03 * view.focal / place[:, 2]
        depth, winner = seen_in_motion(chance, torch.stack(layer_depths, 1), motion)
        every = torch.stack([joints, other_joints], 1)
        turned = chance.flag(_UPSIDE_DOWN, count)
        view, middle = view.upside_down(turned), middle.clone()
        for image in (depth, winner):
            image[turned] = image[turned].flip(1, 2)
        middle[turned, :2] *= -1
        every[turned, :, :, :2] *= -1
        label = torch.tensor(layer_labels, device=chance.device)[winner]
        visible = depth < FAR
        measured, sensor = measure(chance, depth, view)
        if not whole:
            inside = ~cut(chance, view)
            measured, visible = measured * inside, visible & inside
        measured, gone = keep_skin(chance, measured, winner, skin_probabilities)
        visible = visible & ~gone
        label = torch.where(visible, label, torch.zeros_like(label))
        shown = [((winner == 1 + hand) & visible).flatten(1).sum(1) for hand in range(2)]
        pixels = torch.stack([shown[0] * present, shown[1] * both], 1)
        uv = view.project(every.flatten(1, 2)).reshape(count, 2, -1, 2)
        return Scenes(view, measured, label, every, uv, pixels, torch.stack([right, other.right], 1), grasp & present,
                      sensor, lookalike, middle)


def only_joints(mask: Tensor, joints: Tensor, otherwise: Tensor) -> Tensor:
    """`joints` [B, 21, 3] for those samples for which `mask` [B] is true, `otherwise` for the others."""
    return torch.where(mask[:, None, None], joints, otherwise)


def _flip(right: Tensor) -> Tensor:
    """Factors [B, 3] that mirror the x coordinates of left hands."""
    sign = torch.where(right, 1.0, -1.0)
    return torch.stack([sign, torch.ones_like(sign), torch.ones_like(sign)], 1)


def _put(hands: Hands, angles: Tensor, right: Tensor, stance: Stance, place: Tensor) -> tuple[Tensor, Tensor, Tensor]:
    """Places the hands with their palms' centres at `place` [B, 3]. Returns skin, joints and the origins of the hands'
    frames, all in the camera's frame [m]."""
    skin, joints = hands.posed(angles)
    flip = _flip(right)[:, None]
    skin, joints = apply(stance.rotation, flip * skin), apply(stance.rotation, flip * joints)
    origin = place - 0.5 * (joints[:, WRIST] + joints[:, MIDDLE_KNUCKLE])
    return skin + origin[:, None], joints + origin[:, None], origin


def _held(rays: Tensor, solids: Solids, shown: Tensor, right: Tensor, stance: Stance, origin: Tensor) -> Tensor:
    """Depth of the objects in those hands for which `shown` [B] is true."""
    flip, depth = _flip(right), None
    for kind, centre, rotation, half in solids.parts():
        kind = torch.where(shown, kind, torch.full_like(kind, NOTHING))
        part = hit_solid(rays, kind, apply(stance.rotation, flip * centre) + origin,
                         stance.rotation @ (flip[:, :, None] * rotation), half)
        depth = part if depth is None else torch.minimum(depth, part)
    return depth


def _lookalike_kinds(chance: Chance, present: Tensor) -> Tensor:
    """For every scene, which thing that is mistaken for a hand is in it, -1 for none: there is one in most scenes
    without a hand and in a tenth of the others."""
    count = len(present)
    wanted = torch.where(present, chance.flag(0.1, count), chance.flag(0.6, count))
    kind = chance.choice(list(KINDS.values()), count)
    return torch.where(wanted, kind, torch.full_like(kind, -1))
