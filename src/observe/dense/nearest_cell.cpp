// Finds the nearest occupied cell of an image for a few query cells.
#include "observe/dense/nearest_cell.h"

#include <limits>

namespace barehand {
namespace {

constexpr std::int16_t kNone = -1;

}  // namespace

void NearestCell::index(const Image<std::int32_t>& occupied) {
  const int width = occupied.width(), height = occupied.height();
  row_.reset(width, height, kNone);

  // Sweep down: find the nearest occupied row at or above each cell. Working on whole rows lets the compiler vectorise.
  for (int v = 0; v < height; ++v) {
    const std::int32_t* set = occupied.row(v);
    std::int16_t* own = row_.row(v);
    const std::int16_t* above = v > 0 ? row_.row(v - 1) : own;
    for (int u = 0; u < width; ++u) own[u] = set[u] >= 0 ? static_cast<std::int16_t>(v) : above[u];
  }

  // Sweep up: use the nearest occupied row below a cell instead if it is closer.
  for (int v = height - 2; v >= 0; --v) {
    std::int16_t* own = row_.row(v);
    const std::int16_t* below = row_.row(v + 1);
    for (int u = 0; u < width; ++u) {
      const bool nearer = below[u] != kNone && (own[u] == kNone || below[u] - v < v - own[u]);
      own[u] = nearer ? below[u] : own[u];
    }
  }
}

std::int32_t NearestCell::find(int u, int v) const {
  // Replaces the best cell by the nearest occupied cell of a column if that is nearer.
  const int width = row_.width();
  const std::int16_t* row = row_.row(v);
  int best_sq = std::numeric_limits<int>::max();
  std::int32_t nearest = -1;
  const auto try_column = [&](int x) {
    if (row[x] == kNone) return;
    const int dv = row[x] - v, distance_sq = (x - u) * (x - u) + dv * dv;

    if (distance_sq >= best_sq) return;
    best_sq = distance_sq;
    nearest = row[x] * width + x;
  };

  // Search the columns outwards until no column can contain a nearer cell.
  try_column(u);
  for (int step = 1; step < width && step * step < best_sq; ++step) {
    if (u >= step) try_column(u - step);
    if (u + step < width) try_column(u + step);
  }
  return nearest;
}

}  // namespace barehand
