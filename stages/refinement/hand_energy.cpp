#include "stages/refinement/hand_energy.h"

#include <algorithm>
#include <cmath>

#include "hand/joint_linearisation.h"
#include "math/angles.h"

namespace barehand {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Kind = Correspondence::Kind;
using Jacobian = Eigen::Matrix<double, 3, 6>;

double sq(double x) { return x * x; }

// d(R w + t)/d twist of a point at `arm` from the segment's origin.
Jacobian point_jacobian(const Vector3d& arm) {
  Jacobian J;
  J << Matrix3d::Identity(), -skew(arm);
  return J;
}

// One block of residuals r (weighted information W) that depends on a segment and its parent.
template <int N>
void add_pair(GaussianTree& tree, int child, const Eigen::Matrix<double, N, 6>& J_child,
              const Eigen::Matrix<double, N, 6>& J_parent, const Eigen::Matrix<double, N, 1>& r,
              const Eigen::Matrix<double, N, N>& W) {
  const int parent = parent_of(child);
  tree.H_self[child] += J_child.transpose() * W * J_child;
  tree.H_self[parent] += J_parent.transpose() * W * J_parent;
  tree.H_parent[child] += J_child.transpose() * W * J_parent;
  tree.g[child] -= J_child.transpose() * (W * r);
  tree.g[parent] -= J_parent.transpose() * (W * r);
}

// Geman-McClure: energy s^2 d^2 / (s^2 + d^2), weight of the equivalent least squares (s^2 / (s^2 + d^2))^2.
double robust_weight(double distance_sq, double scale_sq) { return sq(scale_sq / (scale_sq + distance_sq)); }
double robust_energy(double distance_sq, double scale_sq) { return scale_sq * distance_sq / (scale_sq + distance_sq); }

class DataTerm {
 public:
  DataTerm(const EnergyParams& p, double widening)
      : surface_scale_sq_(sq(p.robust_scale * widening)),
        surface_gate_(p.gate * widening),
        silhouette_scale_sq_(sq(p.silhouette_scale * widening)),
        silhouette_gate_(p.silhouette_gate * widening),
        information_(1 / sq(p.sigma_depth)),
        params_(p) {}

  /// Residual direction(s) as a 3x3 information matrix and residual model - data; false if gated out.
  bool weigh(const Correspondence& c, Matrix3d& W, Vector3d& r, double& energy) const {
    r = (c.model - c.data).cast<double>();
    const Vector3d n = c.normal.cast<double>();
    if (c.kind == Kind::surface) {
      const double along = n.dot(r);
      if (std::abs(along) > surface_gate_) return false;
      W = c.weight * information_ * robust_weight(sq(along), surface_scale_sq_) * n * n.transpose();
      energy = c.weight * information_ * robust_energy(sq(along), surface_scale_sq_);
      return true;
    }
    // Outside: the silhouette says nothing about depth. Unexplained: the data is a point of the skin.
    const Vector3d axes = c.kind == Kind::outside ? Vector3d(1, 1, 0) : Vector3d(1, 1, 1);
    const double distance_sq = r.cwiseProduct(axes).squaredNorm();
    if (distance_sq > sq(silhouette_gate_)) return false;
    const double weight = c.kind == Kind::outside ? params_.weight_outside : params_.weight_unexplained;
    W = c.weight * weight * information_ * robust_weight(distance_sq, silhouette_scale_sq_) * axes.asDiagonal();
    energy = c.weight * weight * information_ * robust_energy(distance_sq, silhouette_scale_sq_);
    return true;
  }

 private:
  double surface_scale_sq_, surface_gate_, silhouette_scale_sq_, silhouette_gate_, information_;
  const EnergyParams& params_;
};

}  // namespace

double add_data_terms(const Skin& skin, const HandPose& pose, const ModelComparison& comparison,
                      const EnergyParams& params, double widening, GaussianTree& tree) {
  const DataTerm term(params, widening);
  double total = 0;
  for (const Correspondence& c : comparison.correspondences) {
    Matrix3d W;
    Vector3d r;
    double energy;
    if (!term.weigh(c, W, r, energy)) continue;
    total += energy;
    const SkinVertex& v = skin.vertices[c.vertex];
    const Vector3d p = c.model.cast<double>();
    const Jacobian Ja = (1 - v.weight_b) * point_jacobian(p - pose[v.a].t);
    if (v.weight_b == 0) {
      tree.H_self[v.a] += Ja.transpose() * W * Ja;
      tree.g[v.a] -= Ja.transpose() * (W * r);
      continue;
    }
    const Jacobian Jb = v.weight_b * point_jacobian(p - pose[v.b].t);
    const bool a_is_child = parent_of(v.a) == v.b;
    add_pair<3>(tree, a_is_child ? v.a : v.b, a_is_child ? Ja : Jb, a_is_child ? Jb : Ja, r, W);
  }
  return total;
}

double add_joint_terms(const HandProfile& profile, const std::array<JointLimits, kSegmentCount>& limits,
                       const HandPose& pose, const EnergyParams& params, GaussianTree& tree) {
  const auto beyond = [](double x, double lo, double hi) { return x < lo ? x - lo : (x > hi ? x - hi : 0.0); };
  double total = 0;
  for (int s = 1; s < kSegmentCount; ++s) {
    const JointLinearisation joint = linearise_joint(profile, pose, s);
    Jacobian J_child, J_parent;
    J_child << -Matrix3d::Identity(), Matrix3d::Zero();
    J_parent << Matrix3d::Identity(), -skew(joint.lever);
    const Matrix3d W_gap = Matrix3d::Identity() / sq(params.sigma_gap);
    add_pair<3>(tree, s, J_child, J_parent, joint.gap, W_gap);
    total += joint.gap.squaredNorm() / sq(params.sigma_gap);

    const JointLimits& limit = limits[s];
    const Vector3d excess(beyond(joint.angles.flexion, limit.flexion_lo, limit.flexion_hi),
                          beyond(joint.angles.abduction, limit.abduction_lo, limit.abduction_hi), joint.angles.twist);
    const Matrix3d W_angle =
        Vector3d(excess[0] != 0, excess[1] != 0, 1).asDiagonal().toDenseMatrix() / sq(params.sigma_angle_deg * kDegree);
    J_child << Matrix3d::Zero(), joint.d_angles * joint.R_camera_joint.transpose();
    J_parent = -J_child;
    add_pair<3>(tree, s, J_child, J_parent, excess, W_angle);
    total += excess.dot(W_angle * excess);
  }
  return total;
}

double add_prior_terms(const HandProfile& profile, const HandPose& predicted,
                       const std::array<double, kSegmentCount>& seen, const HandPose& pose, const EnergyParams& params,
                       GaussianTree& tree) {
  Vector6d information;
  information << Vector3d::Constant(1 / sq(params.prior_translation)),
      Vector3d::Constant(1 / sq(params.prior_rotation_deg * kDegree));
  const Vector6d r = boxminus(pose[kPalm], predicted[kPalm]);
  tree.H_self[kPalm].diagonal() += information;
  tree.g[kPalm] -= information.cwiseProduct(r);
  double total = r.cwiseProduct(information).dot(r);

  for (int s = 1; s < kSegmentCount; ++s) {
    const double unseen_information = 1 / sq(params.prior_unseen_deg * kDegree);
    const double seen_information = 1 / sq(params.prior_rotation_deg * kDegree);
    const double w = seen[s] * seen_information + (1 - seen[s]) * unseen_information;
    const JointLinearisation joint = linearise_joint(profile, pose, s);
    const JointLinearisation aim = linearise_joint(profile, predicted, s);
    const Vector3d turn = log_so3(joint.R_joint_segment * aim.R_joint_segment.transpose());
    Jacobian J_child, J_parent;
    J_child << Matrix3d::Zero(), joint.R_camera_joint.transpose();
    J_parent = -J_child;
    add_pair<3>(tree, s, J_child, J_parent, turn, w * Matrix3d::Identity());
    total += w * turn.squaredNorm();
  }
  return total;
}

}  // namespace barehand
