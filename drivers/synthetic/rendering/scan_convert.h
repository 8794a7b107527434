#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/synthetic/rendering/rasteriser.h"

namespace barehand::synthetic {

/// A vertex in the image: its pixel coordinates, and its 1 / z [1/m].
struct ScreenPoint {
  double u, v, inverse_z;
};

/// Clips a triangle (camera frame) at the near plane, and passes the rest to `emit(a, b, c)` as triangles in the image.
template <typename Emit>
void project_clipped(const Intrinsics& camera, const std::array<Eigen::Vector3d, 3>& corners, Emit&& emit) {
  std::array<ScreenPoint, 4> polygon;
  int n = 0;
  const auto add = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector2d pixel = camera.project(p);
    polygon[n++] = {pixel.x(), pixel.y(), 1 / p.z()};
  };

  // Clip edge by edge.
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = corners[i], &b = corners[(i + 1) % 3];
    const bool a_in = a.z() >= Rasteriser::kNearPlane, b_in = b.z() >= Rasteriser::kNearPlane;
    if (a_in) add(a);
    if (a_in != b_in) add(a + (Rasteriser::kNearPlane - a.z()) / (b.z() - a.z()) * (b - a));
  }

  // The rest has three or four corners.
  for (int i = 2; i < n; ++i) emit(polygon[0], polygon[i - 1], polygon[i]);
}

/// The u at which the edge p q crosses row v. The result is the same for both directions of an edge, so that
/// neighbouring triangles fit exactly.
inline double edge_at(const ScreenPoint& p, const ScreenPoint& q, double v) {
  const bool swap = q.v < p.v || (q.v == p.v && q.u < p.u);
  const ScreenPoint &top = swap ? q : p, &bottom = swap ? p : q;
  return top.u + (v - top.v) / (bottom.v - top.v) * (bottom.u - top.u);
}

/// Calls `span(v, u_begin, u_end, inverse_z at u_begin, step of inverse_z)` for every row of pixels inside both the
/// triangle and the image of width x height.
template <typename Span>
void scan_triangle(int width, int height, ScreenPoint a, ScreenPoint b, ScreenPoint c, Span&& span) {
  // Sort the corners by row.
  if (b.v < a.v) std::swap(a, b);
  if (c.v < a.v) std::swap(a, c);
  if (c.v < b.v) std::swap(b, c);
  const double area = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
  if (area == 0) return;

  // Compute the gradient of 1 / z.
  const double du = ((b.inverse_z - a.inverse_z) * (c.v - a.v) - (c.inverse_z - a.inverse_z) * (b.v - a.v)) / area;
  const double dv = ((c.inverse_z - a.inverse_z) * (b.u - a.u) - (b.inverse_z - a.inverse_z) * (c.u - a.u)) / area;

  // Fill row by row.
  const int first = static_cast<int>(std::ceil(std::max(a.v, 0.0)));
  const int last = static_cast<int>(std::ceil(std::min(c.v, static_cast<double>(height)))) - 1;
  for (int v = first; v <= last; ++v) {
    // Find the pixels of this row between the two edges, and fill them.
    double left = edge_at(a, c, v), right = v < b.v ? edge_at(a, b, v) : edge_at(b, c, v);
    if (left > right) std::swap(left, right);
    const int begin = static_cast<int>(std::ceil(std::max(left, 0.0)));
    const int end = static_cast<int>(std::ceil(std::min(right, static_cast<double>(width))));
    if (begin < end) span(v, begin, end, a.inverse_z + (begin - a.u) * du + (v - a.v) * dv, du);
  }
}

}  // namespace barehand::synthetic
