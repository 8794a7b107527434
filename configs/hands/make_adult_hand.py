#!/usr/bin/env python3
"""Writes adult_right.json and adult_left.json: the default hand, derived from anatomy. docs/adult_hand.md explains it.

Hand frame of a right hand: origin at the wrist joint, -z towards the fingers, +y out of the back of the hand, so +x is
towards the little finger. Millimetres and degrees here; metres in the files.
"""
import json
import math
import pathlib

# Bone lengths, mean of adults (Buryanov & Kotiuk 2010, n = 66): metacarpal, phalanges, pulp in front of the last bone.
BONES = {
    "thumb": {"metacarpal": 46.2, "phalanges": [31.6, 21.7], "pulp": 5.7},
    "index": {"phalanges": [39.8, 22.4, 15.8], "pulp": 3.8},
    "middle": {"metacarpal": 64.6, "phalanges": [44.6, 26.3, 17.4], "pulp": 4.0},
    "ring": {"phalanges": [41.4, 25.7, 17.3], "pulp": 4.0},
    "little": {"phalanges": [32.7, 18.1, 16.0], "pulp": 3.7},
}
# Distance of a joint's centre of rotation from the end of its proximal bone, inside the bone's rounded head.
HEAD_DEPTH = {"metacarpal": 6.0, "thumb_metacarpal": 4.5, "proximal": 3.5, "intermediate": 2.5}
CARTILAGE = 1.0  # thickness of the cartilage between two bones
# Distance from the wrist's centre, between radius and carpus, to the base of the third metacarpal (carpal height ratio,
# Youm et al. 1978).
CARPUS = 0.54 * BONES["middle"]["metacarpal"]

# Positions of the knuckles in the palm: (x, height relative to the middle knuckle, distance behind it along z).
KNUCKLES = {"index": (-21.5, -3.5, 1.5), "middle": (0.0, 0.0, 0.0), "ring": (18.0, -2.5, 6.5), "little": (34.0, -8.0, 14.0)}
# Angles of the fingers in the open flat hand: spread (positive towards the little finger), and roll along the arch of
# the palm.
SPLAY = {"index": -4.0, "middle": 2.0, "ring": 8.0, "little": 16.0}
ROLL = {"index": 4.0, "middle": 0.0, "ring": -5.0, "little": -12.0}
# Position of the thumb's trapeziometacarpal joint, direction of the relaxed thumb (radial and palmar abduction), and
# its pronation.
THUMB_BASE = (-21.0, -10.0, -34.0)
THUMB_RADIAL, THUMB_PALMAR, THUMB_PRONATION = 37.0, 22.0, 78.0

# Skin radii at the first, second and third joint and at the tip: measured on one small hand, enlarged to this hand.
RADII = {
    "thumb": [15.7, 10.3, 7.3, 7.0],
    "index": [8.4, 7.6, 5.9, 5.2],
    "middle": [7.7, 7.6, 5.7, 5.6],
    "ring": [7.3, 7.0, 5.0, 4.9],
    "little": [7.9, 6.2, 4.8, 4.2],
}
ENLARGED = 1.08
# Half width of the cross-section relative to the radius, at the first, second and third joint and at the tip; the half
# thickness is the radius divided by the same factor.
WIDTH = {"thumb": [1.05, 1.04, 1.08, 1.12]}
WIDTH_FINGER = [1.02, 1.04, 1.06, 1.08]
# Offset of the skin's centre from the bone towards the palm at these places, since the bone is nearer to the back of
# the finger.
PAD = {"thumb": [6.0, 3.0, 1.2, 1.0]}
PAD_FINGER = [3.0, 1.0, 0.4, 0.3]

PALM = {"half_width": [32.0, 42.0], "half_thickness": [20.0, 14.0], "offset_x": [1.5, 5.5], "offset_y": [-5.0, -4.5]}

MCP = [("abd", -20, 20), ("flex", -45, 90)]
JOINTS = {
    "thumb": [("cmc", [("abd", -22, 23), ("flex", -23, 37)]), ("mcp", [("abd", -10, 10), ("flex", -10, 55)]),
              ("ip", [("flex", -15, 80)])],
    "finger": [("mcp", MCP), ("pip", [("flex", 0, 110)]), ("dip", [("flex", 0, 85)])],
}


def rotation(axis, degrees):
    """The rotation matrix about the coordinate axis 0, 1 or 2."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    m = [[float(a == b) for b in range(3)] for a in range(3)]
    m[i][i], m[i][j], m[j][i], m[j][j] = c, -s, s, c
    return m


def times(a, b):
    return [[sum(a[r][k] * b[k][c] for k in range(3)) for c in range(3)] for r in range(3)]


def apply(m, v):
    return [sum(m[r][k] * v[k] for k in range(3)) for r in range(3)]


def add(a, b):
    return [x + y for x, y in zip(a, b)]


def lengths(finger):
    """Lengths of a finger's segments from joint centre to joint centre; the last one reaches the end of the skin."""
    bones = BONES[finger]
    heads = ["metacarpal", "proximal", "intermediate"]
    if finger == "thumb":
        heads = ["thumb_metacarpal", "proximal"]
    depth = [HEAD_DEPTH[h] for h in heads]
    own = [b + depth[i] + CARTILAGE - (depth[i + 1] if i + 1 < len(depth) else 0) for i, b in enumerate(bones["phalanges"])]
    own[-1] += bones["pulp"]
    if finger == "thumb":
        own.insert(0, bones["metacarpal"] - HEAD_DEPTH["thumb_metacarpal"])
    return own


def frame(finger):
    """Orientation of all segments of a straight finger at rest, and the position of its first joint."""
    if finger == "thumb":
        turn = times(times(rotation(1, THUMB_RADIAL), rotation(0, -THUMB_PALMAR)), rotation(2, THUMB_PRONATION))
        return turn, list(THUMB_BASE)
    x, y, shortfall = KNUCKLES[finger]
    return times(rotation(1, -SPLAY[finger]), rotation(2, ROLL[finger])), [x, y, shortfall - palm_length()]


def palm_length():
    return CARPUS + BONES["middle"]["metacarpal"] - HEAD_DEPTH["metacarpal"]


def dof(finger, joint, kind, lo, hi, side):
    if kind == "flex":
        axis = [-1, 0, 0]
    else:  # abduction: away from the middle finger; for the thumb, away from the palm
        radial = finger in ("thumb", "index", "middle")
        axis = [0, side if radial else -side, 0]
    return {"name": f"{finger}_{joint}_{kind}", "axis": axis, "limits_deg": [lo, hi]}


def segment(name, parent, turn, origin, length, skin, dofs, side):
    """One segment of the profile. `side`: +1 for a right hand; -1 for a left one, its mirror image in x = 0."""
    flip = [side, 1, 1]
    metres = lambda values: [round(v / 1000, 6) + 0.0 for v in values]
    rows = [[round(turn[r][c] * flip[r] * flip[c], 9) + 0.0 for c in range(3)] + metres([origin[r] * flip[r]]) for r in range(3)]
    radius = [math.sqrt(w * t) for w, t in zip(skin["half_width"], skin["half_thickness"])]
    return {
        "name": name, "parent": parent, "rest_transform": rows + [[0, 0, 0, 1]],
        "length": metres([length])[0], "distal_local": metres([0, 0, -length]),
        "proximal_radius": metres(radius)[0], "distal_radius": metres(radius)[1],
        "half_width": metres(skin["half_width"]), "half_thickness": metres(skin["half_thickness"]),
        "flesh_offset_x": metres([side * v for v in skin["offset_x"]]), "flesh_offset_y": metres(skin["offset_y"]),
        "dofs": dofs,
    }


def finger_segments(finger, side):
    names = ["metacarpal", "proximal", "distal"] if finger == "thumb" else ["proximal", "intermediate", "distal"]
    joints = JOINTS["thumb" if finger == "thumb" else "finger"]
    radius = [r * ENLARGED for r in RADII[finger]]
    width, pad = WIDTH.get(finger, WIDTH_FINGER), PAD.get(finger, PAD_FINGER)
    turn, origin = frame(finger)
    parent = "palm"
    for k, length in enumerate(lengths(finger)):
        if k == 2:
            length -= radius[3]  # the distal end is the centre of the fingertip's round end
        skin = {
            "half_width": [radius[k] * width[k], radius[k + 1] * width[k + 1]],
            "half_thickness": [radius[k] / width[k], radius[k + 1] / width[k + 1]],
            "offset_x": [0, 0], "offset_y": [-pad[k], -pad[k + 1]],
        }
        joint, kinds = joints[k]
        dofs = [dof(finger, joint, kind, lo, hi, side) for kind, lo, hi in kinds]
        name = f"{finger}_{names[k]}"
        yield segment(name, parent, turn, origin, length, skin, dofs, side)
        parent, origin = name, add(origin, apply(turn, [0, 0, -length]))


def hand(side):
    upright = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    segments = [segment("palm", None, upright, [0, 0, 0], palm_length(), PALM, [], side)]
    for finger in BONES:
        segments += finger_segments(finger, side)
    return {"handedness": "right" if side > 0 else "left",
            "note": "mean adult hand, derived from anatomy by make_adult_hand.py; see docs/adult_hand.md",
            "mean_hand": True,
            "segments": segments}


def text(profile):
    """The profile as JSON with one key per line, so that diffs are readable."""
    lines = []
    for s in profile["segments"]:
        lines.append("  {" + ",\n   ".join(f"{json.dumps(k)}: {json.dumps(v)}" for k, v in s.items()) + "}")
    head = "".join(f" {json.dumps(k)}: {json.dumps(v)},\n" for k, v in profile.items() if k != "segments")
    return "{\n" + head + ' "segments": [\n' + ",\n".join(lines) + "\n ]\n}\n"


if __name__ == "__main__":
    for side, name in ((1, "right"), (-1, "left")):
        (pathlib.Path(__file__).parent / f"adult_{name}.json").write_text(text(hand(side)))
