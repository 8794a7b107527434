#include "stages/search/cut_hand.h"

#include <algorithm>

#include "stages/search/inverse_kinematics.h"
#include "support/rendered_person.h"

namespace barehand {
namespace {

class CutHandTest : public ::testing::Test {
 protected:
  DetectedJoints joints_of(const HandPose& pose) const {
    DetectedJoints joints;
    const auto points = test::landmarks(*profile_, pose);
    for (int k = 0; k < kLandmarkCount; ++k)
      joints[k] = {.position = points[k], .covariance = 1e-5 * Eigen::Matrix3d::Identity()};
    return joints;
  }
  // Largest distance of the ends of the segments of one finger in two poses [m].
  double distance(const HandPose& a, const HandPose& b, int finger) const {
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
      const int s = segment_of(finger, k);
      largest = std::max(largest, (distal_end(*profile_, a, s) - distal_end(*profile_, b, s)).norm());
    }
    return largest;
  }
  // Smallest such distance from the poses of all other joints that would look similar.
  double nearest(const DetectedJoints& reported, int finger) const {
    double smallest = 1;
    for (const DetectedJoints& joints : with_fingers_moved(reported)) {
      const auto fit = fit_to_joints(*profile_, joints);
      if (fit) smallest = std::min(smallest, distance(fit->pose, truth_, finger));
    }
    return smallest;
  }
  std::shared_ptr<const HandProfile> profile_ = test::adult_hand();
  HandPose truth_ = test::facing_pose(*profile_, 0.5);
};

TEST_F(CutHandTest, AHandNearTheBorderMayBeCut) {
  const DetectedJoints joints = joints_of(truth_);
  double right = 0, top = 1000;
  const Intrinsics wide{640, 480, 500, 500, 319.5, 239.5};
  for (const DetectedJoint& joint : joints) {
    right = std::max(right, wide.project(joint.position).x());
    top = std::min(top, wide.project(joint.position).y());
  }
  EXPECT_FALSE(cut_by_border(joints, wide));

  // 2 cm at 0.5 m are 20 pixels.
  Intrinsics camera = wide;
  camera.width = static_cast<int>(right) + 25;
  EXPECT_FALSE(cut_by_border(joints, camera));
  camera.width = static_cast<int>(right) + 15;
  EXPECT_TRUE(cut_by_border(joints, camera));
  camera.width = static_cast<int>(right) - 15;
  EXPECT_TRUE(cut_by_border(joints, camera));
  camera = wide;
  camera.cy -= top - 10;
  EXPECT_TRUE(cut_by_border(joints, camera));
}

TEST_F(CutHandTest, AFingerThatIsTakenForItsNeighbourIsFound) {
  const DetectedJoints joints = joints_of(truth_);

  // The index finger is beyond the border, and the others are reported as their neighbours on the side of the thumb.
  DetectedJoints reported = joints;
  for (int finger = 1; finger < 4; ++finger)
    for (int k = 0; k < 4; ++k) reported[landmark_of(finger, k)] = joints[landmark_of(finger + 1, k)];
  for (int k = 0; k < 4; ++k) {
    DetectedJoint& joint = reported[landmark_of(4, k)];
    joint.position += joints[landmark_of(4, k)].position - joints[landmark_of(3, k)].position;
  }
  const auto fit = fit_to_joints(*profile_, reported);
  ASSERT_TRUE(fit);
  EXPECT_GT(distance(fit->pose, truth_, 2), 0.01) << "as reported";
  EXPECT_LT(nearest(reported, 2), 0.004);
  EXPECT_LT(nearest(reported, 3), 0.004);
}

TEST_F(CutHandTest, AThumbThatIsReportedBeforeThePalmMayBeBesideIt) {
  DetectedJoints reported = joints_of(truth_);
  for (int k = 1; k < 4; ++k)
    reported[landmark_of(0, k)].position = reported[kMiddleKnuckleLandmark].position - Eigen::Vector3d(0, 0, 0.02 * k);

  // How far the thumb's tip is beside the index finger's knuckle, away from the little finger's [m].
  const auto beside = [&](const HandPose& pose) {
    const Eigen::Vector3d little = pose[segment_of(4, 0)].t, index = pose[segment_of(1, 0)].t;
    return (distal_end(*profile_, pose, segment_of(0, 2)) - index).dot((index - little).normalized());
  };
  EXPECT_LT(beside(fit_to_joints(*profile_, reported)->pose), 0);
  double farthest = 0;
  for (const DetectedJoints& joints : with_fingers_moved(reported))
    farthest = std::max(farthest, beside(fit_to_joints(*profile_, joints)->pose));
  EXPECT_GT(farthest, 0.02);
}

}  // namespace
}  // namespace barehand
