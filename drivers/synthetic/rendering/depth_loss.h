#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/synthetic/rendering/shading.h"
#include "math/camera.h"

namespace barehand::synthetic {

/// Computes for one row of depth [m] which pixels are lit by a structured-light projector, mounted `baseline` [m] to
/// the right of the camera. A pixel is not lit if a nearer surface lies on the projector's ray. Sets `lit[u]`.
void lit_by_projector(const Intrinsics& camera, double baseline, const float* depth, std::vector<bool>& lit);

/// Probability that a pixel is lost because it is next to a depth edge of more than 20 mm: high on the far side, lower
/// on the near side.
float edge_loss(const Image<float>& depth, int u, int v);

/// Probability that a patch of pixels is lost because of its surface: dark, at a grazing angle, or glossy and facing
/// the camera.
float surface_loss(const RenderedView& view, std::span<const Material> materials, int u, int v);

}  // namespace barehand::synthetic
