#pragma once

#include <Eigen/Core>

namespace barehand::synthetic {

/// The dimensions of an arm in a sleeve [m].
struct ArmSize {
  double upper = 0.29, forearm = 0.26;
  double shoulder_radius = 0.062, elbow_radius = 0.047, cuff_radius = 0.037;

  double reach() const { return upper + forearm; }
};

/// The position of the elbow between a shoulder and a wrist, on the side to which `towards` points. If the wrist is out
/// of reach, the arm is straight and points to it.
Eigen::Vector3d elbow_between(const ArmSize& arm, const Eigen::Vector3d& shoulder, const Eigen::Vector3d& wrist,
                              const Eigen::Vector3d& towards);

}  // namespace barehand::synthetic
