// Meshes of simple solids, such as balls, boxes and tubes.
#include "drivers/synthetic/rendering/shapes.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "drivers/synthetic/hand/skinning.h"

namespace barehand::synthetic {
namespace {

using Eigen::Vector3d;
constexpr double kTurn = 2 * std::numbers::pi;

/// Transports a frame along a path without twisting it. The columns are the normal and the binormal at each point.
std::vector<Eigen::Matrix<double, 3, 2>> carried_frames(std::span<const Vector3d> path) {
  std::vector<Eigen::Matrix<double, 3, 2>> frames(path.size());
  Vector3d normal = (path[1] - path[0]).unitOrthogonal();
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector3d ahead = (path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0]).normalized();
    normal = (normal - normal.dot(ahead) * ahead).normalized();
    frames[i].col(0) = normal;
    frames[i].col(1) = ahead.cross(normal);
  }
  return frames;
}

}  // namespace

TriangleMesh make_patch(int columns, int rows, const std::function<Vector3d(double, double)>& point, bool closed_u,
                        bool closed_v) {
  TriangleMesh mesh;

  // Compute the vertices; a closed direction has one row less.
  const int nu = closed_u ? columns : columns + 1, nv = closed_v ? rows : rows + 1;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      mesh.vertices.push_back(point(static_cast<double>(i) / columns, static_cast<double>(j) / rows).cast<float>());

  // Make two triangles per quadrilateral.
  const auto index = [&](int i, int j) { return static_cast<std::uint32_t>((j % nv) * nu + i % nu); };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  vertex_normals(mesh.vertices, mesh.triangles, mesh.normals);
  return mesh;
}

TriangleMesh make_plate(const Vector3d& origin, const Vector3d& side_a, const Vector3d& side_b) {
  return make_patch(1, 1, [&](double u, double v) { return Vector3d(origin + u * side_a + v * side_b); });
}

TriangleMesh make_box(const Vector3d& half_sides) {
  TriangleMesh box;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      Vector3d origin = -half_sides, side_a = Vector3d::Zero(), side_b = Vector3d::Zero();
      origin[axis] *= -sign;
      side_a[a] = 2 * half_sides[a];
      side_b[b] = 2 * half_sides[b];
      if (sign < 0) std::swap(side_a, side_b);
      box.append(make_plate(origin, side_a, side_b));
    }
  return box;
}

TriangleMesh make_sphere(double radius) {
  TriangleMesh ball = make_patch(
      96, 48,
      [&](double u, double v) {
        const double a = kTurn * u, b = kTurn / 2 * (v - 0.5);
        return Vector3d(radius * std::cos(b) * std::cos(a), radius * std::cos(b) * std::sin(a), radius * std::sin(b));
      },
      true);
  for (std::size_t i = 0; i < ball.vertices.size(); ++i) ball.normals[i] = ball.vertices[i].normalized();
  return ball;
}

TriangleMesh make_turned(std::span<const Eigen::Vector2d> outline) {
  TriangleMesh mesh;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    mesh.append(make_patch(
        64, 1,
        [&](double u, double v) {
          const Eigen::Vector2d p = (1 - v) * outline[i] + v * outline[i + 1];
          return Vector3d(p.x() * std::cos(kTurn * u), p.x() * std::sin(kTurn * u), p.y());
        },
        true));
  }
  return mesh;
}

TriangleMesh make_tube(std::span<const Vector3d> path, std::span<const double> radii) {
  const auto frames = carried_frames(path);
  const int rows = static_cast<int>(path.size()) - 1;
  return make_patch(
      24, rows,
      [&](double u, double v) {
        const auto i = static_cast<std::size_t>(std::lround(v * rows));
        const Eigen::Vector2d around(std::cos(kTurn * u), std::sin(kTurn * u));
        return Vector3d(path[i] + radii[i] * (frames[i] * around));
      },
      true);
}

TriangleMesh make_mug(const MugSize& size) {
  // Make the body.
  const double r = size.radius, h = size.height / 2, w = size.wall;
  const Eigen::Vector2d outline[] = {{1e-6, -h}, {r, -h}, {r, h}, {r - w, h}, {r - w, -h + w}, {1e-6, -h + w}};
  TriangleMesh mug = make_turned(outline);

  // Make the handle.
  std::vector<Vector3d> path;
  for (int i = 0; i <= 24; ++i) {
    const double a = std::numbers::pi * (i / 24.0 - 0.5);
    path.emplace_back(r - 0.002 + 0.028 * std::cos(a), 0, 0.032 * std::sin(a));
  }
  mug.append(make_tube(path, std::vector<double>(path.size(), 0.0055)));
  return mug;
}

TriangleMesh make_pliers(const PliersSize& size) {
  TriangleMesh pliers;
  const double pivot = -0.3 * size.length, front = -0.55 * size.length, back = 0.45 * size.length;
  for (const double side : {-1.0, 1.0}) {
    // Make one handle, from the pivot to its end.
    std::vector<Vector3d> path;
    std::vector<double> radii;
    for (int i = 0; i <= 20; ++i) {
      const double t = i / 20.0, opening = size.spread * std::sin(t * 2.0) / std::sin(2.0);
      path.emplace_back(pivot + t * (back - pivot), side * opening * 0.75, 0);
      radii.push_back(size.handle_radius * std::sqrt(std::max(0.02, std::min(1.0, 14 * (1 - t)))));
    }
    pliers.append(make_tube(path, radii));

    // Make one jaw, which becomes thinner towards the front.
    TriangleMesh jaw = make_box({(pivot - front) / 2, 0.004, 0.006});
    for (auto& v : jaw.vertices) {
      const float t = v.x() / static_cast<float>(pivot - front) + 0.5f;
      v = {v.x() + static_cast<float>(0.5 * (pivot + front)), static_cast<float>(side) * 0.0045f + v.y() * t, v.z()};
    }
    pliers.append(jaw);
  }

  // Make the rivet.
  const Eigen::Vector2d disc[] = {{1e-6, -0.008}, {0.012, -0.008}, {0.012, 0.008}, {1e-6, 0.008}};
  TriangleMesh rivet = make_turned(disc);
  for (auto& v : rivet.vertices) v.x() += static_cast<float>(pivot);
  pliers.append(rivet);
  return pliers;
}

}  // namespace barehand::synthetic
