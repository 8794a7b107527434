"""The virtual pinhole cameras whose images the networks get (docs/nets.md), and how hands are drawn in these images."""
import warnings
from dataclasses import dataclass

import torch
from torch import Tensor

from .shapes import FAR

# PyTorch 1.13 warns that scatter_reduce is in beta; it has not changed since.
warnings.filterwarnings("ignore", message="scatter_reduce")

FULL_SIZE = (120, 160)  # rows and columns of whole frames
FULL_FOCAL = 131.25  # focal length of whole frames [pixels]
CROP_SIZE = (96, 96)
CROP_ACROSS = 0.34  # width of a window at the palm's depth [m]


@dataclass
class View:
    """B pinhole cameras of `size` (rows, columns). `focal`, `cx`, `cy` [B] in pixels; the centres of pixels have
    integer coordinates."""
    size: tuple[int, int]
    focal: Tensor
    cx: Tensor
    cy: Tensor

    def rays(self) -> Tensor:
        """The rays of all pixels [B, H, W, 3] with z = 1."""
        rows, columns = self.size
        device = self.focal.device
        v, u = torch.meshgrid(torch.arange(rows, device=device), torch.arange(columns, device=device), indexing="ij")
        x = (u - self.cx[:, None, None]) / self.focal[:, None, None]
        y = (v - self.cy[:, None, None]) / self.focal[:, None, None]
        return torch.stack([x, y, torch.ones_like(x)]).permute(1, 2, 3, 0)  # x, y and z each lie together in memory

    def upside_down(self, which: Tensor) -> "View":
        """These cameras, of which those for which `which` [B] is true are turned by 180 degrees about their axes."""
        rows, columns = self.size
        cx, cy = self.cx.clone(), self.cy.clone()
        cx[which], cy[which] = columns - 1 - cx[which], rows - 1 - cy[which]
        return View(self.size, self.focal, cx, cy)

    def project(self, points: Tensor) -> Tensor:
        """Pixel coordinates [B, N, 2] of points [B, N, 3] in the camera's frame [m]."""
        z = points[..., 2].clamp_min(1e-3)
        centre = torch.stack([self.cx, self.cy], -1)[:, None]
        return self.focal[:, None, None] * points[..., :2] / z[..., None] + centre


def draw_points(view: View, points: Tensor) -> Tensor:
    """Depth [B, H, W] of the skin on which `points` [B, P, 3] lie; FAR where there is no skin."""
    rows, columns = view.size
    count = len(points)
    uv, z = view.project(points), points[..., 2]
    buffer = torch.full((count, rows * columns + 1), FAR, device=points.device)

    # Let each point of a near hand cover four pixels, because the hand covers more pixels than it has points.
    pitch = z.mean(1) / view.focal
    for shift_u, shift_v in ((0, 0), (1, 0), (0, 1), (1, 1)):
        if shift_u + shift_v == 0:
            u, v = torch.where((pitch < 0.002)[:, None, None], uv.floor(), uv.round()).long().unbind(-1)
            first_u, first_v, wanted = u, v, torch.ones_like(pitch, dtype=torch.bool)
        else:
            u, v, wanted = first_u + shift_u, first_v + shift_v, pitch < 0.002
            if not bool(wanted.any()):
                break
        seen = (u >= 0) & (u < columns) & (v >= 0) & (v < rows) & (z > 0.05) & wanted[:, None]
        cell = torch.where(seen, v * columns + u, torch.full_like(u, rows * columns))
        buffer.scatter_reduce_(1, cell, torch.where(seen, z, torch.full_like(z, FAR)), "amin")
    return _closed(_closed(buffer[:, :-1].reshape(count, rows, columns)))


def _closed(depth: Tensor) -> Tensor:
    """Fills pixels most of whose neighbours show the hand, and removes pixels of the far side of the hand that show
    through between points."""
    padded = torch.nn.functional.pad(depth[:, None], (1, 1, 1, 1), value=FAR)
    filled = (padded < FAR).float()
    pool = lambda image: 9 * torch.nn.functional.avg_pool2d(image, 3, 1)[:, 0]
    near = pool(filled)
    mean = pool(padded * filled) / near.clamp_min(1)
    least = -torch.nn.functional.max_pool2d(-padded, 3, 1)[:, 0]
    gap = (depth >= FAR) & (near >= 5.5)
    behind = (depth < FAR) & (depth - least > 0.012) & (near >= 6.5) & (mean < depth - 0.006)
    return torch.where(gap, mean, torch.where(behind, least + 0.002, depth))


def full_view(rough_focal: Tensor) -> View:
    """Cameras of whole frames. `rough_focal` [B]: their focal lengths relative to FULL_FOCAL."""
    middle = torch.ones_like(rough_focal)
    return View(FULL_SIZE, FULL_FOCAL * rough_focal, middle * (FULL_SIZE[1] - 1) / 2, middle * (FULL_SIZE[0] - 1) / 2)


def crop_view(middle: Tensor, across: Tensor) -> View:
    """Cameras of windows around `middle` [B, 3] that are `across` [B, m] wide at its depth."""
    focal = CROP_SIZE[1] * middle[:, 2] / across
    half = (CROP_SIZE[1] - 1) / 2
    return View(CROP_SIZE, focal, half - focal * middle[:, 0] / middle[:, 2], half - focal * middle[:, 1] / middle[:, 2])
