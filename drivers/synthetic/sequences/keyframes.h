#pragma once

#include <vector>

#include "drivers/synthetic/hand/skeleton.h"

namespace barehand::synthetic {

/// A smooth curve through keyframes: monotone cubic interpolation (Fritsch and Carlson 1980) of every component. The
/// curve overshoots no key, and a value that is equal in two neighbouring keys stays constant between them. It is
/// constant before the first and after the last key.
class SmoothTrack {
 public:
  /// `times` [s] must increase strictly, and all keys must have the same number of values.
  SmoothTrack(std::vector<double> times, std::vector<std::vector<double>> values);
  /// The values at this time [s].
  std::vector<double> at(double time) const;

 private:
  std::vector<double> times_;
  std::vector<std::vector<double>> values_, slopes_;
};

/// A keyframe of the hand.
struct HandKey {
  double time = 0;                                     ///< time of the keyframe [s]
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position of the wrist [m]
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rotation vector, applied to the base orientation of the track
  HandAngles angles;
};

/// The pose of the animated hand as a function of time.
class HandTrack {
 public:
  /// The pose of the wrist is {exp(turn) base, position}, in the frame in which the keys are given.
  HandTrack(const Eigen::Matrix3d& base, const std::vector<HandKey>& keys);
  /// The pose at this time [s].
  SkeletonPose at(double time) const;

 private:
  Eigen::Matrix3d base_;
  SmoothTrack track_;
};

/// Adds the slow drift of a hand held in the air to all 26 degrees of freedom: up to about 1.5 mm and 1.5 degrees each.
SkeletonPose with_tremor(const SkeletonPose& pose, double time, std::uint64_t seed);

}  // namespace barehand::synthetic
