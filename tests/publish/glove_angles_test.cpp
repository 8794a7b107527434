#include "stages/publish/glove_angles.h"

#include <cmath>

#include "barehand/glove_state_t.hpp"
#include "published_hand.h"

namespace barehand {
namespace {

using Channel = glove_state_t;

class Glove : public testing::TestWithParam<Handedness> {
 protected:
  GloveAngles measure(const Angles& angles) const {
    return glove_angles(profile_, forward_kinematics(profile_, somewhere(), angles));
  }
  /// Sign of an abduction towards the thumb: about +y for a right hand, about -y for a left one.
  double towards_thumb(double angle) const { return GetParam() == Handedness::right ? angle : -angle; }
  double joint(const GloveAngles& glove, std::string_view name) const {
    const auto at = std::find(kGloveJointNames.begin(), kGloveJointNames.end(), name);
    return glove.joint.at(static_cast<std::size_t>(at - kGloveJointNames.begin()));
  }
  HandProfile profile_ = *test::adult_hand(GetParam());
};

TEST_P(Glove, NamedJointsAreZeroAtRest) {
  const GloveAngles glove = measure({});
  for (std::size_t i = 0; i < kGloveJointCount; ++i) EXPECT_NEAR(glove.joint[i], 0, 1e-9) << kGloveJointNames[i];
}

TEST_P(Glove, EveryFlexionReachesItsJointAndChannel) {
  constexpr std::array<std::array<int, 3>, 5> kChannel = {
      {{-1, Channel::THUMB_MPJ, Channel::THUMB_IJ},
       {Channel::INDEX_MPJ, Channel::INDEX_PIJ, Channel::INDEX_DIJ},
       {Channel::MIDDLE_MPJ, Channel::MIDDLE_PIJ, Channel::MIDDLE_DIJ},
       {Channel::RING_MPJ, Channel::RING_PIJ, Channel::RING_DIJ},
       {Channel::PINKIE_MPJ, Channel::PINKIE_PIJ, Channel::PINKIE_DIJ}}};
  const std::array<std::array<const char*, 3>, 5> joints = {
      {{"thumb_cmc_flex", "thumb_mcp_flex", "thumb_ip_flex"},
       {"index_mcp_flex", "index_pip_flex", "index_dip_flex"},
       {"middle_mcp_flex", "middle_pip_flex", "middle_dip_flex"},
       {"ring_mcp_flex", "ring_pip_flex", "ring_dip_flex"},
       {"little_mcp_flex", "little_pip_flex", "little_dip_flex"}}};
  Angles angles{};
  for (int s = 1; s < kSegmentCount; ++s) angles[s].flexion = (10 + s) * kDegree;
  const GloveAngles glove = measure(angles);
  for (int finger = 0; finger < kFingerCount; ++finger) {
    for (int k = 0; k < 3; ++k) {
      const double expected = (10 + segment_of(finger, k)) * kDegree;
      EXPECT_NEAR(joint(glove, joints[finger][k]), expected, 1e-9) << joints[finger][k];
      if (kChannel[finger][k] < 0) continue;
      EXPECT_NEAR(glove.channel[kChannel[finger][k]], expected, 1e-9) << joints[finger][k];
    }
  }
}

// The adult hand's fingers point 4 degrees towards the thumb (index), then 2, 8 and 16 away from it.
TEST_P(Glove, SpreadAtRestIsTheFanOfTheFingers) {
  const GloveAngles glove = measure({});
  EXPECT_NEAR(glove.channel[Channel::MIDDLE_INDEX_AB], 6 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(glove.channel[Channel::RING_MIDDLE_AB], 6 * kDegree, 0.5 * kDegree);
  EXPECT_NEAR(glove.channel[Channel::PINKIE_RING_AB], 8 * kDegree, 0.5 * kDegree);
}

TEST_P(Glove, MovingOneFingerSidewaysChangesTheTwoAnglesBesideIt) {
  const GloveAngles rest = measure({});
  Angles angles{};
  angles[segment_of(2, 0)].abduction = towards_thumb(10 * kDegree);  // middle towards index
  const GloveAngles glove = measure(angles);
  const auto change = [&](int channel) { return glove.channel[channel] - rest.channel[channel]; };
  EXPECT_NEAR(change(Channel::MIDDLE_INDEX_AB), -10 * kDegree, 1e-9);
  EXPECT_NEAR(change(Channel::RING_MIDDLE_AB), 10 * kDegree, 1e-9);
  EXPECT_NEAR(change(Channel::PINKIE_RING_AB), 0, 1e-9);
  EXPECT_NEAR(joint(glove, "middle_mcp_abd"), 10 * kDegree, 1e-9);
}

TEST_P(Glove, AFistKeepsTheSpread) {
  Angles angles{};
  for (int s = segment_of(1, 0); s < kSegmentCount; ++s) angles[s].flexion = 90 * kDegree;
  EXPECT_NEAR(measure(angles).channel[Channel::RING_MIDDLE_AB], measure({}).channel[Channel::RING_MIDDLE_AB], 1e-9);
}

/// The pose with the thumb's metacarpal along a direction given in the palm's frame.
HandPose with_thumb_along(const HandProfile& profile, const Eigen::Vector3d& direction) {
  HandPose pose = forward_kinematics(profile, somewhere(), {});
  const Eigen::Vector3d now = -(pose[kPalm].R.transpose() * pose[segment_of(0, 0)].R.col(2));
  const auto turn = Eigen::Quaterniond::FromTwoVectors(now, direction).toRotationMatrix();
  pose[segment_of(0, 0)].R = pose[kPalm].R * turn * pose[kPalm].R.transpose() * pose[segment_of(0, 0)].R;
  return pose;
}

TEST_P(Glove, ThumbRotateTellsWhereTheThumbStandsAroundThePalm) {
  const double radial = towards_thumb(-1);  // the thumb's side is -x on a right hand
  const auto rotate = [&](const Eigen::Vector3d& direction) {
    return glove_angles(profile_, with_thumb_along(profile_, direction)).channel[Channel::THUMB_ROTATE];
  };
  EXPECT_NEAR(rotate({radial, 0, -1}), 0, 1e-9) << "beside the palm";
  EXPECT_NEAR(rotate({0, -1, -1}), 90 * kDegree, 1e-9) << "in front of the palm";
  EXPECT_NEAR(rotate({radial, 1, -1}), -45 * kDegree, 1e-9) << "behind it";
}

TEST_P(Glove, ThumbAbIsTheAngleToTheIndexMetacarpal) {
  const Eigen::Vector3d index = profile_.rest_relative(segment_of(1, 0)).t.normalized();
  const Eigen::Vector3d away = exp_so3(-35 * kDegree * Eigen::Vector3d::UnitX()) * index;
  const double apart = std::acos(away.dot(index));
  const GloveAngles glove = glove_angles(profile_, with_thumb_along(profile_, away));
  EXPECT_NEAR(glove.channel[Channel::THUMB_AB], apart, 1e-9);
  EXPECT_NEAR(glove_angles(profile_, with_thumb_along(profile_, index)).channel[Channel::THUMB_AB], 0, 1e-9);
}

TEST_P(Glove, WhatCannotBeObservedIsNotANumber) {
  const GloveAngles glove = measure({});
  for (int i = 0; i < kGloveChannelCount; ++i) {
    EXPECT_EQ(std::isnan(glove.channel[i]), i >= Channel::PALM_ARCH) << i;
    EXPECT_EQ(segments_of_channel(i).a < 0, i >= Channel::PALM_ARCH) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(BothHands, Glove, testing::Values(Handedness::right, Handedness::left),
                         [](const auto& info) { return std::string(to_string(info.param)); });

TEST(GloveSegments, AreTheTwoSidesOfTheJoint) {
  const auto expect = [](GloveSegments segments, std::string_view a, std::string_view b) {
    EXPECT_EQ(kSegmentNames[segments.a], a);
    EXPECT_EQ(kSegmentNames[segments.b], b);
  };
  expect(segments_of_joint(0), "palm", "thumb_metacarpal");
  expect(segments_of_joint(4), "thumb_proximal", "thumb_distal");
  expect(segments_of_joint(5), "palm", "index_proximal");
  expect(segments_of_joint(6), "palm", "index_proximal");
  expect(segments_of_joint(20), "little_intermediate", "little_distal");
  expect(segments_of_channel(Channel::THUMB_MPJ), "thumb_metacarpal", "thumb_proximal");
  expect(segments_of_channel(Channel::THUMB_AB), "palm", "thumb_metacarpal");
  expect(segments_of_channel(Channel::INDEX_DIJ), "index_intermediate", "index_distal");
  expect(segments_of_channel(Channel::MIDDLE_MPJ), "palm", "middle_proximal");
  expect(segments_of_channel(Channel::MIDDLE_INDEX_AB), "index_proximal", "middle_proximal");
  expect(segments_of_channel(Channel::PINKIE_RING_AB), "ring_proximal", "little_proximal");
}

}  // namespace
}  // namespace barehand
