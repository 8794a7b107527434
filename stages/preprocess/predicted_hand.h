#pragma once

#include <array>
#include <optional>

#include "hand/hand_pose.h"
#include "stages/preprocess/coarse_grid.h"

namespace barehand {

/// All points within `radius` of the line segment from `a` to `b`: bone and flesh of one segment, or of the part of the
/// palm that leads to one finger. Camera frame [m].
struct Capsule {
  Eigen::Vector3f a, b;
  float radius = 0;
};

/// The tracker's estimate from an earlier frame as a rough shape that can be moved to fit the new frame. Preprocessing
/// needs to know where the hand may be and where it ends at the wrist, not its exact skin.
class PredictedHand {
 public:
  static constexpr int kCapsules = 19;

  /// Makes the shape from an estimate; none if it has no pose or no profile.
  static std::optional<PredictedHand> from(const HandEstimate* earlier);

  /// Distance [m] from a point to the skin; negative inside.
  float distance(const Eigen::Vector3f& p) const;
  /// How far [m] a point lies behind the wrist joint along the forearm; negative on the hand's side.
  float behind_wrist(const Eigen::Vector3f& p) const { return (p - wrist_).dot(arm_axis_); }
  Eigen::Vector3f centre() const { return 0.5f * (capsules_[1].a + capsules_[1].b); }
  const std::array<Capsule, kCapsules>& capsules() const { return capsules_; }
  const Eigen::Vector3f& wrist() const { return wrist_; }
  const Eigen::Vector3f& arm_axis() const { return arm_axis_; }
  void translate(const Eigen::Vector3f& by);

 private:
  void arrange();

  std::array<Capsule, kCapsules> capsules_;  // 4 capsules of the palm, then 15 of the phalanges
  static constexpr int kLanes = 24;          // number of capsules for SIMD, the last one repeated to fill the vectors
  struct CapsuleArrays {
    std::array<float, kLanes> ax, ay, az, dx, dy, dz, inverse_length_sq, radius;
  } arrays_{};
  Eigen::Vector3f wrist_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f arm_axis_ = Eigen::Vector3f::UnitZ();  // unit vector from the fingers towards the elbow, camera frame
};

}  // namespace barehand
