// Removes flying pixels from a frame's depth, and marks depth edges.
#include "stages/preprocess/depth_cleaner.h"

#include <algorithm>
#include <cmath>

#include "stages/preprocess/coarse_grid.h"

namespace barehand {
namespace {

// Number of neighbours at its own depth that a pixel needs in order not to count as flying. In a line one pixel wide
// along a silhouette, pixels have two; at a corner of a real surface, they have three.
constexpr float kMinNeighbours = 3;

}  // namespace

void DepthCleaner::clean(const RgbdFrame& frame, const PreprocessParams& params, const Region& region,
                         Image<float>& depth, Image<std::uint8_t>& edge) {
  neighbours_.resize(region.width);
  raw_.reset(region.width + 2, region.height + 2);
  depth.reset(region.width, region.height);
  edge.reset(region.width, region.height);

  // Convert the depth to metres, with a border of pixels without depth.
  const float unit = static_cast<float>(frame.depth_unit), nearest = static_cast<float>(params.min_depth);
  for (int v = 0; v < region.height; ++v) {
    const std::uint16_t* in = frame.depth.row(v + region.v0) + region.u0;
    float* out = raw_.row(v + 1) + 1;
    for (int u = 0; u < region.width; ++u) {
      const float z = static_cast<float>(in[u]) * unit;
      out[u] = z < nearest ? 0.f : z;
    }
  }

  // Visit the pixels row by row with their neighbours.
  const float fx = static_cast<float>(frame.camera.fx);
  for (int v = 0; v < region.height; ++v) {
    const float* above = raw_.row(v) + 1;
    const float* own = raw_.row(v + 1) + 1;
    const float* below = raw_.row(v + 2) + 1;
    float* out = depth.row(v);
    std::uint8_t* border = edge.row(v);
    float* neighbours = neighbours_.data();

    // Count the neighbours on the same surface.
    for (int u = 0; u < region.width; ++u) {  // uses only floats, so that the compiler vectorises it
      const float z = own[u], step = same_surface_step(z, fx);
      const auto same = [z, step](float other) { return std::abs(other - z) < step ? 1.f : 0.f; };
      const float count = same(above[u - 1]) + same(above[u]) + same(above[u + 1]) + same(own[u - 1]) +
                          same(own[u + 1]) + same(below[u - 1]) + same(below[u]) + same(below[u + 1]);

      // Remove pixels with few of them, and mark those at a depth edge.
      neighbours[u] = count;
      out[u] = count < kMinNeighbours ? 0.f : z;
    }
    for (int u = 0; u < region.width; ++u) border[u] = neighbours[u] < 8.f;
  }
}

}  // namespace barehand
