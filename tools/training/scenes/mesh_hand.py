"""Hands of different people, made from one rigged mesh by changing the bones' lengths, the thickness and the
proportions."""
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from .chance import Chance
from .gltf import JOINTS, RiggedMesh, read_hand
from .hands import Hands, unusual
from .skeleton import PARENT, SEGMENTS, Bones

# The rigid segment that moves with each of the 25 joints, and the joint of each segment.
_SEGMENT_OF_JOINT = [0, 1, 2, 3, 3] + [s for f in range(1, 5) for s in (0, 3 * f + 1, 3 * f + 2, 3 * f + 3, 3 * f + 3)]
_JOINT_OF_SEGMENT = [_SEGMENT_OF_JOINT.index(s) for s in range(SEGMENTS)]
_TIP_JOINTS = [i for i, name in enumerate(JOINTS) if name.endswith("_tip")]


def _bend(turn: np.ndarray) -> np.ndarray:
    """A rotation about x that removes the flexion that a joint's rotation at rest, `turn`, contains."""
    flexion = np.arctan2(turn[1, 2], turn[1, 1])
    c, s = np.cos(flexion), np.sin(flexion)
    return np.array([[1, 0, 0], [0, c, -s], [0, s, c]])


class MeshRig:
    """A rigged hand mesh from which hands of any number of people can be made."""

    def __init__(self, path: Path, points: int, device: torch.device) -> None:
        """Reads the mesh. `points`: number of points that are spread over the skin."""
        mesh = read_hand(path)
        frames = mesh.joints[_JOINT_OF_SEGMENT]
        inverse = np.linalg.inv(frames)
        relative = [np.eye(4)] + [inverse[PARENT[s]] @ frames[s] for s in range(1, SEGMENTS)]

        # Make the fingers straight at zero angles, whatever the mesh's rest pose is; only the thumb's root keeps its
        # rotation at rest. A knuckle's flexion is measured from its metacarpal, which is part of the palm here.
        turns = [frame[:3, :3] for frame in relative]
        for s in range(2, SEGMENTS):
            bone = np.linalg.inv(mesh.joints[_JOINT_OF_SEGMENT[s] - 1]) @ frames[s]
            turns[s] = turns[s] @ _bend(bone[:3, :3])
        vertex_weights = np.zeros((len(mesh.vertices), SEGMENTS))
        for joint, segment in enumerate(_SEGMENT_OF_JOINT):
            vertex_weights[:, segment] += mesh.weights[:, joint]
        places, weights = _spread(mesh, vertex_weights, points)

        # Let each point follow the two segments with the largest weights.
        best = np.argsort(-weights, axis=1, kind="stable")[:, :2]
        share = np.take_along_axis(weights, best, 1)
        ahead = np.concatenate([places, np.ones((points, 1))], 1)
        local = np.einsum("pkij,pj->pki", inverse[best], ahead)[..., :3]

        self.turn, self.joint = _tensor(np.stack(turns), device), _tensor(np.stack(relative)[:, :3, 3], device)
        self.tip = _tensor(np.stack([_tip(mesh, vertex_weights, f, inverse) for f in range(5)]), device)
        self.segment = torch.tensor(best, device=device)
        self.weight, self.local = _tensor(share / share.sum(1, keepdims=True), device), _tensor(local, device)

    def people(self, chance: Chance, count: int) -> Hands:
        """Hands of `count` people."""
        other_size, other_flesh = unusual(chance, count)
        size = torch.exp(chance.normal(0.1, count, 1) + other_size)
        finger = torch.exp(chance.normal(0.05, count, 5)).repeat_interleave(3, 1)
        long = size * torch.cat([torch.exp(chance.normal(0.05, count, 1)),
                                 finger * torch.exp(chance.normal(0.04, count, 15))], 1)
        fingers = torch.tensor([0.5] + 15 * [1.0], device=chance.device)  # the palm's thickness varies less
        thick = size * torch.exp(other_flesh * fingers + chance.normal(0.1, count, 1) + chance.normal(0.04, count, SEGMENTS))
        wide = thick * torch.exp(chance.normal(0.04, count, 1))
        wide[:, 0] = size[:, 0] * torch.exp(chance.normal(0.06, count))
        scale = torch.stack([wide, thick, long], -1)  # factors along x, y, z of each segment [count, 16, 3]

        parent = scale[:, [max(p, 0) for p in PARENT]]
        tips = self.tip * scale[:, [3, 6, 9, 12, 15]]
        bones = Bones(self.turn.expand(count, -1, -1, -1), self.joint * parent, tips)
        per_point = scale[:, self.segment]  # factors for both segments of each point [count, P, 2, 3]
        flesh = 0.0085 * torch.cat([1.5 * thick[:, :1], thick[:, [i for f in range(5) for i in
                                                                 (3 * f + 1, 3 * f + 2, 3 * f + 3, 3 * f + 3)]]], 1)
        return Hands(bones, self.segment.expand(count, -1, -1), self.weight.expand(count, -1, -1),
                     self.local * per_point, flesh)


def _tensor(values: np.ndarray, device: torch.device) -> Tensor:
    return torch.tensor(values, dtype=torch.float32, device=device)


def _spread(mesh: RiggedMesh, weights: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Points [count, 3], random and uniform on the skin, and their weights [count, 16]."""
    corners = mesh.vertices[mesh.triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    random = np.random.default_rng(0)
    chosen = random.choice(len(area), count, p=area / area.sum())
    share = random.random((count, 2))
    share[share.sum(1) > 1] = 1 - share[share.sum(1) > 1]
    mix = np.concatenate([1 - share.sum(1, keepdims=True), share], 1)
    return (np.einsum("pk,pki->pi", mix, corners[chosen]),
            np.einsum("pk,pkj->pj", mix, weights[mesh.triangles[chosen]]))


def _tip(mesh: RiggedMesh, weights: np.ndarray, finger: int, inverse: np.ndarray) -> np.ndarray:
    """Centre of a fingertip's round end in the frame of its segment [m]: one radius before the end of the skin."""
    segment = 3 * finger + 3
    frame = inverse[segment]
    skin = mesh.vertices[weights.argmax(1) == segment] @ frame[:3, :3].T + frame[:3, 3]
    joint = frame[:3, :3] @ mesh.joints[_TIP_JOINTS[finger], :3, 3] + frame[:3, 3]
    along = joint / np.linalg.norm(joint)
    forward = skin @ along
    aside = np.linalg.norm(skin - forward[:, None] * along, axis=1)
    middle = np.abs(forward - 0.6 * forward.max()) < 0.25 * forward.max()
    return (forward.max() - aside[middle].mean()) * along
