#include "stages/detection/expected_hand.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

constexpr double kLongestPrediction = 0.2;  // longest time over which a palm's motion is extrapolated [s]

}  // namespace

std::optional<ExpectedHand> expected_hand(const HandEstimate* earlier, const RgbdFrame& frame) {
  if (!earlier || earlier->status != TrackStatus::tracking) return std::nullopt;
  const SegmentState& palm = earlier->segments[kPalm];
  const Eigen::Vector3d bone = earlier->profile ? earlier->profile->segments[kPalm].distal : Eigen::Vector3d::Zero();
  const double age = std::min(kLongestPrediction, std::abs(static_cast<double>(frame.utime - earlier->utime)) * 1e-6);
  // An unknown velocity (NaN) counts as zero.
  const Eigen::Vector3d velocity =
      palm.velocity.allFinite() ? Eigen::Vector3d(palm.velocity.head<3>()) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d centre = palm.T_camera_segment * (0.5 * bone) + age * velocity;
  if (!(centre.z() > 0)) return std::nullopt;
  return ExpectedHand{centre, earlier->handedness};
}

}  // namespace barehand
