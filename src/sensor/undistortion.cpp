// Removes the lens distortion of depth and colour images.
#include "sensor/undistortion.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

constexpr double kStep = 1e-4;  // relative step along the radius, for the sign of the slope

}  // namespace

// Brown-Conrady with the denominator of OpenCV's rational model (calib3d, "Detailed Description").
Eigen::Vector2d Distortion::distorted(double x, double y) const {
  const double r2 = x * x + y * y;
  const double radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)));
  return {x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x), y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y};
}

Undistortion::Undistortion(const Intrinsics& camera, const Distortion& distortion)
    : from_(static_cast<std::size_t>(camera.width) * camera.height, -1) {
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
      const Eigen::Vector2d there = distortion.distorted(x, y);

      // Beyond the radius at which the distorted radius starts to decrease, the polynomial does not describe a lens.
      const double out = 1 + kStep;
      if (distortion.distorted(out * x, out * y).squaredNorm() < there.squaredNorm()) continue;

      const double du = camera.fx * there.x() + camera.cx, dv = camera.fy * there.y() + camera.cy;
      if (!(du > -0.5 && du < camera.width - 0.5 && dv > -0.5 && dv < camera.height - 0.5)) continue;
      largest_shift_ = std::max(largest_shift_, std::hypot(du - u, dv - v));
      from_[static_cast<std::size_t>(v) * camera.width + u] =
          static_cast<std::int32_t>(std::lround(dv) * camera.width + std::lround(du));
    }
  }
}

double Undistortion::shown() const {
  const auto none = std::ranges::count(from_, -1);
  return 1 - static_cast<double>(none) / static_cast<double>(from_.size());
}

}  // namespace barehand
