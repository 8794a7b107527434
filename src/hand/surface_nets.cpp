#include "hand/surface_nets.h"

#include <cmath>

namespace barehand {
namespace {

// Extracts a triangle mesh from a signed distance on a regular grid.

using Distance = std::function<double(const Eigen::Vector3d&)>;
using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double kStep = 1e-4;  // step of the finite differences [m]

/// Signed distances at the nodes of a regular grid.
class Grid {
 public:
  Grid(const Distance& distance, const Vector3d& lower, const Vector3d& upper, double cell, const std::stop_token& stop)
      : lower_(lower), cell_(cell), nodes_(((upper - lower) / cell).array().ceil().cast<int>() + 1) {
    value_.resize(nodes_.cast<std::size_t>().prod());
    for (int z = 0; z < nodes_.z(); ++z)
      for (int y = 0; y < nodes_.y() && !stop.stop_requested(); ++y)
        for (int x = 0; x < nodes_.x(); ++x) value_[index({x, y, z})] = distance(position({x, y, z}));
  }
  std::size_t index(const Vector3i& n) const {
    return (static_cast<std::size_t>(n.z()) * nodes_.y() + n.y()) * nodes_.x() + n.x();
  }
  Vector3d position(const Vector3i& n) const { return lower_ + cell_ * n.cast<double>(); }
  double value(const Vector3i& n) const { return value_[index(n)]; }
  const Vector3i& nodes() const { return nodes_; }
  std::size_t size() const { return value_.size(); }

  // Computes the mean of the points where the surface crosses the edges of the cell at `n`. Returns false if the
  // surface does not cross the cell.
  bool cell_vertex(const Vector3i& n, Vector3d& vertex) const {
    // Find the sign changes along the twelve edges.
    Vector3d sum = Vector3d::Zero();
    int crossings = 0;
    for (int corner = 0; corner < 8; ++corner) {
      // Visit every edge of the cell once, from its lower corner.
      const Vector3i a = n + Vector3i(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
      for (int axis = 0; axis < 3; ++axis) {
        if (corner & (1 << axis)) continue;
        const Vector3i b = a + Vector3i::Unit(axis);
        const double va = value(a), vb = value(b);

        // Where the sign changes, find the crossing by linear interpolation.
        if ((va < 0) == (vb < 0)) continue;
        sum += position(a) + va / (va - vb) * (position(b) - position(a));
        ++crossings;
      }
    }
    if (crossings > 0) vertex = sum / crossings;
    return crossings > 0;
  }

 private:
  Vector3d lower_;
  double cell_;
  Vector3i nodes_;
  std::vector<double> value_;
};

// Adds a quadrilateral as two triangles, with reversed orientation if `flip`.
void add_quad(TriangleMesh& mesh, const std::array<int, 4>& quad, bool flip) {
  const auto [a, b, c, d] = quad;
  if (flip) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a, d, c});
  } else {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
}

}  // namespace

Vector3d surface_normal(const Distance& distance, const Vector3d& p) {
  Vector3d g;
  for (int i = 0; i < 3; ++i) g[i] = distance(p + kStep * Vector3d::Unit(i)) - distance(p - kStep * Vector3d::Unit(i));
  const double norm = g.norm();
  return norm > 1e-12 ? Vector3d(g / norm) : Vector3d::UnitY();
}

TriangleMesh extract_surface(const Distance& distance, const Vector3d& lower, const Vector3d& upper, double cell,
                             const std::stop_token& stop) {
  const Grid grid(distance, lower, upper, cell, stop);
  const Vector3i cells = grid.nodes().array() - 1;
  TriangleMesh mesh;

  // Every cell that the surface crosses gets one vertex.
  std::vector<int> vertex_of(grid.size(), -1);
  const auto for_each_cell = [&](auto&& visit) {
    for (int z = 0; z < cells.z(); ++z)
      for (int y = 0; y < cells.y() && !stop.stop_requested(); ++y)
        for (int x = 0; x < cells.x(); ++x) visit(Vector3i(x, y, z));
  };

  // Move each vertex onto the surface in a few steps.
  for_each_cell([&](const Vector3i& n) {
    Vector3d vertex;
    if (!grid.cell_vertex(n, vertex)) return;
    vertex_of[grid.index(n)] = static_cast<int>(mesh.vertices.size());
    for (int i = 0; i < 3; ++i) vertex -= distance(vertex) * surface_normal(distance, vertex);
    mesh.vertices.push_back(vertex);
  });

  // Every grid edge that crosses the surface joins the vertices of the four cells around it.
  for_each_cell([&](const Vector3i& n) {
    for (int axis = 0; axis < 3; ++axis) {
      // Skip an edge at the lower border, which does not have four cells around it.
      const Vector3i u = Vector3i::Unit((axis + 1) % 3), v = Vector3i::Unit((axis + 2) % 3);
      if (n[(axis + 1) % 3] == 0 || n[(axis + 2) % 3] == 0) continue;

      // The orientation depends on which end of the edge is inside.
      const bool inside = grid.value(n) < 0;
      if (inside == (grid.value(n + Vector3i::Unit(axis)) < 0)) continue;
      const std::array<int, 4> quad = {vertex_of[grid.index(n - u - v)], vertex_of[grid.index(n - v)],
                                       vertex_of[grid.index(n)], vertex_of[grid.index(n - u)]};
      add_quad(mesh, quad, !inside);
    }
  });
  return mesh;
}

}  // namespace barehand
