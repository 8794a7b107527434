#include "stages/refinement/refinement.h"

#include <algorithm>
#include <cmath>

#include "math/angles.h"

namespace barehand {
namespace {

// Minimises the energy of a pose by Gauss-Newton steps, with a coarse and then a fine comparison.

// Value of EnergyParams::palm_trust while the hand's shape is fitted: the palm's skin is being corrected, so it gets
// more weight than in tracking.
constexpr double kShapePalmTrust = 0.3;
// Value of EnergyParams::robust_scale while the hand's shape is fitted [m]: the skin of a mean hand (the average of
// many people) must change most where its error is largest, so large distances are not outliers.
constexpr double kShapeRobustScale = 0.012;

// Number of final steps that compare finely. Far from the optimum, a coarse comparison yields about the same step at a
// lower cost.
constexpr int kFineSteps = 3;
constexpr int kContactPoints = 60;          // points of each segment's skin that are compared with objects
constexpr double kCoarseCell = 0.006;       // cell size of the coarse skin [m]
constexpr std::size_t kManyPixels = 10000;  // for a hand with more pixels, a coarse comparison uses every other cell

// If less than this fraction of a segment's skin matches data, the skin that blends the segment with a neighbour at a
// joint moves the segment less (not at all if nothing matches) and the neighbour more.
constexpr double kShown = 0.1;
constexpr double kFolds = 4;  // DataWeighting::folds for skin that was not scanned

using Shares = std::array<double, kSegmentCount>;

// How freely each segment may leave its prediction, from 0 to 1: as far as its skin matches data, and as far as data
// beside it is explained by nothing. Noise would turn a segment of which a sliver is seen.
Shares freedom(const ModelComparison& comparison, const RenderedHand& rendered) {
  Shares free;
  for (int s = 0; s < kSegmentCount; ++s) {
    const double cells = comparison.matched[s] + comparison.unexplained[s];
    free[s] = std::min(1.0, cells / std::max(1, rendered.projected[s]));
  }
  return free;
}

// How hidden each segment is.
Shares hidden_of(const RefinedPose& pose) {
  Shares hidden;
  std::ranges::transform(pose.matched, hidden.begin(), [](double share) { return 1 - share; });
  return hidden;
}

}  // namespace

Refinement::Refinement(const RefinementParams& params, std::shared_ptr<const HandProfile> profile,
                       std::shared_ptr<const Skin> skin)
    : params_(params),
      profile_(std::move(profile)),
      skin_(std::move(skin)),
      coarse_skin_(coarsened(*skin_, kCoarseCell)),
      limits_(widened_limits(*profile_, params.energy.limit_widening_deg * kDegree)),
      contact_(*profile_),
      object_contact_(params.objects,
                      params.objects.enabled ? surface_points(*skin_, *profile_, kContactPoints) : HandSurface()) {}

Refinement::Detail Refinement::fine() const { return {*skin_, params_.comparison.stride}; }

Refinement::Detail Refinement::coarse(const HandObservation& observation) const {
  return {coarse_skin_, params_.comparison.stride * (observation.hand_pixels.size() < kManyPixels ? 1 : 2)};
}

void Refinement::compare_at(const HandObservation& observation, const HandPose& pose, const Detail& detail,
                            Normals normals, Workspace& work) const {
  render_hand(detail.skin, pose, observation.frame->camera, grid_of(observation, detail.stride), work.rendered,
              normals);
  compare(observation, detail.skin, pose, work.rendered, params_.comparison, work.comparison);
}

void Refinement::summarise(const Workspace& work, RefinedPose& result) const {
  result.score = work.comparison.score;
  for (int s = 0; s < kSegmentCount; ++s) {
    const double projected = std::max(1, work.rendered.projected[s]);
    result.visible[s] = std::min(1.0, work.comparison.visible[s] / projected);
    result.beyond[s] = std::min(1.0, work.rendered.beyond[s] / projected);
    result.matched[s] = std::min(1.0, work.comparison.matched[s] / projected);
  }
}

bool Refinement::step(const HandPose& predicted, const std::array<double, kSegmentCount>& free,
                      const DataWeighting& weighting, const Skin& skin, std::span<const NearbyObject> objects,
                      Workspace& work, RefinedPose& refined) const {
  HandPose& pose = refined.pose;

  // Store the evidence of the data separately, because the covariance is computed from it.
  refined.evidence.set_zero();
  add_data_terms(skin, pose, work.comparison, params_.energy, weighting, refined.evidence);

  // Add the joints, the contact between fingers and with objects, the prior and the damping.
  GaussianTree& tree = work.tree = refined.evidence;
  add_joint_terms(*profile_, limits_, pose, params_.energy, tree);
  contact_.add_terms(pose, params_.energy.sigma_overlap, tree);
  if (!objects.empty()) {
    const auto rests = object_contact_.add_terms(pose, objects, hidden_of(refined), tree).rests;
    for (int finger = 0; finger < kFingerCount; ++finger) refined.holds[finger].rests = rests[finger];
  }
  add_prior_terms(*profile_, predicted, free, pose, params_.energy, tree);
  for (int s = 0; s < kSegmentCount; ++s) {
    tree.H_self[s].diagonal() *= 1 + params_.damping;
    tree.H_self[s].diagonal().array() += 1e-3;  // negligible, but keeps the step finite in unconstrained directions
  }

  // Solve. A step that is too long is shortened by one factor for all segments, which keeps the joints closed.
  std::array<Vector6d, kSegmentCount> x;
  if (!tree.solve(x)) return false;
  double scale = 1;
  for (const Vector6d& twist : x) {
    scale = std::min(scale, params_.max_translation / std::max(twist.head<3>().norm(), 1e-12));
    scale = std::min(scale, params_.max_rotation_deg * kDegree / std::max(twist.tail<3>().norm(), 1e-12));
  }

  // Apply the step to all segments.
  for (int s = 0; s < kSegmentCount; ++s) {
    pose[s] = boxplus(pose[s], scale * x[s]);
    pose[s].R = orthonormalised(pose[s].R);
  }
  return true;
}

RefinedPose Refinement::evaluate(const HandObservation& observation, const HandPose& pose) const {
  const auto work = workspaces_.take();
  RefinedPose result;
  result.pose = pose;
  result.evidence.set_zero();
  compare_at(observation, pose, fine(), Normals::left_out, *work);
  summarise(*work, result);
  return result;
}

RefinedPose Refinement::refine(const HandObservation& observation, const HandPose& start, const HandPose& predicted,
                               int iterations, std::span<const NearbyObject> objects) const {
  return refine_best(observation, {&start, 1}, predicted, iterations, objects);
}

RefinedPose Refinement::refine_best(const HandObservation& observation, std::span<const HandPose> starts,
                                    const HandPose& predicted, int iterations,
                                    std::span<const NearbyObject> objects) const {
  const auto is_fine = [&](int i) { return i + kFineSteps >= iterations; };

  // Only the first steps compare coarsely; the last ones and the score after them compare finely.
  const auto detail = [&](int i) { return is_fine(i) ? fine() : coarse(observation); };

  // Choose the start that fits the frame best.
  auto work = workspaces_.take();
  RefinedPose result;
  result.pose = starts[0];
  result.evidence.set_zero();
  compare_at(observation, starts[0], detail(0), Normals::computed, *work);

  for (const HandPose& start : starts.subspan(1)) {
    auto other = workspaces_.take();
    compare_at(observation, start, detail(0), Normals::computed, *other);
    if (other->comparison.score >= work->comparison.score) continue;
    std::swap(work, other);
    result.pose = start;
  }
  summarise(*work, result);
  const Shares free = freedom(work->comparison, work->rendered);

  const bool measured = profile_->origin == ProfileOrigin::measured;

  // Until the skin is scanned, its folds at joints are only a guess, whose errors would slowly rotate a hidden finger.
  const bool folds_known = profile_->scanned_skin != nullptr;
  DataWeighting weighting;
  if (!folds_known)
    for (int s = 0; s < kSegmentCount; ++s) weighting.hidden[s] = std::max(0.0, 1 - result.matched[s] / kShown);

  // Take Gauss-Newton steps with gates and robust scales that shrink from step to step.
  for (int i = 0; i < iterations; ++i) {
    const double progress = iterations > 1 ? static_cast<double>(i) / (iterations - 1) : 1;
    weighting.widening = 1 + (params_.first_widening - 1) * (1 - progress);
    // Towards the last step, unexplained data pulls the model less and less along its surface: near the silhouette such
    // a pull is wrong even if the model fits (see add_unexplained() in hand_energy.cpp). If the profile was not
    // measured, the model's silhouette is further off than the error that this avoids, so the full pull is kept.
    weighting.tangential = measured ? std::clamp(weighting.widening - 1, 0.0, 1.0) : 1;
    weighting.folds = is_fine(i) && !folds_known ? kFolds : 0;  // wrong folds disturb only the fine steps

    if (!step(predicted, free, weighting, detail(i).skin, objects, *work, result)) break;
    compare_at(observation, result.pose, detail(i + 1), i + 1 < iterations ? Normals::computed : Normals::left_out,
               *work);
  }

  summarise(*work, result);
  if (!objects.empty()) {
    const auto closed = object_contact_.closed(*profile_, limits_, result.pose, objects, hidden_of(result));
    for (int finger = 0; finger < kFingerCount; ++finger) result.holds[finger].closed = closed[finger];
  }
  return result;
}

void Refinement::shape_equations(const HandObservation& observation, const HandPose& pose, const ShapeBasis& basis,
                                 ShapeEquations& equations) const {
  const auto work = workspaces_.take();
  compare_at(observation, pose, fine(), Normals::computed, *work);

  // Weight the data for fitting the shape instead of tracking.
  equations.set_zero();
  GaussianTree& tree = equations.tree;
  EnergyParams energy = params_.energy;
  energy.palm_trust = kShapePalmTrust;
  energy.robust_scale = kShapeRobustScale;

  // Sum up the data and everything else that constrains the pose.
  ShapeMoments moments;
  moments.reset(pose, skin_->vertices.size());
  add_data_terms(*skin_, pose, work->comparison, energy, {}, tree, &moments);
  add_joint_terms(*profile_, limits_, pose, energy, tree);
  contact_.add_terms(pose, energy.sigma_overlap, tree);
  add_prior_terms(*profile_, pose, freedom(work->comparison, work->rendered), pose, energy, tree);
  for (int s = 0; s < kSegmentCount; ++s) tree.H_self[s].diagonal().array() += 1e-3;

  // Couple the pose with the shape.
  moments.add_to(*skin_, basis, equations);
  add_joint_shape(*profile_, pose, basis, energy.sigma_gap, equations);
}

}  // namespace barehand
