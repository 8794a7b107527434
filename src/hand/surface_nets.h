#pragma once

#include <array>
#include <functional>
#include <stop_token>
#include <vector>

#include <Eigen/Core>

namespace barehand {

/// A triangle mesh [m], in the frame of the signed distance function that it was made from.
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Extracts the zero level set of a signed distance (negative inside) within a box by naive surface nets (Gibson 1998)
/// on a grid with the given cell size. All lengths are in metres. Vertices are then moved onto the surface along the
/// gradient. The mesh is of no use if `stop` was requested.
TriangleMesh extract_surface(const std::function<double(const Eigen::Vector3d&)>& distance,
                             const Eigen::Vector3d& lower, const Eigen::Vector3d& upper, double cell,
                             const std::stop_token& stop = {});

/// Unit outward normal of a signed distance at `p`, by central differences.
Eigen::Vector3d surface_normal(const std::function<double(const Eigen::Vector3d&)>& distance, const Eigen::Vector3d& p);

}  // namespace barehand
