#!/usr/bin/env python3
"""Averages networks that were trained on from the same one, each weight by itself. Needs Debian's python3-opencv.

A network that is trained on in a harder world forgets some of the easier one. The mean of its weights before and after
knows both about as well as the better of the two (Wortsman et al., Robust fine-tuning of zero-shot models, CVPR 2022).
"""
import argparse
from pathlib import Path

from export import SIZES, export, write_manifest
from network import HandNetwork, make_network
from weights import read_folded, set_folded


def average(name: str, folders: list[Path]) -> HandNetwork:
    """The network `name` whose weights are the means of those of the folders' networks."""
    network = make_network(name)
    all_weights = [read_folded(network, folder / f"{name}.onnx") for folder in folders]
    set_folded(network, [tuple(sum(parts) / len(folders) for parts in zip(*layer)) for layer in zip(*all_weights)])
    return network


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path, help="folder for full.onnx, crop.onnx and nets.json")
    for name in SIZES:
        parser.add_argument(f"--{name}", type=Path, nargs="+", required=True, metavar="FOLDER", help=f"of whose {name}.onnx the mean is taken")
    parser.add_argument("--version", default="2.0", help="that nets.json states (default: 2.0)")
    options = parser.parse_args()

    # Read all networks before the first one is written, since a folder may be its own result.
    networks = {name: average(name, getattr(options, name)) for name in SIZES}
    options.out.mkdir(parents=True, exist_ok=True)
    for name, network in networks.items():
        export(network, name, options.out)
    write_manifest(options.out, options.version)


if __name__ == "__main__":
    main()
