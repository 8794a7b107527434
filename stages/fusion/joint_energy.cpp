// The energy of a joint for pairs of samples (paper, Eq. 4-6).
#include "stages/fusion/joint_energy.h"

#include <numbers>

#include "math/angles.h"
#include "math/fast_math.h"

namespace barehand {
namespace {

float inverse_square(double sigma) { return static_cast<float>(1 / (sigma * sigma)); }

/// The part of an angle that lies outside mid +- half; the difference from mid is wrapped to +-pi first.
inline float beyond(float angle, float mid, float half) {
  constexpr float kTurn = 2 * std::numbers::pi_v<float>;
  const float off = angle - mid;
  const float wrapped = std::fabs(off - kTurn * std::floor(off * (1 / kTurn) + 0.5f));
  return wrapped > half ? wrapped - half : 0.0f;
}

/// The energies of one child sample with all parent samples.
void energy_row(const JointModel& joint, float inv_prox_sq, const ParentFrames& parents, const SE3& child,
                float* __restrict out) {
  // Load everything that does not depend on the parent's sample.
  const Eigen::Vector3f o = child.t.cast<float>();
  const Eigen::Vector3f b0 = child.R.col(0).cast<float>(), b1 = child.R.col(1).cast<float>(),
                        b2 = child.R.col(2).cast<float>();

  const float *x = parents.origin(0), *y = parents.origin(1), *z = parents.origin(2);
  const float *a00 = parents.column(0, 0), *a01 = parents.column(0, 1), *a02 = parents.column(0, 2);
  const float *a10 = parents.column(1, 0), *a11 = parents.column(1, 1), *a12 = parents.column(1, 2);
  const float *a20 = parents.column(2, 0), *a21 = parents.column(2, 1), *a22 = parents.column(2, 2);
  const JointModel j = joint;

  // Each SIMD lane handles one parent sample.
  for (std::size_t p = 0; p < parents.size(); ++p) {
    const float dx = x[p] - o[0], dy = y[p] - o[1], dz = z[p] - o[2];
    const float prox = (dx * dx + dy * dy + dz * dz) * inv_prox_sq;
    // The entries of R_rest_posed = R_camera_rest^T R_camera_child that joint_angles() needs.
    const float r00 = a00[p] * b0[0] + a01[p] * b0[1] + a02[p] * b0[2];
    const float r10 = a10[p] * b0[0] + a11[p] * b0[1] + a12[p] * b0[2];
    const float r20 = a20[p] * b0[0] + a21[p] * b0[1] + a22[p] * b0[2];
    const float r11 = a10[p] * b1[0] + a11[p] * b1[1] + a12[p] * b1[2];
    const float r12 = a10[p] * b2[0] + a11[p] * b2[1] + a12[p] * b2[2];

    // Flexion and abduction beyond their limits, and the twist, which should be 0.
    const float twist = fast_atan2(r10, std::sqrt(r00 * r00 + r20 * r20));
    const float abduction = beyond(fast_atan2(-r20, r00), j.abduction_mid, j.abduction_half);
    const float flexion = beyond(fast_atan2(r12, r11), j.flexion_mid, j.flexion_half);

    out[p] = prox + flexion * flexion * j.inv_flexion_sq + abduction * abduction * j.inv_abduction_sq +
             twist * twist * j.inv_twist_sq;
  }
}

}  // namespace

JointModels make_joint_models(const HandProfile& profile, const FusionParams& params) {
  const auto limits = widened_limits(profile, params.limit_widening_deg * kDegree);
  JointModels models;
  for (int s = 1; s < kSegmentCount; ++s) {
    // Copy the joint's position and orientation at rest.
    const JointLimits& l = limits[s];
    JointModel& m = models[s];
    m.joint_in_parent = profile.rest_relative(s).t;
    m.R_parent_rest = profile.rest_relative(s).R;

    // Compute the middle and the half width of its widened ranges.
    m.flexion_mid = static_cast<float>((l.flexion_lo + l.flexion_hi) / 2);
    m.flexion_half = static_cast<float>((l.flexion_hi - l.flexion_lo) / 2);
    m.abduction_mid = static_cast<float>((l.abduction_lo + l.abduction_hi) / 2);
    m.abduction_half = static_cast<float>((l.abduction_hi - l.abduction_lo) / 2);

    // Compute the weights of flexion and abduction beyond these ranges, and of twist.
    m.inv_flexion_sq = inverse_square(params.sigma_flexion_deg * kDegree);
    m.inv_abduction_sq = inverse_square(params.sigma_abduction_deg * kDegree);
    m.inv_twist_sq = inverse_square(params.sigma_twist_deg * kDegree);
  }
  return models;
}

void ParentFrames::reset(const JointModel& joint, const std::vector<SE3>& parents) {
  size_ = parents.size();
  data_.resize(12 * size_);
  for (std::size_t p = 0; p < size_; ++p) {
    const Eigen::Vector3f origin = (parents[p] * joint.joint_in_parent).cast<float>();
    const Eigen::Matrix3f R = (parents[p].R * joint.R_parent_rest).cast<float>();
    for (int k = 0; k < 3; ++k) data_[k * size_ + p] = origin[k];
    for (int k = 0; k < 9; ++k) data_[(3 + k) * size_ + p] = R(k % 3, k / 3);
  }
}

void joint_energy(const JointModel& joint, double sigma_prox, const ParentFrames& parents,
                  const std::vector<SE3>& children, EdgeEnergy& energy) {
  energy.parents = parents.size();
  energy.children = children.size();
  energy.value.resize(energy.parents * energy.children);
  for (std::size_t c = 0; c < energy.children; ++c)
    energy_row(joint, inverse_square(sigma_prox), parents, children[c], energy.value.data() + c * energy.parents);
}

}  // namespace barehand
