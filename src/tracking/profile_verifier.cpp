// Checks by mirrored and scaled copies whether the profile has the side and size of the observed hand.
#include "tracking/profile_verifier.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stages/search/inverse_kinematics.h"
#include "tracking/hand_size_verifier.h"

namespace barehand {
namespace {

// When searches with the profile find no hand, scaled copies of it are tried, of these sizes relative to the profile. A
// deviation of a tenth needs no copy, since a search with the profile itself still finds the hand.
constexpr std::array<double, 6> kOtherSizes = {0.8, 2, 1.25, 0.5, 0.65, 1.5};
// Another size is tried after every kOften failed searches; from kOftenUntil failures on, after every kSeldom, since a
// region in which no hand was found for so long most likely shows none.
constexpr int kOften = 10, kSeldom = 1000, kOftenUntil = 120;

// The size that detected joints show varies by 4 % from frame to frame, and people differ little in proportions. All
// sizes are logarithms of the ratio to the profile.
constexpr double kAnySize = 0.4,  // standard deviation expected of the size of a hand in view
    kOtherSize = 0.1,             // a size that deviates by more than this is verified, which costs a search
    kSameSize = 0.2;              // a size within this range of the confirmed one counts as the confirmed one
constexpr int kSizeChecks = 10,   // number of frames of a track whose detected joints are used
    kVerified = 3,                // number of deviating sizes that are all verified after the last confirmed one
    kVerifiedEvery = 30;          // later, only every n-th deviating size is verified
// The networks underestimate large deviations from the usual size of a hand. If the detected joints show a deviation
// larger than kFarSize, the true one may be kUnderstated times as large, so both sizes are tried.
constexpr double kFarSize = 0.35, kUnderstated = 1.5;

// Log odds of the side (left or right) from which on the networks are trusted: they then err for about one hand in
// fifty.
constexpr double kSureSide = 4;

// Number of search attempts with the mirrored profile if the score of the profile itself is not confident. Most hands
// of the other side are found by the first or second attempt; with many attempts, the mirrored profile might fit a hand
// of the profile's side by chance.
constexpr int kMirroredAttempts = 2;

// A verification ends when one side has the advantage kVerificationAdvantage over at least kFewestFrames frames in
// which both are tracked, and after kMostFrames at the latest. While the mirrored profile is not tracked, or explains
// the frames badly, it is searched in every kSearchAgain-th frame.
constexpr int kFewestFrames = 15, kMostFrames = 60, kSearchAgain = 10;
// Number of successive searches that the profile's side must win after a verification has found the other side.
constexpr int kToConfirm = 3;

}  // namespace

ProfileVerifier::ProfileVerifier(const TrackerParams& params, const HandProfile& profile,
                                 std::shared_ptr<const Skin> skin, std::uint64_t seed, Workers& workers,
                                 std::shared_ptr<spdlog::logger> log)
    : params_(params), profile_(profile), skin_(std::move(skin)), seed_(seed), workers_(workers), log_(std::move(log)) {
  // The trackers of this check run for a few frames only, so scanning a skin or opening a GPU is not worth the time.
  params_.shape_fit.scans = 0;
  params_.segment_tracker.observer = "cpu";
}

std::unique_ptr<HandTracker> ProfileVerifier::tracker_of(HandProfile profile, Skin skin) const {
  return std::make_unique<HandTracker>(params_, std::make_shared<const HandProfile>(std::move(profile)), seed_,
                                       workers_, make_silent_logger(), HandIds(),
                                       std::make_shared<const Skin>(std::move(skin)));
}
std::unique_ptr<HandTracker> ProfileVerifier::tracker_of_size(double size) const {
  return tracker_of(scaled(profile_, size), scaled(*skin_, size));
}

double ProfileVerifier::own_side_log_odds(const DetectedHand& hand) const {
  return side_sign(profile_.handedness) * hand.right_log_odds;
}

void ProfileVerifier::report_other_side() {
  if (side_reported_) return;
  side_reported_ = true;
  const auto seen = to_string(other_side().view().profile->handedness);
  log_->warn("the data looks like a {} hand, but the profile is of a {} one: give --hand {}, or --hand both", seen,
             to_string(profile_.handedness), seen);
}

HandTracker& ProfileVerifier::other_side() {
  if (!mirrored_) mirrored_ = tracker_of(mirrored(profile_), mirrored(*skin_));
  return *mirrored_;
}

void ProfileVerifier::begin_verification(const HandObservation& observation, std::optional<Hypothesis> found) {
  other_side().apply(ResetTracker{});
  other_side().process(observation, std::move(found));
  verification_.emplace();
}

bool ProfileVerifier::is_detected_as_other_side(const HandObservation& observation) {
  ++searched_frames_;
  own_side_is_sure_ = false;
  if (!observation.detected) return false;
  const DetectedHand& hand = *observation.detected;
  const double sum = other_side_evidence_.add(searched_frames_, hand.centre, -own_side_log_odds(hand));
  own_side_is_sure_ = sum < -kSureSide;
  if (sum > kSureSide) report_other_side();
  return sum > kSureSide;
}

bool ProfileVerifier::is_other_side(const HandObservation& observation, Effort effort, int attempts, double score) {
  // If the networks are sure of the profile's side, the verification over the next frames suffices.
  verification_.reset();
  const bool confident = score < params_.choice.confident_score;
  if (own_side_is_sure_ && to_confirm_ == 0) {
    if (!confident) begin_verification(observation, std::nullopt);
    return false;
  }

  // Search with the mirrored profile in the same observation.
  auto other = other_side().search(observation, effort, confident ? 1 : std::min(attempts, kMirroredAttempts));
  const double other_score = other ? other->score() : INFINITY;
  other_side().process(observation, std::nullopt);  // ends its frame, since it gathers evidence over frames

  // After a verification found the other side, the profile's side must win several successive searches.
  const bool worse = clearly_better(other_score, score);
  if (worse) report_other_side();
  if (to_confirm_ > 0) to_confirm_ = clearly_better(score, other_score) ? to_confirm_ - 1 : kToConfirm;
  if (worse || to_confirm_ > 0) return true;

  // An uncertain start is verified over the next frames.
  if (!confident) begin_verification(observation, std::move(other));
  return false;
}

void ProfileVerifier::track_mirrored(const HandObservation& observation) {
  Verification& verification = *verification_;
  if (observation.detected) {
    ++verification.detected;
    verification.own_side += own_side_log_odds(*observation.detected);
  }
  const bool followed = mirrored_->view().status == TrackStatus::tracking;
  const double score = !followed ? INFINITY : verification.mirrored ? verification.mirrored->score : 0;
  const bool search = verification.frames % kSearchAgain == 0 && score > params_.choice.confident_score;
  if (!followed && !search) return;

  // Give the mirrored hand another pose if it has none, or one that explains the frame clearly worse.
  std::optional<Hypothesis> found;
  if (search) found = mirrored_->search(observation, Effort::quick, 1);
  const bool better = !followed || (found && clearly_better(found->score(), score));
  verification.mirrored = better ? mirrored_->process(observation, std::move(found)) : mirrored_->process(observation);
}

bool ProfileVerifier::turns_out_other_side(const HandEstimate& own) {
  // Add up the scores of frames in which both sides are tracked.
  Verification& verification = *verification_;
  const bool lost = !own.has_pose();  // the hand will be searched again
  if (own.status == TrackStatus::tracking && mirrored_->view().status == TrackStatus::tracking) {
    ++verification.compared;
    verification.own_sum += own.score;
    verification.mirrored_sum += verification.mirrored->score;
  }

  // Decide for a side if it was clearly better over enough frames, and for the other one only if the networks did not
  // tell the profile's side on average.
  const bool enough = verification.compared >= kFewestFrames;
  const bool told = verification.own_side > kToldSide * std::max(1, verification.detected);
  const bool other =
      enough && !told && clearly_better(verification.mirrored_sum, verification.own_sum, kVerificationAdvantage);
  const bool same = enough && clearly_better(verification.own_sum, verification.mirrored_sum, kVerificationAdvantage);

  if (++verification.frames == kMostFrames || lost || other || same) verification_.reset();
  if (!other) return false;
  to_confirm_ = kToConfirm;
  report_other_side();
  return true;
}

std::optional<double> ProfileVerifier::other_size_in_view(const HandObservation& observation, double score) {
  // The detected joints show the size of the hand; a mean hand is fitted to the person instead.
  if (profile_.origin == ProfileOrigin::mean || !observation.detected || size_checks_ >= kSizeChecks)
    return std::nullopt;
  ++size_checks_;
  const auto seen = fit_size_to_hand(profile_, *observation.detected, kAnySize);
  if (!seen || std::abs(std::log(seen->scale)) < kOtherSize) return std::nullopt;
  if (confirmed_size_ && std::abs(std::log(seen->scale / *confirmed_size_)) < kSameSize) return confirmed_size_;
  return verified_size(observation, score, std::log(seen->scale));
}

std::optional<double> ProfileVerifier::verified_size(const HandObservation& observation, double score,
                                                     double log_size) {
  if (++size_refuted_ > kVerified && size_refuted_ % kVerifiedEvery != 0) return std::nullopt;

  // A copy of this size, or of the true size if the networks underestimate it, must explain the observation clearly
  // better.
  std::vector<double> log_sizes = {log_size};
  if (std::abs(log_size) > kFarSize) log_sizes.push_back(kUnderstated * log_size);

  // Search with a copy of each size, and keep the best one.
  std::optional<double> best;
  for (const double log_other : log_sizes) {
    const double size = std::exp(log_other);
    const auto found = tracker_of_size(size)->search(observation, Effort::quick, 1);
    if (!found || !clearly_better(found->score(), score)) continue;
    score = found->score();
    best = size;
  }
  if (!best) return std::nullopt;

  // Confirm the size, and start to count refuted sizes from 0 again.
  size_refuted_ = 0;
  confirmed_size_ = best;
  return best;
}

void ProfileVerifier::nothing_found(const HandObservation& observation, double score) {
  // Only some failures lead to a try of another size, since each try costs a search.
  if (size_reported_ || !observation.hand_present) return;
  ++failures_;
  if (failures_ % (failures_ < kOftenUntil ? kOften : kSeldom) != 0) return;

  // Search with a smaller or a larger copy.
  const double size = kOtherSizes[tries_++ % kOtherSizes.size()];
  const auto other = tracker_of_size(size)->search(observation, Effort::quick, 1);
  const double lost_score = std::max(1.0, size) * params_.loss.lost_score;  // scores grow with the size of the hand
  if (!other || other->score() > lost_score || !clearly_better(other->score(), score)) return;
  log_->warn("{}", other_size(size, profile_));
  size_reported_ = true;
}

}  // namespace barehand
