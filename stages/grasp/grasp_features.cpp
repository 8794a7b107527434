// Computes, from the pose of a hand, the features by which grasps are classified.
#include "stages/grasp/grasp_features.h"

#include <algorithm>
#include <cmath>

#include "hand/joint_angles.h"
#include "math/angles.h"

namespace barehand {
namespace {

using Eigen::Vector3d;

constexpr int kThumb = 0, kIndex = 1, kMiddle = 2;
constexpr double kFullFlexion = 285 * kDegree;  // sum over knuckle, PIP and DIP joint of a closed finger [rad]

/// The part of a pose on which the features depend.
struct Shape {
  HandPose pose;
  std::array<Vector3d, kFingerCount> tips;
};

/// The angles between a segment and its parent, which are 0 where their frames agree.
JointAngles angles_between(const HandPose& pose, int segment) {
  return joint_angles(pose[parent_of(segment)].R.transpose() * pose[segment].R);
}

/// Calculates the features of a right hand.
Eigen::Matrix<double, kGraspFeatureCount, 1> values_of(const Shape& shape, double side) {
  Eigen::Matrix<double, kGraspFeatureCount, 1> values;
  int next = 0;
  const auto add = [&](double value) { values[next++] = value; };
  const auto add_vector = [&](const Vector3d& v) {
    add(side * v.x());
    add(v.y());
    add(v.z());
  };

  // Measure lengths as fractions of the palm's length, so that they do not depend on the size of the hand.
  const HandPose& pose = shape.pose;
  const SE3& palm = pose[kPalm];
  const double size = (pose[segment_of(kMiddle, 0)].t - palm.t).norm();

  // Joints.
  const Eigen::Matrix3d R_palm_thumb = palm.R.transpose() * pose[segment_of(kThumb, 0)].R;
  add_vector(-R_palm_thumb.col(2));
  add_vector(R_palm_thumb.col(1));
  for (int finger = kThumb; finger < kFingerCount; ++finger)
    for (int k = finger == kThumb ? 1 : 0; k < 3; ++k) {
      const JointAngles angles = angles_between(pose, segment_of(finger, k));
      add(angles.flexion);
      if (k == (finger == kThumb ? 1 : 0)) add(side * angles.abduction);
    }

  // Fingertips.
  const Vector3d hollow = palm * Vector3d(0, -0.2 * size, -0.75 * size);
  for (int a = 0; a < kFingerCount; ++a)
    for (int b = a + 1; b < kFingerCount; ++b) add((shape.tips[a] - shape.tips[b]).norm() / size);
  for (const Vector3d& tip : shape.tips) add((tip - hollow).norm() / size);

  // The thumb and the fingers that it may oppose.
  const Vector3d& thumb = shape.tips[kThumb];
  for (int finger = kIndex; finger < kFingerCount; ++finger) add((thumb - pose[segment_of(finger, 1)].t).norm() / size);
  for (const int finger : {kIndex, kMiddle}) add_vector(pose[segment_of(finger, 1)].inverse() * thumb / size);
  for (const int finger : {kIndex, kMiddle})
    add(pose[segment_of(kThumb, 2)].R.col(1).dot(pose[segment_of(finger, 2)].R.col(1)));
  return values;
}

/// Standard deviation of the angle of a segment against its parent about an axis (camera frame) [rad].
double deviation_about(const HandEstimate& estimate, int segment, const Vector3d& axis) {
  const auto rotation = [&](int s) { return estimate.segments[s].covariance.bottomRightCorner<3, 3>(); };
  const double variance = axis.dot((rotation(segment) - rotation(parent_of(segment))) * axis);
  return variance > 0 ? std::sqrt(variance) : 0;
}

/// What the palm and the fingers touch. The thumb's metacarpal is part of the ball of the thumb, not of the finger.
std::array<PartTouch, kGraspPartCount> touches_of(const SegmentContacts& objects) {
  std::array<PartTouch, kGraspPartCount> touches{};
  for (int s = 0; s < kSegmentCount; ++s) {
    if (s == segment_of(kThumb, 0) || objects[s].state == ContactState::unknown) continue;
    PartTouch& part = touches[static_cast<std::size_t>(s == kPalm ? 0 : 1 + finger_of(s))];
    part = std::max(part, objects[s].state == ContactState::touching ? PartTouch::touching : PartTouch::apart);
  }
  return touches;
}

Shape shape_of(const HandEstimate& estimate) {
  Shape shape{pose_of(estimate.segments), {}};
  for (int finger = 0; finger < kFingerCount; ++finger)
    shape.tips[finger] = distal_end(*estimate.profile, shape.pose, segment_of(finger, 2));
  return shape;
}

}  // namespace

GraspFeatures grasp_features(const HandEstimate& estimate, const SegmentContacts* objects) {
  const Shape shape = shape_of(estimate);
  GraspFeatures features;
  features.values = values_of(shape, side_sign(estimate.handedness));

  // Find how well each joint is known about each of its axes.
  int next = 0;
  for (int finger = 0; finger < kFingerCount; ++finger)
    for (int k = 0; k < 3; ++k) {
      const int segment = segment_of(finger, k);
      const Eigen::Matrix3d& R = shape.pose[segment].R;
      features.deviations[next++] = deviation_about(estimate, segment, R.col(0));
      const bool abducts = k == 0 || (finger == kThumb && k == 1);
      if (!abducts) continue;
      const Vector3d abduction = finger == kThumb ? R.col(1) : shape.pose[kPalm].R.col(1);
      features.deviations[next++] = deviation_about(estimate, segment, abduction);
    }

  // Find what touches.
  if (objects) features.touches = touches_of(*objects);
  return features;
}

GraspOpening grasp_opening(const HandEstimate& estimate, int first_finger, int last_finger) {
  const Shape shape = shape_of(estimate);
  Vector3d middle = Vector3d::Zero();
  for (int finger = first_finger - 1; finger < last_finger; ++finger) middle += shape.tips[finger];
  middle /= last_finger - first_finger + 1;

  double flexion = 0;
  for (int finger = kIndex; finger < kFingerCount; ++finger)
    for (int k = 0; k < 3; ++k) flexion += angles_between(shape.pose, segment_of(finger, k)).flexion;
  return {(shape.tips[kThumb] - middle).norm(), std::clamp(flexion / 4 / kFullFlexion, 0.0, 1.0)};
}

}  // namespace barehand
