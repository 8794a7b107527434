#!/usr/bin/python3
"""Trains the classifier of grasps.

    tools/training/grasps/train.py configs/grasps.json --planned planned.f32 --exact exact.f32 --tracked tracked.f32 --sequences DIR

`planned.f32` and `exact.f32` are files of planned_examples, of classes and of sequences from seed 0 on; `tracked.f32` is one
of tracked_examples, which got the logs in DIR in the order of their seeds. DIR is the folder of collect.py. Needs Debian's
python3-numpy. The same files give the same classifier; docs/recognised_grasps.md has the commands.
"""
import argparse
import csv
import json
from pathlib import Path

import numpy as np

FEATURES, ANGLES = 52, 21
CLASSES = ("none", "wrap", "index_extension", "thumb_along", "ring", "sphere_3", "sphere_4", "extension", "adduction",
           "tripod_variation", "lateral_tripod", "lateral", "pinch", "tripod", "quadpod", "five_fingers",
           "parallel_extension", "writing_tripod")
KINDS = np.array([0] + [1] * 7 + [2] * 4 + [3] * 6)
FINGER = np.array([0] * 5 + [1] * 4 + [2] * 4 + [3] * 4 + [4] * 4)  # of each joint angle
ABDUCTION = np.isin(np.arange(ANGLES), (1, 3, 6, 10, 14, 18))
GRASPED = 1.9   # s, when the sequences begin to hold the object
CLOSING = 0.6   # s before and after a grasp that are neither learned nor counted
ROWS = ("none",) * 17 + CLASSES[1:]  # row k: a hand that is open for class k + 1; row 17 + k: that holds so
NONE_WEIGHT = 3  # of all hands that hold nothing, against one class
MEMORY = 0.3  # of the filter [s]
FACTORS = (0.5, 1.0, 2.0)  # of the spread that the covariance of the pose implies
SEED = 1


class Examples:
    """Rows of a file (example_file.h): `origin`, `second`, `x` [n, 52] and `spread` [n, 52, 21]."""

    def __init__(self, path):
        rows = np.fromfile(path, np.float32).reshape(-1, 2 + FEATURES * (1 + ANGLES))
        self.origin, self.second = rows[:, 0].astype(int), rows[:, 1].astype(float)
        self.x = rows[:, 2:2 + FEATURES].astype(float)
        self.spread = rows[:, 2 + FEATURES:].reshape(-1, ANGLES, FEATURES).transpose(0, 2, 1)


def noisy(planned, errors, random, repeats):
    """Planned examples with errors, and their rows. In the first copy the errors of joints are drawn; in the others they
    are what the tracker got wrong in a frame of another sequence (`errors`: one array [n, 52] for each), too."""
    parts = []
    for repeat in range(repeats):
        n = len(planned.x)
        hidden = random.random((n, 5)) < random.choice((0.0, 0.3, 0.6), (n, 1))
        deviation = np.where(hidden, random.uniform(0.2, 0.6, (n, 5)), random.uniform(0.03, 0.18, (n, 1)))[:, FINGER]
        together = random.normal(size=(n, 5))[:, FINGER]  # the joints of a finger err alike, in part
        own = random.normal(size=(n, ANGLES))
        error = np.einsum("nfa,na->nf", planned.spread,
                          deviation * np.where(ABDUCTION, 0.5 * own, 0.7 * together + 0.7 * own))
        if repeat > 0:
            chosen = [errors[k][random.integers(len(errors[k]))] for k in random.integers(len(errors), size=n)]
            error = 0.3 * error + np.array(chosen)
        parts.append(planned.x + error)
    return np.concatenate(parts), np.tile(planned.origin + np.where(planned.second > GRASPED, 17, 0), repeats)


def truth_of(folder):
    """[(seconds, classes)] of the sequences in a folder, in the order of their seeds."""
    out = []
    for path in sorted(folder.glob("*.csv"), key=lambda p: int(p.stem)):
        with open(path, encoding="ascii") as table:
            rows = list(csv.reader(table))[1:]
        utime = np.array([int(row[0]) for row in rows])
        out.append((1e-6 * (utime - utime[0]), np.array([CLASSES.index(row[1]) for row in rows])))
    return out


def labels_of(tracked, truth):
    """The true class of each example, -1 where the hand closes or opens."""
    label = np.full(len(tracked.x), -1)
    for number, (seconds, classes) in enumerate(truth):
        rows = np.flatnonzero(tracked.origin == number)
        at = np.clip(np.searchsorted(seconds, tracked.second[rows] - 1e-3), 0, len(seconds) - 1)
        held = seconds[classes > 0]
        near = (seconds > held[0] - CLOSING) & (seconds < held[-1] + CLOSING) & (classes == 0)
        label[rows] = np.where(near[at], -1, classes[at])
    return label


def softmax(score):
    score = score - score.max(1, keepdims=True)
    p = np.exp(score)
    return p / p.sum(1, keepdims=True)


class Classifier:
    """Multinomial logistic regression, as in stages/grasp/grasp_classifier.h."""

    def __init__(self, x, row, weight, penalty=1e-3, steps=300):
        self.mean = np.average(x, axis=0, weights=weight)
        self.deviation = np.sqrt(np.average((x - self.mean) ** 2, axis=0, weights=weight))
        z = np.column_stack(((x - self.mean) / self.deviation, np.ones(len(x)))).astype(np.float32)
        target = np.eye(len(ROWS), dtype=np.float32)[row]
        weight = (weight / weight.sum()).astype(np.float32)[:, None]
        w = np.zeros((z.shape[1], len(ROWS)), np.float32)
        first, second = np.zeros_like(w), np.zeros_like(w)
        for step in range(1, steps + 1):  # Adam, with a rate that falls to 0
            gradient = z.T @ (weight * (softmax(z @ w) - target)) + penalty * np.vstack((w[:-1], 0 * w[-1:]))
            first = 0.9 * first + 0.1 * gradient
            second = 0.99 * second + 0.01 * gradient ** 2
            rate = 0.1 * (1 - step / steps)
            w -= rate * (first / (1 - 0.9 ** step)) / (np.sqrt(second / (1 - 0.99 ** step)) + 1e-8)
        w = w - w.mean(1, keepdims=True)
        self.weights, self.bias = w[:-1].T.astype(float), w[-1].astype(float)

    def log_probabilities(self, x, spread, factor):
        score = (x - self.mean) / self.deviation @ self.weights.T + self.bias
        errors = np.einsum("kf,nfa->nka", self.weights / self.deviation, spread)
        score = score / np.sqrt(1 + np.pi / 8 * factor ** 2 * (errors ** 2).sum(2))
        p = softmax(score)
        return np.log(np.column_stack((p[:, :17].sum(1), p[:, 17:])) + 1e-30)


def balanced(row):
    """Weights with which every class counts the same, and the open hands together NONE_WEIGHT times as much."""
    weight = 1.0 / np.maximum(np.bincount(row, minlength=len(ROWS)), 1)[row]
    weight[row < 17] *= NONE_WEIGHT / 17
    return weight / weight.sum()


def filtered(log_p, seconds, memory):
    """The filter of stages/grasp/grasp_filter.cpp: the probabilities and the stated class of each frame."""
    mean, last, stated, out, classes = log_p[0], seconds[0], 0, [], []
    for row, now in zip(log_p, seconds):
        mean, last = mean + (1 - np.exp((last - now) / memory)) * (row - mean), now
        p = softmax(mean[None])[0]
        best = 1 + int(p[1:].argmax())
        if stated == 0:
            stated = best if p[0] < 0.5 else 0
        elif p[0] > 1.5 * (1 - p[0]):
            stated = 0
        elif p[best] > 1.5 * p[stated]:
            stated = best
        out.append(p)
        classes.append(stated)
    return np.array(out), np.array(classes)


def evaluate(classifier, tracked, label, sequences, factor):
    """Figures over sequences: mean loss; of the frames with a grasp the shares whose class and kind are right and that
    are wrong with a probability of at least 0.9; the share of the others without a grasp; changes of class a second."""
    right = kind = wrong = held = none = open_frames = changes = 0
    loss, seconds = [], 0.0
    for rows in sequences:
        log_p = classifier.log_probabilities(tracked.x[rows], tracked.spread[rows], factor)
        p, stated = filtered(log_p, tracked.second[rows], MEMORY)
        true = label[rows]
        loss.append(-np.log(p[np.arange(len(true)), true] + 1e-12).mean())

        is_held = true > 0
        kinds = 1 + np.stack([p[:, KINDS == k].sum(1) for k in (1, 2, 3)], 1).argmax(1)
        kinds[stated == 0] = 0
        right += (stated == true)[is_held].sum()
        kind += (kinds == KINDS[true])[is_held].sum()
        wrong += ((stated != true) & (p[np.arange(len(p)), stated] >= 0.9))[is_held].sum()
        held += is_held.sum()
        none += (stated == 0)[~is_held].sum()
        open_frames += (~is_held).sum()
        changes += (np.diff(stated[is_held]) != 0).sum()
        seconds += np.ptp(tracked.second[rows][is_held])
    return {"loss": np.mean(loss), "class": right / held, "kind": kind / held, "wrong": wrong / held,
            "none": none / max(1, open_frames), "changes": changes / seconds}


def show(title, figures):
    print(f"{title}: " + "  ".join(f"{key} {value:.3f}" for key, value in figures.items()), flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--planned", type=Path, required=True)
    parser.add_argument("--exact", type=Path, required=True)
    parser.add_argument("--tracked", type=Path, required=True)
    parser.add_argument("--sequences", type=Path, required=True)
    parser.add_argument("--repeats", type=int, default=4, help="copies of each planned example with errors")
    a = parser.parse_args()
    planned, tracked, truth = Examples(a.planned), Examples(a.tracked), truth_of(a.sequences)
    label = labels_of(tracked, truth)

    # Tracked sequences that show a grasp, and what the tracker got wrong in them.
    exact = Examples(a.exact)
    by_time = {(number, round(time * 1000)): x for number, time, x in zip(exact.origin, exact.second, exact.x)}
    seeds = sorted(int(path.stem) for path in a.sequences.glob("*.csv"))
    sequences = [np.flatnonzero((tracked.origin == k) & (label >= 0)) for k in range(len(truth))]
    sequences = [rows for rows in sequences if (label[rows] > 0).any()]
    errors = [tracked.x[rows] - np.array([by_time[seeds[tracked.origin[i]], round(tracked.second[i] * 1000)] for i in rows])
              for rows in sequences]

    def train(learned):
        """A classifier from the planned examples with the tracker's errors in these sequences."""
        x, rows = noisy(planned, [errors[k] for k in learned], np.random.default_rng(SEED), a.repeats)
        return Classifier(x, rows, balanced(rows))

    # Choose the factor of the spread, each sequence judged by a classifier without its errors.
    folds = [(train([k for k in range(len(sequences)) if k % 3 != fold]), sequences[fold::3]) for fold in range(3)]
    losses = {}
    for factor in FACTORS:
        figures = [evaluate(classifier, tracked, label, left_out, factor) for classifier, left_out in folds]
        mean = {key: float(np.mean([f[key] for f in figures])) for key in figures[0]}
        losses[mean["loss"]] = factor
        show(f"factor {factor}", mean)
    factor = losses[min(losses)]

    # Train with the errors in all sequences.
    classifier = train(range(len(sequences)))
    show(f"chosen: {factor}; on the same sequences", evaluate(classifier, tracked, label, sequences, factor))
    a.out.write_text(file_text(classifier, factor), encoding="ascii")


def file_text(classifier, factor):
    """The file that the program reads; one line for the weights of each row."""
    def numbers(values):
        return ", ".join(f"{v:.5g}" for v in values)

    weights = ",\n    ".join(numbers(w) for w in classifier.weights)
    return (f'{{\n  "interface": 1,\n  "classes": {json.dumps(ROWS)},\n  "mean": [{numbers(classifier.mean)}],\n'
            f'  "deviation": [{numbers(classifier.deviation)}],\n  "weights": [\n    {weights}],\n'
            f'  "bias": [{numbers(classifier.bias)}],\n  "spread": {factor},\n  "memory": {MEMORY}\n}}\n')


if __name__ == "__main__":
    main()
