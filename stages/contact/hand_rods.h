#pragma once

#include <array>
#include <vector>

#include "hand/hand_pose.h"
#include "math/closest_points.h"

namespace barehand {

/// The nearest places of two rods. Camera frame [m].
struct RodDistance {
  double distance = 0;         ///< between the skins, negative if they overlap
  Eigen::Vector3d on_a, on_b;  ///< on the two skins
  Eigen::Vector3d normal;      ///< of the skin of b there, towards a
};

/// The hand as tapered rods with elliptic sections: one in each phalanx, and in the palm one towards each finger.
class HandRods {
 public:
  struct Rod {
    int segment = 0;
    LineSegment axis;                                      ///< in the segment frame [m]
    std::array<double, 2> half_width{}, half_thickness{};  ///< along x and y of the segment frame, at both ends [m]
  };

  explicit HandRods(const HandProfile& profile);
  const std::vector<Rod>& rods() const { return rods_; }
  /// Pairs of indices into rods() of different segments that touch only if the hand is bent: not those of one finger,
  /// nor those that skin joins at the knuckles.
  const std::vector<std::array<int, 2>>& apart() const { return apart_; }

  static RodDistance distance(const Rod& a, const HandPose& pose_a, const Rod& b, const HandPose& pose_b);

 private:
  std::vector<Rod> rods_;
  std::vector<std::array<int, 2>> apart_;
};

}  // namespace barehand
