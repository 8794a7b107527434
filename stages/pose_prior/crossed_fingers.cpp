#include "stages/pose_prior/crossed_fingers.h"

#include <algorithm>
#include <cmath>

#include "hand/articulated_pose.h"

namespace barehand {
namespace {

constexpr double kCrossed = 0.005;  // both joints of the last phalanx beyond the neighbour's by this [m]

Eigen::Vector3d end_in_palm(const HandProfile& profile, const HandPose& pose, int finger, int k) {
  return pose[kPalm].inverse() * distal_end(profile, pose, segment_of(finger, k));
}

/// Whether `finger` lies across the next one towards the little finger.
bool crosses_next(const HandProfile& profile, const HandPose& pose, int finger) {
  const double towards_little = side_sign(profile.handedness);
  return std::ranges::all_of(std::array{1, 2}, [&](int k) {
    const double x = end_in_palm(profile, pose, finger, k).x(), next = end_in_palm(profile, pose, finger + 1, k).x();
    return towards_little * (x - next) > kCrossed;
  });
}

/// Abduction that turns a finger to a point of the palm frame [rad]; little for a point that only a bent finger
/// reaches.
double abduction_towards(const HandProfile& profile, int finger, const Eigen::Vector3d& p_palm) {
  const int root = segment_of(finger, 0);
  const Eigen::Vector3d p = profile.rest_relative(root).inverse() * p_palm;
  return std::atan2(-p.x(), std::max(-p.z(), profile.segments[root].length));
}

}  // namespace

std::optional<HandPose> uncrossed(const HandProfile& profile, const HandPose& pose, double widening) {
  std::optional<ArticulatedPose> changed;
  const auto limits = widened_limits(profile, widening);
  for (int finger = 1; finger + 1 < kFingerCount; ++finger) {
    if (!crosses_next(profile, pose, finger)) continue;
    if (!changed) changed = articulated_from(profile, pose, limits);
    auto& angles = changed->angles;
    for (int k = 0; k < 3; ++k) std::swap(angles[segment_of(finger, k)], angles[segment_of(finger + 1, k)]);
    for (const auto& [f, other] : {std::pair(finger, finger + 1), std::pair(finger + 1, finger)})
      angles[segment_of(f, 0)].abduction = abduction_towards(profile, f, end_in_palm(profile, pose, other, 1));
    ++finger;  // the next one has changed places
  }
  if (!changed) return std::nullopt;
  clamp_angles(changed->angles, limits);
  return posed(profile, *changed);
}

}  // namespace barehand
