#pragma once

#include <memory>
#include <span>
#include <vector>

#include "app/profile_check.h"

namespace barehand {

/// Tracks a person's hands, one or a left and a right one, each with a HandTracker of its own. A hand that is not
/// tracked yet, or no more, is searched in what no tracked hand explains. What preprocess could not follow yet, as a
/// hand was found a moment ago, is the hand's that was nearer to it. Two that are searched at once compete for
/// what is seen: each side looks at everything, and what one explains clearly better is its hand; as long as neither
/// does, nobody's. A hand that is tracked alone is not started on a hand of the other side, and given up where that
/// turns out in its first frames; that is said in the log. As deterministic as HandTracker.
class HandsTracker {
 public:
  using Profiles = std::vector<std::shared_ptr<const HandProfile>>;

  /// One hand a profile; see HandTracker.
  HandsTracker(const TrackerParams& params, const Profiles& profiles, std::uint64_t seed, Workers& workers,
               std::shared_ptr<spdlog::logger> log = make_silent_logger());

  /// The observations of one frame and the estimates: one a hand, in the order of the profiles.
  HandEstimates process(const HandObservations& in_order);
  int count() const { return static_cast<int>(hands_.size()); }
  HandTracker& hand(int k) { return *hands_[k]; }
  /// Another person's hand from the next frame on.
  void use(int k, std::shared_ptr<const HandProfile> profile);
  /// See HandTracker::change.
  void change(const TrackerParams& params);

 private:
  using Fit = HandTracker::Fit;
  void check_anew();
  HandEstimatePtr track(int k, const HandObservation& observation);
  void judge_trial(int k, const HandEstimate& estimate);
  HandEstimatePtr process_only(const HandObservation& observation);
  HandObservations by_hand(const HandObservations& observations) const;
  bool searched(int k, const HandObservation& observation) const;
  void search_one(int k, const HandObservations& observations, HandEstimates& out);
  void search_both(const HandObservations& observations, HandEstimates& out);

  TrackerParams params_;
  std::uint64_t seed_;
  Workers& workers_;
  std::shared_ptr<spdlog::logger> log_;
  std::vector<std::unique_ptr<HandTracker>> hands_;
  std::vector<std::unique_ptr<ProfileCheck>> checks_;  // one a hand
  std::int64_t frame_ = 0;
};

}  // namespace barehand
