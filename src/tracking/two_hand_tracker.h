#pragma once

#include <memory>
#include <span>
#include <vector>

#include "tracking/profile_verifier.h"

namespace barehand {

/// Tracks one hand, or the left and the right hand of a person, each with its own HandTracker.
/// (1) A hand that is not tracked is searched in the data that no tracked hand explains. If preprocessing had no
/// feedback yet, because the hands were found only a moment ago, each region is assigned to the nearer hand. (2) If
/// both hands are searched, each region is searched with both profiles, and belongs to the hand that explains it
/// clearly better; otherwise it stays unassigned. (3) A track whose first frames show a hand of the other side is given
/// up. If there is only one profile, no track is started on such a hand in the first place, and both cases are logged.
/// The results are as deterministic as those of HandTracker.
class TwoHandTracker {
 public:
  using Profiles = std::vector<std::shared_ptr<const HandProfile>>;

  /// One hand for each of the one or two profiles; for the other parameters see HandTracker.
  TwoHandTracker(const TrackerParams& params, const Profiles& profiles, std::uint64_t seed, Workers& workers,
                 std::shared_ptr<spdlog::logger> log = make_silent_logger());

  /// Processes one frame. `observations`: one per hand; they are in the order of the profiles if preprocessing had
  /// feedback, and in any order otherwise. They are put in the order of the profiles, like the returned estimates.
  HandEstimates process(HandObservations& observations);
  /// Forgets the k-th hand and the person, and searches.
  void reset(int k);
  /// Tracks the k-th hand from a pose on (StartAt).
  void start_at(int k, const HandPose& pose);
  /// Lets every hand couple with the objects near it (CoupleWith).
  void couple_with(std::span<const NearbyObject> objects);
  int count() const { return static_cast<int>(hands_.size()); }
  TrackView view(int k) const { return hands_[k]->view(); }
  /// Tracks another person's hand as the k-th one from the next frame on.
  void use(int k, std::shared_ptr<const HandProfile> profile);
  /// Continues with other parameters (UseParams). If it throws, the first hand may have changed.
  void change(const TrackerParams& params);

 private:
  // Replaces the profile verifiers, which belong to the former profiles and parameters.
  void renew_verifiers();
  // Tracks the k-th hand while its side (left or right) is being verified: a hand of the other side is tracked in the
  // same data, in parallel.
  HandEstimatePtr track_with_mirrored(int k, const HandObservation& observation);
  // Gives up the k-th hand if the verification finds that it is a hand of the other side.
  void apply_verification(int k, const HandEstimate& estimate);
  // Marks the size of a tracked hand as wrong if the detected joints indicate another size.
  void check_tracked_size(int k, const HandObservation& observation, const HandEstimate& estimate);
  // Marks the size of a hand found by a search as wrong if the detected joints indicate another size. Returns whether
  // they do.
  bool check_found_size(int k, const HandObservation& observation, std::optional<Hypothesis>& found);
  // Processes a whole frame if there is only one hand.
  HandEstimatePtr process_single_hand(const HandObservation& observation);
  // Whether preprocessing followed the k-th hand to its observation, and the hand was not given up since.
  bool follows(int k, const HandObservation& observation) const;
  // Whether the two observations belong to the other hand each.
  bool exchanged(const HandObservations& observations) const;
  // Whether the k-th hand is searched in this observation instead of being tracked.
  bool searched(int k, const HandObservation& observation) const;
  // Whether the networks, if they saw a hand here, allow that it is the k-th one.
  bool may_show(int k, const HandObservation& observation) const;
  void search_one(int k, const HandObservations& observations, HandEstimates& out);
  void search_both(HandObservations& observations, HandEstimates& out);

  TrackerParams params_;
  std::uint64_t seed_;
  Workers& workers_;
  std::shared_ptr<spdlog::logger> log_;
  std::vector<std::unique_ptr<HandTracker>> hands_;
  std::vector<std::unique_ptr<ProfileVerifier>> verifiers_;  // one per hand
  std::int64_t frame_ = 0;                                   // number of frames so far
};

}  // namespace barehand
