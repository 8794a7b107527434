#include "hand/joint_angles.h"

#include <gtest/gtest.h>

namespace barehand {
namespace {

TEST(JointAngles, DecompositionInvertsRotationPastNinetyDegreesOfFlexion) {
  for (double flexion : {-1.0, 0.0, 0.7, 1.5708, 2.4})
    for (double abduction : {-0.5, 0.0, 0.4})
      for (double twist : {-0.3, 0.0, 0.2}) {
        const JointAngles a = joint_angles(joint_rotation({flexion, abduction, twist}));
        EXPECT_NEAR(a.flexion, flexion, 1e-9);
        EXPECT_NEAR(a.abduction, abduction, 1e-9);
        EXPECT_NEAR(a.twist, twist, 1e-9);
      }
}

TEST(JointAngles, FlexionTurnsTheBoneTowardsThePalmSide) {
  // The bone points along -z, and the palm's side is -y.
  const Eigen::Vector3d bone = joint_rotation({0.5, 0, 0}) * -Eigen::Vector3d::UnitZ();
  EXPECT_LT(bone.y(), -0.4);
}

TEST(WidenedLimits, FollowTheAxisSign) {
  HandProfile profile;
  profile.segments[4].dofs = {{"index_mcp_abd", Eigen::Vector3d::UnitY(), -0.1, 0.3},
                              {"index_mcp_flex", Eigen::Vector3d::UnitX(), -1.5, 0.2}};
  const auto limits = widened_limits(profile, 0.05);
  EXPECT_NEAR(limits[4].abduction_lo, -0.15, 1e-12);
  EXPECT_NEAR(limits[4].abduction_hi, 0.35, 1e-12);
  EXPECT_NEAR(limits[4].flexion_lo, -0.25, 1e-12);
  EXPECT_NEAR(limits[4].flexion_hi, 1.55, 1e-12);
}

}  // namespace
}  // namespace barehand
