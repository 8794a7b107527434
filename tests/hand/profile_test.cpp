#include "hand/profile.h"

#include <gtest/gtest.h>

#include "hand/joint_angles.h"

namespace barehand {
namespace {

HandProfile right_index() {
  HandProfile profile;
  SegmentProfile& segment = profile.segments[4];
  segment.T_hand_segment = {exp_so3({0.1, 0.2, 0.3}), {-0.02, 0.01, -0.09}};
  segment.length = 0.04;
  segment.distal = {0.001, 0, -0.04};
  segment.flesh_offset_x = {0.002, -0.001};
  segment.dofs = {{"index_mcp_abd", Eigen::Vector3d::UnitY(), -0.2, 0.4},
                  {"index_mcp_flex", -Eigen::Vector3d::UnitX(), -0.5, 1.5}};
  return profile;
}

TEST(Mirrored, ReflectsEveryPointOfThePosedFinger) {
  const HandProfile right = right_index(), left = mirrored(right);
  EXPECT_EQ(left.handedness, Handedness::left);
  const auto posed = [](const HandProfile& profile) {  // both joints are bent by the same angles about their own axes
    const SegmentProfile& s = profile.segments[4];
    return SE3{s.T_hand_segment.R * exp_so3(0.3 * s.dofs[0].axis) * exp_so3(0.8 * s.dofs[1].axis), s.T_hand_segment.t};
  };
  const Eigen::Vector3d tip = posed(right) * right.segments[4].distal;
  EXPECT_TRUE((posed(left) * left.segments[4].distal).isApprox(tip.cwiseProduct(Eigen::Vector3d(-1, 1, 1)), 1e-12));
  EXPECT_GT(left.segments[4].T_hand_segment.R.determinant(), 0.99);
  EXPECT_DOUBLE_EQ(left.segments[4].flesh_offset_x[0], -0.002);
}

TEST(Mirrored, FlexionKeepsItsSignAndAbductionTurnsAround) {
  const auto limits = widened_limits(mirrored(right_index()), 0);
  EXPECT_DOUBLE_EQ(limits[4].flexion_hi, 1.5);
  EXPECT_DOUBLE_EQ(limits[4].abduction_lo, -0.4);
  EXPECT_DOUBLE_EQ(limits[4].abduction_hi, 0.2);
}

TEST(Mirrored, TwiceIsTheSameHand) {
  const HandProfile right = right_index(), twice = mirrored(mirrored(right));
  EXPECT_EQ(twice.handedness, Handedness::right);
  EXPECT_TRUE(twice.segments[4].T_hand_segment.matrix().isApprox(right.segments[4].T_hand_segment.matrix(), 1e-15));
  EXPECT_TRUE(twice.segments[4].dofs[0].axis.isApprox(right.segments[4].dofs[0].axis));
}

}  // namespace
}  // namespace barehand
