#include "drivers/synthetic/rendering/sleeve.h"

#include "drivers/synthetic/rendering/shapes.h"

namespace barehand::synthetic {

TriangleMesh make_sleeve(const SE3& T_camera_palm, const Eigen::Vector3d& elbow, double hand_scale, bool bare) {
  // The control points of a quadratic Bezier curve are the wrist, a point behind it and the elbow.
  const double s = hand_scale;
  const Eigen::Vector3d wrist = T_camera_palm * Eigen::Vector3d(0.002 * s, -0.0075 * s, bare ? 0.012 * s : 0.005 * s);
  const Eigen::Vector3d bend = wrist + 0.09 * T_camera_palm.R.col(2);

  // Sample the curve; the radius grows towards the elbow.
  constexpr int kRings = 16;
  std::vector<Eigen::Vector3d> path;
  std::vector<double> radii;
  for (int i = 0; i <= kRings; ++i) {
    const double t = static_cast<double>(i) / kRings;
    path.push_back((1 - t) * (1 - t) * wrist + 2 * t * (1 - t) * bend + t * t * elbow);
    radii.push_back(s * (bare ? 0.0255 + 0.016 * t : 0.0315 + 0.0135 * t));
  }

  // Build the tube around the curve.
  return make_tube(path, radii);
}

}  // namespace barehand::synthetic
