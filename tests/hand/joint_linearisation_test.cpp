#include "hand/joint_linearisation.h"

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

// Largest difference between the analytic derivative of the angles and central differences.
double angle_derivative_error(const HandProfile& profile, const HandPose& pose, int segment, const Eigen::Matrix3d& d) {
  constexpr double h = 1e-6;
  const JointLinearisation joint = linearise_joint(profile, pose, segment);
  double worst = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto angles_at = [&](double step) {
      HandPose moved = pose;
      Vector6d twist = Vector6d::Zero();
      twist.tail<3>() = joint.R_camera_joint.col(axis) * step;
      moved[segment] = boxplus(moved[segment], twist);
      const JointAngles a = linearise_joint(profile, moved, segment).angles;
      return Vector3d(a.flexion, a.abduction, a.twist);
    };
    const Vector3d numeric = (angles_at(h) - angles_at(-h)) / (2 * h);
    worst = std::max(worst, (numeric - d.col(axis)).cwiseAbs().maxCoeff());
  }
  return worst;
}

TEST(JointLinearisation, AngleDerivativeMatchesCentralDifferences) {
  const auto profile = test::adult_hand();
  const HandPose pose = bent_pose(*profile);
  for (int s = 1; s < kSegmentCount; ++s)
    EXPECT_LT(angle_derivative_error(*profile, pose, s, linearise_joint(*profile, pose, s).d_angles), 1e-6) << s;
}

TEST(JointLinearisation, TheCheckRejectsASwappedRow) {
  const auto profile = test::adult_hand();
  const HandPose pose = bent_pose(*profile);
  Eigen::Matrix3d wrong = linearise_joint(*profile, pose, 4).d_angles;
  wrong.row(0).swap(wrong.row(2));
  EXPECT_GT(angle_derivative_error(*profile, pose, 4, wrong), 0.1);
}

TEST(JointLinearisation, GapIsZeroInAnArticulatedPose) {
  const auto profile = test::adult_hand();
  const HandPose pose = test::facing_pose(*profile, 0.5);
  for (int s = 1; s < kSegmentCount; ++s) EXPECT_LT(linearise_joint(*profile, pose, s).gap.norm(), 1e-12);
}

}  // namespace
}  // namespace barehand
