// Finds the nearest set pixel of a mask for every pixel.
#include "stages/preprocess/image/distance_transform.h"

#include <cstdlib>

namespace barehand {
namespace {

constexpr std::int32_t kFar = 1 << 13;  // larger than any image, but its square still fits into 32 bits [pixels]

}  // namespace

void NearestPixelTransform::compute(const Image<std::uint8_t>& mask, Image<std::int32_t>& nearest) {
  const int width = mask.width(), height = mask.height();
  nearest.reset(width, height, -1);
  row_.reset(width, height, -kFar);
  // Find the nearest set row in each column, downwards and then upwards: whole rows at a time, so that it vectorises.
  for (int v = 0; v < height; ++v) {
    const std::uint8_t* set = mask.row(v);
    std::int32_t* own = row_.row(v);
    const std::int32_t* above = v > 0 ? row_.row(v - 1) : own;
    for (int u = 0; u < width; ++u) own[u] = set[u] ? v : above[u];
  }

  for (int v = height - 2; v >= 0; --v) {
    std::int32_t* own = row_.row(v);
    const std::int32_t* below = row_.row(v + 1);
    for (int u = 0; u < width; ++u) own[u] = std::abs(below[u] - v) < std::abs(own[u] - v) ? below[u] : own[u];
  }
  // Along each row, compute the lower envelope of the parabolas (x - u)^2 + (v - row(u))^2.
  column_.resize(width);
  from_.resize(width);
  for (int v = 0; v < height; ++v) {
    const std::int32_t* rows = row_.row(v);
    int last = -1;

    // Add one parabola after the other, and remove those that it replaces.
    for (int u = 0; u < width; ++u) {
      const std::int32_t dv = rows[u] - v;
      if (rows[u] < 0) continue;
      std::int32_t start = 0;
      while (last >= 0) {
        const int other = column_[last];
        const std::int32_t other_dv = rows[other] - v;
        // Compute the column from which on the new parabola is strictly lower.
        const std::int32_t above = u * u + dv * dv - other * other - other_dv * other_dv, span = 2 * (u - other);
        start = above < 0 ? 0 : above / span + 1;
        if (start > from_[last]) break;
        --last;
        start = 0;
      }

      if (start >= width) continue;
      column_[++last] = u;
      from_[last] = start;
    }

    // Write the nearest pixel of each interval.
    if (last < 0) continue;
    std::int32_t* out = nearest.row(v);
    for (int k = 0; k <= last; ++k) {
      const int end = k < last ? from_[k + 1] : width;
      const std::int32_t index = rows[column_[k]] * width + column_[k];
      for (int u = from_[k]; u < end; ++u) out[u] = index;
    }
  }
}

}  // namespace barehand
