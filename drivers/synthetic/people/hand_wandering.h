#pragma once

#include <vector>

#include "drivers/synthetic/sequences/keyframes.h"
#include "math/random.h"

namespace barehand::synthetic {

/// A hand that moves about a place, turns and bends its fingers at random.
struct HandWandering {
  double duration = 6;                                      ///< [s]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();         ///< of the middle of the hand [m]
  Eigen::Vector3d range = Eigen::Vector3d::Constant(0.08);  ///< to either side [m]
  Eigen::Matrix3d base = Eigen::Matrix3d::Identity();       ///< orientation of the palm
  double turn = 0.5;                                        ///< to either side about each axis [rad]
};
/// Its keys, in the frame of `base`.
std::vector<HandKey> wander(const HandWandering& wandering, KeyedRandom& random);

/// Orientation of a palm whose fingers point along `fingers` and which faces `facing` as far as that allows.
Eigen::Matrix3d palm_facing(const Eigen::Vector3d& fingers, const Eigen::Vector3d& facing);

/// A random point of the box from -range to +range.
Eigen::Vector3d random_within(const Eigen::Vector3d& range, KeyedRandom& random);

/// From the wrist to the middle of the hand [m].
inline constexpr double kWristToMiddle = 0.09;

}  // namespace barehand::synthetic
