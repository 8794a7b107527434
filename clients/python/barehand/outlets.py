"""The conventions in which a hand can be had. docs/frames_and_units.md has one table of all of them, with a test vector."""
import functools
from typing import NamedTuple

import numpy as np

_FINGERS = ("index", "middle", "ring", "little")

#: The 26 joints of OpenXR (XR_EXT_hand_tracking), in its order.
OPENXR_JOINTS = ("palm", "wrist", "thumb_metacarpal", "thumb_proximal", "thumb_distal", "thumb_tip",
                 *(f"{finger}_{joint}" for finger in _FINGERS
                   for joint in ("metacarpal", "proximal", "intermediate", "distal", "tip")))

#: The 25 joints of the WebXR Hand Input Module, in its order and under its names.
WEBXR_JOINTS = ("wrist", "thumb-metacarpal", "thumb-phalanx-proximal", "thumb-phalanx-distal", "thumb-tip",
                *(f"{name}-finger-{joint}" for name in ("index", "middle", "ring", "pinky")
                  for joint in ("metacarpal", "phalanx-proximal", "phalanx-intermediate", "phalanx-distal", "tip")))

#: The 22 channels of a CyberGlove, in its order.
GLOVE_CHANNELS = ("thumb_rotate", "thumb_mpj", "thumb_ij", "thumb_ab", "index_mpj", "index_pij", "index_dij", "middle_mpj",
                  "middle_pij", "middle_dij", "middle_index_ab", "ring_mpj", "ring_pij", "ring_dij", "ring_middle_ab",
                  "pinkie_mpj", "pinkie_pij", "pinkie_dij", "pinkie_ring_ab", "palm_arch", "wrist_pitch", "wrist_yaw")

#: The 16 segments, in the order of hand_state_t.segments.
SEGMENTS = ("palm", "thumb_metacarpal", "thumb_proximal", "thumb_distal",
            *(f"{finger}_{bone}" for finger in _FINGERS for bone in ("proximal", "intermediate", "distal")))

#: Which OpenXR joints the 21 landmarks are: wrist, thumb (4), index (4), middle (4), ring (4), little finger (4).
LANDMARKS_21 = (1, 2, 3, 4, 5, 7, 8, 9, 10, 12, 13, 14, 15, 17, 18, 19, 20, 22, 23, 24, 25)

#: From the camera frame (x right, y down, z forward) to the axes of OpenXR and WebXR (x right, y up, z backward).
T_XR_CAMERA = np.diag([1.0, -1.0, -1.0, 1.0])

#: From the wrist's frame of the hand detector of dex-retargeting to that of MANO, for row vectors (its OPERATOR2MANO_RIGHT
#: and OPERATOR2MANO_LEFT). Both are rotations.
OPERATOR2MANO = {"right": np.array([[0.0, 0, -1], [-1, 0, 0], [0, 1, 0]]),
                 "left": np.array([[0.0, 0, -1], [1, 0, 0], [0, -1, 0]])}


class Joints(NamedTuple):
    """Poses of joints. Every number is NaN, and every flag 0, where there is no pose."""

    position: np.ndarray     #: (n, 3), metres
    orientation: np.ndarray  #: (n, 4), quaternions (x, y, z, w), w >= 0: joint frame to the outlet's frame
    radius: np.ndarray       #: (n,), joint centre to skin, metres
    flags: np.ndarray        #: (n,), XrSpaceLocationFlags: 3 = valid, 15 = valid and tracked; 3 alone: inferred or held


def rotated(T, q):
    """Quaternions (n, 4), (w, x, y, z), in the frame to which T (4x4) maps, with w >= 0."""
    a, b = _quaternion_of_transform(np.asarray(T, float).tobytes()), np.asarray(q, float)
    w = a[0] * b[:, 0] - b[:, 1:] @ a[1:]
    v = a[0] * b[:, 1:] + b[:, :1] * a[1:] + np.cross(a[1:], b[:, 1:])
    product = np.column_stack([w, v])
    return np.where(product[:, :1] < 0, -product, product)


@functools.lru_cache(maxsize=16)  # every frame asks for the same few
def _quaternion_of_transform(T):
    R = np.frombuffer(T).reshape(4, 4)[:3, :3]
    if not np.allclose(R @ R.T, np.eye(3), atol=1e-6) or np.linalg.det(R) < 0:
        raise ValueError("T is no rigid transform: its upper left 3x3 is no rotation")
    return quaternion_of(R)


def quaternion_of(R):
    """(w, x, y, z) of a rotation matrix: the eigenvector to the largest eigenvalue (Bar-Itzhack 2000)."""
    (a, b, c), (d, e, f), (g, h, i) = R
    K = np.array([[a + e + i, h - f, c - g, d - b], [h - f, a - e - i, b + d, c + g],
                  [c - g, b + d, e - a - i, f + h], [d - b, c + g, f + h, i - a - e]])
    return np.linalg.eigh(K)[1][:, -1]


def rotation_of(q):
    """3x3 rotation matrix of a unit quaternion (w, x, y, z)."""
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def joints_in(T, position, orientation, radius, flags):
    """Joints in the frame to which T maps, of joints in the camera frame with quaternions (w, x, y, z)."""
    T = np.asarray(T, float)
    if T.shape != (4, 4):
        raise ValueError(f"T has the shape {T.shape}; a 4x4 matrix that maps camera coordinates is needed")
    return Joints(position @ T[:3, :3].T + T[:3, 3], np.roll(rotated(T, orientation), -1, axis=1), radius, flags)


def mano_rotation(landmarks, handedness):
    """3x3, MANO's wrist frame to the frame of the 21 landmarks (21, 3), as dex-retargeting's hand detector estimates it from
    wrist and knuckles of index and middle finger: x from middle knuckle to wrist within their plane, z towards the index."""
    wrist, index, middle = landmarks[0], landmarks[5], landmarks[9]
    normal = np.cross(middle - wrist, index - wrist)  # of the plane, and so x has no part along it
    normal /= np.linalg.norm(normal)
    x = wrist - middle
    x /= np.linalg.norm(x)
    z = np.cross(x, normal)
    if z @ (index - middle) < 0:
        normal, z = -normal, -z
    return np.column_stack([x, normal, z]) @ OPERATOR2MANO[handedness]
