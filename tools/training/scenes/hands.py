"""Batches of right hands of different people: each has a skeleton, and points on the skin that follow it."""
import math
from dataclasses import dataclass

import torch
from torch import Tensor

from .chance import Chance
from .skeleton import Bones, forward_kinematics, landmarks


@dataclass
class Hands:
    """B hands with P skin points each. A point follows two segments.

    `segment` [B, P, 2]: the segments that a point follows; `weight` [B, P, 2]: its weights, which sum to 1; `local`
    [B, P, 2, 3]: the position of the point in the frame of each segment [m]; `flesh` [B, 21]: radius of the hand around
    each landmark [m].
    """
    bones: Bones
    segment: Tensor
    weight: Tensor
    local: Tensor
    flesh: Tensor

    def posed(self, angles: Tensor) -> tuple[Tensor, Tensor]:
        """Skin points [B, P, 3] and landmarks [B, 21, 3] in the hand's frame [m] for joint angles [B, 21, rad]."""
        poses = forward_kinematics(self.bones, angles)
        count, points = self.segment.shape[:2]
        skin = torch.zeros(count, points, 3, device=angles.device)
        for k in range(2):
            index = self.segment[:, :, k, None].expand(-1, -1, 12)
            own = poses.reshape(count, -1, 12).gather(1, index).reshape(count, points, 3, 4)
            moved = torch.einsum("bpij,bpj->bpi", own[..., :3], self.local[:, :, k]) + own[..., 3]
            skin = skin + self.weight[:, :, k, None] * moved
        return skin, landmarks(self.bones, poses)


def joined(parts: list[Hands]) -> Hands:
    """Joins several batches to one."""
    def cat(name: str) -> Tensor:
        return torch.cat([getattr(part, name) for part in parts])
    bones = Bones(*(torch.cat([getattr(part.bones, name) for part in parts]) for name in ("turn", "joint", "tip")))
    return Hands(bones, cat("segment"), cat("weight"), cat("local"), cat("flesh"))


def unusual(chance: Chance, count: int) -> tuple[Tensor, Tensor]:
    """Logarithms of factors of size and of thickness [B, 1], 0 for two of three people: small children's hands, large
    ones, thin ones, and hands in thick gloves."""
    rare = chance.flag(0.33, count, 1)
    size = chance.normal(0.17, count, 1).clamp(math.log(0.7), math.log(1.25))
    flesh = chance.normal(0.17, count, 1).clamp(math.log(0.75), math.log(1.4))
    return rare * size, rare * flesh
