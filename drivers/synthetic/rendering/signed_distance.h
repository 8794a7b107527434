#pragma once

#include <functional>
#include <vector>

#include "math/se3.h"

namespace barehand::synthetic {

/// Distance of a point from the surface of an object [m], in the object's frame; negative inside.
using SignedDistance = std::function<double(const Eigen::Vector3d&)>;

/// A sphere about the origin.
SignedDistance sphere_distance(double radius);
/// A solid cylinder about the z axis, centred at the origin.
SignedDistance cylinder_distance(double radius, double half_height);
/// A tube: the union of all spheres with centres on the path.
SignedDistance tube_distance(std::vector<Eigen::Vector3d> path, double radius);
/// The union of several objects.
SignedDistance union_of(std::vector<SignedDistance> parts);

}  // namespace barehand::synthetic
