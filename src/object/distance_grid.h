#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "math/mesh_distance.h"

namespace barehand {

/// Signed distances from a mesh on a grid, for many quick look-ups. Metres, in the mesh's frame, negative inside. The
/// grid covers the mesh's bounding box and kMargin around it. Between its nodes distances are interpolated linearly.
class DistanceGrid {
 public:
  /// How far outside the bounding box of the mesh distances are known [m].
  static constexpr double kMargin = 0.03;

  /// A distance and its gradient.
  struct Sample {
    float distance = 0;
    Eigen::Vector3f gradient = Eigen::Vector3f::Zero();
  };

  /// `lower` and `upper`: the bounding box of the mesh; `cell`: distance of the nodes [m].
  DistanceGrid(const MeshDistance& mesh, const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double cell);
  /// The same of any shape, whose signed distance is a function of the place.
  DistanceGrid(const std::function<float(const Eigen::Vector3f&)>& distance, const Eigen::Vector3d& lower,
               const Eigen::Vector3d& upper, double cell);

  /// The signed distance of `p`. Outside the grid it is that of the nearest place in it plus the distance to it, an
  /// upper bound.
  float distance(const Eigen::Vector3f& p) const { return sample(p).distance; }
  /// The same with the gradient. Outside the grid the gradient is that of the nearest place in it.
  Sample sample(const Eigen::Vector3f& p) const;
  double cell() const { return cell_; }

 private:
  DistanceGrid(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double cell);
  template <class Function>
  void fill(Function&& function);
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(nodes_.y()) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(nodes_.x()) +
           static_cast<std::size_t>(x);
  }

  Eigen::Vector3f origin_, last_;  // position of the first node; largest position, in cells
  Eigen::Vector3i nodes_;
  double cell_;
  std::vector<float> value_;
};

// Here, so that the compiler leaves out the gradient where it is not used.
inline DistanceGrid::Sample DistanceGrid::sample(const Eigen::Vector3f& p) const {
  // Find the cell; places outside the grid move to its border, and those that are not numbers to its first corner.
  const auto cell = static_cast<float>(cell_);
  const Eigen::Vector3f at = (p - origin_) * (1 / cell);
  const Eigen::Vector3f inside = (at.array() > 0).select(at, 0.f).cwiseMin(last_);
  const Eigen::Vector3i i = inside.cast<int>().cwiseMin(nodes_ - Eigen::Vector3i::Constant(2));
  const Eigen::Vector3f f = inside - i.cast<float>();

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
  return {y0 + f.z() * (y1 - y0) + cell * (at - inside).norm(), Eigen::Vector3f(gx, gy, y1 - y0) / cell};
}

}  // namespace barehand
