#include "stages/known_object/observed_depth.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr double kSlant = 0.2;    // cosine of the angle at which a surface is still measured
constexpr double kAlike = 0.006;  // difference in depth of the same surface, besides noise [m]
constexpr float kLeave = 0.004f, kInside = 0.0005f;

/// Whether the object itself is between a place on its surface and the camera. Follows the ray in steps of the distance
/// to the surface.
bool hides_itself(const KnownObject& object, const Vector3f& place, const Vector3f& to_camera) {
  const Vector3f centre = object.centre.cast<float>();
  const auto radius = static_cast<float>(object.radius);
  for (float along = kLeave; along < 2 * radius;) {
    const Vector3f p = place + along * to_camera;
    if ((p - centre).squaredNorm() > radius * radius) return false;
    const float distance = object.grid.distance(p);
    if (distance < kInside) return true;
    along += std::max(distance, 0.001f);
  }
  return false;
}

}  // namespace

ObservedDepth::ObservedDepth(const HandObservations& observations)
    : observations_(observations), frame_(*observations.front()->frame) {
  for (const auto& observation : observations) noise_ = std::max(noise_, observation->noise);
}

bool ObservedDepth::of_hand(int u, int v) const {
  return std::any_of(observations_.begin(), observations_.end(), [&](const HandObservationPtr& seen) {
    const int x = u - seen->u0, y = v - seen->v0;
    return seen->label.contains(x, y) && seen->label.at(x, y) == PixelLabel::hand;
  });
}

void ObservedDepth::points_near(const KnownObject& object, const SE3& T_camera_object, double reach, std::size_t most,
                                std::vector<Vector3f>& points) const {
  // Find the part of the image that the object can be in.
  const Intrinsics& camera = frame_.camera;
  const Vector3d centre = T_camera_object * object.centre;
  if (centre.z() < object.radius + 0.05) return;
  const Eigen::Vector2d middle = camera.project(centre);
  const double radius = camera.fx * (object.radius + reach) / (centre.z() - object.radius);

  // Clip it to the image.
  const int u0 = std::max(0, static_cast<int>(middle.x() - radius));
  const int u1 = std::min(camera.width - 1, static_cast<int>(middle.x() + radius));
  const int v0 = std::max(0, static_cast<int>(middle.y() - radius));
  const int v1 = std::min(camera.height - 1, static_cast<int>(middle.y() + radius));

  // Collect the pixels in it that are near the surface, on a grid that is wide enough for the wanted number.
  const SE3 T_object_camera = T_camera_object.inverse();
  const double area = std::max(0.0, 1.0 + u1 - u0) * std::max(0.0, 1.0 + v1 - v0);
  const int step = std::max(1, static_cast<int>(std::sqrt(0.4 * area / static_cast<double>(most))));
  const std::size_t end = points.size() + most;

  // Leave out the pixels of a hand and those away from the surface.
  for (int v = v0; v <= v1; v += step)
    for (int u = u0; u <= u1 && points.size() < end; u += step) {
      const double z = frame_.depth.at(u, v) * frame_.depth_unit;
      if (std::abs(z - centre.z()) > object.radius + reach || of_hand(u, v)) continue;
      const Vector3d p = camera.unproject(u, v, z);
      if (object.grid.distance((T_object_camera * p).cast<float>()) > reach) continue;
      points.push_back(p.cast<float>());
    }
}

Visibility ObservedDepth::visibility(const KnownObject& object, const SE3& T_camera_object, std::size_t samples) const {
  Visibility visibility;
  const Eigen::Matrix3f R = T_camera_object.R.cast<float>();
  const Vector3f t = T_camera_object.t.cast<float>(), camera_in_object = -(R.transpose() * t);
  const double alike = kAlike + 2 * noise_;
  for (std::size_t i = 0; i < std::min(samples, object.samples.size()); ++i) {
    // Leave out what faces away, and what the object itself hides.
    const SurfaceSample& sample = object.samples[i];
    const Vector3f to_camera = (camera_in_object - sample.p).normalized();
    if (sample.n.dot(to_camera) < kSlant || hides_itself(object, sample.p, to_camera)) continue;

    // Compare its depth with the measured one.
    const Vector3d p = (R * sample.p + t).cast<double>();
    if (p.z() <= 0) continue;
    const Eigen::Vector2d pixel = frame_.camera.project(p);
    const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));

    // Measure the depth at this pixel, which may belong to a hand.
    const double z = frame_.depth.contains(u, v) ? frame_.depth.at(u, v) * frame_.depth_unit : 0;
    const bool hand = z > 0 && of_hand(u, v);

    // Count the sample by what lies in front of it or behind it.
    if (z <= 0)
      ++visibility.hidden;
    else if (z < p.z() - alike)
      ++(hand ? visibility.hidden : visibility.blocked);
    else if (z > p.z() + alike)
      ++visibility.through;
    else
      ++(hand ? visibility.hidden : visibility.seen);
  }
  return visibility;
}

}  // namespace barehand
