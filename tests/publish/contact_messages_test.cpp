#include "stages/publish/contact_messages.h"

#include "barehand/hand_state_t.hpp"
#include "published_hand.h"

namespace barehand {
namespace {

TEST(ContactMessages, StateContactsInTheFramesOfCameraAndObject) {
  const HandEstimate estimate = estimate_of(*test::adult_hand(Handedness::left), {}, 5'000'000);
  FrameVector<ObjectEstimate> objects(1);
  objects[0].id = 7;
  objects[0].T_camera_object = somewhere();
  HandContacts contacts;
  Contact& touch = contacts.object[4];
  touch = {ContactState::touching, true, 0.75, -0.001, 0.002, {0.1, 0.2, 0.4}, {0, 0, -1}, 7, -1};
  contacts.own[15] = {ContactState::near, false, 0.1, 0.008, 0.002, {0, 0, 0.5}, {1, 0, 0}, 5, 3};

  const contact_state_t message = contact_message(estimate, TrackStatus::tracking, contacts, objects);
  EXPECT_EQ(message.utime, 5'000'000);
  EXPECT_EQ(message.frame_number, 5000);
  EXPECT_EQ(message.hand_id, 5);
  EXPECT_EQ(message.handedness, hand_state_t::LEFT);
  EXPECT_EQ(message.object[4].state, contact_state_t::TOUCHING);
  EXPECT_TRUE(message.object[4].inferred);
  EXPECT_EQ(message.object[4].probability, 0.75);
  EXPECT_EQ(message.object[4].partner, 7);
  EXPECT_LT((somewhere() * Eigen::Vector3d(message.object[4].point_in_object) - touch.point).norm(), 1e-12);
  EXPECT_LT((somewhere().R * Eigen::Vector3d(message.object[4].normal_in_object) - touch.normal).norm(), 1e-12);
  EXPECT_EQ(message.own[15].state, contact_state_t::NEAR);
  EXPECT_EQ(message.own[15].segment, 3);
  EXPECT_TRUE(std::isnan(message.own[15].point_in_object[0])) << "a hand has no object's frame";
  EXPECT_EQ(message.object[0].state, contact_state_t::UNKNOWN);
  EXPECT_TRUE(std::isnan(message.object[0].distance)) << "unknown is never 0";
}

TEST(ContactMessages, StateObjects) {
  const HandEstimate estimate = estimate_of(*test::adult_hand(), {}, 5'000'000);
  ObjectEstimate object;
  object.id = 9;
  object.T_camera_object = somewhere();
  object.covariance(0, 4) = 0.25;
  object.extent = {0.1, 0.2, 0.3};
  object.held = true;
  object.hand_id = 5;
  object.since = 4'000'000;
  const object_state_t message = object_message(estimate, object);
  EXPECT_EQ(message.object_id, 9);
  EXPECT_EQ(message.sensor, "test");
  EXPECT_EQ(message.position[2], 0.5);
  EXPECT_GE(message.orientation[0], 0);
  EXPECT_EQ(message.covariance[0][4], 0.25);
  EXPECT_EQ(message.extent[2], 0.3);
  EXPECT_TRUE(message.held);
  EXPECT_EQ(message.since, 4'000'000);
  EXPECT_TRUE(std::isnan(message.linear_velocity[0]));
}

}  // namespace
}  // namespace barehand
