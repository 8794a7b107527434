#pragma once

#include <vector>

#include "hand/hand_pose.h"

namespace barehand {

/// Collects the poses that repeated searches found in one frame and decides when to stop searching. If little of a
/// hand is visible, very different poses may explain it fairly well, and only repetition finds the best of them.
class RestartConsensus {
 public:
  /// `enough` and `worst` are global scores [m]: a pose with a score below `enough` ends the search at once; if the
  /// best score is above `worst`, there is no hand. `profile` must outlive the object.
  RestartConsensus(const HandProfile& profile, double enough, double worst)
      : profile_(profile), enough_(enough), worst_(worst) {}

  /// Adds a pose with its global score [m]; returns whether it is the best one so far.
  bool add(const HandPose& pose, double score);
  /// Whether further searches would not help, which is so if
  /// - the score of the best pose is below `enough`, or
  /// - the best pose was found several times, or
  /// - many poses were found, and nearly all resemble the best one or none explains the data.
  bool converged() const;

 private:
  /// The number of poses within `distance` [m] of the best one, including itself.
  int like_best(double distance) const;

  const HandProfile& profile_;
  double enough_, worst_;
  std::vector<HandPose> poses_;
  std::size_t best_ = 0;
  double best_score_ = 0;
};

}  // namespace barehand
