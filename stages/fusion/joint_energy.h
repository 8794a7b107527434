#pragma once

#include <array>
#include <vector>

#include "hand/joint_angles.h"
#include "stages/fusion/belief_propagation.h"
#include "stages/fusion/fusion_params.h"

namespace barehand {

/// What one joint allows and how much a violation costs (Eq. 4-6), prepared for single precision.
struct JointModel {
  Eigen::Vector3d joint_in_parent = Eigen::Vector3d::Zero();         ///< [m]
  Eigen::Matrix3d R_parent_rest = Eigen::Matrix3d::Identity();       ///< child's orientation at zero angles
  float flexion_mid = 0, flexion_half = 0;                           ///< widened range [rad]
  float abduction_mid = 0, abduction_half = 0;                       ///< widened range [rad]
  float inv_flexion_sq = 0, inv_abduction_sq = 0, inv_twist_sq = 0;  ///< 1 / sigma^2 [1/rad^2]
};
using JointModels = std::array<JointModel, kSegmentCount>;  ///< entry of the palm unused

JointModels make_joint_models(const HandProfile& profile, const FusionParams& params);

/// Joint point and rest frame of every sample of a parent as structure of arrays.
class ParentFrames {
 public:
  /// Keeps its memory.
  void reset(const JointModel& joint, const std::vector<SE3>& parents);
  std::size_t size() const { return size_; }
  const float* origin(int axis) const { return data_.data() + axis * size_; }
  const float* column(int c, int row) const { return data_.data() + (3 + 3 * c + row) * size_; }

 private:
  std::vector<float> data_;
  std::size_t size_ = 0;
};

/// -log psi (Eq. 4) of all pairs of samples, T_camera_segment each: squared distance between the parent's joint point
/// and the child's origin over sigma_prox^2 (Eq. 5), plus squared angles beyond the widened limits over their
/// sigma^2 (Eq. 6), measured the short way round. `energy` keeps its memory.
void joint_energy(const JointModel& joint, double sigma_prox, const ParentFrames& parents,
                  const std::vector<SE3>& children, EdgeEnergy& energy);

}  // namespace barehand
