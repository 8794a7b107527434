#pragma once

#include <functional>
#include <span>

#include "drivers/synthetic/hand/triangle_mesh.h"

namespace barehand::synthetic {

// Meshes of simple solids for simulated scenes.

/// A smooth patch of rows x columns quadrilaterals: `point(u, v)` for u, v in [0, 1], where du x dv points outward. A
/// patch that is closed in u or v (point(0, v) = point(1, v)) shares the vertices at its seam.
TriangleMesh make_patch(int columns, int rows, const std::function<Eigen::Vector3d(double, double)>& point,
                        bool closed_u = false, bool closed_v = false);

/// A flat parallelogram with the corners origin, origin + side_a, origin + side_b and their sum; its normal is along
/// side_a x side_b.
TriangleMesh make_plate(const Eigen::Vector3d& origin, const Eigen::Vector3d& side_a, const Eigen::Vector3d& side_b);
/// A box about the origin with edges parallel to the axes.
TriangleMesh make_box(const Eigen::Vector3d& half_sides);
/// A sphere about the origin.
TriangleMesh make_sphere(double radius);
/// A surface of revolution about z with sharp edges. The outline consists of points (radius, z); the outside is on its
/// right.
TriangleMesh make_turned(std::span<const Eigen::Vector2d> outline);
/// A round tube along a path, with a radius for each point; its ends are open.
TriangleMesh make_tube(std::span<const Eigen::Vector3d> path, std::span<const double> radii);

/// Dimensions of a mug [m].
struct MugSize {
  double radius = 0.040, height = 0.110, wall = 0.004;
};
/// A mug about its centre: axis along z, handle towards +x.
TriangleMesh make_mug(const MugSize& size);

/// Dimensions of combination pliers [m].
struct PliersSize {
  double length = 0.19, handle_radius = 0.0065, spread = 0.019;
};
/// Combination pliers in the x-y plane about the middle of the handles: handles along the x axis, jaws at -x.
TriangleMesh make_pliers(const PliersSize& size);

}  // namespace barehand::synthetic
