#include "drivers/synthetic/rendering/signed_distance.h"

#include <algorithm>
#include <limits>

#include "math/share_along.h"

namespace barehand::synthetic {

// Signed distances of simple solids, with which the grasp planner finds contacts.

using Eigen::Vector3d;

SignedDistance sphere_distance(double radius) {
  return [radius](const Vector3d& p) { return p.norm() - radius; };
}

SignedDistance cylinder_distance(double radius, double half_height) {
  return [=](const Vector3d& p) {
    const Eigen::Vector2d d(p.head<2>().norm() - radius, std::abs(p.z()) - half_height);
    return std::min(d.maxCoeff(), 0.0) + d.cwiseMax(0).norm();
  };
}

SignedDistance tube_distance(std::vector<Vector3d> path, double radius) {
  return [path = std::move(path), radius](const Vector3d& p) {
    double nearest = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      nearest = std::min(nearest, segment_distance(path[i], path[i + 1], p));
    return nearest - radius;
  };
}

SignedDistance union_of(std::vector<SignedDistance> parts) {
  return [parts = std::move(parts)](const Vector3d& p) {
    double nearest = std::numeric_limits<double>::max();
    for (const SignedDistance& part : parts) nearest = std::min(nearest, part(p));
    return nearest;
  };
}

}  // namespace barehand::synthetic
