#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "stages/refinement/refinement.h"

namespace barehand {

/// Checks whether a profile that is not fitted to the person has the size of the tracked hand: in a few frames it
/// compares how well smaller and larger copies of the hand explain the data.
class HandSizeVerifier {
 public:
  /// `skin`: the one that was built for the profile. The copies are made at the first call of look(), since most
  /// trackers only search.
  HandSizeVerifier(const RefinementParams& params, std::shared_ptr<const HandProfile> profile,
                   std::shared_ptr<const Skin> skin)
      : params_(params), profile_(std::move(profile)), skin_(std::move(skin)) {}

  /// Compares one of the copies, in turn, with the profile in a tracked frame. `pose`: the refined pose, which
  /// explains the frame with `score` [m]. After enough frames it returns, once, the size of the hand in view relative
  /// to the profile, provided that another size explains most of these frames clearly better. A few frames are enough
  /// if it explains all of them far better.
  std::optional<double> look(const HandObservation& observation, const HandPose& pose, double score);

 private:
  static constexpr int kEvery = 7, kLooks = 10, kMost = 7, kFew = 3, kIterations = 10;

  struct Candidate {
    double size;  // relative to the profile
    std::unique_ptr<Refinement> refinement;
    int better = 0, much_better = 0;  // frames that this size explains clearly / far better than the profile's own size
    double sum = 0;                   // sum of its scores [m]
  };
  void make_candidates();
  std::optional<double> conclude();

  RefinementParams params_;
  std::shared_ptr<const HandProfile> profile_;
  std::shared_ptr<const Skin> skin_;
  std::vector<Candidate> candidates_;
  int frames_ = 0, looks_ = 0;
};

/// A message for the user: the hand in view has `size` times the profile's size, and what can be done about it.
std::string other_size(double size, const HandProfile& profile);

}  // namespace barehand
