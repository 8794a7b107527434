#pragma once

#include <functional>
#include <vector>

#include "math/se3.h"

namespace barehand::synthetic {

/// Distance from a thing's surface in its own frame [m]; negative inside.
using SignedDistance = std::function<double(const Eigen::Vector3d&)>;

SignedDistance sphere_distance(double radius);
/// Solid cylinder about z.
SignedDistance cylinder_distance(double radius, double half_height);
/// Union of balls rolled along the path.
SignedDistance tube_distance(std::vector<Eigen::Vector3d> path, double radius);
SignedDistance union_of(std::vector<SignedDistance> parts);

}  // namespace barehand::synthetic
