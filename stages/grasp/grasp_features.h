#pragma once

#include "hand/hand_pose.h"

namespace barehand {

/// Features by which grasps are classified. They depend neither on the size of the hand, nor on the side, nor on where
/// it is: a left hand is mirrored, and lengths are divided by the distance from the wrist to the middle finger's
/// knuckle.
inline constexpr int kGraspFeatureCount = 52;
/// Angles of joints on whose errors those of the features depend: 5 of the thumb, 4 of each finger.
inline constexpr int kGraspAngleCount = 21;

/// The features of one pose.
struct GraspFeatures {
  /// In this order:
  ///  0..5   thumb metacarpal in the palm's frame: direction of the bone (3), of its back (3)
  ///  6..8   thumb: flexion and abduction of the MCP joint, flexion of the IP joint [rad]
  ///  9..24  index to little: flexion and abduction at the knuckle, flexion of the PIP and DIP joints [rad]
  /// 25..34  distances of the fingertips: thumb from index to little, index from middle to little, and so on
  /// 35..39  distances of the fingertips, thumb to little, from the hollow of the palm
  /// 40..43  distances of the thumb's tip from the PIP joints, index to little
  /// 44..49  the thumb's tip in the frames of the intermediate phalanges of index (3) and middle finger (3)
  /// 50..51  cosine between the pads of the thumb and of the index and the middle finger; -1: they face each other
  Eigen::Matrix<double, kGraspFeatureCount, 1> values;
  /// Column k is the change of the features by one standard deviation of joint angle k, so that their covariance is
  /// spread * spread'.
  Eigen::Matrix<double, kGraspFeatureCount, kGraspAngleCount> spread;
};

/// The features of an estimate with a pose, and what its covariance says about their errors. The errors of the joints
/// are assumed to be independent; the variance of a joint's angle is that of its segment minus that of
/// the segment's parent.
GraspFeatures grasp_features(const HandEstimate& estimate);

/// How far the hand is open and closed.
struct GraspOpening {
  /// Distance from the thumb's tip to the mean of the tips of `first_finger` .. `last_finger` (2: index, 5: little)
  /// [m].
  double aperture;
  /// Mean flexion of the fingers 2 to 5 over their whole range: 0 flat, 1 fist.
  double closure;
};
GraspOpening grasp_opening(const HandEstimate& estimate, int first_finger, int last_finger);

}  // namespace barehand
