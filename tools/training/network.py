"""The two networks: one small U-shaped architecture in two sizes. docs/nets.md describes their inputs and outputs."""
import torch
from torch import Tensor, nn
from torch.nn import functional

LABELS = 4


def _convolution(inputs: int, outputs: int, stride: int = 1, kernel: int = 3) -> nn.Sequential:
    return nn.Sequential(nn.Conv2d(inputs, outputs, kernel, stride, kernel // 2, bias=False), nn.BatchNorm2d(outputs),
                         nn.ReLU(inplace=True))


class _Residual(nn.Module):
    def __init__(self, width: int) -> None:
        super().__init__()
        self.first = _convolution(width, width)
        self.second = nn.Sequential(nn.Conv2d(width, width, 3, 1, 1, bias=False), nn.BatchNorm2d(width))

    def forward(self, x: Tensor) -> Tensor:
        return functional.relu(x + self.second(self.first(x)))


class _HandOrNot(nn.Module):
    """Computes from planes the log odds that they show a hand [B, 1]. It was trained without the rest of the network,
    and depends on single cells and their mean only: what sees shapes itself learns the generator's world too well."""

    def __init__(self, inputs: int) -> None:
        super().__init__()
        self.features = nn.Sequential(nn.Dropout2d(0.1), *_convolution(inputs, 64, kernel=1))
        self.odds = nn.Sequential(nn.Dropout(0.3), nn.Linear(64, 1))

    def forward(self, x: Tensor) -> Tensor:
        return self.odds(self.features(x).mean((2, 3)))


class HandNetwork(nn.Module):
    """Computes from images [B, 2, H, W] (depth, validity) the maps [B, 2 N, H/4, W/4] (N logits, then N depths), the
    logits of the labels [B, 4, H/2, W/2], and the log odds of a right hand [B, 1]; with `tells_hands` also those of any
    hand [B, 1]. `widths`: channels at full to 1/16 resolution."""

    def __init__(self, joints: int, widths: tuple[int, int, int, int, int], tells_hands: bool = False) -> None:
        super().__init__()
        a, b, c, d, e = widths
        self.stem = _convolution(2, a)
        self.to_half = nn.Sequential(_convolution(a, b, 2), _Residual(b))
        self.to_quarter = nn.Sequential(_convolution(b, c, 2), _Residual(c))
        self.to_eighth = nn.Sequential(_convolution(c, d, 2), _Residual(d))
        self.to_sixteenth = nn.Sequential(_convolution(d, e, 2), _Residual(e), _Residual(e))
        self.up_eighth = nn.Sequential(_convolution(e + d, d), _Residual(d))
        self.up_quarter = nn.Sequential(_convolution(d + c, c), _Residual(c))
        self.up_half = _convolution(c + b, b)
        self.maps, self.labels, self.side = nn.Conv2d(c, 2 * joints, 1), nn.Conv2d(b, LABELS, 1), nn.Linear(e, 1)
        self.hand = _HandOrNot(e + d) if tells_hands else None

    def forward(self, x: Tensor) -> tuple[Tensor, ...]:
        half = self.to_half(self.stem(x))
        quarter = self.to_quarter(half)
        eighth = self.to_eighth(quarter)
        sixteenth = self.to_sixteenth(eighth)
        coarse = self.up_eighth(_beside(sixteenth, eighth))
        middle = self.up_quarter(_beside(coarse, quarter))
        fine = self.up_half(_beside(middle, half))
        outputs = self.maps(middle), self.labels(fine), self.side(sixteenth.mean((2, 3)))
        return outputs if self.hand is None else (*outputs, self.hand(_beside(sixteenth, coarse)))


def _beside(coarse: Tensor, fine: Tensor) -> Tensor:
    """The channels of `coarse`, enlarged to the size of `fine`, followed by those of `fine`."""
    return torch.cat([functional.interpolate(coarse, size=fine.shape[2:], mode="nearest"), fine], 1)


def make_network(name: str) -> HandNetwork:
    """Makes the network `name`: "full" finds palms in whole frames, "crop" finds the joints in a window."""
    if name == "full":
        return HandNetwork(1, (12, 24, 48, 64, 96))
    return HandNetwork(21, (16, 32, 64, 96, 128), tells_hands=True)
