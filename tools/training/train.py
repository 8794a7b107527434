#!/usr/bin/env python3
"""Trains the networks that find hands, measures them on unseen scenes, and writes a folder that the program reads.

  train.py OUT                 half an hour on a GPU
  train.py OUT --resume configs/nets --network crop --minutes 60
                               on a processor: goes on from a shipped network
  train.py OUT --resume configs/nets --only-hand --minutes 60
                               on a processor: teaches the crop network anew what is a hand, and nothing else
  train.py OUT --smoke         a minute or two on a processor: shows that the training works, not how good it is
"""
import argparse
import json
import math
import os
import shutil
import time
from pathlib import Path
from typing import Callable

import torch

from batches import HAND, SMOKE, SUPPLIES, batches
from evaluate import UNSEEN_SEED, evaluate
from examples import Examples, generator_for, make_examples
from export import SIZES, export, greatest_difference, write_manifest
from hands_folder import add_hands_option, right_hand
from losses import LOSSES, hand_loss
from network import HandNetwork, make_network
from weights import read_folded, read_weights, set_folded

_SHARE = {"full": 0.33, "crop": 0.67}  # fraction of the training time for each network
_RATE, _RESUMED_RATE = 2e-3, 2e-4  # highest learning rates; a higher one destroys what resumed networks know
_HANDS = 0.5  # share of the windows that show a hand while only that is learned
_SMOKE_STEPS = {"full": 24, "crop": 120}
_VALIDATION = {"full": 160, "crop": 256}  # number of scenes on which the loss is printed
_VALIDATION_SEED = 1_000_003  # seed whose people and scenes are in no batch of the training


class Schedule:
    """The progress of the training: by time, or by the number of steps if equal runs must give equal networks."""

    def __init__(self, seconds: float, steps: int, highest_rate: float) -> None:
        self.seconds, self.steps, self.highest_rate = seconds, steps, highest_rate
        self.done, self.started = 0, time.monotonic()

    def progress(self) -> float:
        """The part of the training that is done, 0 to 1."""
        if self.steps:
            return self.done / self.steps
        return (time.monotonic() - self.started) / self.seconds

    def rate(self) -> float:
        """The learning rate: rises linearly over the first steps, then decreases like a cosine."""
        rise = min(1.0, (self.done + 1) / (200 if not self.steps else 10))
        return self.highest_rate * rise * 0.5 * (1 + math.cos(math.pi * min(1.0, self.progress()))) + 1e-5


def train(name: str, options: argparse.Namespace, schedule: Schedule, points: int) -> HandNetwork:
    """Trains the network `name` and returns it. Prints the loss on scenes that are not part of the training."""
    torch.manual_seed(options.seed)
    device, mesh = options.device, right_hand(options.hands)
    network = make_network(name)
    kinds = {"hands": _HANDS} if options.only_hand else {}
    unseen = make_examples(generator_for(_VALIDATION_SEED, device, mesh, points, **kinds), name, 32 if options.smoke else _VALIDATION[name])
    if options.only_hand:
        set_folded(network, read_folded(network, options.resume / f"{name}.onnx"))
    elif options.resume:
        read_weights(network, options.resume / f"{name}.onnx", unseen.image.cpu())
    network.to(device, memory_format=torch.channels_last)
    learning, loss_of = (network.hand, hand_loss) if options.only_hand else (network, LOSSES[name])
    network.requires_grad_(False)
    learning.requires_grad_(True)
    optimiser = torch.optim.AdamW(learning.parameters(), weight_decay=1e-3)
    generator = generator_for(options.seed + len(name) * 7919, device, mesh, points, **kinds)
    before = _loss(network, loss_of, unseen)

    # Train, with new examples after every few passes.
    supply = SMOKE if options.smoke else HAND if options.only_hand else SUPPLIES[device][name]
    stream = batches(generator, name, supply)
    while schedule.progress() < 1:
        for group in optimiser.param_groups:
            group["lr"] = schedule.rate()
        learning.train()
        examples = next(stream)
        with torch.autocast(device, torch.bfloat16, enabled=not (options.smoke or options.only_hand)):
            output = network(examples.image.contiguous(memory_format=torch.channels_last))
        loss = loss_of(output, examples)
        optimiser.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(learning.parameters(), 5.0)
        optimiser.step()
        schedule.done += 1
        if schedule.done % (200 if not options.smoke else 30) == 0:
            print(f"{name}: {100 * schedule.progress():.0f} %, {schedule.done} steps, loss {loss.item():.3f}, "
                  f"unseen {_loss(network, loss_of, unseen):.3f}", flush=True)

    after = _loss(network, loss_of, unseen)
    print(f"{name}: loss on unseen scenes from {before:.3f} to {after:.3f}")
    if not after < before:  # this also catches a loss that is not a number
        raise SystemExit(f"{name}: the training did not converge; start it again with another --seed")
    return network


def _loss(network: HandNetwork, loss_of: Callable, examples: Examples) -> float:
    network.eval()
    with torch.no_grad():
        return loss_of(network(examples.image), examples).item()


def main() -> None:
    options = _options()
    options.out.mkdir(parents=True, exist_ok=True)
    torch.backends.cudnn.benchmark = True
    started, figures = time.monotonic(), {}
    for name in options.networks:
        points = 12000 if options.device == "cuda" else 5000
        share = _SHARE[name] if len(options.networks) > 1 else 1
        schedule = Schedule(60 * options.minutes * share, _SMOKE_STEPS[name] if options.smoke else options.steps,
                            _RESUMED_RATE if options.resume and not options.only_hand else _RATE)
        network = train(name, options, schedule, points)

        generator = generator_for(UNSEEN_SEED, options.device, right_hand(options.hands), points)
        scenes = (1, 32) if options.smoke else (40, 128) if options.device == "cuda" else (16, 32)
        figures[name] = evaluate(network.float().eval(), name, generator, *scenes)
        export(network, name, options.out)
        if options.check:
            images = make_examples(generator_for(5, "cpu", right_hand(options.hands), 5000), name, 4).image
            figures[name]["greatest difference in OpenCV"] = greatest_difference(network, name, options.out, images)

    # The program needs both networks. Training of a single one leaves the other one as it is.
    for name in SIZES:
        if options.resume and not (options.out / f"{name}.onnx").is_file():
            shutil.copy(options.resume / f"{name}.onnx", options.out)
    if all((options.out / f"{name}.onnx").is_file() for name in SIZES):
        write_manifest(options.out, options.version)
    name = "evaluation.json" if len(options.networks) > 1 else f"evaluation_{options.networks[0]}.json"
    (options.out / name).write_text(json.dumps(figures, indent=1) + "\n")
    print(json.dumps(figures, indent=1))
    print(f"wrote {options.out} in {(time.monotonic() - started) / 60:.1f} minutes")


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path, help="folder for full.onnx, crop.onnx, nets.json and evaluation.json")
    parser.add_argument("--minutes", type=float, default=25, help="of training (default: 25)")
    parser.add_argument("--steps", type=int, default=0, help="of each network, instead of a time")
    parser.add_argument("--smoke", action="store_true", help="a few small steps")
    parser.add_argument("--network", choices=SIZES, help="train this one only, for example beside the other one")
    parser.add_argument("--resume", type=Path, metavar="FOLDER", help="go on from the networks of an earlier OUT or of configs/nets")
    parser.add_argument("--only-hand", action="store_true", help="the crop network of --resume learns only whether there is a hand")
    parser.add_argument("--version", default="2.0", help="that nets.json states (default: 2.0)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--device", default="cuda" if torch.cuda.is_available() else "cpu")
    parser.add_argument("--check", action="store_true", help="compare with OpenCV's outputs (needs python3-opencv)")
    add_hands_option(parser)
    options = parser.parse_args()
    if options.only_hand and not options.resume:
        parser.error("--only-hand needs --resume FOLDER, whose other weights stay as they are")
    options.networks = ["crop"] if options.only_hand else [options.network] if options.network else ["crop", "full"]
    if options.device == "cpu":
        torch.set_num_threads(int(os.environ.get("OMP_NUM_THREADS", "1")))
        if not options.smoke and not options.resume:
            print("no GPU: the training would take days; --resume configs/nets goes on from the shipped networks", flush=True)
    return options


if __name__ == "__main__":
    main()
