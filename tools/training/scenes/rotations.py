"""Rotations about coordinate axes and small vector algebra, batched."""
import torch
from torch import Tensor


def about(axis: str, angle: Tensor) -> Tensor:
    """Rotation matrices [..., 3, 3] by `angle` [..., rad] about the axis "x", "y" or "z"."""
    c, s, one, zero = torch.cos(angle), torch.sin(angle), torch.ones_like(angle), torch.zeros_like(angle)
    entries = {"x": [one, zero, zero, zero, c, -s, zero, s, c],
               "y": [c, zero, s, zero, one, zero, -s, zero, c],
               "z": [c, -s, zero, s, c, zero, zero, zero, one]}[axis]
    return torch.stack(entries, -1).reshape(*angle.shape, 3, 3)


def apply(rotation: Tensor, vector: Tensor) -> Tensor:
    """The product of matrices [B, 3, 3] and vectors [B, 3] or [B, N, 3]."""
    if vector.dim() == 2:
        return torch.einsum("bij,bj->bi", rotation, vector)
    return torch.einsum("bij,bnj->bni", rotation, vector)


def frame_along(axis: Tensor) -> Tensor:
    """Rotation matrices [B, 3, 3] whose first column is the unit vector `axis` [B, 3]."""
    helper = torch.zeros_like(axis)
    helper.scatter_(1, axis.abs().argmin(1, keepdim=True), 1.0)
    second = torch.nn.functional.normalize(torch.cross(axis, helper, dim=1), dim=1)
    return torch.stack([axis, second, torch.cross(axis, second, dim=1)], -1)


def unit(vector: Tensor) -> Tensor:
    """`vector` [..., 3] scaled to length 1."""
    return torch.nn.functional.normalize(vector, dim=-1)
