// The capsules of a hand, the distance of two capsules, and which pairs of segments may count as touching.
#include "stages/contact/hand_capsules.h"

#include <algorithm>
#include <cmath>

#include "math/share_along.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

constexpr double kCarpus = 0.3;        // start of a capsule in the palm, as a fraction of the way from wrist to knuckle
constexpr double kPalmFraction = 0.9;  // half width of a capsule in the palm, as a fraction of its finger's

// Skin joins the segments of one finger, neighbouring fingers at their roots, and the roots with palm and thumb.
bool joined_by_skin(int a, int b) {
  if (a == kPalm || b == kPalm) {
    const int other = std::max(a, b);
    return other == segment_of(finger_of(other), 0) || other == segment_of(0, 1);
  }
  const bool roots = a == segment_of(finger_of(a), 0) && b == segment_of(finger_of(b), 0);
  return finger_of(a) == finger_of(b) || (roots && std::abs(finger_of(a) - finger_of(b)) == 1);
}

/// Distance from a capsule's axis to its skin in the direction `d` (unit vector in the segment frame), at a point of
/// the axis [m].
double radius_towards(const HandCapsules::Capsule& capsule, const Vector3d& at, const Vector3d& d) {
  const double t = share_along(capsule.axis[0], capsule.axis[1], at);
  const auto mix = [&](const std::array<double, 2>& ends) { return ends[0] + t * (ends[1] - ends[0]); };
  const double width = mix(capsule.half_width), thickness = mix(capsule.half_thickness),
               length = std::min(width, thickness);
  return 1 / (d.array() / Eigen::Array3d(width, thickness, length)).matrix().norm();
}

}  // namespace

HandCapsules::HandCapsules(const HandProfile& profile) {
  // Make a capsule for each phalanx, and for the thumb's metacarpal.
  for (int s = 1; s < kSegmentCount; ++s) {
    const SegmentProfile& phalanx = profile.segments[s];
    Capsule capsule{s, {Vector3d::Zero(), phalanx.distal}, phalanx.half_width, phalanx.half_thickness};
    for (int end = 0; end < 2; ++end)
      capsule.axis[end] += Vector3d(phalanx.flesh_offset_x[end], phalanx.flesh_offset_y[end], 0);
    capsules_.push_back(capsule);
  }

  // Make a capsule in the palm towards each finger but the thumb, as thick as the palm.
  const SegmentProfile& palm = profile.segments[kPalm];
  for (int finger = 1; finger < kFingerCount; ++finger) {
    const Vector3d knuckle = profile.rest_relative(segment_of(finger, 0)).t;
    const double width = kPalmFraction * profile.segments[segment_of(finger, 0)].half_width[0];
    Capsule capsule{kPalm, {kCarpus * knuckle, knuckle}, {width, width}, palm.half_thickness};
    for (int end = 0; end < 2; ++end) capsule.axis[end].y() += palm.flesh_offset_y[end];
    capsules_.push_back(capsule);
  }

  const int count = static_cast<int>(capsules_.size());
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b)
      if (capsules_[a].segment != capsules_[b].segment && !joined_by_skin(capsules_[a].segment, capsules_[b].segment))
        apart_.push_back({a, b});
}

CapsuleDistance HandCapsules::distance(const Capsule& a, const HandPose& pose_a, const Capsule& b,
                                       const HandPose& pose_b) {
  const SE3 &T_a = pose_a[a.segment], &T_b = pose_b[b.segment];
  const auto [p_a, p_b] = closest_points({T_a * a.axis[0], T_a * a.axis[1]}, {T_b * b.axis[0], T_b * b.axis[1]});
  const double between = (p_a - p_b).norm();
  const Vector3d normal = between > 1e-9 ? Vector3d((p_a - p_b) / between) : Vector3d(-Vector3d::UnitZ());
  const double r_a = radius_towards(a, T_a.inverse() * p_a, T_a.R.transpose() * normal),
               r_b = radius_towards(b, T_b.inverse() * p_b, T_b.R.transpose() * normal);
  return {between - r_a - r_b, p_a - r_a * normal, p_b + r_b * normal, normal};
}

}  // namespace barehand
