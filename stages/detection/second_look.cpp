// Lets the second network look at a tracked hand again, beside the tracking.
#include "stages/detection/second_look.h"

#include <algorithm>
#include <utility>

namespace barehand {
namespace {

constexpr int kSooner = 5;  // frames from one look to the next at an ambiguous hand

bool is_partly_hidden(const HandEstimate& hand) { return !std::ranges::all_of(hand.segments, &SegmentState::seen); }

void move_by(const Eigen::Vector3d& translation, DetectedHand& hand) {
  hand.centre += translation;
  for (DetectedJoint& joint : hand.joints) joint.position += translation;
}

}  // namespace

Result<std::optional<DetectedHand>> SecondLook::next(const FramePtr& frame, std::span<const HandEstimatePtr> feedback,
                                                     HandDetector& detector, Workers& workers) {
  ++frame_;
  auto look = look_.take(frame_);
  if (every_ > 0 && !look_.pending()) {
    // The hands take turns, but an ambiguous one is looked at soon.
    const auto is_ambiguous = [](const HandEstimatePtr& hand) {
      return hand && hand->ambiguous && is_partly_hidden(*hand);
    };
    const auto ambiguous = std::ranges::find_if(feedback, is_ambiguous);
    if (frame_ % every_ == 0 && !feedback.empty())
      begin(frame, feedback, turn_++ % feedback.size(), detector, workers);
    else if (frame_ % kSooner == 0 && ambiguous != feedback.end())
      begin(frame, feedback, ambiguous - feedback.begin(), detector, workers);
  }
  if (!look) return std::nullopt;
  if (!look->found || !*look->found) return std::move(look->found);

  // Move what was found with the palm.
  const auto place = look->hand < feedback.size() ? expected_hand(feedback[look->hand].get(), *frame) : std::nullopt;
  if (!place) return std::nullopt;
  move_by(place->centre - look->centre, **look->found);
  return std::move(look->found);
}

void SecondLook::begin(const FramePtr& frame, std::span<const HandEstimatePtr> feedback, std::size_t hand,
                       HandDetector& detector, Workers& workers) {
  const auto place = expected_hand(feedback[hand].get(), *frame);
  if (!place || !is_partly_hidden(*feedback[hand])) return;

  look_.begin(frame_, workers.run_in_background([&detector, frame, hand, place = *place](Workers& beside) {
    return Look{hand, place.centre, detector.examine_beside(*frame, place, beside)};
  }));
}

}  // namespace barehand
