#include "stages/preprocess/predicted_hand.h"

#include <algorithm>
#include <cmath>

namespace barehand {
namespace {

// Approximates an earlier estimate of a hand by capsules.

constexpr int kPalmRays = 4;           // capsules of the palm, from the wrist to each knuckle but the thumb's
constexpr float kPalmRadius = 0.013f;  // half the thickness of a palm [m]; neighbouring capsules leave no gaps

}  // namespace

std::optional<PredictedHand> PredictedHand::from(const HandEstimate* earlier) {
  if (!earlier || !earlier->has_pose() || !earlier->profile) return std::nullopt;
  for (const SegmentState& s : earlier->segments)
    if (!s.T_camera_segment.all_finite()) return std::nullopt;

  // Cover the palm by capsules from the wrist to the knuckles.
  PredictedHand hand;
  const SE3& palm = earlier->segments[kPalm].T_camera_segment;
  hand.wrist_ = palm.t.cast<float>();
  hand.arm_axis_ = palm.R.col(2).cast<float>();
  for (int ray = 0; ray < kPalmRays; ++ray)
    hand.capsules_[ray] = {hand.wrist_, earlier->segments[segment_of(ray + 1, 0)].T_camera_segment.t.cast<float>(),
                           kPalmRadius};

  // Cover each segment of the fingers by one capsule.
  for (int s = 1; s < kSegmentCount; ++s) {
    const SegmentProfile& profile = earlier->profile->segments[s];
    const SE3& T = earlier->segments[s].T_camera_segment;
    hand.capsules_[kPalmRays + s - 1] = {T.t.cast<float>(), (T * profile.distal).cast<float>(),
                                         static_cast<float>(0.5 * (profile.radius[0] + profile.radius[1]))};
  }
  hand.arrange();
  return hand;
}

void PredictedHand::arrange() {
  for (int k = 0; k < kLanes; ++k) {
    const Capsule& c = capsules_[std::min(k, kCapsules - 1)];
    const Eigen::Vector3f d = c.b - c.a;
    arrays_.ax[k] = c.a.x(), arrays_.ay[k] = c.a.y(), arrays_.az[k] = c.a.z();
    arrays_.dx[k] = d.x(), arrays_.dy[k] = d.y(), arrays_.dz[k] = d.z();
    arrays_.inverse_length_sq[k] = 1.f / std::max(d.squaredNorm(), 1e-8f);
    arrays_.radius[k] = c.radius;
  }
}

float PredictedHand::distance(const Eigen::Vector3f& p) const {
  const float px = p.x(), py = p.y(), pz = p.z();
  std::array<float, kLanes> d;

  // Compute the distance from all capsules at once.
  for (int k = 0; k < kLanes; ++k) {
    const float x = px - arrays_.ax[k], y = py - arrays_.ay[k], z = pz - arrays_.az[k];
    float t = (x * arrays_.dx[k] + y * arrays_.dy[k] + z * arrays_.dz[k]) * arrays_.inverse_length_sq[k];
    t = t < 0.f ? 0.f : t;
    t = t > 1.f ? 1.f : t;
    const float ex = x - t * arrays_.dx[k], ey = y - t * arrays_.dy[k], ez = z - t * arrays_.dz[k];
    d[k] = std::sqrt(ex * ex + ey * ey + ez * ez) - arrays_.radius[k];
  }

  // Find the smallest distance: halve the array until three values are left.
  for (int half = kLanes / 2; half >= 3; half /= 2)
    for (int k = 0; k < half; ++k) d[k] = d[k] < d[k + half] ? d[k] : d[k + half];
  return std::min({d[0], d[1], d[2]});
}

void PredictedHand::translate(const Eigen::Vector3f& by) {
  for (Capsule& c : capsules_) {
    c.a += by;
    c.b += by;
  }
  wrist_ += by;
  arrange();
}

}  // namespace barehand
