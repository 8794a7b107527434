#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "drivers/synthetic/shading.h"
#include "math/camera.h"

namespace barehand::synthetic {

/// Where a structured-light projector `baseline` to the right of the camera [m] does not reach: behind a nearer surface
/// on its ray. Sets `lit[u]` for one row of depth [m].
void lit_by_projector(const Intrinsics& camera, double baseline, const float* depth, std::vector<bool>& lit);

/// Probability that a pixel is lost for its place beside a depth edge of more than 20 mm: nearly certain on the far
/// side, rarer on the near side.
float edge_loss(const Image<float>& depth, int u, int v);

/// Probability that a patch of pixels is lost for how the surface looks: dark, grazing, or glossy and facing the
/// camera.
float surface_loss(const RenderedView& view, std::span<const Material> materials, int u, int v);

}  // namespace barehand::synthetic
