#include "stages/publish/hand_messages.h"

#include <cmath>

#include "published_hand.h"
#include "stages/publish/health_message.h"

namespace barehand {
namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000;
constexpr std::int64_t kFrame_us = 33'333;

template <class Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

class HandMessagesTest : public testing::Test {
 protected:
  HandEstimate estimate(int frame, TrackStatus status = TrackStatus::tracking) const {
    Angles angles{};
    for (int s = 1; s < kSegmentCount; ++s) angles[s].flexion = 0.05 * frame;
    HandEstimate e = estimate_of(profile_, angles, kStart + frame * kFrame_us, status);
    if (status == TrackStatus::searching || status == TrackStatus::lost) e.segments = {};
    return e;
  }
  HandProfile profile_ = *test::adult_hand(Handedness::right);
  HandMessageMaker maker_{{}};
};

TEST_F(HandMessagesTest, EveryMessageNamesItsFrameAndHand) {
  const HandEstimate e = estimate(3);
  const HandMessages messages = maker_.process(e);
  const auto check = [&](const auto& message) {
    EXPECT_EQ(message.utime, e.utime);
    EXPECT_EQ(message.frame_number, e.number);
    EXPECT_EQ(message.sensor, "test");
    EXPECT_EQ(message.hand_id, 5);
    EXPECT_EQ(message.handedness, hand_state_t::RIGHT);
    EXPECT_EQ(message.status, hand_state_t::TRACKING);
  };
  check(messages.state);
  check(messages.glove);
  check(messages.joints);
  EXPECT_TRUE(messages.state.has_pose);
  EXPECT_EQ(messages.state.pose_utime, e.utime);
}

TEST_F(HandMessagesTest, ALeftHandSaysSo) {
  profile_ = *test::adult_hand(Handedness::left);
  EXPECT_EQ(maker_.process(estimate(0)).joints.handedness, hand_state_t::LEFT);
}

TEST_F(HandMessagesTest, SegmentsCarryTheEstimate) {
  const HandEstimate e = estimate(3);
  const HandMessages messages = maker_.process(e);
  const HandPose pose = pose_of(e.segments);
  for (int s = 0; s < kSegmentCount; ++s) {
    const segment_state_t& m = messages.state.segments[s];
    const Eigen::Vector3d distal = distal_end(profile_, pose, s);
    const Eigen::Quaterniond q(m.orientation[0], m.orientation[1], m.orientation[2], m.orientation[3]);  // (w, x, y, z)
    EXPECT_LT((q.toRotationMatrix() - pose[s].R).norm(), 1e-12);
    EXPECT_GE(m.orientation[0], 0);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(m.position[i], pose[s].t[i]);
      EXPECT_EQ(m.distal[i], distal[i]);
      EXPECT_DOUBLE_EQ(m.linear_velocity[i], 0.1 * (i + 1));
      EXPECT_DOUBLE_EQ(m.angular_velocity[i], 0.1 * (i + 4));
    }
    EXPECT_EQ(m.covariance[2][2], 1e-6);
    EXPECT_EQ(m.covariance[0][4], 2e-7);
    EXPECT_EQ(m.confidence, 0.8);
    EXPECT_EQ(m.visible, 0.6);
    EXPECT_EQ(m.seen, s != 15);
  }
}

TEST_F(HandMessagesTest, TheSmoothedPoseLagsTheRawOne) {
  for (int frame = 0; frame < 5; ++frame) maker_.process(estimate(frame));
  const HandMessages messages = maker_.process(estimate(5));
  const auto& glove = messages.glove;
  EXPECT_NEAR(glove.channel_raw[glove_state_t::INDEX_PIJ], 0.25, 1e-9);
  EXPECT_LT(glove.channel[glove_state_t::INDEX_PIJ], 0.2499);
  EXPECT_GT(glove.channel[glove_state_t::INDEX_PIJ], 0.15);
  EXPECT_NE(messages.state.segments[6].position[0], messages.state.segments[6].smoothed_position[0]);
}

TEST_F(HandMessagesTest, WithTheFilterOffBothPosesAreEqual) {
  PublishParams params;
  params.smoothing.enabled = false;
  HandMessageMaker maker(params);
  maker.process(estimate(0));
  const HandMessages messages = maker.process(estimate(5));
  for (int i = 0; i < 19; ++i) EXPECT_EQ(messages.glove.channel[i], messages.glove.channel_raw[i]);
}

TEST_F(HandMessagesTest, JointsBesideAnInferredSegmentAreFlagged) {
  const HandMessages messages = maker_.process(estimate(0));
  EXPECT_EQ(messages.glove.channel_flag[glove_state_t::PINKIE_DIJ], glove_state_t::INFERRED);
  EXPECT_EQ(messages.glove.channel_flag[glove_state_t::PINKIE_PIJ], glove_state_t::SEEN);
  EXPECT_EQ(messages.glove.joint_flag[20], glove_state_t::INFERRED);
  EXPECT_EQ(messages.glove.channel_flag[glove_state_t::WRIST_YAW], glove_state_t::UNOBSERVABLE);
  EXPECT_TRUE(std::isnan(messages.glove.channel[glove_state_t::WRIST_YAW]));
  EXPECT_EQ(messages.joints.flags[24], 3) << "little distal: valid, not tracked";
  EXPECT_EQ(messages.joints.flags[23], 15);
}

TEST_F(HandMessagesTest, ALostHandIsHeldWithGrowingCovarianceThenHasNoPose) {
  const HandMessages seen = maker_.process(estimate(0));
  const HandMessages held = maker_.process(estimate(3, TrackStatus::lost));
  EXPECT_EQ(held.state.status, hand_state_t::HOLDING);
  EXPECT_TRUE(held.state.has_pose);
  EXPECT_EQ(held.state.pose_utime, kStart);
  EXPECT_EQ(held.state.utime, kStart + 3 * kFrame_us);
  const segment_state_t &then = seen.state.segments[7], &now = held.state.segments[7];
  EXPECT_EQ(now.position[1], then.position[1]);
  EXPECT_NEAR(now.covariance[0][0], 1e-6 + 1e-4, 1e-7) << "0.1 m/s for 0.1 s";
  EXPECT_NEAR(now.covariance[5][5], 1e-6 + 1e-2, 1e-5) << "1 rad/s for 0.1 s";
  EXPECT_LT(now.confidence, then.confidence);
  EXPECT_TRUE(std::isnan(now.linear_velocity[0]) && std::isnan(now.angular_velocity[2])) << "nobody sees it move";
  EXPECT_FALSE(now.seen);
  EXPECT_EQ(held.joints.flags[0], 3) << "valid, not tracked";

  const HandMessages later = maker_.process(estimate(6, TrackStatus::lost));
  EXPECT_GT(later.state.segments[7].covariance[0][0], now.covariance[0][0]);
  const HandMessages lost = maker_.process(estimate(16, TrackStatus::lost));
  EXPECT_EQ(lost.state.status, hand_state_t::LOST);
  EXPECT_FALSE(lost.state.has_pose);
  EXPECT_EQ(lost.state.pose_utime, 0);
}

TEST_F(HandMessagesTest, AHandIsHeldAlikeWhileTheTrackerHoldsItAndWhenItSaysLost) {
  HandMessageMaker other{{}};
  maker_.process(estimate(0));
  other.process(estimate(0));
  const segment_state_t holding = maker_.process(estimate(3, TrackStatus::holding)).state.segments[7];
  const segment_state_t lost = other.process(estimate(3, TrackStatus::lost)).state.segments[7];
  EXPECT_EQ(bytes_of(holding), bytes_of(lost));
  EXPECT_EQ(holding.visible, 0);
}

TEST_F(HandMessagesTest, ATrackerThatHoldsForTooLongIsLostToo) {
  maker_.process(estimate(0));
  EXPECT_EQ(maker_.process(estimate(3, TrackStatus::holding)).state.status, hand_state_t::HOLDING);
  EXPECT_EQ(maker_.process(estimate(30, TrackStatus::holding)).state.status, hand_state_t::LOST);
  EXPECT_EQ(maker_.process(estimate(31)).state.status, hand_state_t::TRACKING);
}

TEST_F(HandMessagesTest, ASearchThatStartsAnewForgetsThePose) {
  maker_.process(estimate(0));
  EXPECT_EQ(maker_.process(estimate(1, TrackStatus::searching)).state.status, hand_state_t::SEARCHING);
  EXPECT_EQ(maker_.process(estimate(2, TrackStatus::lost)).state.status, hand_state_t::LOST);
}

TEST_F(HandMessagesTest, WithoutAPoseNothingIsZero) {
  HandEstimate searching = estimate(0, TrackStatus::searching);
  searching.profile = nullptr;
  const HandMessages messages = maker_.process(searching);
  EXPECT_FALSE(messages.state.has_pose);
  EXPECT_TRUE(std::isnan(messages.state.score));
  for (const segment_state_t& s : messages.state.segments) {
    EXPECT_TRUE(std::isnan(s.position[2]) && std::isnan(s.orientation[0]) && std::isnan(s.distal[0]));
    EXPECT_TRUE(std::isnan(s.smoothed_position[2]) && std::isnan(s.smoothed_orientation[3]) &&
                std::isnan(s.smoothed_distal[1]));
    EXPECT_TRUE(std::isnan(s.covariance[5][5]) && std::isnan(s.confidence) && std::isnan(s.visible));
    EXPECT_TRUE(std::isnan(s.linear_velocity[0]) && std::isnan(s.angular_velocity[2]));
  }
  for (int i = 0; i < 22; ++i) {
    EXPECT_TRUE(std::isnan(messages.glove.channel[i]));
    EXPECT_EQ(messages.glove.channel_flag[i], glove_state_t::UNOBSERVABLE);
  }
  for (int i = 0; i < 26; ++i) {
    EXPECT_TRUE(std::isnan(messages.joints.position[i][0]) && std::isnan(messages.joints.orientation[i][0]));
    EXPECT_EQ(messages.joints.flags[i], 0);
  }
}

TEST_F(HandMessagesTest, EqualEstimatesGiveEqualBytes) {
  HandMessageMaker other{{}};
  for (const TrackStatus status :
       {TrackStatus::searching, TrackStatus::tracking, TrackStatus::tracking, TrackStatus::lost}) {
    const int frame = static_cast<int>(status);
    const HandMessages a = maker_.process(estimate(frame, status)), b = other.process(estimate(frame, status));
    EXPECT_EQ(bytes_of(a.state), bytes_of(b.state));
    EXPECT_EQ(bytes_of(a.glove), bytes_of(b.glove));
    EXPECT_EQ(bytes_of(a.joints), bytes_of(b.joints));
  }
}

TEST(HealthMessage, CarriesStagesAndQueues) {
  PipelineHealth health;
  health.captured = 10;
  health.dropped = 2;
  health.skipped = 1;
  health.latency.p95 = 0.02;
  health.stages.push_back({"fusion", {7, 0.001, 0.002, 0.003, 0.004, 0.005}, 3});
  health.queues.push_back({"input", 4, 1, 10, 7, 2, {}});
  const health_t m = health_message(health, 77, "lcm");
  EXPECT_EQ(m.utime, 77);
  EXPECT_EQ(m.source, "lcm");
  EXPECT_EQ(m.captured, 10);
  EXPECT_EQ(m.dropped, 2);
  EXPECT_EQ(m.skipped, 1);
  EXPECT_EQ(m.latency_p95, 0.02);
  ASSERT_EQ(m.n_stages, 1);
  EXPECT_EQ(m.stages[0].name, "fusion");
  EXPECT_EQ(m.stages[0].p99, 0.004);
  EXPECT_EQ(m.stages[0].failed, 3);
  ASSERT_EQ(m.n_queues, 1);
  EXPECT_EQ(m.queues[0].capacity, 4);
  EXPECT_EQ(m.queues[0].depth, 1);
  EXPECT_EQ(m.queues[0].dropped, 2);
}

}  // namespace
}  // namespace barehand
