// Simulates which pixels of a structured-light sensor have no depth.
#include "drivers/synthetic/rendering/depth_loss.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace barehand::synthetic {
namespace {

constexpr float kEdge = 0.02f;  // a larger difference of depth between neighbouring pixels is an edge [m]

float luma(Rgb c) { return 0.299f * c.r + 0.587f * c.g + 0.114f * c.b; }

}  // namespace

void lit_by_projector(const Intrinsics& camera, double baseline, const float* depth, std::vector<bool>& lit) {
  // A pixel's column in the projector is its own column, shifted by the disparity.
  const auto shift = static_cast<float>(camera.fx * baseline);
  const int reach = static_cast<int>(shift / 0.2f) + 1;  // the largest disparity considered: a distance of 0.2 m
  std::vector<float> nearest(camera.width + reach, std::numeric_limits<float>::max());
  const auto column = [&](int u) { return static_cast<float>(u) - shift / depth[u] + static_cast<float>(reach); };

  // Find the nearest surface in each column of the projector.
  for (int u = 0; u + 1 < camera.width; ++u) {
    if (depth[u] <= 0 || depth[u + 1] <= 0 || std::abs(depth[u + 1] - depth[u]) > kEdge) continue;
    const float from = std::min(column(u), column(u + 1)), to = std::max(column(u), column(u + 1));
    for (int p = std::max(0, static_cast<int>(from)); p <= std::min<int>(to, static_cast<int>(nearest.size()) - 1); ++p)
      nearest[p] = std::min(nearest[p], std::max(depth[u], depth[u + 1]));
  }

  // Mark the pixels as lit that have no nearer surface in their column of the projector.
  lit.assign(camera.width, true);
  for (int u = 0; u < camera.width; ++u) {
    if (depth[u] <= 0) continue;
    const int p = static_cast<int>(column(u));
    if (p >= 0 && p < static_cast<int>(nearest.size())) lit[u] = depth[u] <= nearest[p] + kEdge;
  }
}

float edge_loss(const Image<float>& depth, int u, int v) {
  const float z = depth.at(u, v);
  float loss = 0;
  for (const auto& [du, dv] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {2, 0}, {-2, 0}, {0, 2}, {0, -2}}) {
    if (!depth.contains(u + du, v + dv)) continue;
    const float other = depth.at(u + du, v + dv);
    const bool close = std::abs(du) + std::abs(dv) == 1;
    if (other > 0 && other < z - kEdge) loss = std::max(loss, close ? 0.9f : 0.5f);
    if (other > z + kEdge || other == 0) loss = std::max(loss, close ? 0.25f : 0.0f);
  }
  return loss;
}

float surface_loss(const RenderedView& view, std::span<const Material> materials, int u, int v) {
  const float dark = std::clamp((55 - luma(view.colour.at(u, v))) / 55, 0.0f, 1.0f);
  const float grazing = std::clamp((0.3f - view.cosine.at(u, v)) / 0.3f, 0.0f, 1.0f);
  const auto gloss = static_cast<float>(materials[view.surface.at(u, v)].gloss);
  const float mirror = std::clamp((view.cosine.at(u, v) - 0.97f) / 0.03f, 0.0f, 1.0f) * gloss;
  return std::min(1.0f, 0.001f + 0.3f * dark + 0.7f * grazing + 0.8f * mirror);
}

}  // namespace barehand::synthetic
