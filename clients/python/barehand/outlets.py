"""The conventions (OpenXR, WebXR, MANO, CyberGlove) in which the values of a hand are available.
docs/frames_and_units.md has a table of all of them, with a test vector."""
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

#: The 22 channels of a CyberGlove, in the glove's order.
GLOVE_CHANNELS = ("thumb_rotate", "thumb_mpj", "thumb_ij", "thumb_ab", "index_mpj", "index_pij", "index_dij", "middle_mpj",
                  "middle_pij", "middle_dij", "middle_index_ab", "ring_mpj", "ring_pij", "ring_dij", "ring_middle_ab",
                  "pinkie_mpj", "pinkie_pij", "pinkie_dij", "pinkie_ring_ab", "palm_arch", "wrist_pitch", "wrist_yaw")

#: The 16 segments, in the order of hand_state_t.segments.
SEGMENTS = ("palm", "thumb_metacarpal", "thumb_proximal", "thumb_distal",
            *(f"{finger}_{bone}" for finger in _FINGERS for bone in ("proximal", "intermediate", "distal")))

#: Names of the classes of grasps, in the order of the constants of grasp_state_t.
GRASPS = ("none", "wrap", "index_extension", "thumb_along", "ring", "sphere_3", "sphere_4", "extension", "adduction",
          "tripod_variation", "lateral_tripod", "lateral", "pinch", "tripod", "quadpod", "five_fingers",
          "parallel_extension", "writing_tripod")

#: Indices in OPENXR_JOINTS of the 21 landmarks: wrist, thumb (4), index (4), middle (4), ring (4), little finger (4).
LANDMARKS_21 = (1, 2, 3, 4, 5, 7, 8, 9, 10, 12, 13, 14, 15, 17, 18, 19, 20, 22, 23, 24, 25)

#: Maps the camera frame (x right, y down, z forward) to the axes of OpenXR and WebXR (x right, y up, z backward).
T_XR_CAMERA = np.diag([1.0, -1.0, -1.0, 1.0])

#: Rotations from the wrist frame of dex-retargeting's hand detector to that of MANO, for row vectors
#: (OPERATOR2MANO_RIGHT and OPERATOR2MANO_LEFT there).
OPERATOR2MANO = {"right": np.array([[0.0, 0, -1], [-1, 0, 0], [0, 1, 0]]),
                 "left": np.array([[0.0, 0, -1], [1, 0, 0], [0, -1, 0]])}


class Joints(NamedTuple):
    """Poses of joints. Without a pose, every number is NaN and every flag is 0."""

    position: np.ndarray     #: (n, 3), metres
    orientation: np.ndarray  #: (n, 4), quaternions (x, y, z, w), w >= 0: joint frame to the frame of `position`
    radius: np.ndarray       #: (n,), distance from the joint's centre to the skin, metres
    flags: np.ndarray        #: (n,), XrSpaceLocationFlags: 15 = valid and tracked, 3 = only valid: inferred or held


def rotated(T, q):
    """Transforms quaternions q (n, 4), (w, x, y, z), to the frame to which T (4x4) maps. The result has w >= 0."""
    a, b = _quaternion_of_transform(np.asarray(T, float).tobytes()), np.asarray(q, float)
    w = a[0] * b[:, 0] - b[:, 1:] @ a[1:]
    v = a[0] * b[:, 1:] + b[:, :1] * a[1:] + np.cross(a[1:], b[:, 1:])
    product = np.column_stack([w, v])
    return np.where(product[:, :1] < 0, -product, product)


@functools.lru_cache(maxsize=16)  # every frame uses the same few transforms
def _quaternion_of_transform(T):
    R = np.frombuffer(T).reshape(4, 4)[:3, :3]
    if not np.allclose(R @ R.T, np.eye(3), atol=1e-6) or np.linalg.det(R) < 0:
        raise ValueError("T is no rigid transform: its upper left 3x3 is no rotation")
    return quaternion_of(R)


def quaternion_of(R):
    """The quaternion (w, x, y, z) of a rotation matrix, as the eigenvector of the largest eigenvalue of K (Bar-Itzhack,
    "New method for extracting the quaternion from a rotation matrix", 2000)."""
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
    """Transforms joints from the camera frame, with quaternions (w, x, y, z), to the frame to which T (4x4) maps."""
    T = np.asarray(T, float)
    if T.shape != (4, 4):
        raise ValueError(f"T has the shape {T.shape}; a 4x4 matrix that maps camera coordinates is needed")
    return Joints(position @ T[:3, :3].T + T[:3, 3], np.roll(rotated(T, orientation), -1, axis=1), radius, flags)


def mano_rotation(landmarks, handedness):
    """The rotation (3x3) from MANO's wrist frame to the frame of the landmarks (21, 3), estimated like
    dex-retargeting's hand detector from the wrist and the knuckles of index and middle finger. The detector's frame has
    x from the middle knuckle to the wrist, y normal to the plane of the three points, and z on the side of the index
    finger."""
    wrist, index, middle = landmarks[0], landmarks[5], landmarks[9]
    normal = np.cross(middle - wrist, index - wrist)  # normal of the plane of the three points, perpendicular to x
    normal /= np.linalg.norm(normal)
    x = wrist - middle
    x /= np.linalg.norm(x)
    z = np.cross(x, normal)
    if z @ (index - middle) < 0:
        normal, z = -normal, -z
    return np.column_stack([x, normal, z]) @ OPERATOR2MANO[handedness]
