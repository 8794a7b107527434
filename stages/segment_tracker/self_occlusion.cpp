// Predicts which pixels of a segment other segments hide.
#include "stages/segment_tracker/self_occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace barehand {
namespace {

using ImagePoint = PredictedPatch::ImagePoint;
constexpr float kFar = std::numeric_limits<float>::max();

/// Projects the skin points that face the camera into pixels of the map.
void project_front(const SegmentSurface& skin, const SE3& T, const PixelMap& map, std::vector<ImagePoint>& points) {
  const Eigen::Matrix3f R = T.R.cast<float>();
  const Eigen::Vector3f t = T.t.cast<float>();
  points.clear();
  for (std::size_t i = 0; i < skin.size(); ++i) {
    const Eigen::Vector3f p = R * Eigen::Vector3f(skin.x[i], skin.y[i], skin.z[i]) + t;
    const Eigen::Vector3f n = R * Eigen::Vector3f(skin.nx[i], skin.ny[i], skin.nz[i]);
    if (p.z() > kNearestSeen && n.dot(p) < 0)
      points.push_back({map.fx * p.x() / p.z() + map.cx, map.fy * p.y() / p.z() + map.cy, p.z()});
  }
}

/// Calls visit(pixel index, cell index) for all pixels of the map that a patch covers.
template <class Visit>
void for_each_pixel(const PredictedPatch& patch, const PixelMap& map, const Visit& visit) {
  const int u_end = std::min(map.width - 1, patch.u0 + patch.columns * patch.cell);
  const int v_end = std::min(map.height - 1, patch.v0 + patch.rows * patch.cell);
  for (int v = patch.v0; v < v_end; ++v)
    for (int u = patch.u0; u < u_end; ++u)
      visit(map.index(u, v),
            static_cast<std::size_t>((v - patch.v0) / patch.cell) * patch.columns + (u - patch.u0) / patch.cell);
}

}  // namespace

void PredictedPatch::predict(const SegmentSurface& skin, const SE3& T, const PixelMap& map, double margin) {
  // Project the skin.
  columns = rows = 0;
  project_front(skin, T, map, points);
  if (points.empty()) return;

  // Find the bounding box of the projected points in the image.
  float u_lo = kFar, v_lo = kFar, u_hi = -kFar, v_hi = -kFar, z_lo = kFar;
  for (const ImagePoint& p : points) {
    u_lo = std::min(u_lo, p.u);
    u_hi = std::max(u_hi, p.u);
    v_lo = std::min(v_lo, p.v);
    v_hi = std::max(v_hi, p.v);
    z_lo = std::min(z_lo, p.z);
  }

  // Lay out the grid: it includes the margin, and its cells are finer than the spacing of the points.
  const float scale = map.fx / z_lo, border = static_cast<float>(margin) * scale;
  const float skin_area = std::accumulate(skin.area.begin(), skin.area.end(), 0.0f);
  const float spacing = std::sqrt(skin_area / static_cast<float>(skin.size())) * scale;
  const auto inside = [](float x, int size) { return static_cast<int>(std::clamp(x, 1.0f, size - 1.0f)); };

  u0 = inside(u_lo - border, map.width);
  v0 = inside(v_lo - border, map.height);
  cell = std::max(1, static_cast<int>(spacing / 2));
  columns = (inside(u_hi + border + 1, map.width) - u0 + cell - 1) / cell;
  rows = (inside(v_hi + border + 1, map.height) - v0 + cell - 1) / cell;
  outline_sq = spacing * spacing;

  z.assign(static_cast<std::size_t>(columns) * rows, kFar);
  gap_sq.assign(z.size(), kFar);

  // Give every cell the depth of the nearest skin point.
  const float centre = (cell - 1) / 2.0f, side = static_cast<float>(cell);
  for (int row = 0; row < rows; ++row) {
    float* row_gap = gap_sq.data() + static_cast<std::size_t>(row) * columns;
    float* row_z = z.data() + static_cast<std::size_t>(row) * columns;
    const float v = v0 + centre + row * side;

    // Compare each point with every cell of the row.
    for (const ImagePoint& p : points) {
      const float dv_sq = (v - p.v) * (v - p.v);
      for (int column = 0; column < columns; ++column) {
        const float du = u0 + centre + static_cast<float>(column) * side - p.u;
        const float d = du * du + dv_sq;

        const bool nearer = d < row_gap[column];
        row_gap[column] = nearer ? d : row_gap[column];
        row_z[column] = nearer ? p.z : row_z[column];
      }
    }
  }
}

/// Applies the paper's rule (Sec. 4.2): a segment is hidden where hand pixels are substantially closer to the camera
/// than its prediction. Occlusion by other objects is decided per sample, in patch_distance().
void SelfOcclusion::label_by_data(float threshold, PixelMap& map) const {
  for (int s = 0; s < kSegmentCount; ++s)
    for_each_pixel(patches_[s], map, [&](std::size_t pixel, std::size_t cell) {
      const float z = map.cells[pixel].z;
      if (z > 0 && z < patches_[s].z[cell] - threshold) map.hidden[pixel] |= 1 << s;
    });
}

/// Applies the rule that is not the paper's: a segment is hidden where the predicted skin of another segment is in
/// front of it, according to a depth buffer of the whole predicted hand.
void SelfOcclusion::label_by_model(float threshold, PixelMap& map) {
  // Render the depth buffer.
  front_.assign(map.cells.size(), kFar);
  for (const PredictedPatch& patch : patches_)
    for_each_pixel(patch, map, [&](std::size_t pixel, std::size_t cell) {
      if (patch.gap_sq[cell] <= patch.outline_sq) front_[pixel] = std::min(front_[pixel], patch.z[cell]);
    });

  // Compare each segment with the depth buffer.
  for (int s = 0; s < kSegmentCount; ++s)
    for_each_pixel(patches_[s], map, [&](std::size_t pixel, std::size_t cell) {
      if (front_[pixel] < patches_[s].z[cell] - threshold) map.hidden[pixel] |= 1 << s;
    });
}

void SelfOcclusion::label(const HandSurface& surface, const HandPose& predicted, const SegmentTrackerParams& params,
                          PixelMap& map, Workers& workers) {
  if (params.self_occlusion == "off") return;
  workers.for_each_index(kSegmentCount,
                         [&](int s) { patches_[s].predict(surface[s], predicted[s], map, params.patch_margin); });
  const float threshold = static_cast<float>(params.self_occlusion_threshold);
  if (params.self_occlusion != "model") label_by_data(threshold, map);
  if (params.self_occlusion != "data") label_by_model(threshold, map);
}

}  // namespace barehand
