#include "object/distance_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace barehand {

using Eigen::Vector3f;

namespace {

constexpr int kStride = 4;  // fine cells of a coarse one
constexpr float kBand = 6;  // distance from the surface up to which nodes are measured one by one, in cells

}  // namespace

DistanceGrid::DistanceGrid(const MeshDistance& mesh, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper,
                           double cell)
    : DistanceGrid(lower, upper, cell) {
  // Measure a coarse grid, which is exact enough far from the surface.
  DistanceGrid coarse(lower, upper, kStride * cell);
  coarse.fill([&](const Vector3f& p) { return static_cast<float>(mesh.signed_distance(p.cast<double>())); });

  // Measure what is near the surface. Between neighbours the surface is crossed only if their distances add up to at
  // most a cell; elsewhere the sign is that of the neighbour, which saves most of the costly tests for inside.
  const auto size = static_cast<float>(cell);
  float before = std::numeric_limits<float>::max();
  Vector3f at_before = Vector3f::Zero();

  // Fill the fine grid.
  fill([&](const Vector3f& p) {
    float distance = coarse.distance(p);

    // Measure exactly within a band around the surface.
    if (std::abs(distance) < kBand * size) {
      const auto exact = static_cast<float>(mesh.nearest(p.cast<double>()).distance);
      const bool same_side = exact + std::abs(before) > 1.01f * (p - at_before).norm();
      const bool inside = same_side ? before < 0 : mesh.inside(p.cast<double>());
      distance = inside ? -exact : exact;
    }
    before = distance;
    at_before = p;
    return distance;
  });
}

DistanceGrid::DistanceGrid(const std::function<float(const Vector3f&)>& distance, const Eigen::Vector3d& lower,
                           const Eigen::Vector3d& upper, double cell)
    : DistanceGrid(lower, upper, cell) {
  fill(distance);
}

DistanceGrid::DistanceGrid(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double cell)
    : origin_((lower.array() - kMargin).cast<float>()), cell_(cell) {
  const Eigen::Vector3d size = upper - lower + Eigen::Vector3d::Constant(2 * kMargin);
  nodes_ = (size / cell).array().ceil().cast<int>() + 1;
  last_ = nodes_.cast<float>().array() - 1;
  value_.resize(index(0, 0, nodes_.z()));
}

/// Sets every node to the value of a function of its place, row by row.
template <class Function>
void DistanceGrid::fill(Function&& function) {
  for (int z = 0; z < nodes_.z(); ++z)
    for (int y = 0; y < nodes_.y(); ++y)
      for (int x = 0; x < nodes_.x(); ++x)
        value_[index(x, y, z)] = function(origin_ + static_cast<float>(cell_) * Eigen::Vector3i(x, y, z).cast<float>());
}

DistanceGrid::Sample DistanceGrid::sample(const Vector3f& p) const {
  // Find the cell; places outside the grid move to its border, and those that are not numbers to its first corner.
  const auto cell = static_cast<float>(cell_);
  const Vector3f at = (p - origin_) / cell;
  const Vector3f inside = (at.array() > 0).select(at, 0.f).cwiseMin(last_);
  const Eigen::Vector3i i = inside.cast<int>().cwiseMin(nodes_ - Eigen::Vector3i::Constant(2));
  const Vector3f f = inside - i.cast<float>();

  // Interpolate along x, y and z in turn.
  const float* v = &value_[index(i.x(), i.y(), i.z())];
  const std::size_t dy = static_cast<std::size_t>(nodes_.x()), dz = dy * static_cast<std::size_t>(nodes_.y());
  const float x00 = v[0] + f.x() * (v[1] - v[0]), x10 = v[dy] + f.x() * (v[dy + 1] - v[dy]);
  const float x01 = v[dz] + f.x() * (v[dz + 1] - v[dz]), x11 = v[dz + dy] + f.x() * (v[dz + dy + 1] - v[dz + dy]);
  const float y0 = x00 + f.y() * (x10 - x00), y1 = x01 + f.y() * (x11 - x01);

  // Differentiate the interpolation.
  const float gx0 = v[1] - v[0] + f.y() * (v[dy + 1] - v[dy] - v[1] + v[0]);
  const float gx1 = v[dz + 1] - v[dz] + f.y() * (v[dz + dy + 1] - v[dz + dy] - v[dz + 1] + v[dz]);
  const float gx = gx0 + f.z() * (gx1 - gx0), gy = x10 - x00 + f.z() * (x11 - x01 - x10 + x00);
  return {y0 + f.z() * (y1 - y0) + cell * (at - inside).norm(), Vector3f(gx, gy, y1 - y0) / cell};
}

}  // namespace barehand
