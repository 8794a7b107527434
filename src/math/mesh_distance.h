#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace barehand {

/// Exact distances of points from a triangle mesh, in the mesh's frame [m]. A tree of bounding boxes finds the nearest
/// triangle; the sign comes from the winding number (Jacobson et al. 2013), which also holds for solids made of parts
/// that overlap, and for surfaces with small holes. Triangles are counter-clockwise seen from outside.
class MeshDistance {
 public:
  using Triangle = std::array<std::uint32_t, 3>;

  /// The mesh must have a triangle.
  MeshDistance(const std::vector<Eigen::Vector3f>& vertices, std::vector<Triangle> triangles);

  /// The place on the surface that is nearest to a point.
  struct Nearest {
    double distance = std::numeric_limits<double>::max();  ///< unsigned distance from the point
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    std::uint32_t triangle = 0;
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< barycentric coordinates in the triangle
  };
  Nearest nearest(const Eigen::Vector3d& p) const;

  /// How often the surface winds around a point: 1 inside a closed surface, 0 outside. Approximate to about 0.03.
  double winding_number(const Eigen::Vector3d& p) const;
  bool inside(const Eigen::Vector3d& p) const;
  /// Distance from the surface; negative inside.
  double signed_distance(const Eigen::Vector3d& p) const;

 private:
  // A node of the tree: a range of triangles, or two children, of which the left one follows its parent.
  struct Node {
    Eigen::Vector3d lower, upper;        // bounding box
    Eigen::Vector3d centre, area;        // area-weighted centroid; sum of area times normal
    double radius = 0;                   // radius of the smallest ball about the centroid that holds the triangles
    std::uint32_t first = 0, count = 0;  // in a leaf: range of its triangles
    std::uint32_t right = 0;             // in an inner node: its right child
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  std::array<Eigen::Vector3d, 3> corners(std::uint32_t triangle) const;
  void search(std::uint32_t node, const Eigen::Vector3d& p, Nearest& best) const;
  double solid_angle(std::uint32_t node, const Eigen::Vector3d& p) const;

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;  // the triangles in the order of the leaves
  std::vector<Node> nodes_;           // the root first
};

}  // namespace barehand
