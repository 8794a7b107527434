// Resamples a frame's depth as the input of a network.
#include "stages/detection/depth_view.h"

#include <algorithm>
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

constexpr float kFarAway = 3;  // farther than what the networks tell from a background [m]

/// Mean log odds of skin over the area of a pixel of a view, around a frame pixel. `step`: frame pixels to its border.
float mean_skin_odds(const Image<Rgb>& colour, const SkinModel& skin, int u, int v, int step) {
  float sum = 0;
  for (const int y : {v - step, v, v + step})
    for (const int x : {u - step, u, u + step})
      sum += skin.log_odds(colour.at(std::clamp(x, 0, colour.width() - 1), std::clamp(y, 0, colour.height() - 1)));
  return sum / 9;
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

void keep_skin(const RgbdFrame& frame, const DepthView& view, const SkinModel& skin, Image<float>& depth) {
  const std::vector<int> columns = nearest(view.width, view.u0, view.step_u, frame.colour.width());
  const std::vector<int> rows = nearest(view.height, view.v0, view.step_v, frame.colour.height());
  const int step = std::max(1, static_cast<int>(std::lround(view.step_u / 3)));
  for (int v = 0; v < view.height; ++v)
    for (int u = 0; u < view.width; ++u) {
      float& z = depth.at(u, v);
      if (z > 0 && mean_skin_odds(frame.colour, skin, columns[u], rows[v], step) <= 0) z = kFarAway;
    }
}

}  // namespace barehand
