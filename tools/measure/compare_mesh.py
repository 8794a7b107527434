#!/usr/bin/env python3
"""Compares the mesh of a scan with the truth: a sphere that is fitted to it, or the true mesh.

  compare_mesh.py SCAN.obj                 radius of the sphere that fits what was seen best, and how far that is off it
  compare_mesh.py SCAN.obj TRUE.obj        distances of the seen vertices from the true surface, and the other way round,
                                           after the scan was moved onto it, since its frame is its own
  compare_mesh.py SCAN.obj TRUE.obj MOVED.obj   also writes the moved scan, whose poses `eval --objects` can then judge
"""
import sys

import numpy as np


def load(path):
    """Vertices and triangles of a mesh, and of a scan the part that was seen."""
    vertices, triangles, group = [], [], ""
    for line in open(path):
        words = line.split()
        if words[:1] == ["v"]:
            vertices.append([float(w) for w in words[1:4]])
        elif words[:1] == ["g"]:
            group = words[1]
        elif words[:1] == ["f"] and group != "closed":
            triangles.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    return np.array(vertices), np.array(triangles)


def spread(mesh, count, rng):
    """Points spread evenly over the surface, and their normals."""
    vertices, triangles = mesh
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    areas = np.linalg.norm(normals, axis=1)
    pick = rng.choice(len(areas), count, p=areas / areas.sum())
    u, v = rng.random((2, count))
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    points = a[pick] + u[:, None] * (b - a)[pick] + v[:, None] * (c - a)[pick]
    return points, normals[pick] / areas[pick, None]


def nearest(points, others):
    """Index of the nearest other point of each point, and its distance."""
    index, distance = [], []
    for part in np.array_split(points, max(1, len(points) * len(others) // 5_000_000)):
        squares = (part**2).sum(1)[:, None] + (others**2).sum(1) - 2 * part @ others.T
        index.append(squares.argmin(1))
        distance.append(np.sqrt(np.maximum(0, squares.min(1))))
    return np.concatenate(index), np.concatenate(distance)


def rotation(vector):
    angle = np.linalg.norm(vector)
    if angle < 1e-12:
        return np.eye(3)
    x, y, z = vector / angle
    skew = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * skew + (1 - np.cos(angle)) * skew @ skew


def align(points, truth, R, t, rounds, kept):
    """Point-to-plane ICP of points onto true points with normals; `kept`: share of the nearest pairs that count."""
    targets, normals = truth
    for _ in range(rounds):
        moved = points @ R.T + t
        index, distance = nearest(moved, targets)
        good = distance <= np.quantile(distance, kept)
        n, p = normals[index][good], moved[good]
        rows = np.hstack([np.cross(p, n), n])
        errors = ((targets[index][good] - p) * n).sum(1)
        step = np.linalg.lstsq(rows.T @ rows + 1e-9 * np.eye(6), rows.T @ errors, rcond=None)[0]
        turn = rotation(step[:3])
        R, t = turn @ R, turn @ t + step[3:]
    return np.median(nearest(points @ R.T + t, targets)[1]), R, t


def register(scan, truth, rng):
    """The motion that brings the scan onto the truth, the best from 60 starts."""
    some, few = spread(scan, 300, rng)[0], spread(truth, 1500, rng)
    middle = lambda mesh: (mesh[0].min(0) + mesh[0].max(0)) / 2
    tries = []
    for _ in range(60):
        R = np.linalg.qr(rng.normal(size=(3, 3)))[0]
        R *= np.sign(np.linalg.det(R))
        tries.append(align(some, few, R, middle(truth) - R @ middle(scan), 12, 0.9))
    _, R, t = min(tries, key=lambda one: one[0])
    return align(spread(scan, 3000, rng)[0], spread(truth, 20000, rng), R, t, 15, 0.9)[1:]


def write_moved(path, moved_path, R, t):
    with open(moved_path, "w") as out:
        for line in open(path):
            words = line.split()
            if words[:1] == ["v"]:
                line = "v %.7f %.7f %.7f\n" % tuple(R @ [float(w) for w in words[1:4]] + t)
            out.write(line)


def show(what, millimetres):
    print(f"{what}: mean {millimetres.mean():.2f} mm, 95 % within {np.quantile(millimetres, 0.95):.2f} mm, "
          f"largest {millimetres.max():.2f} mm")


def main():
    rng = np.random.default_rng(1)
    scan = load(sys.argv[1])
    if len(sys.argv) == 2:
        # Fit a sphere to points that are spread evenly, by least squares of their distances.
        points = spread(scan, 5000, rng)[0]
        centre = points.mean(0)
        for _ in range(100):
            away = points - centre
            lengths = np.linalg.norm(away, axis=1)
            rows = np.hstack([away / lengths[:, None], np.ones((len(points), 1))])
            w = 1 / (1 + ((lengths - np.median(lengths)) / 0.0015)**2)[:, None]
            *step, radius = np.linalg.lstsq(rows * w, lengths * w[:, 0], rcond=None)[0]
            centre = centre + step
        lengths = np.linalg.norm(points - centre, axis=1)
        print(f"radius {1000 * radius:.2f} mm, mean {1000 * lengths.mean():.2f} mm, median {1000 * np.median(lengths):.2f} mm")
        show("distance from the sphere", 1000 * abs(lengths - lengths.mean()))
        return

    truth = load(sys.argv[2])
    R, t = register(scan, truth, rng)
    if len(sys.argv) > 3:
        write_moved(sys.argv[1], sys.argv[3], R, t)
    dense = spread(truth, 40000, rng)
    moved = scan[0][np.unique(scan[1])] @ R.T + t
    index, _ = nearest(moved, dense[0])
    show("vertices of the scan from the truth", 1000 * abs(((moved - dense[0][index]) * dense[1][index]).sum(1)))
    show("truth from the scan", 1000 * nearest(dense[0][:5000], spread((scan[0] @ R.T + t, scan[1]), 40000, rng)[0])[1])


if __name__ == "__main__":
    main()
