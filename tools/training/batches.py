"""Batches of examples, which are made while the training runs."""
from collections import deque
from dataclasses import dataclass
from typing import Iterator

from torch.utils.data import DataLoader, IterableDataset

from examples import Examples, drawn, make_examples
from scenes.scene import Generator


@dataclass(frozen=True)
class Supply:
    """How examples are made: `batch` examples in each step, `at_once` in each group that is made, and in about `passes`
    steps each, of the `kept` newest groups. `beside`: whether a process of its own makes them."""
    batch: int
    at_once: int
    kept: int
    passes: int
    beside: bool = False


# A GPU makes many images in hardly more time than few, a processor makes few the fastest. Both learn from an image in
# less time than it takes to make it.
SUPPLIES = {"cuda": {"full": Supply(160, 960, 1, 3), "crop": Supply(256, 1536, 1, 3)},
            "cpu": {"full": Supply(32, 24, 125, 2, beside=True), "crop": Supply(48, 24, 125, 2, beside=True)}}
HAND = Supply(48, 24, 500, 4, beside=True)  # for whether there is a hand, on a processor
SMOKE = Supply(8, 8, 1, 1)


class _Groups(IterableDataset):
    def __init__(self, generator: Generator, name: str, size: int) -> None:
        self._generator, self._name, self._size = generator, name, size

    def __iter__(self) -> Iterator[Examples]:
        while True:
            yield make_examples(self._generator, self._name, self._size)


def batches(generator: Generator, name: str, supply: Supply) -> Iterator[Examples]:
    """Batches for the network `name`, without end."""
    groups = DataLoader(_Groups(generator, name, supply.at_once), batch_size=None, num_workers=int(supply.beside))
    newest: deque[Examples] = deque(maxlen=supply.kept)
    due = 0
    for group in groups:
        newest.append(drawn([group], supply.at_once))  # a copy: the other process shares a file for every tensor
        due += supply.passes * supply.at_once
        while due >= supply.batch and len(newest) * supply.at_once >= supply.batch:
            due -= supply.batch
            yield drawn(newest, supply.batch)
