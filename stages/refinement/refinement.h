#pragma once

#include <memory>
#include <span>

#include "core/pool.h"
#include "stages/refinement/hand_contact.h"
#include "stages/refinement/hand_energy.h"
#include "stages/refinement/object_contact.h"
#include "stages/refinement/shape_moments.h"

namespace barehand {

// Continuous refinement of a hand's pose.

/// Settings of the continuous refinement.
struct RefinementParams {
  bool enabled = true;
  int iterations = 5;
  double damping = 1e-3;
  double first_widening = 2;
  double max_translation = 0.02;
  double max_rotation_deg = 25;
  ComparisonParams comparison;
  EnergyParams energy;
  ObjectContactParams objects;
  bool operator==(const RefinementParams&) const = default;
};

template <class V>
void visit(V& v, RefinementParams& p) {
  v.user("enabled", p.enabled, "refine the pose continuously after the last level; false: the paper's method");
  v.user("iterations", p.iterations, 0, 100, "Gauss-Newton steps from the best hypothesis");
  v("damping", p.damping, 0.0, 1.0, "Levenberg-Marquardt damping relative to the diagonal");
  v("first_widening", p.first_widening, 1.0, 10.0,
    "factor on the gates and robust scales in the first step; it shrinks to 1");
  v("max_translation", p.max_translation, 1e-3, 1.0, "m, longest translation of a segment in one step");
  v("max_rotation_deg", p.max_rotation_deg, 1.0, 180.0, "degrees, largest rotation of a segment in one step");
  v("comparison", p.comparison, "comparison of model and data, pixel by pixel");
  v("energy", p.energy, "weights of the energy");
  v("objects", p.objects, "known objects, which hold back and attract fingers");
}

/// A refined pose, its score, and how much of each segment was seen.
struct RefinedPose {
  HandPose pose;
  double score = 0;                             ///< ModelComparison::score [m]
  std::array<double, kSegmentCount> visible{};  ///< fraction of the projected skin that is front-most
  std::array<double, kSegmentCount> matched{};  ///< fraction of the projected skin that agrees with hand data
  std::array<double, kSegmentCount> beyond{};   ///< fraction of the projected skin beyond the border of the image
  std::array<FingerHold, kFingerCount> holds;   ///< what the objects that couple with the hand say; else empty
  GaussianTree evidence;  ///< normal equations of the data alone at the last step; zero if no step was taken
};

/// Robust Gauss-Newton on all 96 numbers of the pose with the paper's soft joints. It optimises the same model as the
/// sampler: the energy is the negative logarithm of the paper's Eq. 3 and Eq. 4-6. All const functions may be called
/// from several threads at once.
class Refinement {
 public:
  Refinement(const RefinementParams& params, std::shared_ptr<const HandProfile> profile,
             std::shared_ptr<const Skin> skin);

  /// Moves `start` to a nearby optimum. `predicted` is the weak prior: the more of a segment's skin agrees with data
  /// at `start`, the more freely it may leave its prediction. `iterations`: number of Gauss-Newton steps.
  /// `objects`: the known objects that couple with this hand.
  RefinedPose refine(const HandObservation& observation, const HandPose& start, const HandPose& predicted,
                     int iterations, std::span<const NearbyObject> objects = {}) const;
  /// Like refine(), but starts from the one of `starts` (at least one) that fits the frame best before any step; among
  /// equally good ones, from the first.
  RefinedPose refine_best(const HandObservation& observation, std::span<const HandPose> starts,
                          const HandPose& predicted, int iterations, std::span<const NearbyObject> objects = {}) const;
  /// Score and visibility of an unchanged pose.
  RefinedPose evaluate(const HandObservation& observation, const HandPose& pose) const;
  /// Normal equations of the hand's shape at a refined pose; `basis` must belong to the skin that this
  /// Refinement was made with.
  void shape_equations(const HandObservation& observation, const HandPose& pose, const ShapeBasis& basis,
                       ShapeEquations& equations) const;

 private:
  /// Buffers of one call, pooled because calls may run in parallel.
  struct Workspace {
    RenderedHand rendered;
    ModelComparison comparison;
    GaussianTree tree;
  };
  /// How finely model and data are compared: which skin, and the spacing of the compared pixels.
  struct Detail {
    const Skin& skin;
    int stride;  // every n-th pixel in both directions
  };
  Detail fine() const;
  Detail coarse(const HandObservation& observation) const;
  void compare_at(const HandObservation& observation, const HandPose& pose, const Detail& detail, Normals normals,
                  Workspace& work) const;
  // Copies the score and the visible and matched fractions of the segments to `result`.
  void summarise(const Workspace& work, RefinedPose& result) const;
  // One Gauss-Newton step on `refined.pose`. `free`: as in add_prior_terms(). Returns false if the normal equations
  // cannot be solved.
  bool step(const HandPose& predicted, const std::array<double, kSegmentCount>& free, const DataWeighting& weighting,
            const Skin& skin, std::span<const NearbyObject> objects, Workspace& work, RefinedPose& refined) const;

  RefinementParams params_;
  std::shared_ptr<const HandProfile> profile_;
  std::shared_ptr<const Skin> skin_;
  Skin coarse_skin_;  // used in all but the last steps
  std::array<JointLimits, kSegmentCount> limits_;
  HandContact contact_;
  ObjectContact object_contact_;
  mutable Pool<Workspace> workspaces_;
};

}  // namespace barehand
