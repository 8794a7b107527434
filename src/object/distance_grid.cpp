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

}  // namespace barehand
