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

/// How the pieces of the tracker play together, and the parameters of each.
struct TrackerParams {
  std::string skin = "blended";
  int skin_points = 100;
  double skin_cell = 0.004;
  bool sampling = true;
  double sampling_distinct = 0.005;
  double nominal_rate = 30;
  double seen_fraction = 0.15;
  bool hidden_follow = true;
  bool relax = true;
  bool side_check = true;
  bool size_check = true;
  int search_refined = 12;
  int search_iterations = 12;
  int full_search_every = 10;
  int search_attempts = 16;
  int doubt_every = 12;
  int doubt_near_every = 2;
  int doubt_iterations = 6;
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
  v("skin", p.skin, {"blended", "cylinders"},
    "skin of the local trackers: smooth, or the paper's cylinders (Sec. 3.1)");
  v("skin_points", p.skin_points, 10, 5000, "skin points per segment for the local trackers");
  v("skin_cell", p.skin_cell, 0.001, 0.02, "m, size of the smooth skin's triangles");
  v("sampling", p.sampling, "draw samples and fuse them by belief propagation (Sec. 4); false: refinement alone");
  v("sampling_distinct", p.sampling_distinct, 0.0, 1.0,
    "m, a sampled pose is refined if what is seen lies farther than this from the refined prediction");
  v("nominal_rate", p.nominal_rate, 1.0, 1000.0, "Hz, the frame rate at which the search ranges hold");
  v("seen_fraction", p.seen_fraction, 0.0, 1.0, "a segment counts as seen if so much of its skin agrees with data");
  v("hidden_follow", p.hidden_follow, "fingers that are not seen bend with their neighbours");
  v("relax", p.relax, "hidden joints of a pose that a search found are set to neutral angles");
  v("side_check", p.side_check,
    "compare the hand with one of the other side while it is searched and in its first frames");
  v("size_check", p.size_check, "compare the hand with smaller and larger ones");
  visit(v, p.choice);
  v("search_refined", p.search_refined, 1, 100, "start poses that are refined while searching");
  v("search_iterations", p.search_iterations, 1, 100, "Gauss-Newton steps for each of them");
  v("full_search_every", p.full_search_every, 1, 10000, "frames between full searches; quick ones in between");
  v("search_attempts", p.search_attempts, 1, 100,
    "full searches of one frame until one settles it, three agree or, of eight or more, all but one are alike or none "
    "explains it, while no hand was tracked before");
  v("doubt_every", p.doubt_every, 1, 100000,
    "of so many doubtful frames the middle one is searched anew, at first thoroughly");
  v("doubt_near_every", p.doubt_near_every, 1, 100000,
    "of so many doubtful frames one is searched near the followed pose, if not anew");
  v("doubt_iterations", p.doubt_iterations, 1, 100, "Gauss-Newton steps for each pose found near the followed one");
  v("segment_tracker", p.segment_tracker, "local trackers (Sec. 4.1, 4.2)");
  v("fusion", p.fusion, "soft constraints and belief propagation (Sec. 4.3, 4.4)");
  v("refinement", p.refinement, "continuous refinement of the best hypothesis");
  v("uncertainty", p.uncertainty, "how far the refined pose may be from the truth");
  v("prediction", p.prediction, "motion from frame to frame (Sec. 4.4)");
  v("icp", p.icp, "global motion (Sec. 4.4)");
  v("loss", p.loss, "when a hand counts as tracked");
  v("initialiser", p.initialiser, "start and restart from one observation");
  v("shape_fit", p.shape_fit, "learning the hand of the person in view");

  // One key serves every unit that needs the value.
  p.initialiser.min_hand_pixels = p.loss.min_hand_pixels;
  p.refinement.energy.limit_widening_deg = p.fusion.limit_widening_deg;
}

}  // namespace barehand
