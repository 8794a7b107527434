#pragma once

#include <cstdint>
#include <string>

#include "person/shape_fit.h"
#include "stages/fusion/fusion_params.h"
#include "stages/prediction/motion_prediction.h"
#include "stages/refinement/pose_uncertainty.h"
#include "stages/refinement/refinement.h"
#include "stages/search/initialiser.h"
#include "stages/segment_tracker/segment_tracker_params.h"
#include "tracking/hypotheses/choice.h"
#include "tracking/track_state.h"

namespace barehand {

/// Parameters of the tracker as a whole, and those of each of its parts.
struct TrackerParams {
  std::string skin = "blended";
  int skin_points = 100;
  double skin_cell = 0.004;
  bool sampling = true;
  double sampling_distinct = 0.005;
  double nominal_rate = 30;
  double seen_fraction = 0.15;
  bool hidden_follow = true;
  bool neutral_joints = true;
  bool side_check = true;
  bool size_check = true;
  int search_refined = 12;
  int search_iterations = 12;
  int full_search_every = 10;
  int search_attempts = 16;
  int ambiguous_near_every = 2;
  int near_iterations = 6;
  ChoiceParams choice;
  SegmentTrackerParams segment_tracker;
  FusionParams fusion;
  RefinementParams refinement;
  UncertaintyParams uncertainty;
  PredictionParams prediction;
  IcpParams icp;
  LossParams loss;
  InitialiserParams initialiser;
  ShapeFitParams shape_fit;
  bool operator==(const TrackerParams&) const = default;
};

template <class V>
void visit(V& v, TrackerParams& p) {
  // These describe the skin of the local trackers.
  v("skin", p.skin, {"blended", "cylinders"},
    "skin of the local trackers: smooth, or the paper's cylinders (Sec. 3.1)");
  v("skin_points", p.skin_points, 10, 5000, "number of skin points per segment for the local trackers");
  v("skin_cell", p.skin_cell, 0.001, 0.02, "m, size of the smooth skin's triangles");

  // These control the sampling.
  v("sampling", p.sampling, "draw samples and fuse them by belief propagation (Sec. 4); false: refinement alone");
  v("sampling_distinct", p.sampling_distinct, 0.0, 1.0,
    "m, a sampled pose is refined only if its seen segments lie farther than this from the refined prediction");
  v("nominal_rate", p.nominal_rate, 1.0, 1000.0, "Hz, frame rate for which the ranges of the local trackers are set");

  // These concern the segments that are not seen.
  v("seen_fraction", p.seen_fraction, 0.0, 1.0,
    "a segment counts as seen if at least this fraction of its skin matches the data");
  v("hidden_follow", p.hidden_follow, "fingers that are not seen bend with the neighbouring fingers");
  v.formerly("relax");
  v("neutral_joints", p.neutral_joints, "set the hidden joints of a pose that a search found to neutral angles");

  // These test other profiles against the data.
  v("side_check", p.side_check,
    "test whether the mirrored hand explains the data better, while searching and in the first tracked frames");
  v("size_check", p.size_check, "test whether a smaller or larger hand explains the data better");

  // These choose between hypotheses, and control the search.
  visit(v, p.choice);
  v("search_refined", p.search_refined, 1, 100, "number of start poses that a search refines");
  v("search_iterations", p.search_iterations, 1, 100, "Gauss-Newton steps for each start pose that a search refines");
  v("full_search_every", p.full_search_every, 1, 10000,
    "every n-th frame without a hand is searched with full effort, the others quickly");
  v("search_attempts", p.search_attempts, 1, 100,
    "maximum number of full searches of one frame while no hand has been tracked yet; they end early once one result "
    "is good enough, three agree or, from eight on, all but one agree or none explains the frame");

  // These set how often a search follows an ambiguous pose.
  for (const char* key : {"doubt_every", "ambiguous_search_every"}) v.without_effect(key);
  v.formerly("doubt_near_every");
  v("ambiguous_near_every", p.ambiguous_near_every, 1, 100000,
    "of every n consecutive ambiguous frames one is searched near the followed pose");
  v.formerly("doubt_iterations");
  v("near_iterations", p.near_iterations, 1, 100, "Gauss-Newton steps for each pose found near the followed one");

  // These are groups of their own, for the stages and the track.
  v("segment_tracker", p.segment_tracker, "local trackers (Sec. 4.1, 4.2)");
  v("fusion", p.fusion, "soft constraints and belief propagation (Sec. 4.3, 4.4)");
  v("refinement", p.refinement, "continuous refinement of the best hypothesis");
  v("uncertainty", p.uncertainty, "stated uncertainty of the refined pose");
  v("prediction", p.prediction, "motion from frame to frame (Sec. 4.4)");
  v("icp", p.icp, "global motion of the hand by ICP (Sec. 4.4)");
  v("loss", p.loss, "when a hand counts as tracked, and when as lost");
  v("initialiser", p.initialiser, "search for start poses in one observation");
  v("shape_fit", p.shape_fit, "learning the hand of the person in view");

  // Parameters that have no configuration key of their own are set from those of other groups.
  p.initialiser.min_hand_pixels = p.loss.min_hand_pixels;
  p.refinement.energy.limit_widening_deg = p.fusion.limit_widening_deg;
}

}  // namespace barehand
