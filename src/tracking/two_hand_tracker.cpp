// Tracks up to two hands, and assigns the observed hands to their trackers.
#include "tracking/two_hand_tracker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace barehand {
namespace {

// A search takes longer than tracking. While one hand is tracked, the other one is therefore searched only in every
// n-th frame, unless it was detected.
constexpr int kSearchEvery = 3;

/// Distance of the palm from the centroid of the observed points [m]; kNowhere if no hand was observed.
double distance(const HandPose& pose, const HandObservation& observation) {
  constexpr double kNowhere = 10;
  if (!observation.hand_present || observation.cloud.empty()) return kNowhere;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& p : observation.cloud) sum += p;
  return (sum.cast<double>() / static_cast<double>(observation.cloud.size()) - pose[kPalm].t).norm();
}

}  // namespace

TwoHandTracker::TwoHandTracker(const TrackerParams& params, const Profiles& profiles, std::uint64_t seed,
                               Workers& workers, std::shared_ptr<spdlog::logger> log)
    : params_(params), seed_(seed), workers_(workers), log_(std::move(log)), hands_(profiles.size()) {
  for (int k = 0; k < count(); ++k) use(k, profiles[k]);
}

void TwoHandTracker::use(int k, std::shared_ptr<const HandProfile> profile) {
  if (hands_[k])
    hands_[k]->apply(UseProfile{std::move(profile)});
  else
    hands_[k] =
        std::make_unique<HandTracker>(params_, std::move(profile), seed_, workers_, log_, HandIds{k + 1, count()});
  renew_verifiers();
}

void TwoHandTracker::change(const TrackerParams& params) {
  for (const auto& hand : hands_) hand->apply(UseParams{params});
  params_ = params;
  renew_verifiers();
}

void TwoHandTracker::renew_verifiers() {
  verifiers_.clear();
  // With two hands, the verifiers log nothing: both sides are tracked, so none is wrong.
  for (const auto& hand : hands_) {
    if (!hand) continue;
    const TrackView track = hand->view();
    verifiers_.push_back(std::make_unique<ProfileVerifier>(params_, *track.profile, track.skin, seed_, workers_,
                                                           count() == 1 ? log_ : make_silent_logger()));
  }
}

void TwoHandTracker::couple_with(std::span<const NearbyObject> objects) {
  for (const auto& hand : hands_) hand->apply(CoupleWith{objects});
}

void TwoHandTracker::reset(int k) {
  verifiers_[k]->end_verification();
  hands_[k]->apply(ResetTracker{});
}

void TwoHandTracker::start_at(int k, const HandPose& pose) {
  verifiers_[k]->end_verification();
  hands_[k]->apply(StartAt{pose});
}

HandEstimates TwoHandTracker::process(HandObservations& observations) {
  // With one hand, no observation has to be assigned.
  if (count() == 1) return {process_single_hand(*observations[0])};
  ++frame_;
  if (exchanged(observations)) std::swap(observations[0], observations[1]);
  HandEstimates out(hands_.size());

  // Track the hands that are being tracked, in parallel.
  FrameVector<int> tracked;
  for (int k = 0; k < count(); ++k)
    if (!searched(k, *observations[k])) tracked.push_back(k);
  workers_.for_each_index(static_cast<int>(tracked.size()), [&](int i) {
    const int k = tracked[i];
    out[k] =
        verifiers_[k]->verifying() ? track_with_mirrored(k, *observations[k]) : hands_[k]->process(*observations[k]);
  });

  // End tracks that turn out to be of the other side, check the sizes, and search the other hands.
  for (const int k : tracked) {
    apply_verification(k, *out[k]);
    check_tracked_size(k, *observations[k], *out[k]);
  }

  // Without a tracked hand, search both hands at once.
  if (tracked.empty())
    search_both(observations, out);
  else
    for (int k = 0; k < count(); ++k)
      if (!out[k]) search_one(k, observations, out);
  return out;
}

HandEstimatePtr TwoHandTracker::track_with_mirrored(int k, const HandObservation& observation) {
  HandEstimatePtr estimate;
  workers_.for_each_index(2, [&](int i) {
    if (i == 0) estimate = hands_[k]->process(observation);
    if (i == 1) verifiers_[k]->track_mirrored(observation);
  });
  return estimate;
}

/// A hand that was tracked alone may turn out to be of the other side. If there is a tracker for the other side, it
/// continues from the mirrored pose.
void TwoHandTracker::apply_verification(int k, const HandEstimate& estimate) {
  const bool has_other = count() == 2;
  ProfileVerifier& check = *verifiers_[k];
  if (has_other && view(1 - k).status == TrackStatus::tracking) check.end_verification();
  if (!check.verifying() || !check.turns_out_other_side(estimate)) return;
  reset(k);
  if (has_other) start_at(1 - k, check.mirrored_pose());
}

void TwoHandTracker::check_tracked_size(int k, const HandObservation& observation, const HandEstimate& estimate) {
  if (!params_.size_check || estimate.status != TrackStatus::tracking || view(k).size_mismatch) return;
  const auto size = verifiers_[k]->other_size_in_view(observation, estimate.score);
  if (size) hands_[k]->apply(NoteSizeMismatch{*size});
}

bool TwoHandTracker::check_found_size(int k, const HandObservation& observation, std::optional<Hypothesis>& found) {
  if (!params_.size_check || !found) return false;
  verifiers_[k]->expect_any_size();
  const auto size = verifiers_[k]->other_size_in_view(observation, found->score());
  if (!size) return false;
  hands_[k]->apply(NoteSizeMismatch{*size});  // the size is reported even if no track starts
  found->size = *size;
  return true;
}

HandEstimatePtr TwoHandTracker::process_single_hand(const HandObservation& observation) {
  HandTracker& hand = *hands_[0];
  ProfileVerifier& check = *verifiers_[0];

  // Continue a track; its verification may end it.
  const TrackView before = hand.view();
  if (before.status != TrackStatus::searching || before.start_is_given) {
    HandEstimatePtr estimate = check.verifying() ? track_with_mirrored(0, observation) : hand.process(observation);
    apply_verification(0, *estimate);
    check_tracked_size(0, observation, *estimate);
    return estimate;
  }

  // Without a track, search the hand, unless what was detected is the other hand.
  if (params_.side_check && check.is_detected_as_other_side(observation))
    return hand.process(observation, std::nullopt);
  const int attempts = before.attempts(before.effort);
  std::optional<Hypothesis> found = hand.search(observation, before.effort, attempts);

  // Report a wrong size, and reject a hand of the other side. If the size is wrong but the detection shows the
  // profile's own side, the mirrored profile is not tried, since it has the wrong size, too.
  const double score = found ? found->score() : INFINITY;
  const bool other_size = check_found_size(0, observation, found);

  // Tell the verification that nothing was found, or let it test the other side.
  if (score > params_.loss.lost_score) {
    if (found && !other_size && params_.size_check) check.nothing_found(observation, score);
  } else if (params_.side_check) {
    const bool own_side_seen = other_size && observation.detected->side == before.profile->handedness;
    if (!own_side_seen && check.is_other_side(observation, before.effort, attempts, score)) found.reset();
  }
  return hand.process(observation, std::move(found));
}

bool TwoHandTracker::follows(int k, const HandObservation& observation) const {
  return observation.followed && view(k).expected_pose;
}

/// Preprocessing returns the regions in no particular order if it had no feedback, and in a wrong one while its
/// feedback is older than the decision that a hand is of the other side. The assignment with the smaller total distance
/// is taken.
bool TwoHandTracker::exchanged(const HandObservations& observations) const {
  if (follows(0, *observations[0]) || follows(1, *observations[1])) return false;
  const auto apart = [&](int k, int j) {
    const HandPose* pose = view(k).expected_pose;
    return pose ? distance(*pose, *observations[j]) : 0;
  };
  return apart(0, 1) + apart(1, 0) < apart(0, 0) + apart(1, 1);
}

/// A hand is searched if it has neither a track nor a given start, and the observation belongs to no tracked hand.
bool TwoHandTracker::searched(int k, const HandObservation& observation) const {
  const TrackView track = view(k);
  return !follows(k, observation) && !track.start_is_given && !track.tentative && track.status != TrackStatus::tracking;
}

/// A hand is not searched where the networks tell that there is one of the other side. Its pose may explain the data
/// better by chance, above all that of a hand behind what it holds.
bool TwoHandTracker::may_show(int k, const HandObservation& observation) const {
  return !observation.detected || observation.detected->may_be(view(k).profile->handedness);
}

void TwoHandTracker::search_one(int k, const HandObservations& observations, HandEstimates& out) {
  std::optional<Hypothesis> found;
  const TrackView track = view(k);
  const bool due = observations[k]->detected || frame_ % kSearchEvery == 0;
  if (!track.start_is_given && due && may_show(k, *observations[k]))
    found = hands_[k]->search(*observations[k], track.effort, track.attempts(track.effort));
  check_found_size(k, *observations[k], found);
  out[k] = hands_[k]->process(*observations[k], std::move(found));
}

void TwoHandTracker::search_both(HandObservations& observations, HandEstimates& out) {
  std::array<std::array<std::optional<Hypothesis>, 2>, 2> found;  // [hand][observation]

  // A side that finds no hand gets the score of a bad explanation, not infinity. A detection that confirms a pose
  // reduces its score, as for the start of the track, since every score is bad if the noise is large.
  const double none = params_.loss.lost_score;
  const Choice choice(params_.choice);
  const auto score = [&](int k, int j) {
    if (!found[k][j]) return none;
    return std::min(choice.score_with_detection(*observations[j], *view(k).profile, found[k][j]->refined), none);
  };

  // Whether one of the sides explains the observation well enough already.
  const auto confident = [&](int j) {
    return !observations[j]->hand_present || std::min(score(0, j), score(1, j)) < params_.choice.confident_score;
  };

  // Both sides search with the same effort, which gives them equal chances.
  const std::array<TrackView, 2> tracks = {view(0), view(1)};
  const bool full = tracks[0].effort == Effort::full || tracks[1].effort == Effort::full;
  const Effort effort = full ? Effort::full : Effort::quick;
  const int most = std::max(tracks[0].attempts(effort), tracks[1].attempts(effort));

  // Each side searches every region once, and again with more attempts where neither side is confident.
  const auto search_observation = [&](int j, int attempts) {
    for (int k = 0; k < 2; ++k)
      if (may_show(k, *observations[j])) found[k][j] = hands_[k]->search(*observations[j], effort, attempts);
  };
  for (int j = 0; j < 2; ++j) {
    search_observation(j, 1);
    if (most > 1 && !confident(j)) search_observation(j, most);
  }

  // Each side owns the observation that it explains clearly better than the other side does. Two observations are
  // assigned together.
  std::array<int, 2> owned = {-1, -1};  // observation of each hand; -1: none
  if (observations[0]->hand_present && observations[1]->hand_present) {
    const double straight = score(0, 0) + score(1, 1), crossed = score(0, 1) + score(1, 0);
    if (clearly_better(straight, crossed)) owned = {0, 1};
    if (clearly_better(crossed, straight)) owned = {1, 0};
  } else {
    // Give a single observation to the hand that explains it clearly better.
    const int j = observations[0]->hand_present ? 0 : 1;
    for (int k = 0; k < 2; ++k) {
      const bool other_returns = tracks[1 - k].status == TrackStatus::lost && tracks[k].status != TrackStatus::lost;
      if (clearly_better(score(k, j), score(1 - k, j), other_returns ? kReturningAdvantage : kHandAdvantage))
        owned[k] = j;
    }
  }

  // Start the tracks. If only one hand starts, it is verified against the other side in the next frames.
  for (int k = 0; k < 2; ++k) {
    const int j = owned[k];
    if (j >= 0) check_found_size(k, *observations[j], found[k][j]);
    if (params_.side_check && j >= 0 && owned[1 - k] < 0)
      verifiers_[k]->begin_verification(*observations[j], std::move(found[1 - k][j]));
    out[k] = j < 0 ? hands_[k]->process(*observations[k], std::nullopt)
                   : hands_[k]->process(*observations[j], std::move(found[k][j]));
  }
  if (owned[0] == 1 || owned[1] == 0) std::swap(observations[0], observations[1]);
}

}  // namespace barehand
