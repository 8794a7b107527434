#include "observe/registration/visible_points.h"

#include <algorithm>
#include <limits>

namespace barehand {

namespace {

// Chooses points of a posed surface that face the camera and are not hidden.

constexpr double kCell = 0.006;    // size of a z-buffer cell at the hand [m]; larger than the spacing of the points
constexpr double kBehind = 0.012;  // a point this far behind its cell's front-most point is hidden [m]

}  // namespace

void VisiblePoints::find_facing(const HandSurface& surface, const HandPose& pose) {
  facing_.clear();
  for (int s = 0; s < kSegmentCount; ++s) {
    const SegmentSurface& skin = surface[s];
    for (std::size_t i = 0; i < skin.size(); ++i) {
      const Eigen::Vector3d p = pose[s] * Eigen::Vector3d(skin.x[i], skin.y[i], skin.z[i]);
      const Eigen::Vector3d n = pose[s].R * Eigen::Vector3d(skin.nx[i], skin.ny[i], skin.nz[i]);
      const double cosine = -n.dot(p) / p.norm();
      if (p.z() > 1e-3 && cosine > 0.05) facing_.push_back({{p, n}, skin.area[i] * cosine / (p.z() * p.z())});
    }
  }
}

// Removes points behind another part of the hand, found with a z-buffer of coarse cells.
void VisiblePoints::remove_hidden(const Intrinsics& camera) {
  // Choose the size of a cell for the mean depth.
  double mean_z = 0;
  for (const Facing& f : facing_) mean_z += f.point.p.z() / static_cast<double>(facing_.size());
  const double cell_px = std::max(1.0, kCell * camera.fx / mean_z);

  // Find the extent of the points in the image.
  Eigen::Array2d lo = Eigen::Array2d::Constant(std::numeric_limits<double>::max()), hi = -lo;
  for (const Facing& f : facing_) {
    const Eigen::Array2d uv = camera.project(f.point.p).array() / cell_px;
    lo = lo.min(uv), hi = hi.max(uv);
  }

  // Points almost in the camera plane would need a huge buffer, so such an implausible pose is not tested.
  if (((hi - lo) > 2000).any()) return;

  // Prepare a z-buffer, which holds the least depth of each cell.
  front_.reset(static_cast<int>(hi.x() - lo.x()) + 1, static_cast<int>(hi.y() - lo.y()) + 1,
               std::numeric_limits<float>::max());
  const auto cell = [&](const Facing& f) -> float& {
    const Eigen::Array2d uv = camera.project(f.point.p).array() / cell_px - lo;
    return front_.at(static_cast<int>(uv.x()), static_cast<int>(uv.y()));
  };

  // Fill it, and remove the points that lie clearly behind the front-most point of their cell.
  for (const Facing& f : facing_) cell(f) = std::min(cell(f), static_cast<float>(f.point.p.z()));
  std::erase_if(facing_, [&](const Facing& f) { return f.point.p.z() > cell(f) + kBehind; });
}

std::span<const OrientedPoint> VisiblePoints::of(const HandSurface& surface, const HandPose& pose,
                                                 const Intrinsics& camera, int count) {
  // Find the points that face the camera and are not hidden.
  find_facing(surface, pose);
  if (facing_.empty() || count <= 0) return {};
  remove_hidden(camera);

  // Sum up the image area that they cover.
  double total = 0;
  for (const Facing& f : facing_) total += f.weight;

  // Choose points by systematic sampling: one for every `total / count` of covered image area.
  chosen_.clear();
  const double step = total / count;
  double sum = 0, next = 0.5 * step;
  for (const Facing& f : facing_) {
    sum += f.weight;

    // Take the point in whose area the next sample lies.
    if (sum <= next) continue;
    chosen_.push_back(f.point);
    while (next < sum) next += step;
  }
  return chosen_;
}

}  // namespace barehand
