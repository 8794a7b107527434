#pragma once

#include "math/random.h"
#include "stages/search/coarse_score.h"
#include "stages/search/start_templates.h"

namespace barehand {

/// Parameters of the random local search over palm pose and joint angles (search_pose). Its steps shrink, and only
/// better poses are kept.
struct PoseSearchParams {
  double translation = 0.012;
  double rotation = 0.2;
  double flexion = 0.45;
  double abduction = 0.12;
  double final_step = 0.2;
  double shape_prior = 0.02;
  bool operator==(const PoseSearchParams&) const = default;
};

template <class V>
void visit(V& v, PoseSearchParams& p) {
  v("translation", p.translation, 1e-4, 0.5, "m, standard deviation of the first steps of the position");
  v("rotation", p.rotation, 1e-3, 3.0, "rad, standard deviation of the first steps of the orientation");
  v("flexion", p.flexion, 1e-3, 3.0, "rad, standard deviation of the first steps of the flexion angles");
  v("abduction", p.abduction, 1e-3, 3.0, "rad, standard deviation of the first steps of the abduction angles");
  v("final_step", p.final_step, 1e-3, 1.0, "size of the last steps as a fraction of the first");
  v("shape_prior", p.shape_prior, 0.0, 10.0,
    "cost of a difference of one radian between the flexion of neighbouring fingers (mean square)");
}

struct ScoredPose {
  ArticulatedPose articulated;
  double cost = 0;  ///< coarse score plus shape prior; lower is better
};

/// Cost of a pose in the search: coarse score plus a prior that neighbouring fingers have similar flexion, which
/// determines hidden fingers. Not thread-safe; copies are independent.
class PoseCost {
 public:
  /// `profile` and `skin` must outlive the object.
  PoseCost(const HandProfile& profile, const ScoreGrid& grid, const CoarseSkin& skin, const CoarseScoreParams& score,
           double shape_prior)
      : profile_(profile), scorer_(grid, skin, score), shape_prior_(shape_prior) {}
  double operator()(const ArticulatedPose& pose);

 private:
  const HandProfile& profile_;
  CoarseScorer scorer_;
  double shape_prior_;
};

/// Improves `start`, whose cost must be set, by `evaluations` random trials. The trials depend on `random` only.
ScoredPose search_pose(ScoredPose start, PoseCost& cost, const std::array<JointLimits, kSegmentCount>& limits,
                       int evaluations, KeyedRandom random, const PoseSearchParams& params);

}  // namespace barehand
