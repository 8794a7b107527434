#include "app/listen/state_line.h"

#include <gtest/gtest.h>

#include "drivers/lcm/layouts.h"

namespace barehand {
namespace {

/// A message about the right hand 3 in frame 12.
template <class Message>
Message about_hand() {
  Message message{};
  message.frame_number = 12;
  message.hand_id = 3;
  message.handedness = hand_state_t::RIGHT;
  return message;
}

template <class Message>
std::string line_of(const Message& message) {
  return state_line("CHANNEL", encode_message(message));
}

TEST(StateLine, ListsEveryKindOfState) {
  auto hand = about_hand<hand_state_t>();
  hand.status = hand_state_t::TRACKING;
  hand.has_pose = true;
  hand.segments[0].position[2] = 0.6;
  hand.segments[0].confidence = 0.9;
  EXPECT_EQ(line_of(hand), "frame 12  right hand 3  tracking   palm   0.000   0.000   0.600 m  confidence 0.90");

  auto glove = about_hand<glove_state_t>();
  glove.channel[glove_state_t::INDEX_MPJ] = 0.5;
  EXPECT_EQ(line_of(glove), "frame 12  right hand 3  flexion of knuckles [deg]     0    29     0     0     0");

  auto grasp = about_hand<grasp_state_t>();
  grasp.grasp = grasp_state_t::UNKNOWN;
  EXPECT_EQ(line_of(grasp), "frame 12  right hand 3  grasp unknown");
  grasp.grasp = grasp_state_t::NONE;
  grasp.probability = 0.75;
  grasp.aperture = 0.05;
  EXPECT_EQ(line_of(grasp), "frame 12  right hand 3  grasp none  probability 0.75  opening 50 mm");

  object_state_t object{};
  object.frame_number = 12;
  object.object_id = 7;
  EXPECT_EQ(line_of(object), "frame 12  object 7  at   0.000   0.000   0.000 m  not held");
  object.held = true;
  object.hand_id = 3;
  EXPECT_TRUE(line_of(object).ends_with("held by hand 3"));
}

TEST(StateLine, NamesWhatAHandTouches) {
  auto contact = about_hand<contact_state_t>();
  EXPECT_EQ(line_of(contact), "frame 12  right hand 3  touches  nothing that is known");
  contact.object[3].state = contact.object[6].state = contact_state_t::TOUCHING;
  contact.object[9].state = contact_state_t::NEAR;
  contact.own[6].state = contact_state_t::TOUCHING;
  EXPECT_EQ(line_of(contact),
            "frame 12  right hand 3  touches  an object: thumb_distal, index_distal  itself: index_distal");
}

TEST(StateLine, SaysThatAMessageIsNotKnownOrDamaged) {
  EXPECT_EQ(line_of(about_hand<hand_joints_t>()).find("CHANNEL: "), 0u);
  std::vector<std::uint8_t> damaged = encode_message(about_hand<grasp_state_t>());
  damaged.pop_back();
  const std::string expected = "CHANNEL: " + std::to_string(damaged.size()) + " bytes of another type, or damaged";
  EXPECT_EQ(state_line("CHANNEL", damaged), expected);
}

}  // namespace
}  // namespace barehand
