#include "app/size_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/clearly_better.h"
#include "core/format.h"

namespace barehand {
namespace {

constexpr std::array<double, 4> kSizes = {0.78, 0.88, 1.14, 1.28};

/// Scales a pose about the middle of the palm, whose position the data determines best.
HandPose scaled(const HandProfile& hand, HandPose pose, double size) {
  const Eigen::Vector3d centre = pose[kPalm] * (0.5 * hand.segments[kPalm].distal);
  for (SE3& T : pose) T.t = centre + size * (T.t - centre);
  return pose;
}

}  // namespace

void SizeCheck::make_candidates() {
  for (const double size : kSizes)
    candidates_.push_back(
        {size, std::make_unique<Refinement>(params_, std::make_shared<const HandProfile>(scaled(*profile_, size)),
                                            std::make_shared<const Skin>(scaled(*skin_, size)))});
}

std::string other_size(double size, const HandProfile& profile) {
  return formatted(
      "the hand in view looks about %.0f %% %s than the profile's: give the profile of this hand, or --hand %s for the "
      "mean hand, which is fitted while tracking",
      100 * std::abs(size - 1), size > 1 ? "larger" : "smaller", std::string(to_string(profile.handedness)).c_str());
}

std::optional<double> SizeCheck::look(const HandObservation& observation, const HandPose& pose, double score) {
  // One copy per frame, in turn, since more would delay the frame.
  if (looks_ >= kLooks) return std::nullopt;
  if (candidates_.empty()) make_candidates();
  const std::size_t turn = frames_++ % kEvery;
  if (turn >= candidates_.size()) return std::nullopt;
  Candidate& candidate = candidates_[turn];  // one a frame, or this frame would come late
  const HandPose start = scaled(*profile_, pose, candidate.size);
  const double other = candidate.refinement->refine(observation, start, start, kIterations).score;

  candidate.better += clearly_better(other, score);
  candidate.sum += other;
  if (turn + 1 < candidates_.size() || ++looks_ < kLooks) return std::nullopt;

  // After the last look the size with the best mean score wins, if it was better in most frames.
  const auto best = std::ranges::min_element(candidates_, {}, &Candidate::sum);
  const std::optional<double> size = best->better >= kMost ? std::optional(best->size) : std::nullopt;
  candidates_.clear();
  return size;
}

}  // namespace barehand
