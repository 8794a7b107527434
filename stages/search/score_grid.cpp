// Samples an observation into the grid on which poses are scored.
#include "stages/search/score_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace barehand {

namespace {

/// Median depth of the hand pixels [m]; 0 if none has depth.
double median_hand_depth(const HandObservation& observation) {
  std::vector<float> z;
  z.reserve(observation.hand_pixels.size());
  for (const std::int32_t i : observation.hand_pixels) {
    if (observation.depth[i] > 0) z.push_back(observation.depth[i]);
  }
  if (z.empty()) return 0;
  std::nth_element(z.begin(), z.begin() + z.size() / 2, z.end());
  return z[z.size() / 2];
}

struct Cell {
  PixelLabel label = PixelLabel::unknown;
  float depth = 0;
};

/// The label of a block of pixels, and the mean depth of its pixels with that label. The label is hand if at least a
/// third of the pixels are (fingers are thin), otherwise the most frequent one.
Cell summarise(const HandObservation& observation, int u_begin, int v_begin, int size) {
  std::array<int, 4> count{}, measured{};
  std::array<double, 4> sum{};
  int total = 0;

  // Count the pixels with each label, and add up their depths.
  for (int v = v_begin; v < std::min(v_begin + size, observation.label.height()); ++v) {
    for (int u = u_begin; u < std::min(u_begin + size, observation.label.width()); ++u) {
      const auto label = static_cast<std::size_t>(observation.label.at(u, v));
      const float z = observation.depth.at(u, v);
      ++count[label], ++total;
      if (z > 0) ++measured[label], sum[label] += z;
    }
  }

  // Choose the label.
  auto label = static_cast<std::size_t>(std::max_element(count.begin(), count.end()) - count.begin());
  constexpr auto kHand = static_cast<std::size_t>(PixelLabel::hand);
  if (3 * count[kHand] >= total && measured[kHand] > 0) label = kHand;
  const float depth = measured[label] > 0 ? static_cast<float>(sum[label] / measured[label]) : 0.0f;
  return {static_cast<PixelLabel>(label), depth};
}

/// Two-pass chamfer distance [cells] to the cells for which `is_target` holds.
template <class Predicate>
Image<float> distance_to(const Image<PixelLabel>& label, const Predicate& is_target) {
  constexpr float kDiagonal = 1.4142136f;
  const int w = label.width(), h = label.height();
  Image<float> d(w, h, static_cast<float>(w + h));
  const auto relax = [&](int u, int v, int du, int dv, float step) {
    if (d.contains(u + du, v + dv)) d.at(u, v) = std::min(d.at(u, v), d.at(u + du, v + dv) + step);
  };

  // Propagate from the top left to the bottom right, and then back.
  for (int v = 0; v < h; ++v) {
    for (int u = 0; u < w; ++u) {
      if (is_target(label.at(u, v))) d.at(u, v) = 0;
      relax(u, v, -1, 0, 1), relax(u, v, 0, -1, 1), relax(u, v, -1, -1, kDiagonal), relax(u, v, 1, -1, kDiagonal);
    }
  }

  for (int v = h - 1; v >= 0; --v) {
    for (int u = w - 1; u >= 0; --u) {
      relax(u, v, 1, 0, 1), relax(u, v, 0, 1, 1), relax(u, v, 1, 1, kDiagonal), relax(u, v, -1, 1, kDiagonal);
    }
  }
  return d;
}

/// Sets the number of hand cells, their centroid and the palm centre.
void locate_hand(ScoreGrid& grid) {
  const Image<float> inside = distance_to(grid.label, [](PixelLabel l) { return l != PixelLabel::hand; });
  float widest = -1;
  for (int j = 0; j < grid.label.height(); ++j) {
    for (int i = 0; i < grid.label.width(); ++i) {
      if (grid.label.at(i, j) != PixelLabel::hand) continue;
      const Eigen::Vector3d p = grid.camera.unproject(i, j, grid.depth.at(i, j));
      ++grid.hand_cells;
      grid.centroid += p;
      if (inside.at(i, j) > widest) widest = inside.at(i, j), grid.palm_centre = p;
    }
  }
  if (grid.hand_cells > 0) grid.centroid /= grid.hand_cells;
}

}  // namespace

ScoreGrid make_score_grid(const HandObservation& observation, double cell) {
  const double z = median_hand_depth(observation);
  if (!(z > 0)) return {};
  const Intrinsics& camera = observation.frame->camera;
  const int size = std::max(1, static_cast<int>(std::lround(cell * camera.fx / z)));
  const int w = (observation.label.width() + size - 1) / size, h = (observation.label.height() + size - 1) / size;
  ScoreGrid grid;
  grid.cell = size * z / camera.fx;

  // Make the camera whose pixels are the cells: the centre of cell i lies at frame pixel u0 + (i + 0.5) * size - 0.5.
  grid.camera = {w,
                 h,
                 camera.fx / size,
                 camera.fy / size,
                 (camera.cx - observation.u0 + 0.5) / size - 0.5,
                 (camera.cy - observation.v0 + 0.5) / size - 0.5};
  grid.i_lo = -observation.u0 / size, grid.j_lo = -observation.v0 / size;
  grid.i_hi = (camera.width - observation.u0) / size, grid.j_hi = (camera.height - observation.v0) / size;

  // Compute the label and the depth of every cell, and the quantities derived from them.
  grid.depth.reset(w, h, 0);
  grid.label.reset(w, h, PixelLabel::unknown);
  for (int j = 0; j < h; ++j) {
    for (int i = 0; i < w; ++i) {
      const Cell c = summarise(observation, i * size, j * size, size);
      grid.label.at(i, j) = c.label;
      grid.depth.at(i, j) = c.depth;
    }
  }

  // Find the hand in the grid, and compute the distance of every cell from it.
  locate_hand(grid);
  grid.hand_distance = distance_to(grid.label, [](PixelLabel l) { return l == PixelLabel::hand; });
  for (std::size_t i = 0; i < grid.hand_distance.size(); ++i) grid.hand_distance[i] *= static_cast<float>(grid.cell);
  return grid;
}

}  // namespace barehand
