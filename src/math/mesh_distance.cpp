// Distances from a triangle mesh and its winding numbers, by a tree of bounding boxes.
#include "math/mesh_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

namespace barehand {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

constexpr std::uint32_t kLeaf = 4;  // largest number of triangles in a leaf
constexpr double kFar = 3.0;        // a node farther than this many of its radii is approximated by one dipole

/// Barycentric coordinates of the place in a triangle that is nearest to p (Ericson, Real-Time Collision Detection,
/// 5.1.5).
Vector3d nearest_weights(const Corners& c, const Vector3d& p) {
  // Return a corner if p is in its Voronoi region.
  const Vector3d ab = c[1] - c[0], ac = c[2] - c[0];
  const double d1 = ab.dot(p - c[0]), d2 = ac.dot(p - c[0]);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const double d3 = ab.dot(p - c[1]), d4 = ac.dot(p - c[1]);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double d5 = ab.dot(p - c[2]), d6 = ac.dot(p - c[2]);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};

  // Return a place on an edge if p is in its Voronoi region.
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  const double along = d4 - d3, against = d5 - d6;
  if (va <= 0 && along >= 0 && against >= 0) return {0, against / (along + against), along / (along + against)};

  // Otherwise, the nearest place is inside the face. Degenerate triangles were handled above, except for rounding.
  const double sum = va + vb + vc;
  return sum > 0 ? Vector3d(va / sum, vb / sum, vc / sum) : Vector3d(1, 0, 0);
}

/// Solid angle of a triangle seen from p (van Oosterom and Strackee 1983).
double solid_angle_of(const Corners& corners, const Vector3d& p) {
  const Vector3d a = corners[0] - p, b = corners[1] - p, c = corners[2] - p;
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

double distance_from_box(const Vector3d& lower, const Vector3d& upper, const Vector3d& p) {
  return (lower - p).cwiseMax(p - upper).cwiseMax(0).norm();
}

}  // namespace

MeshDistance::MeshDistance(const std::vector<Eigen::Vector3f>& vertices, std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
  assert(!triangles_.empty());
  for (const auto& v : vertices) vertices_.push_back(v.cast<double>());
  std::iota(order_.begin(), order_.end(), 0u);
  build(0, static_cast<std::uint32_t>(triangles_.size()));
}

Corners MeshDistance::corners(std::uint32_t triangle) const {
  const Triangle& t = triangles_[triangle];
  return {vertices_[t[0]], vertices_[t[1]], vertices_[t[2]]};
}

std::uint32_t MeshDistance::build(std::uint32_t first, std::uint32_t count) {
  // Compute the bounding box of the triangles, the sum of area times normal, and the area-weighted centroid.
  Node node;
  node.lower.setConstant(std::numeric_limits<double>::max());
  node.upper = -node.lower;
  node.centre = node.area = Vector3d::Zero();
  double weight = 0;

  // Extend the box by the corners of every triangle.
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Corners c = corners(order_[i]);
    for (const Vector3d& corner : c) {
      node.lower = node.lower.cwiseMin(corner);
      node.upper = node.upper.cwiseMax(corner);
    }

    // Add the triangle to the normal and the centroid, weighted by its area.
    const Vector3d area = 0.5 * (c[1] - c[0]).cross(c[2] - c[0]);
    const double w = area.norm() + 1e-18;  // triangles without area have a centroid, too
    node.area += area;
    node.centre += w * (c[0] + c[1] + c[2]) / 3;
    weight += w;
  }
  node.centre /= weight;

  // Compute the radius of the smallest sphere around the centroid that contains all triangles.
  for (std::uint32_t i = first; i < first + count; ++i)
    for (const Vector3d& corner : corners(order_[i]))
      node.radius = std::max(node.radius, (corner - node.centre).norm());

  // Make a leaf if there are few triangles.
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  if (count <= kLeaf) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return index;
  }

  // Otherwise, split the list at the median of the triangles' centres along the longest side of the box.
  int axis = 0;
  (node.upper - node.lower).maxCoeff(&axis);
  const auto place = [&](std::uint32_t t) {
    return vertices_[triangles_[t][0]][axis] + vertices_[triangles_[t][1]][axis] + vertices_[triangles_[t][2]][axis];
  };
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });

  // The left child follows its parent.
  build(first, count / 2);
  const std::uint32_t right = build(first + count / 2, count - count / 2);
  nodes_[index].right = right;
  return index;
}

void MeshDistance::search(std::uint32_t index, const Vector3d& p, Nearest& best) const {
  // In a leaf, compute the distance of every triangle.
  const Node& node = nodes_[index];
  if (node.count > 0) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Corners c = corners(order_[i]);
      const Vector3d w = nearest_weights(c, p), q = w[0] * c[0] + w[1] * c[1] + w[2] * c[2];
      const double distance = (p - q).norm();
      if (distance < best.distance) best = {distance, q, order_[i], w};
    }
    return;
  }

  // Search the nearer child first, and skip a child whose box is farther away than the nearest triangle so far.
  std::array<std::uint32_t, 2> child = {index + 1, node.right};
  std::array<double, 2> gap{};
  for (int k = 0; k < 2; ++k) gap[k] = distance_from_box(nodes_[child[k]].lower, nodes_[child[k]].upper, p);
  const int near = gap[0] <= gap[1] ? 0 : 1;
  for (const int k : {near, 1 - near})
    if (gap[k] < best.distance) search(child[k], p, best);
}

double MeshDistance::solid_angle(std::uint32_t index, const Vector3d& p) const {
  // Approximate a far node by one dipole (Barill et al. 2018).
  const Node& node = nodes_[index];
  const Vector3d to_centre = node.centre - p;
  const double distance = to_centre.norm();
  if (distance > kFar * node.radius) return node.area.dot(to_centre) / (distance * distance * distance);

  if (node.count == 0) return solid_angle(index + 1, p) + solid_angle(node.right, p);
  double sum = 0;
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i) sum += solid_angle_of(corners(order_[i]), p);
  return sum;
}

MeshDistance::Nearest MeshDistance::nearest(const Vector3d& p) const {
  Nearest best;
  search(0, p, best);
  return best;
}

double MeshDistance::winding_number(const Vector3d& p) const { return solid_angle(0, p) / (4 * std::numbers::pi); }

bool MeshDistance::inside(const Vector3d& p) const {
  if (distance_from_box(nodes_[0].lower, nodes_[0].upper, p) > 0) return false;
  return winding_number(p) > 0.5;
}

double MeshDistance::signed_distance(const Vector3d& p) const {
  const double distance = nearest(p).distance;
  return inside(p) ? -distance : distance;
}

}  // namespace barehand
