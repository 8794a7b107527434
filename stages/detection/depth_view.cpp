// Resamples a frame's depth as the input of a network.
#include "stages/detection/depth_view.h"

#include <cmath>
#include <vector>

namespace barehand {
namespace {

/// For each of the `count` columns (or rows) of a view, the nearest column (or row) of the frame; -1 if that lies
/// outside the frame's `limit`.
std::vector<int> nearest(int count, double middle, double step, int limit) {
  std::vector<int> result(count);
  for (int i = 0; i < count; ++i) {
    const double position = std::round(middle + (i - 0.5 * (count - 1)) * step);
    result[i] = position >= 0 && position < limit ? static_cast<int>(position) : -1;
  }
  return result;
}

}  // namespace

void sample_depth(const RgbdFrame& frame, const DepthView& view, Image<float>& depth) {
  const std::vector<int> columns = nearest(view.width, view.u0, view.step_u, frame.depth.width());
  const std::vector<int> rows = nearest(view.height, view.v0, view.step_v, frame.depth.height());
  const auto unit = static_cast<float>(frame.depth_unit);

  depth.reset(view.width, view.height);
  for (int v = 0; v < view.height; ++v) {
    if (rows[v] < 0) continue;
    const std::uint16_t* row = frame.depth.row(rows[v]);
    for (int u = 0; u < view.width; ++u)
      if (columns[u] >= 0) depth.at(u, v) = unit * static_cast<float>(row[columns[u]]);
  }
}

}  // namespace barehand
