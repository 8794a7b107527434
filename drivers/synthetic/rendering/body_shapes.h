#pragma once

#include <span>

#include "drivers/synthetic/hand/triangle_mesh.h"

namespace barehand::synthetic {

/// An ellipse across the z axis, with half axes along x and y [m].
struct LoftRing {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double half_x = 0, half_y = 0;
};

/// A smooth surface through rings that are ordered by increasing z. It is closed if the first and the last ring are
/// points.
TriangleMesh make_loft(std::span<const LoftRing> rings);
/// An ellipsoid about the origin.
TriangleMesh make_ellipsoid(const Eigen::Vector3d& half_axes);
/// A limb with round ends: the hull of a sphere about the origin and one about (0, 0, length).
TriangleMesh make_limb(double length, double radius, double end_radius);
/// The pose of a limb that begins at one point and points towards another.
SE3 limb_between(const Eigen::Vector3d& begin, const Eigen::Vector3d& end);

}  // namespace barehand::synthetic
