#include "stages/segment_tracker/self_occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace barehand {
namespace {

using Patches = std::array<PredictedPatch, kSegmentCount>;
constexpr float kFar = std::numeric_limits<float>::max();
constexpr float kNearest = 0.01f;  // [m]

struct ImagePoint {
  float u, v, z;
};

/// Front-facing skin points in pixels of the map.
std::vector<ImagePoint> project_front(const SegmentSurface& skin, const SE3& T, const PixelMap& map) {
  const Eigen::Matrix3f R = T.R.cast<float>();
  const Eigen::Vector3f t = T.t.cast<float>();
  std::vector<ImagePoint> points;
  for (std::size_t i = 0; i < skin.size(); ++i) {
    const Eigen::Vector3f p = R * Eigen::Vector3f(skin.x[i], skin.y[i], skin.z[i]) + t;
    const Eigen::Vector3f n = R * Eigen::Vector3f(skin.nx[i], skin.ny[i], skin.nz[i]);
    if (p.z() > kNearest && n.dot(p) < 0)
      points.push_back({map.fx * p.x() / p.z() + map.cx, map.fy * p.y() / p.z() + map.cy, p.z()});
  }
  return points;
}

/// Calls visit(pixel index, cell index) for the pixels of the map that a patch covers.
template <class Visit>
void for_each_pixel(const PredictedPatch& patch, const PixelMap& map, const Visit& visit) {
  const int u_end = std::min(map.width - 1, patch.u0 + patch.columns * patch.cell);
  const int v_end = std::min(map.height - 1, patch.v0 + patch.rows * patch.cell);
  for (int v = patch.v0; v < v_end; ++v)
    for (int u = patch.u0; u < u_end; ++u)
      visit(map.index(u, v),
            static_cast<std::size_t>((v - patch.v0) / patch.cell) * patch.columns + (u - patch.u0) / patch.cell);
}

/// Sec. 4.2: data substantially closer to the camera than the prediction. Only skin: other data is judged per sample.
void label_by_data(const Patches& patches, float threshold, PixelMap& map) {
  for (int s = 0; s < kSegmentCount; ++s)
    for_each_pixel(patches[s], map, [&](std::size_t pixel, std::size_t cell) {
      const float z = map.cells[pixel].z;
      if (z > 0 && z < patches[s].z[cell] - threshold) map.hidden[pixel] |= 1 << s;
    });
}

/// The whole predicted hand in one depth buffer: another segment's skin in front hides this one.
void label_by_model(const Patches& patches, float threshold, PixelMap& map) {
  std::vector<float> front(map.cells.size(), kFar);
  for (const PredictedPatch& patch : patches)
    for_each_pixel(patch, map, [&](std::size_t pixel, std::size_t cell) {
      if (patch.gap_sq[cell] <= patch.outline_sq) front[pixel] = std::min(front[pixel], patch.z[cell]);
    });
  for (int s = 0; s < kSegmentCount; ++s)
    for_each_pixel(patches[s], map, [&](std::size_t pixel, std::size_t cell) {
      if (front[pixel] < patches[s].z[cell] - threshold) map.hidden[pixel] |= 1 << s;
    });
}

}  // namespace

PredictedPatch predict_patch(const SegmentSurface& skin, const SE3& T, const PixelMap& map, double margin) {
  PredictedPatch patch;
  const std::vector<ImagePoint> points = project_front(skin, T, map);
  if (points.empty()) return patch;
  float u_lo = kFar, v_lo = kFar, u_hi = -kFar, v_hi = -kFar, z_lo = kFar;
  for (const ImagePoint& p : points) {
    u_lo = std::min(u_lo, p.u);
    u_hi = std::max(u_hi, p.u);
    v_lo = std::min(v_lo, p.v);
    v_hi = std::max(v_hi, p.v);
    z_lo = std::min(z_lo, p.z);
  }
  const float scale = map.fx / z_lo, border = static_cast<float>(margin) * scale;
  const float skin_area = std::accumulate(skin.area.begin(), skin.area.end(), 0.0f);
  const float spacing = std::sqrt(skin_area / static_cast<float>(skin.size())) * scale;
  const auto inside = [](float x, int size) { return static_cast<int>(std::clamp(x, 1.0f, size - 1.0f)); };
  patch.u0 = inside(u_lo - border, map.width);
  patch.v0 = inside(v_lo - border, map.height);
  patch.cell = std::max(1, static_cast<int>(spacing / 2));
  patch.columns = (inside(u_hi + border + 1, map.width) - patch.u0 + patch.cell - 1) / patch.cell;
  patch.rows = (inside(v_hi + border + 1, map.height) - patch.v0 + patch.cell - 1) / patch.cell;
  patch.outline_sq = spacing * spacing;
  patch.z.assign(static_cast<std::size_t>(patch.columns) * patch.rows, kFar);
  patch.gap_sq.assign(patch.z.size(), kFar);

  const float centre = (patch.cell - 1) / 2.0f, cell = static_cast<float>(patch.cell);
  for (int row = 0; row < patch.rows; ++row) {
    float* gap = patch.gap_sq.data() + static_cast<std::size_t>(row) * patch.columns;
    float* z = patch.z.data() + static_cast<std::size_t>(row) * patch.columns;
    const float v = patch.v0 + centre + row * cell;
    for (const ImagePoint& p : points) {
      const float dv_sq = (v - p.v) * (v - p.v);
      for (int column = 0; column < patch.columns; ++column) {
        const float du = patch.u0 + centre + static_cast<float>(column) * cell - p.u;
        const float d = du * du + dv_sq;
        const bool nearer = d < gap[column];
        gap[column] = nearer ? d : gap[column];
        z[column] = nearer ? p.z : z[column];
      }
    }
  }
  return patch;
}

void label_self_occlusion(const HandSurface& surface, const HandPose& predicted, const SegmentTrackerParams& params,
                          PixelMap& map, Workers& workers) {
  if (params.self_occlusion == "off") return;
  Patches patches;
  workers.for_each_index(
      kSegmentCount, [&](int s) { patches[s] = predict_patch(surface[s], predicted[s], map, params.patch_margin); });
  const float threshold = static_cast<float>(params.self_occlusion_threshold);
  if (params.self_occlusion != "model") label_by_data(patches, threshold, map);
  if (params.self_occlusion != "data") label_by_model(patches, threshold, map);
}

}  // namespace barehand
