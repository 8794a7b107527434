#include "app/profile_check.h"

#include <array>

#include "app/clearly_better.h"
#include "app/size_check.h"

namespace barehand {
namespace {

constexpr std::array<double, 4> kSizes = {0.8, 1.25, 0.65, 1.5};  // a search bridges a tenth by itself
// Searches that fail between two tries. What is in view for long without being found is most likely no hand.
constexpr int kOften = 10, kSeldom = 1000, kOftenUntil = 120;

}  // namespace

ProfileCheck::ProfileCheck(const TrackerParams& params, const HandProfile& profile, std::uint64_t seed,
                           Workers& workers, std::shared_ptr<spdlog::logger> log)
    : params_(params), profile_(profile), seed_(seed), workers_(workers), log_(std::move(log)) {}

HandTracker ProfileCheck::tracker_of(const HandProfile& profile) const {
  return HandTracker(params_, std::make_shared<const HandProfile>(profile), seed_, workers_);
}

bool ProfileCheck::is_other_side(const HandObservation& observation, Effort effort, int attempts, double score) {
  if (!mirrored_) mirrored_ = std::make_unique<HandTracker>(tracker_of(mirrored(profile_)));
  const auto other = mirrored_->look(observation, effort, attempts);
  if (!other || !clearly_better(other->refined.score, score)) return false;
  if (!said_side_) {
    const auto seen = to_string(mirrored_->profile().handedness);
    log_->warn("what is seen looks like a {} hand, the profile is of a {} one: give --hand {} for that one, or both",
               seen, to_string(profile_.handedness), seen);
  }
  return said_side_ = true;
}

void ProfileCheck::nothing_found(const HandObservation& observation, double score) {
  if (said_size_) return;
  ++failures_;
  if (failures_ % (failures_ < kOftenUntil ? kOften : kSeldom) != 0) return;
  const double size = kSizes[tries_++ % kSizes.size()];
  const auto other = tracker_of(scaled(profile_, size)).look(observation, Effort::quick, 1);
  if (!other || other->refined.score > params_.loss.lost_score || !clearly_better(other->refined.score, score)) return;
  log_->warn("{}", other_size(size, profile_));
  said_size_ = true;
}

}  // namespace barehand
