"""Writes the files that the program reads: full.onnx, crop.onnx and nets.json (docs/nets.md)."""
import inspect
import json
import warnings
import zlib
from pathlib import Path
from typing import Callable

import torch
from torch import Tensor

from network import HandNetwork
from scenes.views import CROP_SIZE, FULL_SIZE

INTERFACE = "2"  # version of inputs and outputs that stages/detection/weights.cpp expects
OUTPUTS = {"full": ["j", "seg", "side"], "crop": ["j", "seg", "side", "hand"]}
SIZES = {"full": FULL_SIZE, "crop": CROP_SIZE}


def export(network: HandNetwork, name: str, folder: Path) -> None:
    """Writes folder/NAME.onnx so that OpenCV 4.6 can read it: with opset 11, by the older of PyTorch's two
    exporters."""
    network = network.float().cpu().eval()
    options = {"dynamo": False} if "dynamo" in inspect.signature(torch.onnx.export).parameters else {}
    path = folder / f"{name}.onnx"
    unfinished = path.with_suffix(".unfinished")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        torch.onnx.export(network, torch.zeros(1, 2, *SIZES[name]), str(unfinished), opset_version=11, input_names=["x"],
                          output_names=OUTPUTS[name], **options)
    unfinished.rename(path)


def write_manifest(folder: Path, version: str) -> None:
    """Writes folder/nets.json, which describes the networks in the folder."""
    manifest: dict = {"version": version, "interface": INTERFACE}
    for name in SIZES:
        data = (folder / f"{name}.onnx").read_bytes()
        manifest[name] = {"file": f"{name}.onnx", "crc32": f"{zlib.crc32(data):08x}"}
    (folder / "nets.json").write_text(json.dumps(manifest, indent=1) + "\n")


def opencv_network(name: str, folder: Path) -> Callable[[Tensor], tuple[Tensor, ...]]:
    """A function that runs folder/NAME.onnx with OpenCV on images [B, 2, H, W]. Needs Debian's python3-opencv."""
    import cv2

    reader = cv2.dnn.readNetFromONNX(str(folder / f"{name}.onnx"))

    def run(images: Tensor) -> tuple[Tensor, ...]:
        single = []
        for image in images.cpu():
            reader.setInput(image[None].numpy())
            single.append([torch.from_numpy(output.copy()) for output in reader.forward(OUTPUTS[name])])
        return tuple(torch.cat(parts) for parts in zip(*single))

    return run


def greatest_difference(network: HandNetwork, name: str, folder: Path, images: Tensor) -> float:
    """The greatest difference between OpenCV's and PyTorch's outputs for `images` [B, 2, H, W]."""
    with torch.no_grad():
        wanted = network.float().cpu().eval()(images.cpu())
    return max(float((ours - theirs).abs().max()) for ours, theirs in zip(wanted, opencv_network(name, folder)(images)))
