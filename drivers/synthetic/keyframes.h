#pragma once

#include <vector>

#include "drivers/synthetic/skeleton.h"

namespace barehand::synthetic {

/// Smooth curve through keys: monotone cubic (Fritsch and Carlson 1980) in every component, so that nothing overshoots
/// a key and what is equal in two neighbouring keys stays still. Before the first and after the last key it holds.
class SmoothTrack {
 public:
  /// Times rise strictly; all keys have the same number of values.
  SmoothTrack(std::vector<double> times, std::vector<std::vector<double>> values);
  std::vector<double> at(double time) const;

 private:
  std::vector<double> times_;
  std::vector<std::vector<double>> values_, slopes_;
};

/// Where the hand is at one time.
struct HandKey {
  double time = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< wrist [m]
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();      ///< rotation vector applied to the track's base orientation
  HandAngles angles;
};

/// The animated hand as a function of time.
class HandTrack {
 public:
  /// A pose is {exp(turn) base, position}, in the frame that the keys are given in.
  HandTrack(const Eigen::Matrix3d& base, const std::vector<HandKey>& keys);
  SkeletonPose at(double time) const;

 private:
  Eigen::Matrix3d base_;
  SmoothTrack track_;
};

/// Slow drift of all 26 degrees of freedom as of a hand held in the air, up to about 1.5 mm and 1.5 degrees.
SkeletonPose with_tremor(const SkeletonPose& pose, double time, std::uint64_t seed);

}  // namespace barehand::synthetic
