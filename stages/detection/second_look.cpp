// Lets the second network look at a tracked hand again, beside the tracking.
#include "stages/detection/second_look.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace barehand {
namespace {

constexpr std::int64_t kDelay = 2;     // frames after which a look's result is used, since it takes about as long
constexpr std::int64_t kOutdated = 8;  // frames after which it is dropped, since the fingers have moved

bool is_partly_hidden(const HandEstimate& hand) { return !std::ranges::all_of(hand.segments, &SegmentState::seen); }

void move_by(const Eigen::Vector3d& translation, DetectedHand& hand) {
  hand.centre += translation;
  for (DetectedJoint& joint : hand.joints) joint.position += translation;
}

}  // namespace

Result<std::optional<DetectedHand>> SecondLook::next(const FramePtr& frame, std::span<const HandEstimatePtr> feedback,
                                                     HandDetector& detector, Workers& workers) {
  const std::int64_t now = frame_++;
  if (every_ > 0 && now % every_ == 0 && !look_) begin(frame, feedback, detector, workers);

  // Wait until the look is old enough and done.
  const std::int64_t age = look_ ? now - look_->begun : 0;
  if (age < kDelay || look_->found.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return std::nullopt;
  Look look = *std::exchange(look_, std::nullopt);
  Result<std::optional<DetectedHand>> found = look.found.get();
  if (!found || !*found) return found;

  // Move what was found with the palm.
  const auto place = look.hand < feedback.size() ? expected_hand(feedback[look.hand].get(), *frame) : std::nullopt;
  if (age > kOutdated || !place) return std::nullopt;
  move_by(place->centre - look.centre, **found);
  return found;
}

void SecondLook::begin(const FramePtr& frame, std::span<const HandEstimatePtr> feedback, HandDetector& detector,
                       Workers& workers) {
  // The hands take turns.
  if (feedback.empty()) return;
  const std::size_t hand = turn_++ % feedback.size();
  const auto place = expected_hand(feedback[hand].get(), *frame);
  if (!place || !is_partly_hidden(*feedback[hand])) return;

  look_ = {frame_ - 1, hand, place->centre,
           workers.run_in_background([&detector, frame, place = *place](Workers& beside) {
             return detector.examine_beside(*frame, place, beside);
           })};
}

}  // namespace barehand
