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
  /// `skin`: the one that was built for the profile. The copies are made at the first call of add_frame(), since most
  /// trackers only search.
  HandSizeVerifier(const RefinementParams& params, std::shared_ptr<const HandProfile> profile,
                   std::shared_ptr<const Skin> skin)
      : params_(params), profile_(std::move(profile)), skin_(std::move(skin)) {}

  /// Compares one of the copies, in turn, with the profile in a tracked frame. `pose`: the refined pose, which
  /// explains the frame with `score` [m]. After enough frames it returns, once, the size of the hand in view relative
  /// to the profile, provided that another size explains most of these frames clearly better. A few frames are enough
  /// if it explains all of them far better.
  std::optional<double> add_frame(const HandObservation& observation, const HandPose& pose, double score);

 private:
  static constexpr int kCompareEvery = 7;     // each copy is compared in every n-th tracked frame
  static constexpr int kFramesCompared = 10;  // frames in which each copy is compared before the check concludes
  static constexpr int kVotesNeeded = 7;  // the copy must explain this many of kFramesCompared frames clearly better
  static constexpr int kFramesIfObvious = 3;  // frames that suffice if a copy explains all of them far better
  static constexpr int kIterations = 10;      // Gauss-Newton steps of one comparison

  struct Candidate {
    double size;  // relative to the profile
    std::unique_ptr<Refinement> refinement;
    int better = 0, much_better = 0;  // frames that this size explains clearly / far better than the profile's size
    double sum = 0;                   // sum of the scores of this copy in all compared frames [m]
  };
  void make_candidates();
  std::optional<double> conclude();

  RefinementParams params_;
  std::shared_ptr<const HandProfile> profile_;
  std::shared_ptr<const Skin> skin_;
  std::vector<Candidate> candidates_;
  int frames_ = 0;    // calls of add_frame()
  int compared_ = 0;  // frames in which each copy was compared
};

/// A message for the user: the hand in view has `size` times the profile's size, and what can be done about it.
std::string other_size(double size, const HandProfile& profile);

}  // namespace barehand
