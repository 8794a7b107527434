#include "stages/preprocess/predicted_hand.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

constexpr int kPalmRays = 4;
constexpr float kPalmRadius = 0.013f;  // half the thickness of a palm; neighbouring rays close the gaps

float distance_sq(const Capsule& c, const Eigen::Vector3f& p) {
  const Eigen::Vector3f axis = c.b - c.a;
  const float length_sq = axis.squaredNorm();
  const float t = length_sq > 0 ? std::clamp((p - c.a).dot(axis) / length_sq, 0.f, 1.f) : 0.f;
  return (p - c.a - t * axis).squaredNorm();
}

}  // namespace

std::optional<PredictedHand> PredictedHand::from(const HandEstimate* hint) {
  if (!hint || !hint->has_pose() || !hint->profile) return std::nullopt;
  for (const SegmentState& s : hint->segments)
    if (!s.T_camera_segment.all_finite()) return std::nullopt;
  PredictedHand hand;
  const SE3& palm = hint->segments[kPalm].T_camera_segment;
  hand.wrist_ = palm.t.cast<float>();
  hand.arm_axis_ = palm.R.col(2).cast<float>();
  for (int ray = 0; ray < kPalmRays; ++ray)
    hand.capsules_[ray] = {hand.wrist_, hint->segments[segment_of(ray + 1, 0)].T_camera_segment.t.cast<float>(),
                           kPalmRadius};
  for (int s = 1; s < kSegmentCount; ++s) {
    const SegmentProfile& profile = hint->profile->segments[s];
    const SE3& T = hint->segments[s].T_camera_segment;
    hand.capsules_[kPalmRays + s - 1] = {T.t.cast<float>(), (T * profile.distal).cast<float>(),
                                         static_cast<float>(0.5 * (profile.radius[0] + profile.radius[1]))};
  }
  return hand;
}

float PredictedHand::distance(const Eigen::Vector3f& p) const {
  float best = INFINITY;
  for (const Capsule& c : capsules_) best = std::min(best, std::sqrt(distance_sq(c, p)) - c.radius);
  return best;
}

void PredictedHand::translate(const Eigen::Vector3f& by) {
  for (Capsule& c : capsules_) {
    c.a += by;
    c.b += by;
  }
  wrist_ += by;
}

}  // namespace barehand
