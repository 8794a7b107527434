#pragma once

#include <memory>
#include <span>

#include "core/pool.h"
#include "stages/refinement/hand_contact.h"
#include "stages/refinement/hand_energy.h"
#include "stages/refinement/shape_moments.h"

namespace barehand {

struct RefinementParams {
  bool enabled = true;
  int iterations = 5;             ///< Gauss-Newton steps from the best hypothesis
  double damping = 1e-3;          ///< relative Levenberg damping
  double first_widening = 2;      ///< gates and robust scales start this much wider and shrink to 1
  double max_translation = 0.02;  ///< m, longest step of a segment
  double max_rotation_deg = 25;   ///< largest turn of a segment in one step
  ComparisonParams comparison;
  EnergyParams energy;
  bool operator==(const RefinementParams&) const = default;
};

template <class V>
void visit(V& v, RefinementParams& p) {
  v.user("enabled", p.enabled, "continuous refinement after the last level; false is the paper's method");
  v.user("iterations", p.iterations, 0, 100, "Gauss-Newton steps from the best hypothesis");
  v("damping", p.damping, 0.0, 1.0, "relative Levenberg damping");
  v("first_widening", p.first_widening, 1.0, 10.0, "gates and robust scales start this much wider and shrink to 1");
  v("max_translation", p.max_translation, 1e-3, 1.0, "m, longest step of a segment");
  v("max_rotation_deg", p.max_rotation_deg, 1.0, 180.0, "degrees, largest turn of a segment in one step");
  v("comparison", p.comparison, "model against data, pixel by pixel");
  v("energy", p.energy, "weights of the energy");
}

/// A pose, how well it explains the frame, and what was seen of each segment there.
struct RefinedPose {
  HandPose pose;
  double score = 0;                             ///< ModelComparison::score [m]
  std::array<double, kSegmentCount> visible{};  ///< fraction of the projected skin that is front-most
  std::array<double, kSegmentCount> matched{};  ///< fraction of the projected skin that agrees with hand data
  GaussianTree evidence;  ///< what the data alone says about the last step; none if no step was taken
};

/// Robust Gauss-Newton on all 96 numbers with the paper's soft joints: one model with the sampler, since the energy is
/// the negative log of Eq. 3 and Eq. 4-6. Both functions may be called from several threads at once.
class Refinement {
 public:
  Refinement(const RefinementParams& params, std::shared_ptr<const HandProfile> profile,
             std::shared_ptr<const Skin> skin);

  /// Moves `start` to a nearby optimum. `predicted` is the weak prior: a segment may leave it the more freely, the more
  /// of its skin agrees with data at `start`.
  RefinedPose refine(const HandObservation& observation, const HandPose& start, const HandPose& predicted,
                     int iterations) const;
  /// The same from that of the starts, at least one, which explains the frame best as it is; the first of equals.
  RefinedPose refine_best(const HandObservation& observation, std::span<const HandPose> starts,
                          const HandPose& predicted, int iterations) const;
  /// Score and visibility of a pose as it is.
  RefinedPose evaluate(const HandObservation& observation, const HandPose& pose) const;
  /// What the frame says about the hand's shape at a refined pose; `basis` belongs to the skin.
  void shape_equations(const HandObservation& observation, const HandPose& pose, const ShapeBasis& basis,
                       ShapeEquations& equations) const;

 private:
  /// Buffers of one call.
  struct Workspace {
    RenderedHand rendered;
    ModelComparison comparison;
    GaussianTree tree;
  };
  /// How finely model and data are compared.
  struct Detail {
    const Skin& skin;
    int stride;  // pixels
  };
  Detail fine() const;
  Detail coarse(const HandObservation& observation) const;
  void compare_at(const HandObservation& observation, const HandPose& pose, const Detail& detail, Normals normals,
                  Workspace& work) const;
  void summarise(const Workspace& work, RefinedPose& result) const;
  bool step(const HandPose& predicted, const std::array<double, kSegmentCount>& seen, const DataWeighting& weighting,
            const Skin& skin, Workspace& work, RefinedPose& refined) const;

  RefinementParams params_;
  std::shared_ptr<const HandProfile> profile_;
  std::shared_ptr<const Skin> skin_;
  Skin coarse_skin_;  // for all but the last steps
  std::array<JointLimits, kSegmentCount> limits_;
  HandContact contact_;
  mutable Pool<Workspace> workspaces_;
};

}  // namespace barehand
