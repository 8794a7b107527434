#pragma once

#include <array>
#include <vector>

#include "hand/joint_angles.h"
#include "stages/fusion/belief_propagation.h"
#include "stages/fusion/fusion_params.h"

namespace barehand {

/// The limits of one joint and the cost of violating them (Eq. 4-6), prepared for single precision.
struct JointModel {
  Eigen::Vector3d joint_in_parent = Eigen::Vector3d::Zero();         ///< place of the joint [m]
  Eigen::Matrix3d R_parent_rest = Eigen::Matrix3d::Identity();       ///< orientation of the child at zero angles
  float flexion_mid = 0, flexion_half = 0;                           ///< middle and half of the widened range [rad]
  float abduction_mid = 0, abduction_half = 0;                       ///< the same for abduction [rad]
  float inv_flexion_sq = 0, inv_abduction_sq = 0, inv_twist_sq = 0;  ///< 1 / sigma^2 [1/rad^2]
};
using JointModels = std::array<JointModel, kSegmentCount>;  ///< the palm's entry is unused

/// One model for each joint of the profile.
JointModels make_joint_models(const HandProfile& profile, const FusionParams& params);

/// The joint's place and rest frame for every sample of the parent, in a structure of arrays for SIMD.
class ParentFrames {
 public:
  /// Recomputes everything; the memory is kept.
  void reset(const JointModel& joint, const std::vector<SE3>& parents);
  std::size_t size() const { return size_; }
  /// Coordinate `axis` of the joint's place in the camera frame [m], one value per sample.
  const float* origin(int axis) const { return data_.data() + axis * size_; }
  /// Entry (`row`, `c`) of the rest frame's rotation matrix, one value per sample.
  const float* column(int c, int row) const { return data_.data() + (3 + 3 * c + row) * size_; }

 private:
  std::vector<float> data_;
  std::size_t size_ = 0;
};

/// -log psi (Eq. 4) of all pairs of samples (each a T_camera_segment): the squared distance between the joint's place
/// in the parent and the child's origin over sigma_prox^2 (Eq. 5), plus the squared angles beyond the widened limits
/// over their sigma^2 (Eq. 6). Angles are measured the short way round. `energy` keeps its memory.
void joint_energy(const JointModel& joint, double sigma_prox, const ParentFrames& parents,
                  const std::vector<SE3>& children, EdgeEnergy& energy);

}  // namespace barehand
