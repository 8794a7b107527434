#pragma once

#include <vector>

#include "hand/hand_pose.h"

namespace barehand {

inline constexpr double kAlike = 0.040;  ///< poses closer than this differ in their fingers only [m]

/// Poses that several searches of one frame found, and whether more searches may find a better one. A hand of which
/// little is seen may be explained fairly well by several poses far apart; only chance finds the right one among them.
class FoundPoses {
 public:
  /// Global scores [m]: a pose below `enough` needs no other; where the best one is above `worst`, there is no hand.
  FoundPoses(const HandProfile& profile, double enough, double worst)
      : profile_(profile), enough_(enough), worst_(worst) {}

  /// Whether it is the best so far. `score`: global [m].
  bool add(const HandPose& pose, double score);
  /// The best pose is good enough, or was found again often enough, or of many poses nearly all are like it or none
  /// explains anything.
  bool settled() const;

 private:
  /// How many poses lie within `distance` [m] of the best one, itself included.
  int like_best(double distance) const;

  const HandProfile& profile_;
  double enough_, worst_;
  std::vector<HandPose> poses_;
  std::size_t best_ = 0;
  double best_score_ = 0;
};

}  // namespace barehand
