#include "tracking/hypotheses/restart_consensus.h"

#include <algorithm>

#include "stages/search/initialiser.h"

namespace barehand {
namespace {

constexpr double kSame = 0.005;  // poses closer than this [m] count as the same
constexpr int kFoundAgain = 3;   // number of times that the best pose must be found to be final
constexpr int kMany = 8;         // poses; if all but one are alike, the hand is there but hard to see

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

bool RestartConsensus::settled() const {
  if (poses_.empty()) return false;

  // The best pose is good enough, or repetition has confirmed it.
  if (best_score_ < enough_ || like_best(kSame) >= kFoundAgain) return true;

  // Many poses were tried without a hand, or all of them show the hand at the same place.
  const int count = static_cast<int>(poses_.size());
  return count >= kMany && (best_score_ > worst_ || like_best(kAlike) >= count - 1);
}

}  // namespace barehand
