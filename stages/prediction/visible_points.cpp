#include "stages/prediction/visible_points.h"

#include <algorithm>
#include <limits>

#include "core/image.h"

namespace barehand {

namespace {

constexpr double kCell = 0.006;    // [m] at the hand's distance; coarser than the spacing of the surface points
constexpr double kBehind = 0.012;  // [m] a point this much behind its cell's front-most point is hidden

struct Facing {
  OrientedPoint point;
  double weight;  // pixels that the point covers, up to a constant
};

std::vector<Facing> facing_points(const HandSurface& surface, const HandPose& pose) {
  std::vector<Facing> facing;
  std::size_t points = 0;
  for (const SegmentSurface& skin : surface) points += skin.size();
  facing.reserve(points);
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentSurface& skin = surface[s];
    for (std::size_t i = 0; i < skin.size(); ++i) {
      const Eigen::Vector3d p = pose[s] * Eigen::Vector3d(skin.x[i], skin.y[i], skin.z[i]);
      const Eigen::Vector3d n = pose[s].R * Eigen::Vector3d(skin.nx[i], skin.ny[i], skin.nz[i]);
      const double cosine = -n.dot(p) / p.norm();
      if (p.z() > 1e-3 && cosine > 0.05) facing.push_back({{p, n}, skin.area[i] * cosine / (p.z() * p.z())});
    }
  }
  return facing;
}

/// Removes what lies behind another part of the hand, by a z-buffer of coarse cells.
void remove_hidden(std::vector<Facing>& facing, const Intrinsics& camera) {
  double mean_z = 0;
  for (const Facing& f : facing) mean_z += f.point.p.z() / static_cast<double>(facing.size());
  const double cell_px = std::max(1.0, kCell * camera.fx / mean_z);
  Eigen::Array2d lo = Eigen::Array2d::Constant(std::numeric_limits<double>::max()), hi = -lo;
  for (const Facing& f : facing) {
    const Eigen::Array2d uv = camera.project(f.point.p).array() / cell_px;
    lo = lo.min(uv), hi = hi.max(uv);
  }
  // Points almost at the camera plane would ask for a huge buffer; such a pose hides nothing worth testing.
  if (((hi - lo) > 2000).any()) return;
  Image<float> front(static_cast<int>(hi.x() - lo.x()) + 1, static_cast<int>(hi.y() - lo.y()) + 1,
                     std::numeric_limits<float>::max());
  const auto cell = [&](const Facing& f) -> float& {
    const Eigen::Array2d uv = camera.project(f.point.p).array() / cell_px - lo;
    return front.at(static_cast<int>(uv.x()), static_cast<int>(uv.y()));
  };
  for (const Facing& f : facing) cell(f) = std::min(cell(f), static_cast<float>(f.point.p.z()));
  std::erase_if(facing, [&](const Facing& f) { return f.point.p.z() > cell(f) + kBehind; });
}

}  // namespace

std::vector<OrientedPoint> visible_points(const HandSurface& surface, const HandPose& pose, const Intrinsics& camera,
                                          int count) {
  std::vector<Facing> facing = facing_points(surface, pose);
  if (facing.empty() || count <= 0) return {};
  remove_hidden(facing, camera);
  double total = 0;
  for (const Facing& f : facing) total += f.weight;
  // Systematic sampling: one point for every `total / count` of covered image area.
  std::vector<OrientedPoint> chosen;
  chosen.reserve(count);
  const double step = total / count;
  double sum = 0, next = 0.5 * step;
  for (const Facing& f : facing) {
    sum += f.weight;
    if (sum <= next) continue;
    chosen.push_back(f.point);
    while (next < sum) next += step;
  }
  return chosen;
}

}  // namespace barehand
