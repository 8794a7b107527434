#pragma once

#include <vector>

#include "drivers/synthetic/hand/triangle_mesh.h"

namespace barehand::synthetic {

/// A surface of revolution about z with smooth normals. The outline consists of points (radius, z) from the axis to the
/// axis; the outside is on its right.
TriangleMesh make_lathed(const std::vector<Eigen::Vector2d>& outline);
/// A round tube along a path, closed by flat discs at both ends.
TriangleMesh make_closed_tube(const std::vector<Eigen::Vector3d>& path, double radius);

}  // namespace barehand::synthetic
