"""Hands of different people, made from the mean hand configs/hands/adult_right.json by the 51 shape parameters of
src/hand/hand_shape.h. The skin consists of elliptic tubes, a simpler form of src/hand/implicit_hand.h."""
import json
from pathlib import Path

import numpy as np
import torch
from torch import Tensor

from .chance import Chance
from .hands import Hands, unusual
from .skeleton import PARENT, SEGMENTS, Bones

PROFILE = Path(__file__).resolve().parents[3] / "configs/hands/adult_right.json"

# Standard deviations of the components of a HandShape between people; a test compares them with hand_shape.cpp.
DEVIATIONS = {"size": 0.08, "palm_width": 0.06, "palm_length": 0.06, "palm_thickness": 0.15, "finger_length": 0.05,
              "bone_length": 0.05, "fingers_thickness": 0.12, "flatness": 0.08, "finger_thickness": 0.06,
              "knuckle_thickness": 0.2, "thenar_thickness": 0.15, "tip_length": 0.2, "finger_flesh": 0.1,
              "palm_flesh": 0.1, "thumb_knuckle": 0.004, "knuckle": 0.002}
_PALM_TUBES, _TUBES = 4, 20  # numbers of tubes: 4 metacarpals; in all, also 15 bones of the digits and the thumb's fold


class ParametricRig:
    """The mean hand, from which hands of any number of people can be made."""

    def __init__(self, points: int, device: torch.device, profile: Path = PROFILE) -> None:
        """Reads the mean hand. `points`: number of points that are spread over the skin."""
        segments = json.loads(profile.read_text())["segments"]
        self.device = device
        rest = np.array([s["rest_transform"] for s in segments])
        relative = np.stack([rest[0]] + [np.linalg.inv(rest[PARENT[s]]) @ rest[s] for s in range(1, SEGMENTS)])
        self.turn, self.joint = self._tensor(relative[:, :3, :3]), self._tensor(relative[:, :3, 3])
        self.length = self._tensor([s["length"] for s in segments])
        self.tip_radius = self._tensor([segments[3 * f + 3]["distal_radius"] for f in range(5)])
        self.half = self._tensor([[s["half_width"], s["half_thickness"]] for s in segments])  # [16, {x, y}, end]
        self.offset = self._tensor([[s["flesh_offset_x"], s["flesh_offset_y"]] for s in segments])

        # Draw the tube of each point, its position along the tube (0 to 1; beyond that on the caps), and its angle
        # around the tube.
        random = np.random.default_rng(0)
        area = np.array([26.0] * 4 + [14, 12, 9] + [14, 8, 6] * 4 + [8])
        self.tube = torch.tensor(random.choice(_TUBES, points, p=area / area.sum()), device=device)
        self.along = self._tensor(random.uniform(-0.15, 1.15, points))
        self.around = self._tensor(random.uniform(0, 2 * np.pi, points))

    def _tensor(self, values: object) -> Tensor:
        return torch.tensor(np.asarray(values), dtype=torch.float32, device=self.device)

    def people(self, chance: Chance, count: int) -> Hands:
        """Hands of `count` people."""
        dev = DEVIATIONS
        draw = lambda name, *shape: chance.normal(dev[name], count, *shape)
        other_size, other_flesh = unusual(chance, count)
        size, fold = draw("size") + other_size[:, 0], 3

        # Change the lengths of the bones.
        longer = torch.exp(size[:, None] + draw("finger_length", 5).repeat_interleave(fold, 1) + draw("bone_length", 15))
        palm = torch.exp(size[:, None] + torch.stack([draw("palm_width"), torch.zeros_like(size), draw("palm_length")], 1))
        length = self.length * torch.cat([palm[:, 2:], longer], 1)
        joint = self.joint.repeat(count, 1, 1)
        roots = [1 + 3 * f for f in range(5)]
        shift = torch.cat([draw("thumb_knuckle", 1, 3), draw("knuckle", 4, 3)], 1)
        outer = [s for s in range(1, SEGMENTS) if s not in roots]
        joint[:, outer] = joint[:, outer] * longer[:, [PARENT[s] - 1 for s in outer], None]
        joint[:, roots] = joint[:, roots] * palm[:, None] + shift

        # Change the sections: width and thickness at both ends of each segment.
        wider = size[:, None] + other_flesh + draw("fingers_thickness", 1) + draw("finger_thickness", 5).repeat_interleave(fold, 1)
        wider[:, 0] += draw("thenar_thickness")
        flat = torch.stack([wider, wider + draw("flatness", 1)], -1)
        palm_section = torch.stack([palm[:, 0].log(), size + 0.5 * other_flesh[:, 0] + draw("palm_thickness")], -1)
        factor = torch.exp(torch.cat([palm_section[:, None], flat], 1))[..., None]  # [count, 16, 2, 1]
        half, offset = self.half * factor, self.offset * factor
        root = torch.exp(draw("knuckle_thickness"))[:, None, None]
        half[:, roots[1:], :, 0] *= root
        offset[:, roots[1:], :, 0] *= root
        flesh = torch.cat([draw("palm_flesh", 1), draw("finger_flesh", 1).expand(-1, 15)], 1)
        offset[:, :, 1] += flesh[..., None] * half[:, :, 1]

        radius = self.tip_radius * torch.exp(wider[:, 2::3]) * torch.exp(draw("tip_length", 1))
        tip = torch.zeros(count, 5, 3, device=self.device)
        tip[:, :, 2] = -length[:, 3::3]
        bones = Bones(self.turn.expand(count, -1, -1, -1), joint, tip)
        return self._skin(bones, length, half, offset, radius)

    def _skin(self, bones: Bones, length: Tensor, half: Tensor, offset: Tensor, tip_radius: Tensor) -> Hands:
        """The hands with their skin points. `length` [B, 16]; `half`, `offset` [B, 16, {x, y}, end]; all in metres."""
        count, points = len(length), len(self.tube)
        start, end, sections, cap = self._tubes(bones, length, half, offset, tip_radius)

        # Compute the section of the tube at each point; beyond its ends, the tube is rounded off.
        pick = lambda values: values[:, self.tube]
        inside = self.along.clamp(0, 1)
        bone = pick(end - start)
        reach = pick(cap)[..., 0] * (self.along < 0) + pick(cap)[..., 1] * (self.along > 1)
        beyond = ((self.along - inside) / 0.15).clamp(-1, 1)
        round_off = torch.sqrt((1 - beyond ** 2).clamp_min(0))
        chosen = pick(sections)  # [count, P, {half, offset}, {x, y}, 3 places]
        before = chosen[..., 0] + (chosen[..., 1] - chosen[..., 0]) * (2 * inside)[:, None, None].clamp(0, 1)
        section = before + (chosen[..., 2] - chosen[..., 1]) * (2 * inside - 1)[:, None, None].clamp(0, 1)
        across = section[:, :, 1] + round_off[:, None] * section[:, :, 0] * torch.stack(
            [torch.cos(self.around), torch.sin(self.around)], -1)
        local = pick(start) + inside[:, None] * bone
        local = local + (reach * beyond)[..., None] * torch.nn.functional.normalize(bone, dim=-1)
        local = torch.cat([local[..., :2] + across, local[..., 2:]], -1)

        # Let each tube follow its segment, and the fold both the thumb and the palm.
        own = (self.tube - _PALM_TUBES + 1).clamp_min(0)
        fold = self.tube == _TUBES - 1
        own = torch.where(fold, torch.zeros_like(own), own)
        segment = torch.stack([own, torch.where(fold, torch.ones_like(own), own)], -1)
        share = torch.where(fold, 1 - inside, torch.zeros_like(inside))
        in_thumb = torch.einsum("bji,bpj->bpi", bones.turn[:, 1], local - bones.joint[:, None, 1])
        local = torch.stack([local, torch.where(fold[:, None], in_thumb, local)], 2)
        flesh = half.prod(2).sqrt()  # mean radius at both ends of each segment [count, 16, 2]
        around = torch.stack([0.6 * flesh[:, 0, 0]] + [r for f in range(5) for r in (
            flesh[:, 3 * f + 1, 0], flesh[:, 3 * f + 2, 0], flesh[:, 3 * f + 3, 0], tip_radius[:, f])], 1)
        return Hands(bones, segment.expand(count, -1, -1), torch.stack([1 - share, share], -1).expand(count, points, 2),
                     local, around)

    def _tubes(self, bones: Bones, length: Tensor, half: Tensor, offset: Tensor,
               tip_radius: Tensor) -> tuple[Tensor, Tensor, Tensor, Tensor]:
        """Start and end [B, 20, 3], sections [B, 20, {half, offset}, {x, y}, 3] and caps [B, 20, 2] of the 20 tubes, in
        the frames of their segments [m]. Sections are given at the start, the middle and the end; caps are the lengths
        of the round ends."""
        count = len(length)
        start, end = torch.zeros(2, count, _TUBES, 3, device=self.device)
        sections = torch.zeros(count, _TUBES, 2, 2, 3, device=self.device)
        cap = torch.full((count, _TUBES, 2), 0.004, device=self.device)

        # Make the metacarpals: each leads from its part of the wrist's section to its knuckle, and is as wide as the
        # gaps to its neighbours require.
        knuckles = bones.joint[:, [4, 7, 10, 13]]
        across = torch.tensor([-1.0, -1 / 3, 1 / 3, 1.0], device=self.device)
        start[:, :4, 0] = (0.19 * across - 0.04) * half[:, :1, 0, 0]
        end[:, :4] = knuckles
        gap = (knuckles[:, 1:, 0] - knuckles[:, :-1, 0]).abs()
        root = half[:, [4, 7, 10, 13]]
        to_thumb, to_little = torch.cat([root[:, :1, 0, 0], gap], 1), torch.cat([gap, root[:, 3:, 0, 0]], 1)
        reach, aside = 0.5 * (to_little + to_thumb), 0.5 * (to_little - to_thumb)
        thick, low = half[:, :1, 1, 0], offset[:, :1, 1, 0]
        wrist = 0.6 * half[:, :1, 0, 0].expand(-1, 4)
        sections[:, :4, 0, 0] = torch.stack([wrist, 0.5 * (wrist + reach), reach], -1)
        sections[:, :4, 0, 1] = torch.stack([(0.48 - 0.08 * across) * thick, 0.72 * thick.expand(-1, 4),
                                             0.87 * root[:, :, 1, 0]], -1)
        sections[:, :4, 1, 0] = aside[..., None] * torch.tensor([0.0, 0.5, 1.0], device=self.device)
        sections[:, :4, 1, 1] = torch.stack([0.18 * low.expand(-1, 4), 0.75 * low.expand(-1, 4),
                                             0.86 * offset[:, [4, 7, 10, 13], 1, 0]], -1)

        # Make the phalanges and the thumb's metacarpal.
        end[:, 4:19, 2] = -length[:, 1:]
        for k, values in enumerate((half, offset)):
            ends = values[:, 1:]
            sections[:, 4:19, k] = torch.stack([ends[..., 0], ends.mean(-1), ends[..., 1]], -1)
        cap[:, 4:19] = half[:, 1:].amin(2)
        cap[:, 6:19:3, 1] = tip_radius

        # Make the fold of skin from the thumb's metacarpal to the palm.
        thumb = torch.einsum("bij,bj->bi", bones.turn[:, 1], -0.8 * torch.nn.functional.pad(length[:, 1:2], (2, 0)))
        start[:, 19] = bones.joint[:, 1] + thumb
        end[:, 19] = 0.66 * knuckles[:, 0]
        end[:, 19, 1] -= 0.35 * half[:, 2, 1, 0]
        sections[:, 19, 0] = half[:, 2, 1, :1, None] * torch.tensor([0.6, 0.6], device=self.device)[:, None]
        return start, end, sections, cap
