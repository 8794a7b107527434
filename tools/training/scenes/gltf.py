"""Reads a rigged right hand from a binary glTF file whose joints have the names of WebXR or OpenXR."""
import json
import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np

_TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
_FINGERS = ("thumb", "index", "middle", "ring", "little")
_BONES = {"thumb": ("metacarpal", "proximal", "distal", "tip"),
          "other": ("metacarpal", "proximal", "intermediate", "distal", "tip")}
JOINTS = ["wrist"] + [f"{f}_{b}" for f in _FINGERS for b in _BONES["thumb" if f == "thumb" else "other"]]
_FILLERS = {"xr", "hand", "joint", "ext", "finger", "phalanx", "left", "right", "l", "r"}


@dataclass
class RiggedMesh:
    """A rigged hand at rest. `vertices` [V, 3] in the wrist's frame [m]; `triangles` [T, 3]; `weights` [V, 25] of the
    JOINTS; `joints` [25, 4, 4]: joint coordinate frames of the rest pose, in the wrist's frame (-z towards the
    fingertips, +y out of the back of the hand)."""
    vertices: np.ndarray
    triangles: np.ndarray
    weights: np.ndarray
    joints: np.ndarray


def plain_name(name: str) -> str:
    """The name of a joint as in JOINTS: "index-finger-phalanx-proximal" (WebXR) and "XR_HAND_JOINT_INDEX_PROXIMAL_EXT"
    (OpenXR) become "index_proximal"."""
    words = "".join(c.lower() if c.isalnum() else " " for c in name).split()
    return "_".join("little" if word == "pinky" else word for word in words if word not in _FILLERS)


def _chunks(path: Path) -> tuple[dict, bytes]:
    """The two chunks of a binary glTF file: the JSON document and the binary data."""
    data = path.read_bytes()
    if data[:4] != b"glTF":
        raise ValueError(f"{path}: is no binary glTF file; fetch the hands with deploy/fetch_hand_mesh.sh")
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + length]), data[28 + length:]


def _array(document: dict, binary: bytes, accessor: int) -> np.ndarray:
    """The data of an accessor, one row per element."""
    entry = document["accessors"][accessor]
    view = document["bufferViews"][entry["bufferView"]]
    kind, width = _TYPES[entry["componentType"]], _WIDTH[entry["type"]]
    start = view.get("byteOffset", 0) + entry.get("byteOffset", 0)
    tight = np.dtype(kind).itemsize * width
    rows = np.lib.stride_tricks.as_strided(
        np.frombuffer(binary, np.uint8, offset=start), (entry["count"], tight), (view.get("byteStride", tight), 1))
    return np.ascontiguousarray(rows).view(kind).reshape(entry["count"], width)


def read_hand(path: Path) -> RiggedMesh:
    """Reads a hand. Raises ValueError if the file is not a rigged hand."""
    document, binary = _chunks(path)
    skin, primitive = document["skins"][0], document["meshes"][0]["primitives"][0]
    attributes = primitive["attributes"]

    # Find the skin's joints in the order of JOINTS.
    names = [plain_name(document["nodes"][node]["name"]) for node in skin["joints"]]
    missing = [name for name in JOINTS if name not in names]
    if missing:
        raise ValueError(f"{path}: has no joint {missing[0]}; name the joints as WebXR or OpenXR do")
    order = [names.index(name) for name in JOINTS]

    # Joint coordinate frames of the rest pose, in the wrist's frame. glTF stores matrices column by column.
    inverse = _array(document, binary, skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
    joints = np.linalg.inv(inverse.astype(np.float64))[order]
    joints[:, :3, :3] /= np.linalg.norm(joints[:, :3, :3], axis=1, keepdims=True)
    to_wrist = np.linalg.inv(joints[0])
    vertices = _array(document, binary, attributes["POSITION"]).astype(np.float64) @ to_wrist[:3, :3].T + to_wrist[:3, 3]

    # Weights; a vertex may name the same joint several times, so they are summed.
    index, value = (_array(document, binary, attributes[name]) for name in ("JOINTS_0", "WEIGHTS_0"))
    weights = np.zeros((len(vertices), len(names)))
    for k in range(4):
        np.add.at(weights, (np.arange(len(vertices)), index[:, k]), value[:, k])
    triangles = _array(document, binary, primitive["indices"]).reshape(-1, 3).astype(np.int64)
    return RiggedMesh(vertices, triangles, weights[:, order], to_wrist @ joints)
