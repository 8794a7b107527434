#pragma once

#include <array>
#include <optional>

#include "hand/contacts.h"
#include "hand/hand_pose.h"

namespace barehand {

/// Features by which grasps are classified. They depend neither on the size of the hand, nor on the side, nor on where
/// it is: a left hand is mirrored, and lengths are divided by the distance from the wrist to the middle finger's
/// knuckle.
inline constexpr int kGraspFeatureCount = 52;
/// Angles of joints on whose errors those of the features depend: 5 of the thumb, 4 of each finger.
inline constexpr int kGraspAngleCount = 21;
/// Parts of the hand that may touch an object: the palm, and the five fingers from the thumb on.
inline constexpr int kGraspPartCount = 1 + kFingerCount;

/// Whether a part of the hand touches an object. unknown: that is not known of any of its segments.
enum class PartTouch : std::int8_t { unknown = 0, apart = 1, touching = 2 };

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
  /// Standard deviations of the joint angles [rad], finger by finger from the thumb on and from the palm to the tip;
  /// the flexion of a joint comes before its abduction.
  Eigen::Matrix<double, kGraspAngleCount, 1> deviations;
  /// What touches an object. Empty: contacts were not looked for.
  std::optional<std::array<PartTouch, kGraspPartCount>> touches;
};

/// The features of an estimate with a pose. The variance of a joint's angle is that of its segment minus that of the
/// segment's parent. `objects`: what the segments touch; null: contacts were not looked for.
GraspFeatures grasp_features(const HandEstimate& estimate, const SegmentContacts* objects);

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
