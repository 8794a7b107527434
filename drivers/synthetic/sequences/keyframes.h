#pragma once

#include <vector>

#include "drivers/synthetic/hand/skeleton.h"

namespace barehand::synthetic {

/// A smooth curve through keys: monotone cubic interpolation (Fritsch and Carlson 1980) in every component. The curve
/// overshoots no key, and a value that is equal in two neighbouring keys stays constant between them. It is constant
/// before the first and after the last key.
class SmoothTrack {
 public:
  /// `times` must rise strictly, and all keys must have the same number of values.
  SmoothTrack(std::vector<double> times, std::vector<std::vector<double>> values);
  /// The values at this time.
  std::vector<double> at(double time) const;

 private:
  std::vector<double> times_;
  std::vector<std::vector<double>> values_, slopes_;
};

/// The state of the hand at one time.
struct HandKey {
  double time = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< wrist [m]
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rotation vector, applied to the base orientation of the track
  HandAngles angles;
};

/// The pose of the animated hand as a function of time.
class HandTrack {
 public:
  /// The pose of the wrist is {exp(turn) base, position}, in the frame of the keys.
  HandTrack(const Eigen::Matrix3d& base, const std::vector<HandKey>& keys);
  /// The pose at this time [s].
  SkeletonPose at(double time) const;

 private:
  Eigen::Matrix3d base_;
  SmoothTrack track_;
};

/// Adds the slow drift of a hand held in the air to all 26 degrees of freedom, up to about 1.5 mm and 1.5 degrees.
SkeletonPose with_tremor(const SkeletonPose& pose, double time, std::uint64_t seed);

}  // namespace barehand::synthetic
