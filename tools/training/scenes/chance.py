"""Seeded random numbers on the device on which the data is made."""
import math
from typing import Sequence

import torch
from torch import Tensor


class Chance:
    """A source of random numbers. The same seed on the same kind of device gives the same numbers."""

    def __init__(self, seed: int, device: str = "cpu") -> None:
        self.device = torch.device(device)
        self.generator = torch.Generator(device=self.device)
        self.generator.manual_seed(seed)

    def uniform(self, low: float, high: float, *shape: int) -> Tensor:
        return low + (high - low) * torch.rand(*shape, generator=self.generator, device=self.device)

    def log_uniform(self, low: float, high: float, *shape: int) -> Tensor:
        return torch.exp(self.uniform(math.log(low), math.log(high), *shape))

    def normal(self, deviation: float, *shape: int) -> Tensor:
        return deviation * torch.randn(*shape, generator=self.generator, device=self.device)

    def flag(self, probability: float, *shape: int) -> Tensor:
        """Booleans that are true with this probability."""
        return self.uniform(0, 1, *shape) < probability

    def choice(self, weights: Sequence[float], count: int) -> Tensor:
        """Indices [count] into `weights`, drawn in proportion to these, which need not sum to 1."""
        share = torch.tensor(weights, dtype=torch.float32, device=self.device)
        return torch.multinomial(share, count, replacement=True, generator=self.generator)

    def direction(self, count: int) -> Tensor:
        """Unit vectors [count, 3], uniform on the sphere."""
        return torch.nn.functional.normalize(self.normal(1, count, 3), dim=1)

    def rotation(self, count: int) -> Tensor:
        """Rotation matrices [count, 3, 3], uniform over all rotations."""
        w, x, y, z = torch.nn.functional.normalize(self.normal(1, count, 4), dim=1).T
        rows = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]
        return torch.stack(rows, -1).reshape(count, 3, 3)
