#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/parallel/parallel.h"
#include "hand/skin.h"
#include "observe/registration/rigid_icp.h"
#include "stages/search/pose_search.h"

namespace barehand {

// The search for the start pose of a hand.

/// Effort of a search: the number of templates that are scored on the coarse grid, and the numbers of those that the
/// two later rounds improve.
struct SearchEffort {
  int in_plane = 16;
  int rolls = 8;
  int pitches = 3;
  int shapes = 6;
  int first_survivors = 72;
  int first_evaluations = 120;
  int second_survivors = 24;
  int second_evaluations = 400;
  double distant_fraction = 0.34;
  bool operator==(const SearchEffort&) const = default;
};

template <class V>
void visit(V& v, SearchEffort& p) {
  // Declare the keys for the templates.
  v("in_plane", p.in_plane, 1, 360, "number of in-plane rotations of every template");
  v("rolls", p.rolls, 1, 360, "number of rotations about the finger axis, among them palm and back to the camera");
  v("pitches", p.pitches, 1, 90, "number of tilts of the fingers towards the camera and away from it");
  v("shapes", p.shapes, 1, 6, "number of shape templates, from open to fist");

  // Declare the keys for the two rounds.
  v("first_survivors", p.first_survivors, 1, 10000, "number of templates that are improved on the coarse grid");
  v("first_evaluations", p.first_evaluations, 0, 100000,
    "random trials for each template that is improved on the coarse grid");
  v("second_survivors", p.second_survivors, 1, 10000,
    "number of poses that are improved further, by ICP and on the fine grid");
  v("second_evaluations", p.second_evaluations, 0, 100000,
    "random trials for each pose that is improved on the fine grid");

  // Declare the key for the variety of the kept poses.
  v.formerly("elsewhere");
  v("distant_fraction", p.distant_fraction, 0.0, 1.0,
    "fraction of the poses kept in each round that must differ from the others by `apart`");
}

/// Parameters of the search for a start pose (Initialiser).
struct InitialiserParams {
  double coarse_cell = 0.008;
  double fine_cell = 0.005;
  double widening = 0.17;
  int min_hand_pixels = 200;  ///< with fewer hand pixels, no start pose is proposed
  int results = 12;
  double distinct = 0.012;
  double apart = 0.06;
  int near_survivors = 2;
  int near_evaluations = 60;
  SearchEffort full;
  SearchEffort quick{8, 4, 3, 3, 8, 60, 3, 200, 0};
  CoarseScoreParams score;
  PoseSearchParams search;
  RegistrationParams icp;
  bool operator==(const InitialiserParams&) const = default;
};

template <class V>
void visit(V& v, InitialiserParams& p) {
  // Declare the keys for a search without a pose.
  v("coarse_cell", p.coarse_cell, 1e-3, 0.1, "m, cell size while templates are scored");
  v("fine_cell", p.fine_cell, 1e-3, 0.1, "m, cell size of the second round");
  v("widening", p.widening, 0.0, 1.0, "rad by which the profile's joint limits are widened");
  v.retired("min_hand_pixels", "tracker.loss.min_hand_pixels");
  v("results", p.results, 1, 1000, "maximum number of start poses that are returned");
  v("distinct", p.distinct, 0.0, 1.0, "m, minimum distance between two results (mean over the segment ends)");
  v("apart", p.apart, 0.0, 1.0, "m, minimum distance between poses that count as being in different places");

  // Declare the keys for a search near a pose.
  v("near_survivors", p.near_survivors, 1, 10000,
    "search near a followed pose: number of poses with changed fingers that are improved on the fine grid");
  v("near_evaluations", p.near_evaluations, 0, 100000, "search near a followed pose: random trials for each pose");

  // Declare the groups of keys.
  v("full", p.full, "effort of a full search");
  v("quick", p.quick, "effort of the search in every frame while the hand is lost");
  v("score", p.score, "coarse score of a whole pose");
  v("search", p.search, "random local search");
  v("icp", p.icp, "rigid alignment of the survivors");
}

/// A proposed start pose; its joints are closed.
struct StartCandidate {
  std::string name;  ///< the template that it was made from, for example "open" or "last"
  HandPose pose;
  double cost = 0;  ///< coarse score with shape prior; comparable within one observation
};

enum class Effort { quick, full };

/// Cost of model cells that are hidden behind an object: `counted` means a small cost, which suits a mostly visible
/// hand; `ignored` means none.
enum class HiddenCost { counted, ignored };

/// Proposes start poses from a single observation. (Not in the paper, whose start is manual; Sec. 5.2.) Templates of
/// hand shapes are laid over the hand's pixels in many orientations, scored by silhouette and depth, and the best are
/// improved. The handedness is that of the profile. Deterministic: the result depends on the arguments only, not on the
/// number of threads.
class Initialiser {
 public:
  /// `skin`: of the profile.
  Initialiser(std::shared_ptr<const HandProfile> profile, const Skin& skin, const InitialiserParams& params);

  /// Returns start poses, best first; none if the observation shows too little of a hand. `last_good`: last good pose
  /// before a loss, which is tried at its own position and, in several in-plane rotations, moved onto the data. A quick
  /// search uses other orientations of the templates in every frame, so that successive frames complement each other.
  /// `hidden_cost` should be `ignored` if so little of the hand is visible that otherwise the most compact shape would
  /// win.
  std::vector<StartCandidate> propose(const HandObservation& observation, Effort effort, std::uint64_t seed,
                                      Workers& workers, HiddenCost hidden_cost = HiddenCost::counted,
                                      const HandPose* last_good = nullptr) const;

  /// Returns start poses near `followed`, best first. The palm of `followed` must be about right, since the search
  /// tries only this pose and poses in which one finger is bent as in a template. It improves the best on the fine
  /// grid.
  std::vector<StartCandidate> propose_near(const HandObservation& observation, const HandPose& followed,
                                           std::uint64_t seed, Workers& workers) const;

 private:
  struct Trial;
  using Trials = std::vector<Trial>;
  template <class Visit>
  static void for_each_trial(Trials& trials, const PoseCost& cost, int together, Workers& workers, const Visit& visit);
  Trials template_shapes(const SearchEffort& effort, double turn) const;
  Trials changed_fingers(const HandPose& pose) const;
  std::vector<StartCandidate> ranked(Trials trials, double distinct, double distant_fraction) const;
  Trials last_good_shapes(const HandPose& last_good) const;
  void place(Trial& trial, const ScoreGrid& grid, PoseCost& cost) const;
  Trials most_promising(Trials trials, int count, double distinct, double distant_fraction) const;
  void align(Trial& trial, const HandObservation& observation, const ObservedCloud& cloud, PoseCost& cost) const;

  std::shared_ptr<const HandProfile> profile_;
  HandSurface surface_;
  InitialiserParams params_;
  std::array<JointLimits, kSegmentCount> limits_;
  std::vector<ShapeTemplate> shapes_;
  CoarseSkin coarse_skin_, fine_skin_;
};

/// Mean distance between the distal ends of the 16 segments in two poses [m].
double pose_distance(const HandProfile& profile, const HandPose& a, const HandPose& b);

}  // namespace barehand
