#include "tracking/hypotheses/proposers.h"

#include <algorithm>
#include <utility>

#include "stages/pose_prior/crossed_fingers.h"
#include "stages/search/cut_hand.h"
#include "stages/search/inverse_kinematics.h"
#include "tracking/hypotheses/neutral_pose.h"
#include "tracking/hypotheses/restart_consensus.h"

namespace barehand {
namespace {

// Hypotheses that do not continue the track: from the detected joints, from searches of the observation, and from
// uncrossing fingers.

constexpr std::uint64_t kAttemptSeed = 1000003;  // difference between the random seeds of two attempts in one frame

// Thresholds on the log odds that a detection is a hand (HandEvidence).
constexpr double kPossibleHand = 0,  // below, the detection is ignored
    kProvenHand = 3,                 // from here on, with the evidence of the pose and earlier frames, it is a hand
    kCertainHand = 6;                // from here on, the networks alone suffice
constexpr double kAwaited = 1;       // is added to the log odds while a lost hand is awaited
constexpr double kSamePalm = 0.06;   // a pose whose palm is farther from the detected one is not that hand's [m]

/// Whether the palm of a pose is where the networks see it. Forearms are often explained better by some pose than fists
/// are.
bool is_there(const DetectedHand& detected, const HandPose& pose) {
  const Eigen::Vector3d palm = 0.5 * (pose[kPalm].t + pose[segment_of(2, 0)].t);
  return (palm - detected.centre).norm() < kSamePalm;
}

}  // namespace

std::optional<Hypothesis> Proposers::search_frame(const HandObservation& observation, const HandModel& hand,
                                                  Track& track, Effort effort, int attempts,
                                                  std::uint32_t frame) const {
  const TrackerParams& params = context_.params;
  if (static_cast<int>(observation.hand_pixels.size()) < params.loss.min_hand_pixels) return std::nullopt;

  // What is detected may be something other than a hand.
  const DetectedHand* const unproven = observation.detected.get();
  double log_odds = kCertainHand;
  if (unproven) log_odds = unproven->hand_log_odds + (track.was_followed() ? kAwaited : 0);
  if (log_odds < kPossibleHand) {
    track.evidence.forget(unproven->centre);
    return std::nullopt;
  }

  // Unless the networks are certain, the refined pose and earlier frames must confirm that it is a hand.
  std::optional<Hypothesis> best = detected(observation, hand);
  if (best && !is_there(*unproven, best->refined.pose)) best.reset();
  if (log_odds < kCertainHand) {
    const double of_pose = best ? log_odds_of_pose(best->refined, *hand.profile, *unproven) : 0;
    if (track.evidence.add(frame, unproven->centre, log_odds + of_pose) < kProvenHand) return std::nullopt;
  }

  // If the detected pose explains the frame well, no search is needed.
  if (best && choice_.score_with_detection(observation, *hand.profile, best->refined) < params.loss.recovered_score)
    return best;

  // Repeat the search until further attempts would not help (RestartConsensus).
  RestartConsensus poses(*hand.profile, params.choice.sufficient_score, params.loss.recovered_score);
  for (int attempt = 0; attempt < attempts && !poses.converged(); ++attempt) {
    auto found = search_once(observation, hand, track, effort, attempt, frame);
    if (!found || (unproven && !is_there(*unproven, found->refined.pose))) continue;
    const bool better = poses.add(found->refined.pose, found->score());
    if (better && (!best || found->score() < best->score())) best = std::move(found);
  }
  return best;
}

std::optional<Hypothesis> Proposers::propose_alternative(const HandObservation& observation, const HandModel& hand,
                                                         Track& track, const Hypothesis& followed,
                                                         std::uint32_t frame) const {
  // A tentative track is compared with what the networks see now. Without a detection it gets a full search, since the
  // quick search that found it might repeat its mistake.
  const TrackerParams& params = context_.params;
  if (track.tentative()) {
    if (observation.detected) return detected(observation, hand);
    return search_once(observation, hand, track, Effort::full, 0, frame);
  }
  if (!track.is_ambiguous(followed.score(), params.choice)) return std::nullopt;

  // The pose is ambiguous: fingers may be confused with their neighbours. The detected joints, if any, resolve that;
  // without a detection, every n-th such frame is searched near the followed pose.
  const int frames = ++track.ambiguous_frames;
  if (observation.detected) return detected(observation, hand);
  if (frames % params.ambiguous_near_every == 0) return search_near(observation, hand, followed.refined.pose, frame);
  return std::nullopt;
}

void Proposers::look_again(const HandObservation& observation, const HandModel& hand, const Track& track,
                           Hypothesis& followed, std::uint32_t frame) {
  const bool ambiguous = track.is_ambiguous(followed.score(), context_.params.choice);
  const auto pose = second_opinion_.next(observation, hand, followed, ambiguous, frame);
  if (!pose) return;
  auto best = best_of(Origin::detected, observation, hand, {{"detected", *pose}}, context_.params.near_iterations);
  if (choice_.replaces("second look", *best, followed, 0)) followed = std::move(*best);
}

void Proposers::uncross_fingers(const HandObservation& observation, const HandModel& hand, Hypothesis& followed) const {
  const TrackerParams& params = context_.params;
  if (!params.refinement.enabled || !params.choice.uncross_fingers) return;
  const auto apart = uncrossed(*hand.profile, followed.refined.pose, params.initialiser.widening);
  if (!apart) return;
  auto best = best_of(Origin::uncrossed, observation, hand, {{"uncrossed", *apart}}, params.near_iterations);
  if (choice_.replaces("uncross", *best, followed, -kUncrossAllowance)) followed = std::move(*best);
}

/// Fits a pose to the detected joints by inverse kinematics, then refines it like every start pose.
std::optional<Hypothesis> Proposers::detected(const HandObservation& observation, const HandModel& hand) const {
  if (!observation.detected) return std::nullopt;
  const DetectedJoints& joints = observation.detected->joints_of(hand.profile->handedness);
  std::vector<StartCandidate> starts;
  const auto add = [&](const char* name, const DetectedJoints& of) {
    if (const auto fit = fit_to_joints(*hand.profile, of)) starts.push_back({name, fit->pose});
  };
  add("detected", joints);
  if (cut_by_border(joints, observation.frame->camera))
    for (const DetectedJoints& others : with_fingers_moved(joints)) add("cut", others);
  auto best = best_of(Origin::detected, observation, hand, starts, context_.params.search_iterations);
  set_neutral_joints(observation, hand, best);
  return best;
}

std::optional<Hypothesis> Proposers::search_once(const HandObservation& observation, const HandModel& hand,
                                                 const Track& track, Effort effort, int attempt,
                                                 std::uint32_t frame) const {
  const HiddenCost hidden_cost = attempt == 0 ? HiddenCost::counted : HiddenCost::ignored;
  const std::uint64_t seed = context_.seed + frame + attempt * kAttemptSeed;
  const HandPose* const last_good = track.last_good ? &*track.last_good : nullptr;
  auto best = best_of(Origin::searched, observation, hand,
                      hand.initialiser->propose(observation, effort, seed, context_.workers, hidden_cost, last_good),
                      context_.params.search_iterations);
  set_neutral_joints(observation, hand, best);
  return best;
}

std::optional<Hypothesis> Proposers::search_near(const HandObservation& observation, const HandModel& hand,
                                                 const HandPose& followed, std::uint32_t frame) const {
  const auto starts = hand.initialiser->propose_near(observation, followed, context_.seed + frame, context_.workers);
  return best_of(Origin::near, observation, hand, starts, context_.params.near_iterations);
}

std::optional<Hypothesis> Proposers::best_of(Origin origin, const HandObservation& observation, const HandModel& hand,
                                             const std::vector<StartCandidate>& starts, int iterations) const {
  std::vector<RefinedPose> refined(std::min<std::size_t>(context_.params.search_refined, starts.size()));
  if (refined.empty()) return std::nullopt;
  context_.workers.for_each_index(static_cast<int>(refined.size()), [&](int i) {
    refined[i] = hand.refinement.refine(observation, starts[i].pose, starts[i].pose, iterations);
  });
  Hypothesis best;
  best.origin = origin;
  best.refined = *std::ranges::min_element(refined, {}, &RefinedPose::score);
  best.joint_gap = joint_gap(*hand.profile, best.refined.pose);
  return best;
}

/// Sets unobserved joints to neutral angles, since a search leaves them at random ones (neutral_pose).
void Proposers::set_neutral_joints(const HandObservation& observation, const HandModel& hand,
                                   std::optional<Hypothesis>& found) const {
  if (found)
    found->refined = neutral_pose(observation, found->refined, *hand.profile, hand.refinement, context_.params);
}

}  // namespace barehand
