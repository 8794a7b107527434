#!/usr/bin/env python3
"""Tests that the joints of the training mesh are where the simulator has them, so that both mean the same 21 landmarks.
  mesh_test.py BAREHAND"""
import json
import subprocess
import sys
import tempfile

import surroundings  # first: skips without PyTorch
import torch
from data_test import CPU, MESH, NoChance
from scenes.mesh_hand import MeshRig
from scenes.skeleton import PARENT


def main(barehand: str) -> None:
    with tempfile.TemporaryDirectory() as work:
        subprocess.run([barehand, "sim", "open", "--out", f"{work}/sim", "--set", "frames=1"], check=True, capture_output=True)
        with open(f"{work}/sim/hand.json", encoding="utf-8") as file:
            segments = json.load(file)["segments"]
    bones = MeshRig(MESH, 10, CPU).people(NoChance(1), 1).bones
    rest = torch.tensor([segment["rest_transform"] for segment in segments], dtype=torch.float64)

    for s in range(1, 16):
        joint = (torch.linalg.inv(rest[PARENT[s]]) @ rest[s])[:3, 3]
        apart = 1e3 * (bones.joint[0, s] - joint).norm().item()
        assert apart < 0.2, f"{segments[s]['name']}: its joint is {apart:.1f} mm off"
    for finger in range(5):
        tip = torch.tensor(segments[3 * finger + 3]["distal_local"])
        apart = 1e3 * (bones.tip[0, finger] - tip).norm().item()
        assert apart < 1, f"finger {finger}: its tip is {apart:.1f} mm off"
    print("joints within 0.2 mm, tips within 1 mm")


if __name__ == "__main__":
    main(sys.argv[1])
