#pragma once

#include <functional>
#include <span>

#include "drivers/synthetic/triangle_mesh.h"

namespace barehand::synthetic {

/// Smooth patch of rows x columns quads; `point(u, v)` for u, v in [0, 1] with du x dv outward. A patch that is closed
/// in u or v (point(0, v) = point(1, v)) shares the vertices of its seam.
TriangleMesh make_patch(int columns, int rows, const std::function<Eigen::Vector3d(double, double)>& point,
                        bool closed_u = false, bool closed_v = false);

/// Flat parallelogram: origin, origin + side_a, origin + side_b, ...; normal along side_a x side_b.
TriangleMesh make_plate(const Eigen::Vector3d& origin, const Eigen::Vector3d& side_a, const Eigen::Vector3d& side_b);
/// Axis-parallel box about the origin.
TriangleMesh make_box(const Eigen::Vector3d& half_sides);
/// Ball about the origin.
TriangleMesh make_sphere(double radius);
/// Surface of revolution about z: (radius, z) along the outline, the outside on the right of the way; sharp corners.
TriangleMesh make_turned(std::span<const Eigen::Vector2d> outline);
/// Round tube along a path, with the radius at each of its points; open ends.
TriangleMesh make_tube(std::span<const Eigen::Vector3d> path, std::span<const double> radii);

/// A mug about its centre, axis along z, handle towards +x.
struct MugSize {
  double radius = 0.040, height = 0.110, wall = 0.004;
};
TriangleMesh make_mug(const MugSize& size);

/// Combination pliers in the x-y plane about the middle of the handles: handles along +-x, jaws at -x.
struct PliersSize {
  double length = 0.19, handle_radius = 0.0065, spread = 0.019;
};
TriangleMesh make_pliers(const PliersSize& size);

}  // namespace barehand::synthetic
