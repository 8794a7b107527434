// Follows a hand into the next frame: predicts, samples and refines its pose.
#include "tracking/hypotheses/follower.h"

#include <algorithm>
#include <utility>

namespace barehand {
namespace {

constexpr double kDistinct = 0.001;  // start poses with a smaller pose_distance() count as the same [m]

}  // namespace

Follower::Follower(const TrackerContext& context) : context_(context), budget_(context.params.segment_tracker) {}

void Follower::change() { budget_ = SampleBudget(context_.params.segment_tracker); }

Hypothesis Follower::follow(const HandObservation& observation, HandModel& hand, MotionModel& motion,
                            std::uint32_t frame, Choice& choice) {
  // Predict.
  const TrackerParams& params = context_.params;
  Hypothesis followed;
  followed.prediction = motion.predict(observation, *hand.surface);

  // Sample and refine in parallel; neither needs the other's result. The sampler has index 0, so that it starts first:
  // it distributes its own work over the idle threads, and a thread that is still busy with the refinement cannot help.
  const bool refine = params.refinement.enabled, sampling = params.sampling || !refine;
  FusedPose fused;
  context_.workers.for_each_index(2, [&](int i) {
    if (i == 0 && sampling) fused = sample(observation, hand, *followed.prediction, frame);
    if (i == 1 && refine) followed.refined = refine_best_start(observation, hand, *followed.prediction);
  });
  followed.joint_gap = joint_gap(*hand.profile, sampling ? fused.pose : followed.refined.pose);

  // Without refinement, the result is the sampled pose, as in the paper.
  if (!refine) {
    followed.origin = Origin::sampled;
    followed.refined = hand.refinement.evaluate(observation, fused.pose);
    followed.belief = fused.covariance;
    return followed;
  }

  // Refine the sampled pose if it differs from the refined prediction. It replaces the refined prediction only if its
  // score is clearly better: a good local optimum must not be replaced by a pose that is merely as good.
  if (!sampling || !is_distinct(*hand.profile, followed.refined, fused.pose)) return followed;
  Hypothesis sampled;
  sampled.origin = Origin::sampled;
  sampled.refined = hand.refinement.refine(observation, fused.pose, followed.prediction->primary(),
                                           params.refinement.iterations, context_.objects);
  if (choice.replaces("sampling", sampled, followed, params.choice.sampling_advantage)) {
    followed.origin = Origin::sampled;
    followed.refined = std::move(sampled.refined);
  }
  return followed;
}

FusedPose Follower::sample(const HandObservation& observation, HandModel& hand, const Prediction& prediction,
                           std::uint32_t frame) {
  const PreparedObservation& prepared = hand.segment_tracker.prepare(observation, prediction.primary());
  const bool on_device = context_.observer->on_device();
  if (budget_.to_be_measured(on_device)) measure_budget(prepared, hand, prediction.primary(), frame);

  // On each level, draw and weight the samples of every segment, fuse them by belief propagation, and centre the
  // proposals of the next level on the best samples.
  const double factor = interval_factor(prediction.dt);
  const Proposals* proposals = &hand.fusion.first_proposals(prediction.primary(), factor);
  const int levels = context_.params.fusion.levels;

  // Go through the levels; the last one yields the fused pose.
  for (int level = 0;; ++level) {
    const int count = budget_.samples(context_.observer->on_device());
    const SegmentSamples& samples =
        hand.segment_tracker.sample(prepared, *proposals, {context_.seed, frame, level, levels}, count);
    const HandBelief& belief = hand.fusion.fuse(samples, level);
    if (level + 1 == levels) return hand.fusion.read_out(samples, belief, factor);
    proposals = &hand.fusion.next_proposals(samples, belief, level, factor);
  }
}

/// Measures how many samples fit into the time budget by running the first level of a frame; the results are discarded.
void Follower::measure_budget(const PreparedObservation& prepared, HandModel& hand, const HandPose& predicted,
                              std::uint32_t frame) {
  budget_.measure([&](int count) {
    const Proposals& proposals = hand.fusion.first_proposals(predicted);
    const SampleKey key{context_.seed, frame, 0, context_.params.fusion.levels};
    const SegmentSamples& samples = hand.segment_tracker.sample(prepared, proposals, key, count);
    const HandBelief& belief = hand.fusion.fuse(samples, 0);
    hand.fusion.next_proposals(samples, belief, 0);
  });
  context_.log->info("{}", budget_.to_text());
}

/// Factor on the search ranges, which are given for the nominal frame rate: longer intervals between frames widen them.
double Follower::interval_factor(double dt) const { return std::clamp(dt * context_.params.nominal_rate, 0.5, 4.0); }

RefinedPose Follower::refine_best_start(const HandObservation& observation, const HandModel& hand,
                                        const Prediction& prediction) {
  starts_.assign(1, prediction.primary());
  for (std::size_t i = 1; i < prediction.candidates.size(); ++i) {
    const HandPose& pose = prediction.candidates[i].pose;
    if (pose_distance(*hand.profile, pose, prediction.primary()) >= kDistinct) starts_.push_back(pose);
  }
  return hand.refinement.refine_best(observation, starts_, prediction.primary(), context_.params.refinement.iterations,
                                     context_.objects);
}

/// Whether a visible segment of the sampled pose is in another place than in the refined one. Otherwise refining the
/// sampled pose would lead to the refined one again.
bool Follower::is_distinct(const HandProfile& profile, const RefinedPose& refined, const HandPose& sampled) const {
  const TrackerParams& params = context_.params;
  for (int s = 0; s < kSegmentCount; ++s) {
    if (refined.visible[s] < params.seen_fraction) continue;
    if ((refined.pose[s].t - sampled[s].t).norm() > params.sampling_distinct) return true;
    const double tips_apart = (distal_end(profile, refined.pose, s) - distal_end(profile, sampled, s)).norm();
    if (tips_apart > params.sampling_distinct) return true;
  }
  return false;
}

}  // namespace barehand
