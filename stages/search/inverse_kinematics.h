#pragma once

#include <optional>

#include "hand/gaussian_tree.h"
#include "hand/hand_pose.h"
#include "hand/joint_angles.h"
#include "observe/detection.h"

namespace barehand {

// Fits a hand profile to detected joints.

/// The joints of a detected hand, in the order of landmarks (detection.h).

/// The pose that was fitted to detected joints, and how well it agrees with them.
struct KinematicFit {
  HandPose pose;     ///< T_camera_segment of the unscaled profile; the joints are closed
  double scale = 1;  ///< size of the detected hand relative to the profile
  double cost = 0;   ///< mean robust (Cauchy) squared Mahalanobis distance of the joints
};

/// Fits the kinematic tree of a profile to detected joints: Gauss-Newton on the hand's Gaussian tree with soft joints,
/// joint limits and a weak prior of slightly bent fingers. Unless the profile was measured, one scale of the whole hand
/// is fitted, too. None: the detected joints do not define a pose.
std::optional<KinematicFit> fit_to_joints(const HandProfile& profile, const DetectedJoints& joints);
/// Like fit_to_joints(), but the scale is fitted even if the profile was measured. `deviation`: prior standard
/// deviation of the logarithm of the scale.
std::optional<KinematicFit> fit_size_to_joints(const HandProfile& profile, const DetectedJoints& joints,
                                               double deviation);

/// Fits the size of a detected hand like fit_size_to_joints(). `profile` may be of either side: it is mirrored if there
/// are no joints of its own side.
std::optional<KinematicFit> fit_size_to_hand(const HandProfile& profile, const DetectedHand& detected,
                                             double deviation);

/// Mean distance of the joints of a pose from detected ones [m].
double mean_distance(const HandProfile& profile, const HandPose& pose, const DetectedJoints& joints);

/// Mean robust (Cauchy) squared Mahalanobis distance of the joints of a pose from detected ones: KinematicFit::cost of
/// this pose.
double joint_cost(const HandProfile& profile, const HandPose& pose, const DetectedJoints& joints);

/// Standard deviation of the logarithm of the hand's size among adults and youths.
inline constexpr double kScaleDeviation = 0.12;

/// Negative log posterior (times two) of a pose and a scale, and its normal equations.
struct KinematicEquations {
  double energy = 0;
  double cost = 0;                               ///< KinematicFit::cost
  GaussianTree tree;                             ///< normal equations of the segments
  std::array<Vector6d, kSegmentCount> coupling;  ///< entries of H between a segment and the logarithm of the scale
  double scale_information = 0,
         scale_gradient = 0;  ///< H's and the right-hand side's entries for the logarithm of scale
};
KinematicEquations kinematic_equations(const HandProfile& profile, const std::array<JointLimits, kSegmentCount>& limits,
                                       const DetectedJoints& joints, const HandPose& pose, double scale,
                                       double scale_deviation = kScaleDeviation);

}  // namespace barehand
