"""The hand's 16 segments, 21 joint angles and 21 landmarks, in the order and the frames of docs/frames_and_units.md.

The frame of a segment: origin at the proximal end, -z along the bone, +y out of the back of the hand, x along the
flexion axis. All hands here are right hands; a left hand is made by mirroring when it is put into a scene.
"""
from dataclasses import dataclass
from typing import Optional

import torch
from torch import Tensor

from .rotations import about

SEGMENTS = 16
PARENT = [-1] + [0 if k == 0 else 3 * f + k for f in range(5) for k in range(3)]  # parent of segment 1 + 3 f + k
DISTAL = [3, 6, 9, 12, 15]

# For each segment, the indices of its flexion and its abduction among the 21 angles. Positive flexion bends towards the
# palm, positive abduction turns towards the thumb's side.
FLEXION: list[Optional[int]] = [None, 1, 2, 4] + [5 + 4 * f + i for f in range(4) for i in (0, 2, 3)]
ABDUCTION: list[Optional[int]] = [None, 0, 3, None] + [i for f in range(4) for i in (6 + 4 * f, None, None)]
FINGER_ANGLES = {finger: slice(5 + 4 * finger, 9 + 4 * finger) for finger in range(4)}  # 0 index to 3 little finger
ANGLES = 21

_FINGER_LIMITS = [(-20, 90), (-18, 18), (0, 108), (-5, 80)]
LIMITS_DEGREES = [(-22, 32), (-23, 37), (-10, 55), (-8, 8), (-12, 80)] + 4 * _FINGER_LIMITS

LANDMARKS = 21
WRIST, MIDDLE_KNUCKLE = 0, 9
KNUCKLES = [5, 9, 13, 17]
TIPS = [4, 8, 12, 16, 20]


def limits(device: torch.device) -> Tensor:
    """Lowest and highest value of every angle [21, 2, rad]."""
    return torch.deg2rad(torch.tensor(LIMITS_DEGREES, dtype=torch.float32, device=device))


@dataclass
class Bones:
    """The skeletons of a batch of hands. `turn` [B, 16, 3, 3]: rotation of a segment in its parent's frame at zero
    angles; `joint` [B, 16, 3]: origin of a segment in its parent's frame [m]; `tip` [B, 5, 3]: centre of a fingertip in
    the frame of the finger's last segment [m]."""
    turn: Tensor
    joint: Tensor
    tip: Tensor

    def repeated(self, times: int) -> "Bones":
        """The batch with each hand repeated `times` times in a row."""
        return Bones(*(part.repeat_interleave(times, 0) for part in (self.turn, self.joint, self.tip)))


def forward_kinematics(bones: Bones, angles: Tensor) -> Tensor:
    """Transforms [B, 16, 3, 4] from the segments' frames to the hand's frame, for joint angles [B, 21, rad]."""
    poses = []
    for segment in range(SEGMENTS):
        rotation, place = bones.turn[:, segment], bones.joint[:, segment]
        if (abduction := ABDUCTION[segment]) is not None:
            rotation = rotation @ about("y", angles[:, abduction])
        if (flexion := FLEXION[segment]) is not None:
            rotation = rotation @ about("x", -angles[:, flexion])
        if segment > 0:
            parent = poses[PARENT[segment]]
            place = torch.einsum("bij,bj->bi", parent[:, :, :3], place) + parent[:, :, 3]
            rotation = parent[:, :, :3] @ rotation
        poses.append(torch.cat([rotation, place[..., None]], -1))
    return torch.stack(poses, 1)


def landmarks(bones: Bones, poses: Tensor) -> Tensor:
    """Landmarks [B, 21, 3] in the hand's frame [m], for the segments' `poses` of forward_kinematics()."""
    last = poses[:, DISTAL]
    tips = torch.einsum("bfij,bfj->bfi", last[..., :3], bones.tip) + last[..., 3]
    points = [poses[:, 0, :, 3]]
    for finger in range(5):
        points += [poses[:, 1 + 3 * finger + k, :, 3] for k in range(3)] + [tips[:, finger]]
    return torch.stack(points, 1)
