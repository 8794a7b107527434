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
import sys
from pathlib import Path

import numpy as np

FEATURES, ANGLES, PARTS = 52, 21, 6
CLASSES = ("none", "wrap", "index_extension", "thumb_along", "ring", "sphere_3", "sphere_4", "extension", "adduction",
           "tripod_variation", "lateral_tripod", "lateral", "pinch", "tripod", "quadpod", "five_fingers",
           "parallel_extension", "writing_tripod")
KINDS = np.array([0] + [1] * 7 + [2] * 4 + [3] * 6)
GRASPED = 1.9   # s, when the sequences begin to hold the object
CLOSING = 0.6   # s before and after a grasp that are neither learned nor counted
ROWS = ("none",) * 17 + CLASSES[1:]  # row k: a hand that is open for class k + 1; row 17 + k: that holds so
MEMORY = 0.3  # of the filter [s]
MOST_DEVIATION, DEVIATION_UNIT = 0.3, 0.1  # of joints [rad]; the first is that of grasp_classifier.cpp
HIDDEN, STEPS, BATCH, PENALTY = 32, 4000, 1024, 1e-3  # of the network and its training
FACTORS = (0.5, 0.7, 1.0)  # of the network's scores, which is too sure in hands that it has not seen
TOUCH_FACTOR = 0.3   # of what touches say: those of the fingers depend on each other, and last
TOUCH_EXAMPLES = 100  # frames that the mean of all grasps counts as, for each class
SEED = 1


class Examples:
    """Rows of a file (example_file.h): `origin`, `second`, `x` [n, 52], `deviation` [n, 21], `touch` [n, 6], and where
    the file has them, `derivative` [n, 52, 21]."""

    def __init__(self, path, derivatives):
        width = 2 + FEATURES + ANGLES + PARTS
        rows = np.fromfile(path, np.float32).reshape(-1, width + (FEATURES * ANGLES if derivatives else 0))
        self.origin, self.second = rows[:, 0].astype(int), rows[:, 1].astype(float)
        self.x = rows[:, 2:2 + FEATURES].astype(float)
        self.deviation = rows[:, 2 + FEATURES:2 + FEATURES + ANGLES].astype(float)
        self.touch = rows[:, width - PARTS:width].astype(int)
        if derivatives:
            self.derivative = rows[:, width:].reshape(-1, ANGLES, FEATURES).transpose(0, 2, 1)


def noisy(planned, errors, random):
    """Planned examples as they would be tracked: their features with errors, the deviations of their joints, and their
    rows. Each gets what the tracker got wrong in a frame of some sequence, more or less of it, and the deviations that
    it stated there (`errors`: for each sequence, an array [n, 52] and one [n, 21])."""
    n = len(planned.x)
    chosen = [(k, random.integers(len(errors[k][0]))) for k in random.integers(len(errors), size=n)]
    error = np.array([errors[k][0][i] for k, i in chosen])
    deviation = np.array([errors[k][1][i] for k, i in chosen])
    drawn = random.normal(size=(n, ANGLES)) * np.maximum(deviation, 0.05)
    x = planned.x + random.uniform(0.3, 1.8, (n, 1)) * error + np.einsum("nfa,na->nf", planned.derivative, drawn)
    return x, deviation, planned.origin + np.where(planned.second > GRASPED, 17, 0)


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


class Network:
    """Multinomial regression with one hidden layer, as in stages/grasp/grasp_classifier.h. Every row is learned equally
    well, and all open hands together as much as one class."""

    def __init__(self, x, deviation, row):
        random = np.random.default_rng(SEED)
        self.mean = np.concatenate((x.mean(0), np.zeros(ANGLES)))
        self.unit = np.concatenate((x.std(0), np.full(ANGLES, DEVIATION_UNIT)))
        z = self._inputs(x, deviation).astype(np.float32)

        # Examples are drawn with these probabilities.
        weight = 1.0 / np.maximum(np.bincount(row, minlength=len(ROWS)), 1)[row]
        weight[row < 17] /= 17
        total = np.cumsum(weight) / weight.sum()

        # Adam, with a rate that falls to 0.
        sizes = ((z.shape[1], HIDDEN), HIDDEN, (HIDDEN, len(ROWS)), len(ROWS))
        scales = (z.shape[1] ** -0.5, 0, 0.1 * HIDDEN ** -0.5, 0)
        layers = [(scale * random.normal(size=size)).astype(np.float32) for size, scale in zip(sizes, scales)]
        first, second = [0 * p for p in layers], [0 * p for p in layers]
        for step in range(1, STEPS + 1):
            drawn = np.searchsorted(total, random.random(BATCH)).clip(0, len(z) - 1)
            hidden = np.tanh(z[drawn] @ layers[0] + layers[1])
            wrong = softmax(hidden @ layers[2] + layers[3])
            wrong[np.arange(BATCH), row[drawn]] -= 1
            wrong /= BATCH
            back = (wrong @ layers[2].T) * (1 - hidden ** 2)
            gradients = (z[drawn].T @ back + PENALTY * layers[0], back.sum(0),
                         hidden.T @ wrong + PENALTY * layers[2], wrong.sum(0))
            rate = 0.004 * (1 - step / STEPS)
            for k, gradient in enumerate(gradients):
                first[k] = 0.9 * first[k] + 0.1 * gradient
                second[k] = 0.99 * second[k] + 0.01 * gradient ** 2
                layers[k] -= rate * (first[k] / (1 - 0.9 ** step)) / (np.sqrt(second[k] / (1 - 0.99 ** step)) + 1e-8)
        self.layers = [layer.astype(float) for layer in layers]

    def _inputs(self, x, deviation):
        return (np.column_stack((x, np.minimum(deviation, MOST_DEVIATION))) - self.mean) / self.unit

    def log_probabilities(self, x, deviation, factor):
        hidden = np.tanh(self._inputs(x, deviation) @ self.layers[0] + self.layers[1])
        p = softmax(factor * (hidden @ self.layers[2] + self.layers[3]))
        return np.log(np.column_stack((p[:, :17].sum(1), p[:, 17:])) + 1e-30)


def touch_table(tracked, label, sequences):
    """What the touches of the parts say about the classes, in the tracked sequences: logarithms [18, 6, 3]."""
    rows = np.concatenate(sequences)
    touch, true = tracked.touch[rows], label[rows]
    share = lambda chosen: np.stack([(touch[chosen] == state).sum(0) for state in range(3)], 1)
    grasps = share(true > 0) / (true > 0).sum()
    return TOUCH_FACTOR * np.log(np.stack([
        (share(true == k) + TOUCH_EXAMPLES * grasps + 0.5) / ((true == k).sum() + TOUCH_EXAMPLES + 1.5)
        for k in range(len(CLASSES))]))


class Classifier:
    """A network and a table of touches, as the program has them."""

    def __init__(self, network, table):
        self.network, self.table = network, table

    def log_probabilities(self, tracked, rows, factor):
        score = self.network.log_probabilities(tracked.x[rows], tracked.deviation[rows], factor)
        for part in range(PARTS):
            score += self.table[:, part, tracked.touch[rows, part]].T
        return np.log(softmax(score) + 1e-30)


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
        log_p = classifier.log_probabilities(tracked, rows, factor)
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
    a = parser.parse_args()
    planned, tracked, truth = Examples(a.planned, True), Examples(a.tracked, False), truth_of(a.sequences)
    if (tracked.touch < 0).any():
        sys.exit(f"train.py: {a.tracked} has hands without contacts: collect with contact.enabled, as is the default")
    label = labels_of(tracked, truth)

    # Tracked sequences that show a grasp, and what the tracker got wrong in them.
    exact = Examples(a.exact, False)
    by_time = {(number, round(time * 1000)): x for number, time, x in zip(exact.origin, exact.second, exact.x)}
    seeds = sorted(int(path.stem) for path in a.sequences.glob("*.csv"))
    sequences = [np.flatnonzero((tracked.origin == k) & (label >= 0)) for k in range(len(truth))]
    sequences = [rows for rows in sequences if (label[rows] > 0).any()]
    exact_of = lambda i: by_time[seeds[tracked.origin[i]], round(tracked.second[i] * 1000)]
    errors = [(tracked.x[rows] - np.array([exact_of(i) for i in rows]), tracked.deviation[rows]) for rows in sequences]

    def train(learned):
        """A classifier from the planned examples with the tracker's errors in these sequences."""
        network = Network(*noisy(planned, [errors[k] for k in learned], np.random.default_rng(SEED)))
        return Classifier(network, touch_table(tracked, label, [sequences[k] for k in learned]))

    # Choose the factor of the scores, each sequence judged by a classifier without its errors.
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
    """The file that the program reads; one line for the weights of each row. The scores include the factor."""
    def numbers(values):
        return ", ".join(f"{v:.5g}" for v in values)

    def matrix(rows):
        return "[\n    " + ",\n    ".join(numbers(row) for row in rows) + "]"

    network = classifier.network
    hidden, hidden_bias, output, bias = network.layers
    return (f'{{\n  "interface": 2,\n  "classes": {json.dumps(ROWS)},\n  "mean": [{numbers(network.mean)}],\n'
            f'  "deviation": [{numbers(network.unit)}],\n  "hidden_weights": {matrix(hidden.T)},\n'
            f'  "hidden_bias": [{numbers(hidden_bias)}],\n  "weights": {matrix(factor * output.T)},\n'
            f'  "bias": [{numbers(factor * bias)}],\n  "touches": {matrix(classifier.table.reshape(len(CLASSES), -1))},\n'
            f'  "memory": {MEMORY}\n}}\n')


if __name__ == "__main__":
    main()
