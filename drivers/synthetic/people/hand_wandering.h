#pragma once

#include <vector>

#include "drivers/synthetic/sequences/keyframes.h"
#include "math/random.h"

namespace barehand::synthetic {

/// A random motion of a hand: it moves within a box, turns, and bends its fingers.
struct HandWandering {
  double duration = 6;                                      ///< duration of the motion [s]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();         ///< centre of the box in which the hand's middle moves [m]
  Eigen::Vector3d range = Eigen::Vector3d::Constant(0.08);  ///< half sides of this box [m]
  Eigen::Matrix3d base = Eigen::Matrix3d::Identity();       ///< mean orientation of the palm
  double turn = 0.5;                                        ///< largest rotation from `base` about each axis [rad]
};
/// Random keyframes of such a motion, expressed in the frame of wandering.base.
std::vector<HandKey> wander(const HandWandering& wandering, KeyedRandom& random);

/// Orientation of a palm whose fingers point along `fingers` and which faces the direction `facing` as far as possible.
Eigen::Matrix3d palm_facing(const Eigen::Vector3d& fingers, const Eigen::Vector3d& facing);

/// A random point in the box from -range to +range.
Eigen::Vector3d random_within(const Eigen::Vector3d& range, KeyedRandom& random);

/// Distance from the wrist to the middle of the hand [m].
inline constexpr double kWristToMiddle = 0.09;

}  // namespace barehand::synthetic
