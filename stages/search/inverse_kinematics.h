#pragma once

#include <optional>

#include "hand/gaussian_tree.h"
#include "hand/hand_pose.h"
#include "hand/joint_angles.h"
#include "observe/detection.h"

namespace barehand {

/// A hand's joints as a detection gives them.
using DetectedJoints = std::array<DetectedJoint, kLandmarkCount>;

/// A pose of a profile, and how well it agrees with detected joints.
struct KinematicFit {
  HandPose pose;     ///< T_camera_segment of the profile in its own size, joints closed
  double scale = 1;  ///< size of the detected hand relative to the profile
  double cost = 0;   ///< mean squared Mahalanobis distance of a joint, robust
};

/// Fits the profile's chain to detected joints: Gauss-Newton on the hand's Gaussian tree with soft joints, joint limits
/// and a weak pull towards slightly bent fingers. Unless the profile was measured, one scale of the whole hand is
/// fitted, too. None: the joints lie in a way that defines no pose.
std::optional<KinematicFit> fit_to_joints(const HandProfile& profile, const DetectedJoints& joints);
/// The same with the scale fitted to any profile. `deviation`: by how much the logarithm of the scale is expected to
/// differ from 0.
std::optional<KinematicFit> fit_size_to_joints(const HandProfile& profile, const DetectedJoints& joints,
                                               double deviation);

/// Mean distance of the joints of a pose from detected ones [m].
double mean_distance(const HandProfile& profile, const HandPose& pose, const DetectedJoints& joints);

/// Of the logarithm of a hand's size among adults and youths.
inline constexpr double kScaleDeviation = 0.12;

/// Negative log posterior (times two) of a pose and a scale, and its normal equations.
struct KinematicEquations {
  double energy = 0;
  double cost = 0;                                   ///< of the joints alone, per joint
  GaussianTree tree;                                 ///< of the segments
  std::array<Vector6d, kSegmentCount> coupling;      ///< H between a segment and the scale
  double scale_information = 0, scale_gradient = 0;  ///< H and right-hand side of the logarithm of the scale
};
KinematicEquations kinematic_equations(const HandProfile& profile, const std::array<JointLimits, kSegmentCount>& limits,
                                       const DetectedJoints& joints, const HandPose& pose, double scale,
                                       double scale_deviation = kScaleDeviation);

}  // namespace barehand
