#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stages/refinement/refinement.h"

namespace barehand {

/// Whether a profile whose bones are used as they are has the size of the hand that is tracked with it: on a few
/// frames, would a smaller or a larger copy of the hand explain the data better?
class SizeCheck {
 public:
  /// `skin`: made for the profile. The copies are made at the first look: most trackers only search.
  SizeCheck(const RefinementParams& params, std::shared_ptr<const HandProfile> profile,
            std::shared_ptr<const Skin> skin)
      : params_(params), profile_(std::move(profile)), skin_(std::move(skin)) {}

  /// Looks at a tracked frame at its refined pose, which explains it with `score`, with one of the copies in turn.
  /// After enough looks, once: size of the hand in view by that of the profile, if another one explains most of them
  /// clearly better. A few are enough where it explains all of them far better.
  std::optional<double> look(const HandObservation& observation, const HandPose& pose, double score);

 private:
  static constexpr int kEvery = 7, kLooks = 10, kMost = 7, kFew = 3, kIterations = 10;

  struct Candidate {
    double size;
    std::unique_ptr<Refinement> refinement;
    int better = 0, much_better = 0;  // frames that it explains clearly better, and far better
    double sum = 0;                   // of its scores
  };
  void make_candidates();
  std::optional<double> conclude();

  RefinementParams params_;
  std::shared_ptr<const HandProfile> profile_;
  std::shared_ptr<const Skin> skin_;
  std::vector<Candidate> candidates_;
  int frames_ = 0, looks_ = 0;
};

/// For people: a hand of `size` times the profile's is seen, and what to do.
std::string other_size(double size, const HandProfile& profile);

}  // namespace barehand
