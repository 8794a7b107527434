#include "stages/contact/surface_links.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

constexpr float kVoxel = 0.0125f;                // surfaces in neighbouring voxels are linked [m]
constexpr float kFlush = 0.9f, kLevel = 0.004f;  // cosine and step [m] between pieces of one flat surface

std::uint64_t key_of(int x, int y, int z) {
  const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)) & 0x1fffff; };
  return part(x) << 42 | part(y) << 21 | part(z);
}

}  // namespace

void SurfaceLinks::link(const std::vector<bool>& open, const std::vector<SurfacePoint>& points) {
  list_voxels(points);
  find_pieces(open);

  // Join the components that have points in neighbouring voxels.
  sets_.clear();
  while (sets_.size() < open.size()) sets_.add();
  for_neighbours([&](const Voxel& a, const Voxel& b) {
    if (open_[a.component] == open_[b.component]) sets_.join(a.component, b.component);
  });
}

void SurfaceLinks::list_voxels(const std::vector<SurfacePoint>& points) {
  voxels_.clear();
  for (const SurfacePoint& point : points) {
    const Eigen::Vector3i v = (point.p / kVoxel).array().floor().cast<int>();
    voxels_.push_back({key_of(v.x(), v.y(), v.z()), point.component, &point});
  }
  const auto before = [](const Voxel& a, const Voxel& b) {
    return a.key != b.key ? a.key < b.key : a.component < b.component;
  };
  const auto same = [](const Voxel& a, const Voxel& b) { return a.key == b.key && a.component == b.component; };
  std::sort(voxels_.begin(), voxels_.end(), before);
  voxels_.erase(std::unique(voxels_.begin(), voxels_.end(), same), voxels_.end());
}

/// Finds the pieces that are flush with something open: they are parts of the table, cut off by what stands on it.
void SurfaceLinks::find_pieces(const std::vector<bool>& open) {
  flush_.assign(open.size(), 0);
  for_neighbours([&](const Voxel& a, const Voxel& b) {
    if (!open[a.component] || open[b.component]) return;
    const Eigen::Vector3f step = b.point->p - a.point->p;
    const bool flush = a.point->n.dot(b.point->n) > kFlush && std::abs(a.point->n.dot(step)) < kLevel;
    flush_[b.component] += flush ? 1 : -1;
  });
  open_ = open;
  for (std::size_t i = 0; i < flush_.size(); ++i)
    if (flush_[i] > 0) open_[i] = true;
}

/// Calls `act` with each ordered pair of entries of different components in the same or in neighbouring voxels.
template <class Act>
void SurfaceLinks::for_neighbours(const Act& act) const {
  const auto less = [](const Voxel& v, std::uint64_t key) { return v.key < key; };
  for (const Voxel& voxel : voxels_)
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        // Voxels that differ in z alone have successive keys.
        const std::uint64_t first = voxel.key + key_of(dx, dy, -1) - key_of(0, 0, 0);
        for (auto at = std::lower_bound(voxels_.begin(), voxels_.end(), first, less);
             at != voxels_.end() && at->key <= first + 2; ++at)
          if (at->component != voxel.component) act(voxel, *at);
      }
}

}  // namespace barehand
