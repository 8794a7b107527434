#include "stages/prediction/motion_prediction.h"

#include <gtest/gtest.h>

#include "stages/search/start_templates.h"
#include "support/point_world.h"

namespace barehand {
namespace {

constexpr std::int64_t kFrameUs = 33333;
constexpr int kIndexTip = 6;

const StartPose* find(const Prediction& prediction, const std::string& name) {
  for (const StartPose& candidate : prediction.candidates) {
    if (candidate.name == name) return &candidate;
  }
  return nullptr;
}

/// Predicts without ICP, to test the rules of the velocity alone. The observations contain only a sufficient number of
/// points.
class VelocityRules : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(profile_);
    surface_ = make_cylinder_surface(*profile_, 100);
    icp_.enabled = false;
    params_.damping = 1;
    seen_.fill(true);
    first_ = forward_kinematics(*profile_, {palm_orientation(0, 0, 0), {0, 0.08, 0.4}}, {});
  }
  HandObservation observation(std::int64_t utime) const {
    auto frame = std::make_shared<RgbdFrame>();
    frame->utime = utime;
    frame->camera = test::small_camera();
    HandObservation o;
    o.frame = frame;
    for (int i = 0; i < 300; ++i) o.cloud.emplace_back(0.001f * (i % 20), 0.001f * (i / 20), 0.4f);
    return o;
  }
  /// Processes two frames and predicts the third.
  Prediction third(const HandPose& second, std::int64_t interval, std::int64_t next_interval) {
    MotionModel model(params_, icp_);
    model.restart(first_, 0);
    const Prediction before = model.predict(observation(interval), surface_);
    model.update(second, seen_, before);
    return model.predict(observation(interval + next_interval), surface_);
  }
  HandPose with_tip_moved(double x) const {
    HandPose pose = first_;
    pose[kIndexTip].t.x() += x;
    return pose;
  }
  double predicted_tip_step(const HandPose& second, std::int64_t interval, std::int64_t next_interval) {
    const Prediction prediction = third(second, interval, next_interval);
    return find(prediction, "velocity")->pose[kIndexTip].t.x() - second[kIndexTip].t.x();
  }

  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  HandSurface surface_;
  HandPose first_;
  PredictionParams params_;
  IcpParams icp_;
  std::array<bool, kSegmentCount> seen_{};
};

TEST_F(VelocityRules, ASeenSegmentKeepsItsVelocity) {
  EXPECT_NEAR(predicted_tip_step(with_tip_moved(0.002), kFrameUs, kFrameUs), 0.002, 1e-6);
  params_.damping = 0.5;
  EXPECT_NEAR(predicted_tip_step(with_tip_moved(0.002), kFrameUs, kFrameUs), 0.001, 1e-6);
}

TEST_F(VelocityRules, VelocityScalesWithTheInterval) {
  EXPECT_NEAR(predicted_tip_step(with_tip_moved(0.002), kFrameUs, 2 * kFrameUs), 0.004, 1e-6);
}

TEST_F(VelocityRules, AnUnseenSegmentHoldsAtSensorRate) {
  seen_[kIndexTip] = false;
  EXPECT_NEAR(predicted_tip_step(with_tip_moved(0.002), kFrameUs, kFrameUs), 0, 1e-6);
}

TEST_F(VelocityRules, AnUnseenSegmentKeepsPartOfItsRotationAtLowRate) {
  seen_[kIndexTip] = false;
  params_.slow_unseen_damping = 0.5;
  HandPose second = first_;
  second[kIndexTip].R = exp_so3({0.2, 0, 0}) * second[kIndexTip].R;
  const auto turned = [&](std::int64_t interval) {
    const Prediction prediction = third(second, interval, interval);
    return log_so3(find(prediction, "velocity")->pose[kIndexTip].R * second[kIndexTip].R.transpose()).norm();
  };
  EXPECT_NEAR(turned(4 * kFrameUs), 0.1, 1e-6);
  EXPECT_NEAR(turned(kFrameUs), 0, 1e-6);
}

TEST_F(VelocityRules, AnUnseenSegmentStaysOnTheJointOfAMovingParent) {
  seen_[kIndexTip] = false;
  HandPose second = first_;
  for (const int s : {kIndexTip - 1, kIndexTip}) second[s].t.x() += 0.002;
  EXPECT_NEAR(predicted_tip_step(second, kFrameUs, kFrameUs), 0.002, 1e-6);
}

TEST_F(VelocityRules, GlobalMotionIsAppliedOnce) {
  const SE3 motion{exp_so3({0, 0, 0.1}), {0.01, 0, 0}};
  const HandPose second = moved(motion, first_);
  const Prediction prediction = third(second, kFrameUs, kFrameUs);
  const HandPose expected =
      moved(boxplus(second[kPalm], boxminus(second[kPalm], first_[kPalm])) * second[kPalm].inverse(), second);
  EXPECT_LT(test::mean_error(*profile_, find(prediction, "velocity")->pose, expected), 1e-4);
}

TEST_F(VelocityRules, VelocityIsForgottenAfterALongGap) {
  EXPECT_NEAR(predicted_tip_step(with_tip_moved(0.002), kFrameUs, 1000000), 0, 1e-9);
}

TEST_F(VelocityRules, EqualStampsAreAStandstill) {
  const Prediction prediction = third(with_tip_moved(0.002), kFrameUs, 0);
  EXPECT_EQ(prediction.dt, 0);
  EXPECT_NEAR(find(prediction, "velocity")->pose[kIndexTip].t.x(), with_tip_moved(0.002)[kIndexTip].t.x(), 1e-12);
}

TEST_F(VelocityRules, ImpossibleVelocityIsBounded) {
  params_.max_speed = 0.3;
  EXPECT_NEAR(predicted_tip_step(with_tip_moved(0.1), kFrameUs, kFrameUs), 0.3 * kFrameUs * 1e-6, 1e-6);
}

TEST_F(VelocityRules, WithFewPointsThePoseIsHeld) {
  MotionModel model(params_, icp_);
  model.restart(first_, 0);
  HandObservation empty = observation(kFrameUs);
  empty.cloud.resize(10);
  const Prediction prediction = model.predict(empty, surface_);
  ASSERT_EQ(prediction.candidates.size(), 1u);
  EXPECT_EQ(prediction.candidates[0].name, "held");
  EXPECT_LT(test::mean_error(*profile_, prediction.primary(), first_), 1e-12);
}

TEST(MotionModel, FollowsASteadyHandWithIcp) {
  const auto profile = test::adult_hand();
  ASSERT_TRUE(profile);
  const test::PointWorld world(*profile);
  const HandSurface surface = make_cylinder_surface(*profile, 300);
  const SE3 motion{exp_so3({0, 0, 0.05}), {0.02, 0.0, 0.005}};
  std::array<bool, kSegmentCount> seen;
  seen.fill(true);
  HandPose truth = forward_kinematics(*profile, {palm_orientation(0.2, 0.2, 0.1), {-0.02, 0.05, 0.4}}, {});
  MotionModel model({}, {});
  model.restart(truth, 0);
  for (int i = 1; i <= 3; ++i) {
    truth = moved(motion, truth);
    const Prediction prediction = model.predict(*world.observe(truth, i * kFrameUs), surface);
    ASSERT_TRUE(prediction.icp.reliable);
    EXPECT_EQ(prediction.candidates[0].name, "icp_velocity");
    for (const char* name : {"icp", "velocity", "held"}) EXPECT_TRUE(find(prediction, name)) << name;
    EXPECT_LT(test::mean_error(*profile, prediction.primary(), truth), 0.004);
    EXPECT_GT(test::mean_error(*profile, find(prediction, "held")->pose, truth), 0.015);
    model.update(truth, seen, prediction);
  }
}

}  // namespace
}  // namespace barehand
