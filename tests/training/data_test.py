#!/usr/bin/env python3
"""Tests the synthetic training data: hands, grasps, scenes and sensors."""
import dataclasses
import json
import re
import unittest
from unittest import mock

import surroundings
import torch
from scenes.chance import Chance
from scenes.grasps import grasps
from scenes.lookalikes import FEET, lookalikes
from scenes.lookalikes import KINDS as LOOKALIKES
from scenes.mesh_hand import MeshRig
from scenes.motion import seen_in_motion
from scenes.objects import objects
from scenes.pairs import partners
from scenes.parametric_hand import DEVIATIONS, PROFILE, ParametricRig
from scenes.people import stances
from scenes.poses import free_poses
from scenes.scene import ARM, BACKGROUND, HAND, OBJECT, Generator
from scenes.sensors import cut, measure
from scenes.shapes import BOX, CAPSULE, CYLINDER, ELLIPSOID, FAR, NOTHING, distance_to_solid, hit_solid
from scenes.skeleton import MIDDLE_KNUCKLE, TIPS, WRIST, forward_kinematics, landmarks, limits
from scenes.skin import FAR_AWAY, keep_skin
from scenes.views import crop_view, full_view

CPU = torch.device("cpu")
MESH = surroundings.HANDS / "right.glb"


class NoChance(Chance):
    """Random numbers that are all zero, so that every person has the mean shape."""

    def normal(self, deviation, *shape):
        return torch.zeros(*shape)


class Hands(unittest.TestCase):
    def test_the_mean_parametric_hand_is_the_shipped_one(self):
        segments = json.loads(PROFILE.read_text())["segments"]
        hands = ParametricRig(10, CPU).people(NoChance(1), 1)
        joints = landmarks(hands.bones, forward_kinematics(hands.bones, torch.zeros(1, 21)))[0]
        for finger in range(5):
            for k in range(3):
                place = torch.tensor(segments[1 + 3 * finger + k]["rest_transform"])[:3, 3]
                self.assertLess((joints[1 + 4 * finger + k] - place).norm(), 1e-4)
            last = torch.tensor(segments[3 + 3 * finger]["rest_transform"])
            tip = last[:3, :3] @ torch.tensor(segments[3 + 3 * finger]["distal_local"]) + last[:3, 3]
            self.assertLess((joints[4 + 4 * finger] - tip).norm(), 1e-4)

    def test_people_differ_as_much_as_in_the_program(self):
        source = (surroundings.ROOT / "src/hand/hand_shape.cpp").read_text()
        program = {name: float(value) for name, value in re.findall(r'\{"(\w+)", ([\d.]+)\}', source)}
        for finger_wide, value in re.findall(r'\{finger \+ "_(\w+)", ([\d.]+)\}', source):
            program["finger_" + finger_wide] = float(value)
        program["bone_length"] = float(re.search(r'kSegmentNames\[s\]\) \+ "_length", ([\d.]+)', source)[1])
        thumb, others = re.search(r"f == 0 \? ([\d.]+) : ([\d.]+)", source).groups()
        program["thumb_knuckle"], program["knuckle"] = float(thumb), float(others)
        program["flatness"] = program.pop("fingers_flatness")
        self.assertEqual(program, DEVIATIONS)

    def test_a_straight_finger_of_the_mesh_is_straight(self):
        hands = MeshRig(MESH, 10, CPU).people(NoChance(1), 1)
        joints = landmarks(hands.bones, forward_kinematics(hands.bones, torch.zeros(1, 21)))[0]
        for finger in range(1, 5):
            a, b, c = (joints[1 + 4 * finger + k] for k in range(3))
            self.assertGreater(torch.nn.functional.cosine_similarity(b - a, c - b, dim=0), 0.98)
        self.assertGreater((joints[12] - joints[0]).norm(), 0.17)

    def test_flexion_bends_towards_the_palm_and_abduction_towards_the_thumb(self):
        for rig in (ParametricRig(10, CPU), MeshRig(MESH, 10, CPU)):
            hands = rig.people(NoChance(1), 3)
            angles = torch.zeros(3, 21)
            angles[1, 9], angles[2, 10] = 1.0, 0.3  # the middle finger's knuckle
            tips = landmarks(hands.bones, forward_kinematics(hands.bones, angles))[:, 12]
            self.assertLess(tips[1, 1], tips[0, 1] - 0.05)
            self.assertLess(tips[2, 0], tips[0, 0] - 0.02)

    def test_people_are_of_many_sizes_and_thicknesses(self):
        for rig in (ParametricRig(10, CPU), MeshRig(MESH, 10, CPU)):
            mean, hands = rig.people(NoChance(1), 1), rig.people(Chance(16), 600)
            size = hands.bones.joint[:, 7].norm(dim=1) / mean.bones.joint[:, 7].norm(dim=1)  # the middle knuckle
            thick = (hands.flesh / mean.flesh)[:, 5:].mean(1) / size
            for values, low, high in ((size, 0.75, 1.22), (thick, 0.78, 1.35)):
                self.assertLess(values.quantile(0.01), low)
                self.assertGreater(values.quantile(0.99), high)
                self.assertLess((values.median() - 1).abs(), 0.06)

    def test_free_poses_keep_the_limits_and_neighbours_move_together(self):
        poses = free_poses(Chance(1), 2000)
        low, high = limits(CPU).T
        self.assertTrue(((poses >= low - 1e-5) & (poses <= high + 1e-5)).all())
        ring_and_little = torch.corrcoef(poses[:, [15, 19]].T)[0, 1]
        self.assertGreater(ring_and_little, 0.4)


class Grasps(unittest.TestCase):
    def test_fingers_end_on_the_object(self):
        hands = ParametricRig(10, CPU).people(Chance(3), 60)
        angles, solids, gap = grasps(Chance(4), hands)
        touching = (gap.abs() < 0.005).sum(1)
        self.assertGreater((touching >= 2).float().mean(), 0.6)
        self.assertGreater((gap > -0.004).float().mean(), 0.9)

        # The same fingers do not touch an object that is displaced: the check above can fail.
        elsewhere = dataclasses.replace(solids, centre=solids.centre + 0.03)
        tips = landmarks(hands.bones, forward_kinematics(hands.bones, angles))[:, TIPS]
        wrong = (elsewhere.distance(tips) - hands.flesh[:, TIPS]).abs() < 0.005
        self.assertLess((wrong.sum(1) >= 2).float().mean(), 0.4)

    def test_distance_to_a_solid_is_zero_where_a_ray_hits_it(self):
        kind = torch.tensor([BOX, ELLIPSOID, CAPSULE, CYLINDER])
        chance = Chance(5)
        centre = torch.tensor([[0.05, -0.03, 0.7]]).expand(4, 3)
        half, rotation = torch.tensor([[0.09, 0.05, 0.05]]).expand(4, 3), chance.rotation(4)
        rays = full_view(torch.ones(4)).rays()
        depth = hit_solid(rays, kind, centre, rotation, half)
        for i in range(4):
            seen = depth[i] < FAR
            self.assertGreater(seen.sum(), 100)
            points = (rays[i] * depth[i][..., None])[seen]
            one = slice(i, i + 1)
            self.assertLess(distance_to_solid(points[None], kind[one], centre[one], rotation[one], half[one]).abs().max(), 1e-3)


    def test_the_distance_from_an_object_is_that_from_its_nearest_part(self):
        things = objects(Chance(12), 60)
        self.assertEqual(set((things.kind != NOTHING).sum(1).tolist()), {1, 2, 3})
        things.centre = torch.tensor([[0.0, 0.0, 0.8]]).expand(60, 3)
        rays = full_view(torch.ones(60)).rays()
        depth = torch.stack([hit_solid(rays, *part) for part in things.parts()]).amin(0)
        for i in range(60):
            seen = depth[i] < FAR
            self.assertGreater(seen.sum(), 2)
            points = torch.zeros(60, seen.sum(), 3)
            points[i] = (rays[i] * depth[i][..., None])[seen]
            self.assertLess(things.distance(points)[i].abs().max(), 2e-3)


class Lookalikes(unittest.TestCase):
    def test_each_thing_is_seen_where_it_is_put_and_nothing_elsewhere(self):
        kind = torch.arange(-1, len(LOOKALIKES)).repeat_interleave(20)
        place = torch.tensor([[0.1, -0.1, 0.6]]).expand(len(kind), 3)
        view = crop_view(place, torch.full((len(kind),), 0.34))
        depth = lookalikes(Chance(13), view.rays(), place, kind)
        self.assertTrue((depth[kind < 0] == FAR).all())
        seen = (depth < FAR).flatten(1).sum(1)
        for index in range(len(LOOKALIKES)):
            self.assertGreater((seen[kind == index] > 150).float().mean(), 0.7)
        near = (depth[:, 32:64, 32:64] - 0.6).abs().flatten(1).amin(1)
        self.assertGreater((near[kind >= 0] < 0.05).float().mean(), 0.8)

    def test_toes_can_be_told_from_each_other(self):
        # Where a bare foot is narrow enough to show its toes, rows of the image alternate between toe and background.
        place = torch.tensor([[0.0, 0.0, 0.4]]).expand(80, 3)
        view = crop_view(place, torch.full((80,), 0.34))
        seen = lookalikes(Chance(14), view.rays(), place, torch.full((80,), FEET)) < 0.6
        changes = torch.maximum((seen[:, :, 1:] != seen[:, :, :-1]).sum(2).amax(1), (seen[:, 1:] != seen[:, :-1]).sum(1).amax(1))
        self.assertGreater((changes >= 6).float().mean(), 0.3)

    def test_they_are_background_in_frames_and_windows_without_a_hand(self):
        for kind in ("frames", "windows"):
            scenes = getattr(Generator(Chance(15), None, 500), kind)(80)
            alone = (scenes.lookalike >= 0) & (scenes.pixels.sum(1) == 0)
            self.assertGreater(alone.sum(), 3)
            self.assertFalse((scenes.label[alone] == HAND).any())
            self.assertLess((scenes.label[alone] == ARM).flatten(1).any(1).float().mean(), 0.3)  # of hands that are hidden
            shown = ((scenes.label[alone] == BACKGROUND) & (scenes.depth[alone] > 0)).flatten(1).any(1)
            self.assertGreater(shown.float().mean(), 0.8)


class Pairs(unittest.TestCase):
    def test_some_second_hands_grip_the_first_one_and_none_is_in_it(self):
        place = torch.tensor([[0.0, 0.0, 0.6]]).expand(1000, 3)
        apart = (partners(Chance(17), stances(Chance(18), 1000), torch.ones(1000, dtype=torch.bool), place).place - place).norm(dim=1)
        self.assertTrue(100 < (apart < 0.069).sum() < 250)
        self.assertGreater(apart.min(), 0.025)


class Motion(unittest.TestCase):
    def test_the_edge_of_a_quick_hand_frays_and_that_of_the_others_does_not(self):
        layers = torch.full((200, 2, 60, 80), FAR)
        layers[:, 0], layers[:, 1, 20:40, 30:50] = 1.2, 0.8
        for farthest in (0.0, 8.0):
            depth, winner = seen_in_motion(Chance(19), layers, torch.full((200,), farthest))
            changed = (winner != layers.min(1)[1]).flatten(1).any(1)
            self.assertTrue(10 < changed.sum() < 50 if farthest else not changed.any())
            self.assertTrue((depth[~changed] == layers.amin(1)[~changed]).all())
            self.assertTrue(((depth >= 0.8) & (depth <= 1.2001)).all())
            self.assertEqual(((depth > 0.81) & (depth < 1.19)).any(), farthest > 0)  # some sensors mix two depths
            self.assertTrue((winner[:, 32, 40] == 1).all())
            self.assertTrue((winner[:, :10] == 0).all())


class Scenes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.frames = Generator(Chance(6), MESH, 5000).frames(24)
        cls.windows = Generator(Chance(7), MESH, 5000).windows(24)

    def test_the_same_seed_gives_the_same_scenes(self):
        first, second, other = (Generator(Chance(seed), MESH, 500).windows(2).depth for seed in (8, 8, 9))
        self.assertTrue(torch.equal(first, second))
        self.assertFalse(torch.equal(first, other))

    def test_shapes_and_labels(self):
        self.assertEqual(self.frames.depth.shape, (24, 120, 160))
        self.assertEqual(self.windows.depth.shape, (24, 96, 96))
        for scenes in (self.frames, self.windows):
            self.assertTrue(torch.isfinite(scenes.depth).all())
            self.assertTrue((scenes.depth >= 0).all())
            self.assertEqual(set(scenes.label.unique().tolist()), {BACKGROUND, HAND, ARM, OBJECT})
            self.assertEqual(len(scenes.right[:, 0].unique()), 2)

    def test_scenes_without_a_hand_have_no_pixel_of_one(self):
        frames = Generator(Chance(10), MESH, 500).frames(40)
        empty = frames.pixels.sum(1) == 0
        self.assertGreater(empty.sum(), 2)
        self.assertFalse((frames.label[empty] == HAND).any())
        self.assertTrue((frames.label[empty] == ARM).any())  # arms that end without a hand
        seen = frames.pixels[:, 0] > 50
        self.assertTrue(((frames.label == HAND).flatten(1).sum(1) > 0)[seen].all())

    def test_the_joints_lie_where_the_hand_is_seen(self):
        self.check_joints(self.windows)

    def test_so_they_do_in_images_that_are_upside_down(self):
        with mock.patch("scenes.scene._UPSIDE_DOWN", 1.0):
            windows = Generator(Chance(7), MESH, 5000).windows(24)
        upright = (windows.joints[:, 0, MIDDLE_KNUCKLE, 1] < windows.joints[:, 0, WRIST, 1])
        self.assertLess(upright.float().mean(), 0.5)
        self.check_joints(windows)

    def check_joints(self, windows):
        for i in range(24):
            if windows.pixels[i, 0] < 300:
                continue
            hand = (windows.label[i] == HAND).nonzero().flip(1).float()
            distance = (hand[None] - windows.uv[i, 0][:, None]).norm(dim=-1).amin(1)
            self.assertLess(distance.median(), 4)
            valid = (windows.label[i] == HAND) & (windows.depth[i] > 0)
            if valid.any():
                self.assertLess((windows.depth[i][valid].median() - windows.joints[i, 0, :, 2].median()).abs(), 0.1)


class Skin(unittest.TestCase):
    def test_most_of_what_does_not_have_its_colour_is_moved_away_in_some_images(self):
        depth, surface = torch.full((400, 30, 40), 0.7), torch.zeros(400, 30, 40, dtype=torch.long)
        depth[:, :, 35:] = 0
        surface[:, :, 10:20] = 1  # a hand
        kept, gone = keep_skin(Chance(21), depth, surface, (0.0, 1.0))
        some = gone.flatten(1).any(1)
        self.assertTrue(60 < some.sum() < 140)
        self.assertTrue(torch.equal(kept, torch.where(gone, torch.full_like(depth, FAR_AWAY), depth)))
        self.assertFalse(gone[:, :, 35:].any())
        self.assertGreater(gone[some][:, :, 20:35].float().mean(), 0.85)
        self.assertLess(gone[some][:, :, 10:20].float().mean(), 0.25)


class Sensors(unittest.TestCase):
    def test_some_windows_reach_beyond_the_border_of_the_image(self):
        beyond = cut(Chance(20), crop_view(torch.tensor([[0.0, 0.0, 0.5]]).expand(400, 3), torch.full((400,), 0.34)))
        share = beyond.float().mean((1, 2))
        self.assertTrue(25 < (share > 0).sum() < 80)
        self.assertLess(share.max(), 0.42)
        self.assertFalse(beyond[:, 48, 48].any())
        for edge in (beyond[:, 0], beyond[:, -1], beyond[:, :, 0], beyond[:, :, -1]):
            self.assertTrue(edge.all(1).any())

    def test_each_sensor_measures_a_wall_and_shadows_or_frays_its_edge(self):
        depth = torch.full((200, 60, 80), 1.2)
        depth[:, 15:45, 20:50] = 0.8
        measured, kinds = measure(Chance(11), depth, full_view(torch.full((200,), 1.0)))
        self.assertEqual(set(kinds.tolist()), {0, 1, 2, 3})
        for kind in range(4):
            own = measured[kinds == kind]
            flat = own[:, 5:10, 60:75]
            seen = flat[flat > 0]
            self.assertGreater(len(seen), 0)
            self.assertLess((seen - 1.2).abs().median(), 0.02)
            beside_edge, lost = own[:, 15:45, 47:58], lambda x: (x == 0).float().mean()
            if kind < 3:
                self.assertGreater(lost(beside_edge), lost(own[:, 2:12, 60:75]))


if __name__ == "__main__":
    unittest.main()
