#include "pipeline/sinks/hand_message_makers.h"

#include <gtest/gtest.h>

#include "support/adult_hand.h"

namespace barehand {
namespace {

TEST(HandMessageMakers, AllMessagesAboutAHandStateTheSameStatus) {
  // The tracker loses a hand, whose pose is held at first.
  HandMessageMakers makers({}, nullptr);
  const auto process = [&](std::int64_t utime, TrackStatus status) {
    auto estimate = std::make_shared<HandEstimate>();
    estimate->utime = utime;
    estimate->status = status;
    estimate->profile = test::adult_hand();
    auto contacts = std::make_shared<FrameContacts>();
    contacts->hands.resize(1);
    auto grasps = std::make_shared<FrameGrasps>(1);
    return makers.process({nullptr, {}, {estimate}, contacts, grasps}).hands[0];
  };
  process(0, TrackStatus::tracking);
  const HandMessages held = process(100'000, TrackStatus::lost);
  EXPECT_EQ(held.state.status, hand_state_t::HOLDING);
  EXPECT_EQ(held.contact->status, hand_state_t::HOLDING);
  EXPECT_EQ(held.grasp->status, hand_state_t::HOLDING);
}

}  // namespace
}  // namespace barehand
