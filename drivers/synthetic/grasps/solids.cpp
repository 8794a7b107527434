#include "drivers/synthetic/grasps/solids.h"

#include <cmath>
#include <numbers>

#include "drivers/synthetic/rendering/shapes.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;

/// A fan of triangles around the mean of a ring of vertices; `outward`: its normal.
void close_ring(TriangleMesh& mesh, const std::vector<Eigen::Vector3f>& ring, const Vector3d& outward) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  const auto count = static_cast<std::uint32_t>(ring.size());
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  for (const auto& v : ring) centre += v / static_cast<float>(count);
  mesh.vertices.insert(mesh.vertices.end(), ring.begin(), ring.end());
  mesh.vertices.push_back(centre);
  mesh.normals.insert(mesh.normals.end(), count + 1, outward.cast<float>());

  // Turn every triangle so that it faces outward.
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    const bool forward = (ring[i] - centre).cross(ring[next] - centre).dot(outward.cast<float>()) > 0;
    mesh.triangles.push_back({first + count, first + (forward ? i : next), first + (forward ? next : i)});
  }
}

}  // namespace

TriangleMesh make_lathed(const std::vector<Eigen::Vector2d>& outline) {
  const int rows = static_cast<int>(outline.size()) - 1;
  return make_patch(
      64, rows,
      [&](double u, double v) {
        const Eigen::Vector2d& p = outline[static_cast<std::size_t>(std::lround(v * rows))];
        const double a = 2 * std::numbers::pi * u;
        return Vector3d(p.x() * std::cos(a), p.x() * std::sin(a), p.y());
      },
      true);
}

TriangleMesh make_closed_tube(const std::vector<Vector3d>& path, double radius) {
  TriangleMesh tube = make_tube(path, std::vector<double>(path.size(), radius));
  const std::size_t around = tube.vertices.size() / path.size();
  const std::vector<Eigen::Vector3f> front(tube.vertices.begin(), tube.vertices.begin() + static_cast<long>(around));
  const std::vector<Eigen::Vector3f> back(tube.vertices.end() - static_cast<long>(around), tube.vertices.end());
  close_ring(tube, front, (path[0] - path[1]).normalized());
  close_ring(tube, back, (path[path.size() - 1] - path[path.size() - 2]).normalized());
  return tube;
}

}  // namespace barehand::synthetic
