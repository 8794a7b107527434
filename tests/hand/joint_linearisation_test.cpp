#include "hand/joint_linearisation.h"

#include <functional>

#include "support/adult_hand.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

HandPose bent_pose(const HandProfile& profile) {
  std::array<JointAngles, kSegmentCount> angles{};
  for (int s = 1; s < kSegmentCount; ++s) angles[s] = {0.3 + 0.08 * s, 0.15 - 0.02 * s, 0.05};
  HandPose pose = forward_kinematics(profile, {exp_so3({0.4, -1, 0.7}), {0.1, 0, 0.6}}, angles);
  for (int s = 1; s < kSegmentCount; ++s) pose[s].t += Vector3d(0.001, -0.002, 0.0005 * s);
  return pose;
}

// A quantity of a joint as a vector, evaluated in a pose near the one at which the joint was linearised.
using Quantity = std::function<Vector3d(const JointLinearisation&)>;

Vector3d gap(const JointLinearisation& joint) { return joint.gap; }
Vector3d angles(const JointLinearisation& joint) {
  return {joint.angles.flexion, joint.angles.abduction, joint.angles.twist};
}
Quantity turn_from(const JointLinearisation& joint) {
  return [R = joint.R_joint_segment](const JointLinearisation& moved) {
    return log_so3(moved.R_joint_segment * R.transpose());
  };
}

class JointJacobiansTest : public ::testing::Test {
 protected:
  /// Largest difference between J and central differences.
  double error(int segment, const Quantity& quantity, const JointJacobians& J) const {
    constexpr double h = 1e-6;
    const auto moved = [&](int body, int axis, double step) {
      HandPose pose = pose_;
      pose[body] = boxplus(pose[body], Vector6d::Unit(axis) * step);
      return quantity(linearise_joint(*profile_, pose, segment));
    };

    // Compare every column, for the segment and for its parent.
    double worst = 0;
    for (int axis = 0; axis < 6; ++axis) {
      const auto numeric = [&](int body) { return ((moved(body, axis, h) - moved(body, axis, -h)) / (2 * h)).eval(); };
      worst = std::max({worst, (numeric(segment) - J.child.col(axis)).cwiseAbs().maxCoeff(),
                        (numeric(parent_of(segment)) - J.parent.col(axis)).cwiseAbs().maxCoeff()});
    }
    return worst;
  }

  const std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  const HandPose pose_ = bent_pose(*profile_);
};

TEST_F(JointJacobiansTest, MatchCentralDifferences) {
  for (int s = 1; s < kSegmentCount; ++s) {
    const JointLinearisation joint = linearise_joint(*profile_, pose_, s);
    EXPECT_LT(error(s, gap, joint.of_gap()), 1e-6) << s;
    EXPECT_LT(error(s, turn_from(joint), joint.of_turn()), 1e-6) << s;
    EXPECT_LT(error(s, angles, joint.of_angles()), 1e-6) << s;
  }
}

TEST_F(JointJacobiansTest, TheCheckRejectsWrongOnes) {
  JointLinearisation joint = linearise_joint(*profile_, pose_, 4);
  JointJacobians swapped = joint.of_gap();
  swapped.child.swap(swapped.parent);
  EXPECT_GT(error(4, gap, swapped), 0.1);
  EXPECT_GT(error(4, angles, joint.of_turn()), 0.1);
  joint.lever *= 0.5;
  EXPECT_GT(error(4, gap, joint.of_gap()), 0.01);
  joint.d_angles.row(0).swap(joint.d_angles.row(2));
  EXPECT_GT(error(4, angles, joint.of_angles()), 0.1);
}

TEST(JointLinearisation, GapIsZeroInAnArticulatedPose) {
  const auto profile = test::adult_hand();
  const HandPose pose = test::facing_pose(*profile, 0.5);
  for (int s = 1; s < kSegmentCount; ++s) EXPECT_LT(linearise_joint(*profile, pose, s).gap.norm(), 1e-12);
}

}  // namespace
}  // namespace barehand
