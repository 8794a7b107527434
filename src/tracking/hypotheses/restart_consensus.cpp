// Decides when the poses that repeated searches have found are enough.
#include "tracking/hypotheses/restart_consensus.h"

#include <algorithm>

#include "stages/search/initialiser.h"

namespace barehand {
namespace {

// pose_distance() [m] below which two poses count as the same, or differ only in their fingers.
constexpr double kSame = 0.005, kSamePalm = 0.040;
constexpr int kFoundAgain = 3;  // the search ends when the best pose was found this many times
// After this many poses, the search ends if none explains the data, or if all but one have the palm in the same place,
// which means that a hand is there but hard to see.
constexpr int kMany = 8;

}  // namespace

bool RestartConsensus::add(const HandPose& pose, double score) {
  const bool best = poses_.empty() || score < best_score_;
  if (best) {
    best_ = poses_.size();
    best_score_ = score;
  }
  poses_.push_back(pose);
  return best;
}

int RestartConsensus::like_best(double distance) const {
  const auto like = [&](const HandPose& pose) { return pose_distance(profile_, poses_[best_], pose) < distance; };
  return static_cast<int>(std::ranges::count_if(poses_, like));
}

bool RestartConsensus::converged() const {
  if (poses_.empty()) return false;

  // The best pose is good enough, or repetition has confirmed it.
  if (best_score_ < enough_ || like_best(kSame) >= kFoundAgain) return true;

  // Many poses were found, and either none explains the data or nearly all show the hand in the same place.
  const int count = static_cast<int>(poses_.size());
  return count >= kMany && (best_score_ > worst_ || like_best(kSamePalm) >= count - 1);
}

}  // namespace barehand
