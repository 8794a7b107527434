// Corrects poses in which two fingers cross, by exchanging them.
#include "stages/pose_prior/crossed_fingers.h"

#include <algorithm>
#include <cmath>

#include "hand/articulated_pose.h"

namespace barehand {
namespace {

// Fingers cross if both ends of the last phalanx lie beyond those of the neighbour's by at least this [m].
constexpr double kCrossed = 0.005;

/// Distal end of phalanx `k` (0 to 2) of a finger in the palm frame [m].
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

/// Abduction that turns a finger to a point of the palm frame [rad]. The point counts as at least one phalanx away
/// along the finger, so that a point that only a bent finger reaches gives a small angle.
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

    // Exchange the joint angles of the pair, and turn each finger to where the other one was.
    if (!changed) changed = articulated_from(profile, pose, limits);
    auto& angles = changed->angles;
    for (int k = 0; k < 3; ++k) std::swap(angles[segment_of(finger, k)], angles[segment_of(finger + 1, k)]);
    for (const auto& [f, other] : {std::pair(finger, finger + 1), std::pair(finger + 1, finger)})
      angles[segment_of(f, 0)].abduction = abduction_towards(profile, f, end_in_palm(profile, pose, other, 1));
    ++finger;  // skip the next finger, which has just been exchanged
  }

  // Pose the hand with these angles.
  if (!changed) return std::nullopt;
  clamp_angles(changed->angles, limits);
  return posed(profile, *changed);
}

}  // namespace barehand
