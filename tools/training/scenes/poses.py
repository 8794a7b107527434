"""Poses of hands that hold nothing, with joint angles that are correlated as in people."""
import torch
from torch import Tensor

from .chance import Chance
from .skeleton import ANGLES, FINGER_ANGLES, limits

# Probabilities of the kinds of poses.
KINDS = {"free": 0.12, "synergy": 0.38, "counting": 0.22, "relaxed": 0.12, "pinch": 0.16}
_FAN = (0.12, 0.0, -0.09, -0.18)  # abduction of index, middle, ring and little finger in a spread hand [rad]
_BEND = (1.5, 1.75, 1.15)  # flexion of knuckle, middle joint and last joint of a closed finger [rad]


def _closure(chance: Chance, kind: Tensor) -> Tensor:
    """How far each of the four fingers is closed [B, 4]: 0 open, 1 closed."""
    count = len(kind)

    # Let neighbouring fingers move together: ring and little finger most, index and middle finger least.
    step = chance.normal(1, count, 4) * torch.tensor([0.22, 0.15, 0.10, 0.10], device=chance.device)
    walk = torch.flip(torch.cumsum(torch.flip(step, [1]), 1), [1])
    synergy = chance.uniform(-0.1, 1.1, count, 1) + walk
    counting = torch.where(chance.flag(0.5, count, 4), chance.uniform(0.75, 1.05, count, 4), chance.uniform(0, 0.12, count, 4))
    ramp = torch.tensor([0.0, 0.07, 0.14, 0.2], device=chance.device)
    relaxed = chance.uniform(0.05, 0.35, count, 1) + ramp + chance.normal(0.04, count, 4)
    pinch = chance.uniform(0, 0.9, count, 1) + 0.4 * walk

    closure = torch.where((kind == 1)[:, None], synergy, counting)
    closure = torch.where((kind == 3)[:, None], relaxed, closure)
    return torch.where((kind == 4)[:, None], pinch, closure).clamp(0, 1)


def _fingers(chance: Chance, closure: Tensor) -> Tensor:
    """Angles [B, 16] of the four fingers. In some hands mostly the outer joints bend (hook), in some mostly the
    knuckles (table top)."""
    count, styles = len(closure), chance.choice([0.7, 0.15, 0.15], len(closure))[:, None]
    at_knuckle = torch.where(styles == 1, 0.15, torch.where(styles == 2, 1.0, 0.9))
    at_middle = torch.where(styles == 2, 0.2, 1.0)

    knuckle = _BEND[0] * at_knuckle * closure - 0.2 * chance.uniform(0, 1, count, 1) * (1 - closure)
    middle = _BEND[1] * at_middle * closure
    middle = (middle + chance.normal(0.12, count, 4)).clamp_min(0)
    last = _BEND[2] / _BEND[1] * middle * chance.uniform(0.6, 1.1, count, 1) + chance.normal(0.07, count, 4)
    spread = chance.normal(0.9, count, 1) + 0.6
    abduction = torch.tensor(_FAN, device=chance.device) * spread + chance.normal(0.05, count, 4)
    abduction = abduction * (1 - 0.7 * closure)
    return torch.stack([knuckle + chance.normal(0.1, count, 4), abduction, middle, last], -1).reshape(count, 16)


def _thumb(chance: Chance, closure: Tensor) -> Tensor:
    """Angles [B, 5] of the thumb, which is opposed and bent more if the fingers are closed."""
    count = len(closure)
    opposed = (chance.uniform(0, 1, count) * 0.7 + 0.3 * closure.mean(1) * chance.uniform(0, 1.5, count)).clamp(0, 1)
    bent = (chance.normal(0.25, count) + 0.5 * closure.mean(1)).clamp(-0.1, 1)
    angles = torch.stack([-0.25 + 0.75 * opposed, -0.2 + 0.7 * bent * chance.uniform(0.4, 1.2, count), 0.8 * bent,
                          torch.zeros_like(bent), 1.1 * bent * chance.uniform(0.2, 1.2, count)], 1)
    return angles + chance.normal(0.1, count, 5)


def free_poses(chance: Chance, count: int) -> Tensor:
    """Joint angles [count, 21, rad] within the limits."""
    low, high = limits(chance.device).T
    kind = chance.choice(list(KINDS.values()), count)
    closure = _closure(chance, kind)
    angles = torch.cat([_thumb(chance, closure), _fingers(chance, closure)], 1)

    # For a pinch, let the index finger and the thumb meet in front of the palm.
    meeting = torch.tensor([0.45, 0.3, 0.25, 0.0, 0.35, 0.75, 0.0, 0.85, 0.45], device=chance.device)
    pinch = meeting + chance.normal(0.12, count, 9)
    angles[:, :9] = torch.where((kind == 4)[:, None], pinch, angles[:, :9])

    # For free poses, draw independent, uniform angles.
    anything = low + (high - low) * chance.uniform(0, 1, count, ANGLES)
    return torch.minimum(torch.maximum(torch.where((kind == 0)[:, None], anything, angles), low), high)


def bend(angles: Tensor, finger: int, joints: tuple[int, ...], amount: Tensor) -> None:
    """Adds `amount` [B, rad] to the flexion of joints (0 knuckle, 2 middle, 3 last) of a finger (0 index), in place."""
    start = FINGER_ANGLES[finger].start
    for joint in joints:
        angles[:, start + joint] += amount
