#include "stages/refinement/hand_energy.h"

#include <algorithm>
#include <cmath>

#include "hand/joint_linearisation.h"
#include "math/angles.h"
#include "math/square.h"
#include "stages/refinement/residual_moments.h"
#include "stages/refinement/shape_moments.h"

namespace barehand {
namespace {

// The terms of the energy that the refinement minimises: depth data, joints, and the prior at the predicted pose.

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Kind = Correspondence::Kind;

/// Turns a correspondence into weighted residuals along up to four directions.
class DataTerm {
 public:
  DataTerm(const EnergyParams& p, const DataWeighting& w)
      : surface_{scale_sq(p.robust_scale, w.widening), scale_sq(p.gate, w.widening), information(p, 1)},
        outside_{scale_sq(p.silhouette_scale, w.widening), scale_sq(p.silhouette_gate, w.widening),
                 information(p, p.weight_outside)},
        unexplained_{outside_.scale_sq, outside_.gate_sq, information(p, p.weight_unexplained)},
        tangential_(static_cast<float>(w.tangential)),
        folds_(static_cast<float>(w.folds)),
        palm_trust_(static_cast<float>(p.palm_trust)) {}

  /// Calls `use(direction, residual, information)` for up to four directions. The residual is the model point minus
  /// the data point along the direction [m]. Returns the energy; 0 if the correspondence is beyond the gate.
  template <class Use>
  double add(const Correspondence& c, const SkinVertex& v, const Use& use) const {
    const Vector3f r = c.model - c.data;
    const float share = c.weight * trust(v);
    if (c.kind == Kind::surface) return add_along(c.normal, r, surface_, share, use);
    if (c.kind == Kind::behind) return add_along(Vector3f::UnitZ(), r, outside_, share, use);
    return c.kind == Kind::outside ? add_outside(r, share, use) : add_unexplained(r, c.normal, share, use);
  }

 private:
  // Geman-McClure: energy s^2 d^2 / (s^2 + d^2), weight of the equivalent least squares (s^2 / (s^2 + d^2))^2.
  struct Robust {
    float scale_sq, gate_sq, information;
    float weight(float distance_sq) const { return information * square(scale_sq / (scale_sq + distance_sq)); }
    float energy(float distance_sq) const { return information * scale_sq * distance_sq / (scale_sq + distance_sq); }
  };

  template <class Use>
  static double add_along(const Vector3f& direction, const Vector3f& r, const Robust& robust, float share,
                          const Use& use) {
    const float along = direction.dot(r), distance_sq = square(along);
    if (distance_sq > robust.gate_sq) return 0;
    use(direction, along, share * robust.weight(distance_sq));
    return share * robust.energy(distance_sq);
  }

  // Residuals of skin that the model projects outside the observed hand. It is pulled in the image plane only, because
  // a silhouette contains no information about depth.
  template <class Use>
  double add_outside(const Vector3f& r, float share, const Use& use) const {
    const float distance_sq = r.head<2>().squaredNorm();
    if (distance_sq > outside_.gate_sq) return 0;
    const float weight = share * outside_.weight(distance_sq);
    for (int axis = 0; axis < 2; ++axis) use(Vector3f(Vector3f::Unit(axis)), r[axis], weight);
    return share * outside_.energy(distance_sq);
  }

  // Residuals of observed hand points that no skin of the model explains and that it should reach. Most of them are
  // just outside the model's silhouette, where the surface turns away and is millimetres deeper than the nearest
  // visible skin even if the model fits well. A pull along the surface would be wrong there.
  template <class Use>
  double add_unexplained(const Vector3f& r, const Vector3f& normal, float share, const Use& use) const {
    if (r.squaredNorm() > unexplained_.gate_sq) return 0;
    const float along = normal.dot(r), across_share = 1 - tangential_;
    const float distance_sq = across_share * square(along) + tangential_ * r.squaredNorm();
    const float weight = share * unexplained_.weight(distance_sq);
    use(normal, along, across_share * weight);
    if (tangential_ > 0)
      for (int axis = 0; axis < 3; ++axis) use(Vector3f(Vector3f::Unit(axis)), r[axis], tangential_ * weight);
    return share * unexplained_.energy(distance_sq);
  }

  // Weight of a segment's skin in the data term: that of the palm and the thumb's root counts less, since it differs
  // most from person to person.
  float trust(int segment) const { return segment == kPalm || segment == segment_of(0, 0) ? palm_trust_ : 1.0f; }
  float trust(const SkinVertex& v) const {
    const float of_segments = (1 - v.weight_b) * trust(v.a) + v.weight_b * trust(v.b);
    return of_segments / fold_penalty(v, folds_);
  }
  static float scale_sq(double metres, double widening) { return static_cast<float>(square(metres * widening)); }
  static float information(const EnergyParams& p, double weight) {
    return static_cast<float>(weight / square(p.sigma_depth));
  }

  Robust surface_, outside_, unexplained_;
  float tangential_;  // fraction of the pull of unexplained data that acts in all directions
  float folds_;       // strength of fold_penalty(), which down-weights skin near joints
  float palm_trust_;
};

/// The vertex's skinning weight for its second segment, after the weights of hidden segments were reduced and both
/// weights normalised (DataWeighting::hidden).
float shown_weight_b(const SkinVertex& v, const std::array<double, kSegmentCount>& hidden) {
  const double a = (1 - v.weight_b) * (1 - hidden[v.a]), b = v.weight_b * (1 - hidden[v.b]);
  return a + b > 0 ? static_cast<float>(b / (a + b)) : v.weight_b;
}

}  // namespace

double add_data_terms(const Skin& skin, const HandPose& pose, const ModelComparison& comparison,
                      const EnergyParams& params, const DataWeighting& weighting, GaussianTree& tree,
                      ShapeMoments* shape) {
  const DataTerm term(params, weighting);
  ResidualMoments sums(pose);
  double total = 0;
  for (const Correspondence& c : comparison.correspondences) {
    // The pose uses the skinning weights that were reduced for hidden segments, the shape uses the original ones.
    const SkinVertex& v = skin.vertices[c.vertex];
    SkinVertex moved = v;
    moved.weight_b = shown_weight_b(v, weighting.hidden);
    total += term.add(c, v, [&](const Vector3f& direction, float residual, float information) {
      sums.add(moved, c.model, direction, residual, information);
      if (shape) shape->add(c, v, direction, residual, information);
    });
  }

  sums.add_to(tree);
  return total;
}

double add_joint_terms(const HandProfile& profile, const std::array<JointLimits, kSegmentCount>& limits,
                       const HandPose& pose, const EnergyParams& params, GaussianTree& tree) {
  double total = 0;
  for (int s = 1; s < kSegmentCount; ++s) {
    // Add the penalty for the gap at the joint (paper, Eq. 5).
    const JointLinearisation joint = linearise_joint(profile, pose, s);
    const JointJacobians J_gap = joint.of_gap(), J_angles = joint.of_angles();
    const Matrix3d W_gap = Matrix3d::Identity() / square(params.sigma_gap);
    tree.add<3>(s, J_gap.child, J_gap.parent, joint.gap, W_gap);
    total += joint.gap.squaredNorm() / square(params.sigma_gap);

    // Add the penalty for angles beyond their limits and for any twist (paper, Eq. 6).
    const AngleExcess excess = joint.excess(limits[s]);
    const Matrix3d W_angle = Matrix3d(excess.counts.asDiagonal()) / square(params.sigma_angle_deg * kDegree);
    tree.add<3>(s, J_angles.child, J_angles.parent, excess.angles, W_angle);
    total += excess.angles.dot(W_angle * excess.angles);
  }
  return total;
}

double add_prior_terms(const HandProfile& profile, const HandPose& predicted,
                       const std::array<double, kSegmentCount>& free, const HandPose& pose, const EnergyParams& params,
                       GaussianTree& tree) {
  // Pull the palm to its predicted pose in the camera frame.
  Vector6d information;
  information << Vector3d::Constant(1 / square(params.prior_translation)),
      Vector3d::Constant(1 / square(params.prior_rotation_deg * kDegree));
  const Vector6d r = boxminus(pose[kPalm], predicted[kPalm]);
  tree.H_self[kPalm].diagonal() += information;
  tree.g[kPalm] -= information.cwiseProduct(r);
  double total = r.cwiseProduct(information).dot(r);

  for (int s = 1; s < kSegmentCount; ++s) {
    // An unseen joint is held more firmly than a seen one.
    const double unseen_information = 1 / square(params.prior_unseen_deg * kDegree);
    const double seen_information = 1 / square(params.prior_rotation_deg * kDegree);
    const double w = free[s] * seen_information + (1 - free[s]) * unseen_information;
    const JointLinearisation joint = linearise_joint(profile, pose, s);
    // Compute the rotation from the predicted joint angles to the current ones.
    const JointLinearisation aim = linearise_joint(profile, predicted, s);
    const Vector3d turn = log_so3(joint.R_joint_segment * aim.R_joint_segment.transpose());
    const JointJacobians J = joint.of_turn();
    tree.add<3>(s, J.child, J.parent, turn, w * Matrix3d::Identity());
    total += w * turn.squaredNorm();
  }
  return total;
}

}  // namespace barehand
