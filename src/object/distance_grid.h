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

}  // namespace barehand
