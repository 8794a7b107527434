#include "app/profile_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/clearly_better.h"
#include "app/size_check.h"

namespace barehand {
namespace {

constexpr std::array<double, 6> kSizes = {0.8, 2, 1.25, 0.5, 0.65, 1.5};  // a search bridges a tenth by itself
// Searches that fail between two tries. What is in view for long without being found is most likely no hand.
constexpr int kOften = 10, kSeldom = 1000, kOftenUntil = 120;

// Attempts of the mirrored profile where its own does not convince. A hand of the other side is found by the first or
// second one in most cases; one of its own side must not be taken for the other's by the luck of many.
constexpr int kMirroredAttempts = 2;

// Of a trial: frames in which both are tracked before it may end, frames after which it does, those between two
// searches while the mirrored profile is not tracked, and the advantage of one side that ends it.
constexpr int kFewestFrames = 15, kMostFrames = 60, kSearchAgain = 10;
constexpr double kTrialAdvantage = 0.2;
constexpr int kSuspected = 3;  // searches in a row that must find the profile's own side after a trial found the other

}  // namespace

ProfileCheck::ProfileCheck(const TrackerParams& params, const HandProfile& profile, std::uint64_t seed,
                           Workers& workers, std::shared_ptr<spdlog::logger> log)
    : params_(params), profile_(profile), seed_(seed), workers_(workers), log_(std::move(log)) {
  params_.shape_fit.scans = 0;  // of what is only tried
}

HandTracker ProfileCheck::tracker_of(const HandProfile& profile) const {
  return HandTracker(params_, std::make_shared<const HandProfile>(profile), seed_, workers_);
}

void ProfileCheck::say_side() {
  if (said_side_) return;
  said_side_ = true;
  const auto seen = to_string(mirrored_->profile().handedness);
  log_->warn("what is seen looks like a {} hand, the profile is of a {} one: give --hand {} for that one, or both",
             seen, to_string(profile_.handedness), seen);
}

HandTracker& ProfileCheck::other_side() {
  if (!mirrored_) mirrored_ = std::make_unique<HandTracker>(tracker_of(mirrored(profile_)));
  return *mirrored_;
}

void ProfileCheck::begin_trial(const HandObservation& observation, std::optional<HandTracker::Fit> found) {
  other_side().reset();
  other_side().process(observation, std::move(found));
  trial_.emplace();
}

bool ProfileCheck::is_other_side(const HandObservation& observation, Effort effort, int attempts, double score) {
  trial_.reset();
  const bool convincing = score < params_.search_convincing;
  auto other = other_side().look(observation, effort, convincing ? 1 : std::min(attempts, kMirroredAttempts));
  const double other_score = other ? other->refined.score : INFINITY;
  const bool worse = clearly_better(other_score, score);
  if (worse) say_side();
  if (suspected_ > 0) suspected_ = clearly_better(score, other_score) ? suspected_ - 1 : kSuspected;
  if (worse || suspected_ > 0) return true;
  if (!convincing) begin_trial(observation, std::move(other));
  return false;
}

void ProfileCheck::track_mirrored(const HandObservation& observation) {
  Trial& trial = *trial_;
  const bool followed = mirrored_->status() == TrackStatus::tracking;
  if (!followed && trial.frames % kSearchAgain != 0) return;
  trial.mirrored = followed ? mirrored_->process(observation)
                            : mirrored_->process(observation, mirrored_->look(observation, Effort::quick, 1));
}

bool ProfileCheck::turns_out_other_side(const HandEstimate& own) {
  Trial& trial = *trial_;
  const bool lost = !own.has_pose();  // it is searched anew then
  if (own.status == TrackStatus::tracking && mirrored_->status() == TrackStatus::tracking) {
    ++trial.compared;
    trial.own_sum += own.score;
    trial.mirrored_sum += trial.mirrored->score;
  }
  const bool enough = trial.compared >= kFewestFrames;
  const bool other = enough && clearly_better(trial.mirrored_sum, trial.own_sum, kTrialAdvantage);
  const bool same = enough && clearly_better(trial.own_sum, trial.mirrored_sum, kTrialAdvantage);
  if (++trial.frames == kMostFrames || lost || other || same) trial_.reset();
  if (!other) return false;
  suspected_ = kSuspected;
  say_side();
  return true;
}

void ProfileCheck::nothing_found(const HandObservation& observation, double score) {
  if (said_size_ || !observation.hand_present) return;
  ++failures_;
  if (failures_ % (failures_ < kOftenUntil ? kOften : kSeldom) != 0) return;
  const double size = kSizes[tries_++ % kSizes.size()];
  const auto other = tracker_of(scaled(profile_, size)).look(observation, Effort::quick, 1);
  if (!other || other->refined.score > params_.loss.lost_score || !clearly_better(other->refined.score, score)) return;
  log_->warn("{}", other_size(size, profile_));
  said_size_ = true;
}

}  // namespace barehand
