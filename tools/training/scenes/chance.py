"""Seeded random numbers on the device that makes the data."""
import math
from typing import Sequence

import torch
from torch import Tensor


class Chance:
    """Draws batches of B samples. The same seed on the same kind of device gives the same data."""

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
        """True with this probability."""
        return self.uniform(0, 1, *shape) < probability

    def choice(self, weights: Sequence[float], count: int) -> Tensor:
        """[count] indices into `weights`, which need not sum up to 1."""
        share = torch.tensor(weights, dtype=torch.float32, device=self.device)
        return torch.multinomial(share, count, replacement=True, generator=self.generator)

    def direction(self, count: int) -> Tensor:
        """[count, 3] unit vectors, uniform on the sphere."""
        return torch.nn.functional.normalize(self.normal(1, count, 3), dim=1)

    def rotation(self, count: int) -> Tensor:
        """[count, 3, 3] rotations, uniform over all."""
        w, x, y, z = torch.nn.functional.normalize(self.normal(1, count, 4), dim=1).T
        rows = [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]
        return torch.stack(rows, -1).reshape(count, 3, 3)
