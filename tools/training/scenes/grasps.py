"""Grasps: an object is placed in the hand, and the fingers close until their skin touches it. Hand frame, metres."""
import torch
from torch import Tensor

from .chance import Chance
from .hands import Hands
from .objects import Solids, objects
from .rotations import about, apply, frame_along, unit
from .skeleton import KNUCKLES, TIPS, forward_kinematics, landmarks, limits

_STEPS = 10  # number of steps in which a finger closes; all of them are tested at once
# The stages of closing, one after the other: whole fingers, then their outer joints, then the last joints. Of each
# stage: (index of one of the 21 angles, its change [rad]) for the thumb (0) and for the index finger (1); the other
# fingers are like the index finger.
_STAGES = [
    {0: [(1, 0.5), (2, 0.5)], 1: [(5, 1.3), (7, 1.3), (8, 0.7)]},
    {0: [(2, 0.6), (4, 0.9)], 1: [(7, 1.0), (8, 0.5)]},
    {0: [(4, 0.6)], 1: [(8, 0.6)]},
]


def _place(chance: Chance, hands: Hands, open_angles: Tensor, solids: Solids) -> Tensor:
    """Places each object against the palm or between thumb and fingertips. Returns [B]: whether against the palm."""
    count = len(open_angles)
    joints = landmarks(hands.bones, forward_kinematics(hands.bones, open_angles))
    knuckles, thumb = joints[:, KNUCKLES], joints[:, 3]
    against_palm = chance.flag(0.65, count)

    # Choose the direction of the long axis: across the palm, or any direction.
    across = unit(knuckles[:, 3] - knuckles[:, 0])
    wobble = unit(across + chance.normal(0.35, count, 3))
    solids.rotation = frame_along(torch.where(chance.flag(0.8, count)[:, None], wobble, chance.direction(count)))
    solids.rotation = solids.rotation @ about("x", chance.uniform(0, 6.3, count))

    # Turn those parts that are not gripped away from the palm.
    inwards = apply(solids.rotation, solids.offset.mean(1))[:, 1] > 0
    solids.rotation = solids.rotation @ about("x", torch.where(inwards, torch.pi, 0.0))

    # Choose the position: below the knuckles, or where thumb and fingers meet.
    share = chance.uniform(0.1, 0.75, count, 1)
    on_palm = knuckles[:, 1] * (1 - 0.5 * share) + 0.15 * (knuckles[:, 3] - knuckles[:, 0]) * chance.normal(1, count, 1)
    ahead = 0.5 * (thumb + joints[:, [7, 11]].mean(1)) + chance.normal(0.008, count, 3)
    spot = torch.where(against_palm[:, None], on_palm, ahead)

    # Move the object along the palm's normal until it touches the palm's skin from outside.
    away = torch.tensor([0.0, -1.0, 0.0], device=chance.device)
    flesh = torch.where(against_palm, 1.25 * hands.flesh[:, 9], 0.5 * hands.flesh[:, 7])
    solids.centre = spot + 0.5 * away * solids.half[:, 0].amin(1, keepdim=True)
    for _ in range(8):
        gap = (solids.distance(spot[:, None])[:, 0] - flesh).clamp(-0.04, 0.04)
        solids.centre = solids.centre - away * torch.where(against_palm, gap, gap.clamp_max(0) * 0.5)[:, None]
    return against_palm


def _touching(bones, flesh: Tensor, angles: Tensor, solids: Solids) -> Tensor:
    """Whether a finger's flesh reaches more than 2 mm into the object [B, 5]."""
    joints = landmarks(bones, forward_kinematics(bones, angles))
    hit = []
    for finger in range(5):
        chain = joints[:, 1 + 4 * finger:5 + 4 * finger]
        radius = flesh[:, 1 + 4 * finger:5 + 4 * finger]
        places = torch.cat([chain[:, 1:], 0.5 * (chain[:, 1:] + chain[:, :-1])], 1)
        reach = torch.cat([radius[:, 1:], 0.5 * (radius[:, 1:] + radius[:, :-1])], 1)
        hit.append((solids.distance(places) < reach - 0.002).any(1))
    return torch.stack(hit, 1)


def _close(hands: Hands, angles: Tensor, solids: Solids, stage: dict[int, list[tuple[int, float]]]) -> Tensor:
    """The angles after each finger has moved through the stage until it touches the object."""
    count, device = len(angles), angles.device
    share = torch.linspace(0, 1, _STEPS, device=device)
    motion = torch.zeros(5, 21, device=device)
    for finger in range(5):
        for index, amount in stage[min(finger, 1)]:
            motion[finger, index + 4 * max(finger - 1, 0)] = amount

    # Try all steps of all hands at once.
    tried = angles[:, None] + share[:, None] * motion.sum(0)
    tried = torch.minimum(tried, limits(device)[:, 1]).reshape(-1, 21)
    many = hands.bones.repeated(_STEPS)
    hit = _touching(many, hands.flesh.repeat_interleave(_STEPS, 0), tried, solids.repeated(_STEPS))
    free = (torch.cumsum(hit.reshape(count, _STEPS, 5).int(), 1) == 0).sum(1)  # steps before the first touch [B, 5]
    moved = share[(free - 1).clamp_min(0)]
    return torch.minimum(angles + moved @ motion, torch.maximum(limits(device)[:, 1], angles))


def grasps(chance: Chance, hands: Hands) -> tuple[Tensor, Solids, Tensor]:
    """Angles [B, 21] of hands that hold objects, the objects, and the distance of each fingertip's skin from its hand's
    object [B, 5, m]."""
    count = len(hands.flesh)
    solids = objects(chance, count)
    angles = torch.zeros(count, 21, device=chance.device)
    angles[:, :5] = torch.tensor([0.4, -0.2, 0.0, 0.0, 0.0], device=chance.device) + chance.normal(0.1, count, 5)
    angles[:, 6::4] = torch.tensor([0.1, 0.0, -0.08, -0.15], device=chance.device) * chance.uniform(0, 2, count, 1)
    angles[:, 5::4] = chance.uniform(-0.2, 0.5, count, 1) + chance.normal(0.08, count, 4)
    against_palm = _place(chance, hands, angles, solids)
    angles[:, 5::4] -= 0.25 * against_palm[:, None]

    # Close the fingers. Some of them stay away from the object, as little fingers and pointing ones do.
    closed = angles
    for stage in _STAGES:
        closed = _close(hands, closed, solids, stage)
    idle = chance.flag(0.08, count, 5).float().repeat_interleave(torch.tensor([5, 4, 4, 4, 4], device=chance.device), 1)
    closed = closed + idle * (angles - closed)

    tips = landmarks(hands.bones, forward_kinematics(hands.bones, closed))[:, TIPS]
    return closed, solids, solids.distance(tips) - hands.flesh[:, TIPS]
