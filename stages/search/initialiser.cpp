// Searches for the start pose of a hand: scores templates coarsely and refines the best ones.
#include "stages/search/initialiser.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

namespace barehand {

namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr double kMaxPitch = 0.9;  // largest tilt of a template towards the camera or away from it [rad]
constexpr int kSkinPoints = 600;   // surface points per segment: dense enough for the palm on the fine grid
constexpr int kLastGoodTurns = 8;  // in-plane rotations in which the last good pose is tried
// Centre and heel of the palm, as fractions of the palm's bone from the wrist.
constexpr double kPalmCentre = 0.6, kHeel = 0.3;
// Number of trials in one parallel task, for templates and for changed fingers.
constexpr int kPlacedTogether = 24, kChangedTogether = 6;
// Factor on the parameter `distinct` in the search near a pose, whose trials differ in one finger only, a fifth of the
// hand.
constexpr double kNearDistinct = 0.25;

/// Mean of the points that face a camera looking along `view`, weighted by their projected area.
Vector3d visible_mean(const CoarseSkin& skin, const HandPose& pose, const Vector3d& view) {
  Vector3d sum = Vector3d::Zero();
  double weight = 0;

  // Add up the points of each part in its own frame.
  for (const CoarseSkin::Part& part : skin.parts) {
    const SE3& T = pose[part.segment];
    const Eigen::Vector3f local_view = (T.R.transpose() * view).cast<float>();
    Eigen::Vector3f local = Eigen::Vector3f::Zero();
    float local_weight = 0;

    // Weight each point by its projected area.
    for (std::size_t i = 0; i < part.size(); ++i) {
      const float facing = -local_view.dot(Eigen::Vector3f(part.nx[i], part.ny[i], part.nz[i]));
      const float w = std::max(0.0f, facing) * part.width * part.width;
      local += w * Eigen::Vector3f(part.x[i], part.y[i], part.z[i]);
      local_weight += w;
    }

    // Transform the sum to the camera frame.
    sum += T.R * local.cast<double>() + local_weight * T.t;
    weight += local_weight;
  }
  return weight > 0 ? Vector3d(sum / weight) : pose[kPalm].t;
}

}  // namespace

/// A pose that is tried, and its cost once the cost is known.
struct Initialiser::Trial {
  std::string name;  ///< name of the template that it was made from
  ScoredPose scored;
  bool stays = false;  ///< whether it is scored at its own position instead of being moved onto the data
};

double pose_distance(const HandProfile& profile, const HandPose& a, const HandPose& b) {
  double sum = 0;
  for (int s = 0; s < kSegmentCount; ++s) sum += (distal_end(profile, a, s) - distal_end(profile, b, s)).norm();
  return sum / kSegmentCount;
}

Initialiser::Initialiser(std::shared_ptr<const HandProfile> profile, const Skin& skin, const InitialiserParams& params)
    : profile_(std::move(profile)),
      surface_(surface_points(skin, *profile_, kSkinPoints)),
      params_(params),
      limits_(widened_limits(*profile_, params.widening)),
      shapes_(shape_templates(*profile_, limits_)),
      coarse_skin_(make_coarse_skin(*profile_, surface_, params.coarse_cell)),
      fine_skin_(make_coarse_skin(*profile_, surface_, params.fine_cell)) {}

std::vector<StartCandidate> Initialiser::propose(const HandObservation& observation, Effort effort, std::uint64_t seed,
                                                 Workers& workers, HiddenCost hidden_cost,
                                                 const HandPose* last_good) const {
  if (static_cast<int>(observation.hand_pixels.size()) < params_.min_hand_pixels) return {};

  // Prepare the grids and the costs for both rounds.
  const SearchEffort& work = effort == Effort::full ? params_.full : params_.quick;
  const ScoreGrid coarse = make_score_grid(observation, params_.coarse_cell);
  const ScoreGrid fine = make_score_grid(observation, params_.fine_cell);
  if (coarse.empty() || fine.empty()) return {};
  CoarseScoreParams score = params_.score;
  if (hidden_cost == HiddenCost::ignored) score.hidden = 0;
  const PoseCost coarse_cost(*profile_, coarse, coarse_skin_, score, params_.search.shape_prior);
  const PoseCost fine_cost(*profile_, fine, fine_skin_, score, params_.search.shape_prior);
  const auto frame = static_cast<std::uint32_t>(observation.frame->number);

  // Lay all templates over the data and keep the best. In a quick search, the in-plane rotations are shifted from frame
  // to frame by the golden ratio, so that successive frames cover different ones.
  const double turn = effort == Effort::quick ? std::fmod(0.6180339887 * frame, 1.0) : 0.0;
  Trials trials = template_shapes(work, turn);
  if (last_good) std::ranges::move(last_good_shapes(*last_good), std::back_inserter(trials));
  for_each_trial(trials, coarse_cost, kPlacedTogether, workers,
                 [&](Trial& trial, std::uint32_t, PoseCost& cost) { place(trial, coarse, cost); });
  trials = most_promising(std::move(trials), work.first_survivors, 2 * params_.distinct, work.distant_fraction);

  // First round: improve the kept poses by a random search on the coarse grid.
  for_each_trial(trials, coarse_cost, 1, workers, [&](Trial& trial, std::uint32_t number, PoseCost& cost) {
    const KeyedRandom random(seed, frame, 1, number);
    trial.scored = search_pose(trial.scored, cost, limits_, work.first_evaluations, random, params_.search);
  });
  trials = most_promising(std::move(trials), work.second_survivors, params_.distinct, work.distant_fraction);

  // Second round: align the best of these to the hand's points by ICP, and improve them on the fine grid.
  const ObservedCloud cloud(observation);
  for_each_trial(trials, fine_cost, 1, workers, [&](Trial& trial, std::uint32_t number, PoseCost& cost) {
    trial.scored.cost = cost(trial.scored.articulated);
    align(trial, observation, cloud, cost);
    const KeyedRandom random(seed, frame, 2, number);
    trial.scored = search_pose(trial.scored, cost, limits_, work.second_evaluations, random, params_.search);
  });
  return ranked(std::move(trials), params_.distinct, work.distant_fraction);
}

std::vector<StartCandidate> Initialiser::propose_near(const HandObservation& observation, const HandPose& followed,
                                                      std::uint64_t seed, Workers& workers) const {
  if (static_cast<int>(observation.hand_pixels.size()) < params_.min_hand_pixels) return {};
  const ScoreGrid grid = make_score_grid(observation, params_.fine_cell);
  if (grid.empty()) return {};
  const PoseCost cost(*profile_, grid, fine_skin_, params_.score, params_.search.shape_prior);
  const auto frame = static_cast<std::uint32_t>(observation.frame->number);

  // Try the pose with each finger changed, and keep the best.
  Trials trials = changed_fingers(followed);
  for_each_trial(trials, cost, kChangedTogether, workers,
                 [&](Trial& trial, std::uint32_t, PoseCost& own) { place(trial, grid, own); });
  const double distinct = kNearDistinct * params_.distinct;
  trials = most_promising(std::move(trials), params_.near_survivors, distinct, 0);

  // Improve the best trials by a local random search.
  for_each_trial(trials, cost, 1, workers, [&](Trial& trial, std::uint32_t number, PoseCost& own) {
    const KeyedRandom random(seed, frame, 3, number);
    trial.scored = search_pose(trial.scored, own, limits_, params_.near_evaluations, random, params_.search);
  });
  return ranked(std::move(trials), distinct, 0);
}

std::vector<StartCandidate> Initialiser::ranked(Trials trials, double distinct, double distant_fraction) const {
  std::vector<StartCandidate> result;
  for (Trial& trial : most_promising(std::move(trials), params_.results, distinct, distant_fraction))
    result.push_back({trial.name, posed(*profile_, trial.scored.articulated), trial.scored.cost});
  return result;
}

/// The pose itself, and the pose with each finger bent as in each of the templates.
Initialiser::Trials Initialiser::changed_fingers(const HandPose& pose) const {
  const ArticulatedPose original = articulated_from(*profile_, pose, limits_);
  Trials trials{{"followed", {original, 0}, true}};
  for (int finger = 0; finger < kFingerCount; ++finger) {
    for (const ShapeTemplate& shape : shapes_) {
      // Replace the angles of this finger.
      ArticulatedPose changed = original;
      for (int k = 0; k < 3; ++k) {
        const int s = segment_of(finger, k);
        changed.angles[s].flexion = shape.angles[s].flexion;
        if (finger == 0) changed.angles[s].abduction = shape.angles[s].abduction;
      }

      trials.push_back({std::string(shape.name), {changed, 0}, true});
    }
  }
  return trials;
}

/// Calls visit(trial, number of the trial, cost function) for every trial, in parallel. Every task has its own copy of
/// the cost function and visits `together` trials.
template <class Visit>
void Initialiser::for_each_trial(Trials& trials, const PoseCost& cost, int together, Workers& workers,
                                 const Visit& visit) {
  const int count = static_cast<int>(trials.size());
  workers.for_each_index((count + together - 1) / together, [&](int task) {
    PoseCost own = cost;
    for (int i = task * together; i < std::min((task + 1) * together, count); ++i)
      visit(trials[i], static_cast<std::uint32_t>(i), own);
  });
}

/// The templates in all orientations, without a position. `turn`: offset of the in-plane rotations, as a fraction of
/// their step.
Initialiser::Trials Initialiser::template_shapes(const SearchEffort& effort, double turn) const {
  // If only some shapes are used, they are spread over all templates, so that open and closed hands are among them.
  const std::size_t count = std::min<std::size_t>(effort.shapes, shapes_.size());
  Trials trials;

  // Combine every shape with every orientation.
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t i = n * shapes_.size() / count;
    for (int r = 0; r < effort.rolls; ++r) {
      for (int p = 0; p < effort.pitches; ++p) {
        const double pitch = effort.pitches > 1 ? kMaxPitch * (2.0 * p / (effort.pitches - 1) - 1) : 0.0;
        for (int k = 0; k < effort.in_plane; ++k) {
          // Turn the hand; where it lies in the image is found later.
          ArticulatedPose pose;
          pose.angles = shapes_[i].angles;
          pose.T_camera_palm.R =
              palm_orientation(2 * kPi * r / effort.rolls, pitch, 2 * kPi * (k + turn) / effort.in_plane);
          trials.push_back({std::string(shapes_[i].name), {pose, 0}});
        }
      }
    }
  }
  return trials;
}

/// Shifts the start pose of a trial so that it meets the observed hand, in three ways, and keeps the best one. It puts
/// the mean of the model's visible skin at the centroid of the hand's pixels; the centre of the palm at their widest
/// part, which is right even if fingers are hidden; or the heel of the palm there, in case half of the palm is hidden.
void Initialiser::place(Trial& trial, const ScoreGrid& grid, PoseCost& cost) const {
  const ArticulatedPose shape = trial.scored.articulated;
  if (trial.stays) {
    trial.scored.cost = cost(shape);
    return;
  }

  // Compute the three shifts.
  const HandPose pose = posed(*profile_, shape);
  const Vector3d view = grid.centroid.normalized();
  const SegmentProfile& palm = profile_->segments[kPalm];
  const Vector3d skin_on_bone = -0.5 * palm.half_thickness[1] * view;
  const std::array<Vector3d, 3> steps = {grid.centroid - visible_mean(coarse_skin_, pose, view),
                                         grid.palm_centre - (pose[kPalm] * (kPalmCentre * palm.distal) + skin_on_bone),
                                         grid.palm_centre - (pose[kPalm] * (kHeel * palm.distal) + skin_on_bone)};

  // Keep the one with the lowest cost.
  trial.scored.cost = std::numeric_limits<double>::infinity();
  for (const Vector3d& step : steps) {
    ScoredPose placed{shape, 0};
    placed.articulated.T_camera_palm.t += step;
    placed.cost = cost(placed.articulated);
    if (placed.cost < trial.scored.cost) trial.scored = placed;
  }
}

/// The last good pose at its own position, and several in-plane rotations of it to be moved onto the data.
Initialiser::Trials Initialiser::last_good_shapes(const HandPose& last_good) const {
  ArticulatedPose pose = articulated_from(*profile_, last_good, limits_);
  Trials trials{{"last", {pose, 0}, true}};
  const SE3 original = pose.T_camera_palm;
  for (int k = 0; k < kLastGoodTurns; ++k) {
    const Eigen::AngleAxisd turn(2 * kPi * k / kLastGoodTurns, Vector3d::UnitZ());
    pose.T_camera_palm = SE3{turn.toRotationMatrix() * original.R, original.t};
    trials.push_back({"last", {pose, 0}});
  }
  return trials;
}

/// Returns the best `count` trials of which no two are closer than `distinct` [m], best first. A fraction
/// `distant_fraction` of them is reserved for the best trials that are farther than params_.apart from all others, if
/// there are any, so that variants of one pose do not displace all other poses.
Initialiser::Trials Initialiser::most_promising(Trials trials, int count, double distinct,
                                                double distant_fraction) const {
  const auto by_cost = [](const Trial& a, const Trial& b) { return a.scored.cost < b.scored.cost; };
  std::ranges::stable_sort(trials, by_cost);
  Trials chosen;
  std::vector<HandPose> poses;
  std::vector<bool> taken(trials.size());
  // Chooses trials from index `from` on that are at least `apart` away from all chosen ones, until `up_to` are chosen.
  // Returns the index at which it stopped.
  const auto choose = [&](std::size_t from, int up_to, double apart) {
    std::size_t i = from;
    for (; i < trials.size() && static_cast<int>(chosen.size()) < up_to; ++i) {
      if (taken[i]) continue;

      // Leave out a trial that is too close to a chosen one.
      const HandPose pose = posed(*profile_, trials[i].scored.articulated);
      const bool twin = std::ranges::any_of(
          poses, [&](const HandPose& other) { return pose_distance(*profile_, pose, other) < apart; });
      if (twin) continue;
      taken[i] = true;
      poses.push_back(pose);
      chosen.push_back(std::move(trials[i]));
    }
    return i;
  };

  // Choose the best ones first. Fill the rest with trials that are far from all others, and then with any.
  const std::size_t rest = choose(0, count - static_cast<int>(distant_fraction * count), distinct);
  choose(rest, count, std::max(distinct, params_.apart));
  choose(rest, count, distinct);
  std::ranges::stable_sort(chosen, by_cost);
  return chosen;
}

/// Aligns a trial rigidly to the observed points by ICP; the result is kept if it lowers the cost.
void Initialiser::align(Trial& trial, const HandObservation& observation, const ObservedCloud& cloud,
                        PoseCost& cost) const {
  const HandPose pose = posed(*profile_, trial.scored.articulated);
  VisiblePoints visible;
  const auto model = visible.of(surface_, pose, observation.frame->camera, params_.icp.model_points);
  const IcpResult icp = align_rigid(model, cloud, SE3{}, motion_bound(params_.icp), params_.icp);
  if (!icp.reliable) return;
  ScoredPose aligned = trial.scored;
  aligned.articulated.T_camera_palm = icp.motion * aligned.articulated.T_camera_palm;
  aligned.cost = cost(aligned.articulated);
  if (aligned.cost < trial.scored.cost) trial.scored = aligned;
}

}  // namespace barehand
