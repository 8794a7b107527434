// Computes the joints of OpenXR's hand tracking from a hand pose.
#include "stages/publish/openxr_joints.h"

#include <algorithm>

namespace barehand {
namespace {

constexpr int kThumbFinger = 0, kMiddle = 2;
/// Mean lengths of the metacarpals from the thumb (not used here) to the little finger [mm].
constexpr std::array<double, kFingerCount> kMetacarpal_mm = {46.2, 68.1, 64.6, 58.0, 53.7};
/// Length of the middle metacarpal as a fraction of the distance from the wrist joint to the middle knuckle; the carpal
/// bones are the rest.
constexpr double kMetacarpalPart = 0.63;

/// The knuckle of a finger in the palm's frame.
Eigen::Vector3d knuckle(const HandProfile& profile, int finger) {
  return profile.rest_relative(segment_of(finger, 0)).t;
}

/// Frame at the base of a finger's metacarpal, in the palm's frame.
SE3 metacarpal(const HandProfile& profile, int finger) {
  const double scale = kMetacarpalPart * knuckle(profile, kMiddle).norm() / kMetacarpal_mm[kMiddle];
  const Eigen::Vector3d direction = knuckle(profile, finger).normalized();
  const Eigen::Vector3d x = Eigen::Vector3d::UnitY().cross(-direction).normalized();  // +y stays dorsal
  SE3 T_palm_joint;
  T_palm_joint.t = knuckle(profile, finger) - scale * kMetacarpal_mm[finger] * direction;
  T_palm_joint.R << x, (-direction).cross(x), -direction;
  return T_palm_joint;
}

/// Half the palm's thickness [m] at a point on its -z axis, `distance` [m] from the wrist.
double palm_radius(const SegmentProfile& palm, double distance) {
  const double t = std::clamp(distance / palm.length, 0.0, 1.0);
  return (1 - t) * palm.half_thickness[0] + t * palm.half_thickness[1];
}

}  // namespace

std::array<OpenXrJoint, kOpenXrJointCount> openxr_joints(const HandProfile& profile, const HandPose& pose) {
  const SegmentProfile& palm = profile.segments[kPalm];
  const auto in_palm = [&](const SE3& T_palm_joint) {
    return OpenXrJoint{pose[kPalm] * T_palm_joint, palm_radius(palm, -T_palm_joint.t.z()), kPalm};
  };
  std::array<OpenXrJoint, kOpenXrJointCount> joints;
  auto next = joints.begin();

  // Compute the centre of the palm (the middle of the middle finger's metacarpal) and the wrist.
  SE3 centre = metacarpal(profile, kMiddle);
  centre.t = (centre.t + knuckle(profile, kMiddle)) / 2;
  *next++ = in_palm(centre);
  *next++ = in_palm(SE3());

  // Append the joints of the fingers, each from the metacarpal to the tip.
  for (int finger = 0; finger < kFingerCount; ++finger) {
    if (finger != kThumbFinger) *next++ = in_palm(metacarpal(profile, finger));
    for (int k = 0; k < 3; ++k) {
      const int s = segment_of(finger, k);
      *next++ = {pose[s], profile.segments[s].radius[0], s};
    }

    // Append the fingertip.
    const int last = segment_of(finger, 2);
    SE3 tip = pose[last];
    tip.t = pose[last] * profile.segments[last].distal;
    *next++ = {tip, profile.segments[last].radius[1], last};
  }
  return joints;
}

}  // namespace barehand
