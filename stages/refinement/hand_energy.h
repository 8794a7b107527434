#pragma once

#include <array>

#include "hand/gaussian_tree.h"
#include "hand/joint_angles.h"
#include "observe/dense/model_comparison.h"

namespace barehand {

// The energy of a hand's pose in a frame, as terms of normal equations.

class ShapeMoments;

/// Weights of the continuous energy that refinement minimises: the negative logarithm of the paper's likelihood
/// (Eq. 3) and constraints (Eq. 4-6), made robust and summed over all segments at once.
struct EnergyParams {
  double sigma_depth = 0.002;
  double robust_scale = 0.004;
  double gate = 0.015;
  double silhouette_scale = 0.008;
  double silhouette_gate = 0.040;
  double weight_outside = 0.5;
  double weight_unexplained = 1.0;
  double palm_trust = 0.1;
  double sigma_gap = 0.0005;
  double sigma_angle_deg = 2.0;
  double limit_widening_deg = 10.0;  ///< widening of the joint limits [degrees]: objects bend fingers (paper, Sec. 4.3)
  double sigma_overlap = 0.001;
  double prior_translation = 0.05;
  double prior_rotation_deg = 30.0;
  double prior_unseen_deg = 4.0;
  bool operator==(const EnergyParams&) const = default;
};

template <class V>
void visit(V& v, EnergyParams& p) {
  // Declare the keys for the distance between the model and the data.
  v("sigma_depth", p.sigma_depth, 1e-4, 0.05, "m, standard deviation of a surface distance");
  v("robust_scale", p.robust_scale, 5e-4, 0.1, "m, Geman-McClure scale of surface distances");
  v("gate", p.gate, 1e-3, 0.2, "m, larger surface distances are ignored");
  v("silhouette_scale", p.silhouette_scale, 5e-4, 0.1, "m, Geman-McClure scale of silhouette distances");
  v("silhouette_gate", p.silhouette_gate, 1e-3, 0.5, "m, larger silhouette distances are ignored");
  v("weight_outside", p.weight_outside, 0.0, 10.0, "weight of model pixels where the data shows no hand");
  v("weight_unexplained", p.weight_unexplained, 0.0, 10.0, "weight of hand data that no model pixel explains");
  v("palm_trust", p.palm_trust, 0.0, 1.0,
    "weight of the skin on the palm and the thumb's root relative to a phalanx's: its shape differs most between "
    "people");

  // Declare the keys for the joints and the contact of segments.
  v("sigma_gap", p.sigma_gap, 1e-5, 0.05, "m, standard deviation of the gap at a joint (Eq. 5)");
  v("sigma_angle_deg", p.sigma_angle_deg, 0.1, 45.0,
    "degrees, standard deviation of the twist and of angles beyond the limits (Eq. 6)");
  v.retired("limit_widening_deg", "tracker.fusion.limit_widening_deg");
  v("sigma_overlap", p.sigma_overlap, 1e-5, 10.0, "m, standard deviation of the overlap of two segments");

  // Declare the keys for the prediction.
  v("prior_translation", p.prior_translation, 1e-4, 10.0,
    "m, standard deviation of the palm's position about its prediction");
  v("prior_rotation_deg", p.prior_rotation_deg, 0.1, 3600.0,
    "degrees, standard deviation of the palm and of seen joints about their prediction");
  v("prior_unseen_deg", p.prior_unseen_deg, 0.1, 3600.0,
    "degrees, standard deviation of unseen joints about their prediction");
}

/// How the data term is weighted in one Gauss-Newton step.
struct DataWeighting {
  double widening = 1;  ///< factor on all gates and robust scales
  /// 0 to 1: fraction of the pull of unexplained data that acts in all directions; the rest acts only along the normal.
  double tangential = 0;
  /// Per segment, 0 (visible) to 1 (hidden): w' = w (1 - hidden) replaces each of the two skinning weights w of a
  /// vertex, which are then normalised. So skin that blends into a hidden segment moves its visible neighbour instead.
  /// The normal equations are exactly those of the energy where all values are 0.
  std::array<double, kSegmentCount> hidden{};
  double folds = 0;  ///< down-weights skin that blends two segments: see fold_penalty()
};

/// Gauss-Newton normal equations of the data term at `pose`, with Geman-McClure weights (iteratively reweighted least
/// squares). A surface correspondence pulls along the model's normal; skin outside the observed silhouette is pulled in
/// the image plane; skin that should be behind an object is pulled along the optical axis; unexplained data pulls along
/// the normal and, in part, along the surface. `comparison` must contain normals. Adds to `tree` and, if given, the
/// part that depends on the shape to `shape`; returns the robust energy.
double add_data_terms(const Skin& skin, const HandPose& pose, const ModelComparison& comparison,
                      const EnergyParams& params, const DataWeighting& weighting, GaussianTree& tree,
                      ShapeMoments* shape = nullptr);

/// Soft joints (paper, Eq. 4-6) as least squares: the joint gap, flexion and abduction beyond `limits` [rad], and
/// twist. Adds to `tree`; returns the energy.
double add_joint_terms(const HandProfile& profile, const std::array<JointLimits, kSegmentCount>& limits,
                       const HandPose& pose, const EnergyParams& params, GaussianTree& tree);

/// Weak pull to the predicted pose: the palm in the camera frame, every joint relative to its parent. `free[s]` in
/// [0, 1] blends the information of joint s from that of an unseen (0) to that of a fully seen joint (1). Adds to
/// `tree`; returns the energy.
double add_prior_terms(const HandProfile& profile, const HandPose& predicted,
                       const std::array<double, kSegmentCount>& free, const HandPose& pose, const EnergyParams& params,
                       GaussianTree& tree);

}  // namespace barehand
