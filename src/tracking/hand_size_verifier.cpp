// Checks by scaled copies whether the profile has the size of the observed hand.
#include "tracking/hand_size_verifier.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/format.h"
#include "tracking/hypotheses/choice.h"

namespace barehand {
namespace {

// Sizes of the copies relative to the profile: four that other people's hands have, then two that only a wrong depth
// unit explains.
constexpr std::array<double, 6> kComparedSizes = {0.78, 0.88, 1.14, 1.28, 0.55, 1.8};
// Ratio by which the hands of two adults never differ; a larger one means a wrong depth unit or a wrong profile.
constexpr double kImpossibleRatio = 1.4;

/// Scales a pose about the middle of the palm, whose position the data determines best.
HandPose scaled(const HandProfile& hand, HandPose pose, double size) {
  const Eigen::Vector3d centre = pose[kPalm] * (0.5 * hand.segments[kPalm].distal);
  for (SE3& T : pose) T.t = centre + size * (T.t - centre);
  return pose;
}

}  // namespace

void HandSizeVerifier::make_candidates() {
  for (const double size : kComparedSizes)
    candidates_.push_back(
        {size, std::make_unique<Refinement>(params_, std::make_shared<const HandProfile>(scaled(*profile_, size)),
                                            std::make_shared<const Skin>(scaled(*skin_, size)))});
}

std::string other_size(double size, const HandProfile& profile) {
  if (size > kImpossibleRatio || size < 1 / kImpossibleRatio)
    return formatted(
        "the hand in the data is about %.1f times the profile's size: is depth_units_per_metre (depth_unit of a "
        "message) "
        "right, or the profile another person's?",
        size);
  return formatted(
      "the hand in view looks about %.0f %% %s than the profile's: give the profile of this hand, or --hand %s for the "
      "mean hand, which is fitted while tracking; if the profile is right, depth_units_per_metre is not",
      100 * std::abs(size - 1), size > 1 ? "larger" : "smaller", std::string(to_string(profile.handedness)).c_str());
}

std::optional<double> HandSizeVerifier::add_frame(const HandObservation& observation, const HandPose& pose,
                                                  double score) {
  // One copy per frame, in turn, since more would delay the frame.
  if (compared_ >= kFramesCompared) return std::nullopt;
  if (candidates_.empty()) make_candidates();
  const std::size_t turn = frames_++ % kCompareEvery;
  if (turn >= candidates_.size()) return std::nullopt;
  Candidate& candidate = candidates_[turn];
  const HandPose start = scaled(*profile_, pose, candidate.size);
  const double other = candidate.refinement->refine(observation, start, start, kIterations).score;

  // Count the copy's advantages. When every copy has been compared once more, decide.
  candidate.better += clearly_better(other, score);
  candidate.much_better += clearly_better(other, score, kFarBetter);
  candidate.sum += other;
  if (turn + 1 < candidates_.size()) return std::nullopt;
  ++compared_;
  return conclude();
}

std::optional<double> HandSizeVerifier::conclude() {
  const auto best = std::ranges::min_element(candidates_, {}, &Candidate::sum);
  const bool at_once = compared_ == kFramesIfObvious && best->much_better == kFramesIfObvious;
  if (compared_ < kFramesCompared && !at_once) return std::nullopt;
  const std::optional<double> size = at_once || best->better >= kVotesNeeded ? std::optional(best->size) : std::nullopt;
  compared_ = kFramesCompared;
  candidates_.clear();
  return size;
}

}  // namespace barehand
