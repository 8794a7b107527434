#include "app/found_poses.h"

#include <algorithm>

#include "stages/prediction/initialiser.h"

namespace barehand {
namespace {

constexpr double kSame = 0.005;  // poses closer than this are the same [m]
constexpr int kFoundAgain = 3;   // times the best pose was found: there is no better one
constexpr int kMany = 8;         // poses; where all but one are alike, the hand is hard to see, but it is there

}  // namespace

bool FoundPoses::add(const HandPose& pose, double score) {
  const bool best = poses_.empty() || score < best_score_;
  if (best) {
    best_ = poses_.size();
    best_score_ = score;
  }
  poses_.push_back(pose);
  return best;
}

int FoundPoses::like_best(double distance) const {
  const auto like = [&](const HandPose& pose) { return pose_distance(profile_, poses_[best_], pose) < distance; };
  return static_cast<int>(std::ranges::count_if(poses_, like));
}

bool FoundPoses::settled() const {
  if (poses_.empty()) return false;
  if (best_score_ < enough_ || like_best(kSame) >= kFoundAgain) return true;
  const int count = static_cast<int>(poses_.size());
  return count >= kMany && (best_score_ > worst_ || like_best(kAlike) >= count - 1);
}

}  // namespace barehand
