#pragma once

#include <array>
#include <vector>

#include "hand/hand_pose.h"
#include "math/closest_points.h"

namespace barehand {

/// The nearest points of two capsules. Camera frame [m].
struct CapsuleDistance {
  double distance = 0;         ///< between the skins, negative if they overlap
  Eigen::Vector3d on_a, on_b;  ///< nearest points on the two skins
  Eigen::Vector3d normal;      ///< normal of b's skin at this place, towards a
};

/// The hand as tapered capsules with elliptic sections: one in each phalanx, and in the palm one towards each finger.
class HandCapsules {
 public:
  struct Capsule {
    int segment = 0;
    LineSegment axis;                                      ///< in the segment frame [m]
    std::array<double, 2> half_width{}, half_thickness{};  ///< along x and y of the segment frame, at both ends [m]
  };

  explicit HandCapsules(const HandProfile& profile);
  const std::vector<Capsule>& capsules() const { return capsules_; }
  /// Pairs of indices into capsules() of different segments that touch only if the hand is bent: not those of one
  /// finger, nor those that skin joins at the knuckles.
  const std::vector<std::array<int, 2>>& apart() const { return apart_; }

  static CapsuleDistance distance(const Capsule& a, const HandPose& pose_a, const Capsule& b, const HandPose& pose_b);

 private:
  std::vector<Capsule> capsules_;
  std::vector<std::array<int, 2>> apart_;
};

}  // namespace barehand
