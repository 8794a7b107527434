#pragma once

#include <array>
#include <vector>

#include "hand/joint_angles.h"
#include "stages/fusion/belief_propagation.h"
#include "stages/fusion/fusion_params.h"

namespace barehand {

// The energy of a joint for pairs of samples (paper, Eq. 4-6).

/// The limits of one joint and the cost of violating them (paper, Eq. 4-6), prepared for single precision.
struct JointModel {
  Eigen::Vector3d joint_in_parent = Eigen::Vector3d::Zero();    ///< position of the joint in the parent [m]
  Eigen::Matrix3d R_parent_rest = Eigen::Matrix3d::Identity();  ///< orientation of the child at zero angles
  float flexion_mid = 0, flexion_half = 0;                      ///< middle and half of flexion's widened range [rad]
  float abduction_mid = 0, abduction_half = 0;                  ///< middle and half of that of abduction [rad]
  float inv_flexion_sq = 0, inv_abduction_sq = 0, inv_twist_sq = 0;  ///< 1 / sigma^2 [1/rad^2]
};
using JointModels = std::array<JointModel, kSegmentCount>;  ///< the palm's entry is unused

/// One model for each joint of the profile.
JointModels make_joint_models(const HandProfile& profile, const FusionParams& params);

/// The joint's position and rest frame in the camera frame, for every sample of the parent; a structure of arrays for
/// SIMD.
class ParentFrames {
 public:
  /// Recomputes all values for these samples of the parent (T_camera_segment); the memory is reused.
  void reset(const JointModel& joint, const std::vector<SE3>& parents);
  std::size_t size() const { return size_; }
  /// Coordinate `axis` of the joint's position in the camera frame [m], one value per sample.
  const float* origin(int axis) const { return data_.data() + axis * size_; }
  /// Entry (`row`, `c`) of the rest frame's rotation matrix, one value per sample.
  const float* column(int c, int row) const { return data_.data() + (3 + 3 * c + row) * size_; }

 private:
  std::vector<float> data_;
  std::size_t size_ = 0;
};

/// -log psi (paper, Eq. 4) of all pairs of samples (each a T_camera_segment): the squared distance between the joint's
/// position in the parent and the child's origin, divided by sigma_prox^2 (Eq. 5), plus the squared angles beyond the
/// widened limits, divided by their sigma^2 (Eq. 6). Flexion and abduction are wrapped to +-pi about the middle of
/// their range. The memory of `energy` is reused.
void joint_energy(const JointModel& joint, double sigma_prox, const ParentFrames& parents,
                  const std::vector<SE3>& children, EdgeEnergy& energy);

}  // namespace barehand
