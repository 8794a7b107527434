#!/usr/bin/env python3
"""Tests the inputs, the losses and the metrics of the training."""
import itertools
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import surroundings  # first: skips without PyTorch
import torch
from average import average
from batches import Supply, batches
from evaluate import evaluate
from examples import MAP_OFFSET, MAP_STEP, crop_input, drawn, full_input, generator_for, make_examples
from export import export
from losses import LOSSES, hand_loss, joint_errors_mm
from network import make_network
from weights import read_folded, read_weights, set_folded

MESH = surroundings.HANDS / "right.glb"


def perfect_maps(examples):
    """The perfect output for a batch of windows: a peak between two cells, and the joint's depth everywhere."""
    cells = (examples.uv[:, 0] - MAP_OFFSET) / MAP_STEP
    columns, rows = torch.arange(24.0), torch.arange(24.0)[:, None]
    square = (columns - cells[..., 0, None, None]) ** 2 + (rows - cells[..., 1, None, None]) ** 2
    depths = examples.depth[:, 0, :, None, None].expand(-1, -1, 24, 24)
    return torch.cat([-square / 2, depths], 1)


class Inputs(unittest.TestCase):
    def test_frames_are_encoded_as_in_the_program(self):
        image = full_input(torch.tensor([[[0.0, 0.5, 1.0, 9.0]]]))
        self.assertEqual(image[0, 0, 0].tolist(), [1.5, -0.5, 0.0, 1.5])
        self.assertEqual(image[0, 1, 0].tolist(), [0, 1, 1, 1])

    def test_windows_are_encoded_as_in_the_program(self):
        image = crop_input(torch.tensor([[[0.0, 0.5, 0.575, 0.425, 2.0, 0.1]]]), torch.tensor([0.5]))
        self.assertTrue(torch.allclose(image[0, 0, 0], torch.tensor([1.0, 0.0, 0.5, -0.5, 1.0, -1.0]), atol=1e-5))
        self.assertEqual(image[0, 1, 0].tolist(), [0, 1, 1, 1, 1, 1])


class Figures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.windows = make_examples(generator_for(3, "cpu", MESH, 2000), "crop", 24)

    def test_perfect_maps_have_no_error_and_shifted_ones_have(self):
        windows, maps = self.windows, perfect_maps(self.windows)
        inside = ((windows.uv[:, 0] > 16) & (windows.uv[:, 0] < 80)).all(-1) & windows.seen[:, :1]
        self.assertGreater(inside.sum(), 50)
        self.assertLess(joint_errors_mm(maps, windows)[inside].max(), 1.5)
        deeper = torch.cat([maps[:, :21], maps[:, 21:] + 10 / 150], 1)
        self.assertLess((joint_errors_mm(deeper, windows)[inside] - 10).abs().max(), 1.5)

    def test_the_loss_is_least_for_the_truth(self):
        windows, maps = self.windows, perfect_maps(self.windows)
        labels = 9 * torch.nn.functional.one_hot(windows.label[:, ::2, ::2], 4).permute(0, 3, 1, 2).float()
        side = torch.where(windows.right, 9.0, -9.0)[:, None]
        hand = torch.where(windows.seen[:, :1], 9.0, -9.0)
        right = LOSSES["crop"]((maps, labels, side, hand), windows)
        for wrong in ((maps.roll(1, 3), labels, side, hand), (maps, labels.roll(1, 1), side, hand),
                      (maps, labels, -side, hand), (maps, labels, side, -hand)):
            self.assertGreater(LOSSES["crop"](wrong, windows), right + 0.1)

    def test_a_decided_side_costs_more_where_there_is_no_hand(self):
        windows = make_examples(generator_for(3, "cpu", None, 500), "crop", 24)
        windows.seen = torch.zeros_like(windows.seen)
        maps, labels = perfect_maps(windows), torch.zeros(24, 4, 48, 48)
        hand = torch.zeros(24, 1)
        undecided, *decided = (LOSSES["crop"]((maps, labels, torch.full((24, 1), side), hand), windows)
                               for side in (0.0, 4.0, -4.0))
        self.assertLess(undecided + 0.1, min(decided))

    def test_hands_that_are_hardly_seen_are_no_examples_of_hands_or_other_things(self):
        windows = make_examples(generator_for(3, "cpu", None, 500), "crop", 24)
        windows.seen = torch.zeros_like(windows.seen)
        windows.scenes.pixels = torch.full_like(windows.scenes.pixels, 20)
        self.assertEqual(hand_loss((None, None, None, torch.full((24, 1), 9.0)), windows), 0)
        windows.scenes.pixels.zero_()
        self.assertGreater(hand_loss((None, None, None, torch.full((24, 1), 9.0)), windows), 8)

    def test_as_many_windows_show_hands_as_are_asked_for(self):
        for hands in (0.0, 1.0):
            windows = make_examples(generator_for(3, "cpu", None, 500, hands=hands), "crop", 24)
            self.assertEqual((windows.scenes.pixels[:, 0] > 0).any().item(), hands > 0)

    def test_windows_show_right_hands_mostly(self):
        share = self.windows.right.float().mean()
        self.assertGreater(share, 0.6)
        self.assertLess(share, 1)


    def test_false_palms_on_feet_are_counted(self):
        for logit, share in ((9.0, 100.0), (-9.0, 0.0)):
            network = lambda image: (torch.full((len(image), 2, 30, 40), logit), torch.zeros(len(image), 4, 60, 80), None)
            figures = evaluate(network, "full", generator_for(4, "cpu", None, 500), 1, 120)
            self.assertEqual(figures["frames of feet with a false palm"], share)


class Batches(unittest.TestCase):
    def test_examples_of_the_newest_groups_are_seen_as_often_as_said(self):
        for beside in (False, True):
            supply = Supply(batch=6, at_once=4, kept=3, passes=2, beside=beside)
            made = itertools.islice(batches(generator_for(5, "cpu", None, 500), "crop", supply), 20)
            depths = torch.cat([examples.image[:, 0].mean((1, 2)) for examples in made])
            self.assertEqual(len(depths), 120)
            self.assertAlmostEqual(len(depths.unique()), 60, delta=12)

    def test_drawn_examples_stay_whole(self):
        groups = [make_examples(generator_for(seed, "cpu", None, 500), "crop", 6) for seed in (7, 8)]
        some = drawn(groups, 8)
        self.assertEqual(len(some.image), 8)
        for image, uv, label in zip(some.image, some.uv, some.scenes.label):
            same = [(group, i) for group in groups for i in range(6) if torch.equal(group.image[i], image)]
            self.assertEqual(len(same), 1)
            (group, i), = same
            self.assertTrue(torch.equal(group.uv[i], uv) and torch.equal(group.scenes.label[i], label))


class Networks(unittest.TestCase):
    def test_their_weights_are_read_back_from_their_files(self):
        images = make_examples(generator_for(6, "cpu", None, 500), "crop", 24).image
        network, same = make_network("crop"), make_network("crop")
        network.train()(images)  # sets the means and variances of the normalisations
        with tempfile.TemporaryDirectory() as folder:
            export(network, "crop", Path(folder))
            read_weights(same, Path(folder) / "crop.onnx", images)
            with self.assertRaisesRegex(SystemExit, "another network"):
                read_weights(make_network("full"), Path(folder) / "crop.onnx", images)
            with self.assertRaisesRegex(SystemExit, "full.onnx is missing"):
                read_weights(make_network("full"), Path(folder) / "full.onnx", images)
        with torch.no_grad():
            wanted = network.eval()(images)
            for mode, tolerance in ((False, 1e-4), (True, 0.1)):  # while training, each batch has a mean of its own
                for ours, theirs in zip(same.train(mode)(images), wanted):
                    self.assertLess((ours - theirs).abs().max(), tolerance * (1 + theirs.abs().max()))

    def test_one_that_does_not_tell_hands_yet_is_read(self):
        older, network = make_network("crop"), make_network("crop")
        older.hand = None
        older.train()(torch.rand(8, 2, 96, 96))  # sets the means and variances of the normalisations
        with tempfile.TemporaryDirectory() as folder, unittest.mock.patch.dict("export.OUTPUTS", crop=["j", "seg", "side"]):
            export(older, "crop", Path(folder))
            set_folded(network, read_folded(network, Path(folder) / "crop.onnx"))
        image = torch.rand(1, 2, 96, 96)
        for ours, theirs in zip(network.eval()(image), older.eval()(image)):
            self.assertLess((ours - theirs).abs().max(), 1e-4)

    def test_their_mean_has_the_mean_of_each_weight(self):
        images = make_examples(generator_for(6, "cpu", None, 500), "crop", 24).image
        with tempfile.TemporaryDirectory() as folder:
            folders, networks = [Path(folder, name) for name in "ab"], [make_network("crop") for _ in "ab"]
            for one, network in zip(folders, networks):
                one.mkdir()
                network.train()(images)  # sets the means and variances of the normalisations
                export(network, "crop", one)
            same, mean = average("crop", folders[:1]), average("crop", folders)
        with torch.no_grad():
            for ours, theirs in zip(same.eval()(images), networks[0](images)):
                self.assertLess((ours - theirs).abs().max(), 1e-4)
        for layer in (lambda network: network.maps, lambda network: network.side):
            for part in ("weight", "bias"):
                first, second = (getattr(layer(network), part) for network in networks)
                self.assertLess((getattr(layer(mean), part) - (first + second) / 2).abs().max(), 1e-6)
                self.assertGreater((first - second).abs().max(), 1e-3)

    def test_their_outputs_have_the_shapes_of_the_interface(self):
        for name, size, joints in (("full", (120, 160), 1), ("crop", (96, 96), 21)):
            maps, labels, side, *hand = make_network(name).eval()(torch.zeros(1, 2, *size))
            self.assertEqual(maps.shape, (1, 2 * joints, size[0] // 4, size[1] // 4))
            self.assertEqual(labels.shape, (1, 4, size[0] // 2, size[1] // 2))
            self.assertEqual(side.shape, (1, 1))
            self.assertEqual([odds.shape for odds in hand], [(1, 1)] if name == "crop" else [])


if __name__ == "__main__":
    unittest.main()
