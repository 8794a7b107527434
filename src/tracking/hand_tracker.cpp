// Tracks one hand: follows or searches it in each frame, and chooses one of the hypotheses.
#include "tracking/hand_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/segment_tracker/make_observer.h"

namespace barehand {
namespace {

bool sees_nothing(const RefinedPose& refined) {
  return std::ranges::all_of(refined.matched, [](double fraction) { return fraction == 0; });
}

}  // namespace

HandTracker::HandTracker(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::uint64_t seed,
                         Workers& workers, std::shared_ptr<spdlog::logger> log, HandIds ids,
                         std::shared_ptr<const Skin> skin)
    : context_{params, seed, workers, log, make_observer(params.segment_tracker, workers, log)},
      person_(context_, std::move(profile), std::move(skin)),
      follower_(context_),
      choice_(context_.params.choice),
      proposers_(context_, choice_),
      track_(params),
      estimates_(context_, ids) {}

HandEstimatePtr HandTracker::process(const HandObservation& observation) {
  const TrackEvidence evidence = begin_frame(observation);
  const bool enough_data = evidence.hand_pixels >= context_.params.loss.min_hand_pixels;
  start_where_given(observation, enough_data);
  if (!enough_data) return conclude(observation, std::nullopt, evidence);

  // Follow the hand from its last pose into this frame: predict, sample and refine.
  std::optional<Hypothesis> followed, other;
  if (track_.motion.has_pose())
    followed = follower_.follow(observation, person_.hand(), track_.motion, frame_, choice_);

  // Propose another pose. If the followed pose is good but ambiguous or tentative, propose an alternative to it
  // (Proposers::propose_alternative). If it is bad or missing, search the whole observation (Proposers::search_frame).
  const double score =
      followed ? choice_.score_with_detection(observation, person_.profile(), followed->refined) : INFINITY;
  if (score < track_.state.bad_threshold(evidence)) {
    track_.search_frames = 0;
    proposers_.look_again(observation, person_.hand(), track_, *followed, frame_);
    proposers_.uncross_fingers(observation, person_.hand(), *followed);
    track_.baseline.update(followed->score());
    other = proposers_.propose_alternative(observation, person_.hand(), track_, *followed, frame_);
  } else {
    const Effort effort = track_.effort(context_.params.full_search_every);
    other = search(observation, effort, track_.attempts(effort, context_.params.search_attempts));
  }
  if (!followed || !other) return conclude(observation, followed ? followed : other, evidence);

  // Choose.
  const bool replaced = choice_.replaces("search", *other, *followed, context_.params.choice.search_advantage);
  return conclude(observation, replaced ? other : followed, evidence);
}

HandEstimatePtr HandTracker::process(const HandObservation& observation, std::optional<Hypothesis> found,
                                     std::span<const Decision> decisions) {
  for (const Decision& decision : decisions) choice_.note(decision);
  TrackEvidence evidence = begin_frame(observation);
  if (!found) evidence.hand_pixels = 0;  // no pixel belongs to this hand
  return conclude(observation, found, evidence);
}

std::optional<Hypothesis> HandTracker::search(const HandObservation& observation, Effort effort, int attempts) {
  track_.searched = true;
  return proposers_.search_frame(observation, person_.hand(), track_, effort, attempts, frame_);
}

HandEstimatePtr HandTracker::conclude(const HandObservation& observation, const std::optional<Hypothesis>& best,
                                      TrackEvidence evidence) {
  // Update the state machine, and the track if the hand is tracked.
  const TrackStatus status = update_state(observation, best, evidence);
  const bool tracked = status == TrackStatus::tracking && best;
  if (tracked) commit(observation, *best);

  // Build the estimate before learning: the pose refers to the hand model as it was in this frame.
  const bool bad = evidence.score && *evidence.score > track_.state.bad_threshold(evidence);
  const bool ambiguous = best && track_.is_ambiguous(best->score(), context_.params.choice);
  HandEstimatePtr estimate =
      estimates_.build(observation, status, best ? &*best : nullptr, bad, ambiguous, person_, choice_.take());

  // Learn the person.
  const bool good = tracked && best->score() < track_.state.good_threshold(evidence);
  if (good) track_.last_good = best->refined.pose;
  if (tracked) person_.learn(observation, best->refined, good);
  person_.adopt_scan();
  return estimate;
}

TrackEvidence HandTracker::begin_frame(const HandObservation& observation) {
  const std::int64_t utime = observation.frame->utime;
  TrackEvidence evidence;
  // A recording played backwards has decreasing time stamps, so take the absolute difference.
  evidence.dt = last_utime_ ? std::abs(utime - last_utime_) * 1e-6 : 0.0;  // in seconds
  evidence.hand_pixels = observation.hand_present ? static_cast<int>(observation.hand_pixels.size()) : 0;
  evidence.noise = observation.noise;
  evidence.hand_length = person_.profile().hand_length();
  last_utime_ = utime;
  return evidence;
}

void HandTracker::start_where_given(const HandObservation& observation, bool enough_data) {
  const auto start = std::exchange(given_start_, std::nullopt);
  if (!start) return;
  if (!enough_data)
    return context_.log->warn("the given start pose is ignored, because its frame shows no hand; the hand is searched");
  track_.motion.restart(*start, observation.frame->utime);
  track_.state.start_tracking();
  start_track();
}

void HandTracker::start_track() {
  track_.ambiguous_frames = 0;
  track_.hidden_fingers.forget();
  proposers_.start_track();
  estimates_.start_track();
  person_.start_track();
}

TrackStatus HandTracker::update_state(const HandObservation& observation, const std::optional<Hypothesis>& best,
                                      TrackEvidence& evidence) {
  ++frame_;
  if (std::exchange(track_.searched, false)) ++track_.search_frames;

  // Collect the evidence of the best pose.
  if (best) {
    evidence.score = choice_.score_with_detection(observation, person_.profile(), best->refined);
    const bool confirms = track_.tentative() && best->prediction;
    evidence.to_be_confirmed = track_.needs_confirmation(*evidence.score, confirms, context_.params.choice);
    // The observation may be of something else, for example until the first pose has come back to preprocessing.
    if (best->prediction && sees_nothing(best->refined)) evidence.hand_pixels = 0;
  }

  // Update the state machine, and restart or clear the motion model when the phase requires it.
  const TrackPhase before = track_.state.phase(), phase = track_.state.update(evidence);
  if (phase != before)
    choice_.note({"state", to_string(phase), to_string(before), evidence.score.value_or(NAN), NAN, 0});
  if (phase == TrackPhase::tentative) {
    track_.motion.restart(best->refined.pose, observation.frame->utime);
  } else if (phase == TrackPhase::searching) {
    track_.motion.forget();
    track_.baseline.reset();
    track_.last_good.reset();
  }
  return track_.state.status();
}

void HandTracker::commit(const HandObservation& observation, const Hypothesis& best) {
  if (best.prediction) return track_.continue_with(best, person_.profile(), context_.params);

  // A pose that was found without a prediction starts a track, or resumes one.
  if (!track_.motion.has_pose()) start_track();
  if (best.size != 1) person_.note_size_mismatch(best.size);
  track_.motion.restart(best.refined.pose, observation.frame->utime);
}

void HandTracker::apply(const TrackRequest& request) {
  if (const auto* start = std::get_if<StartAt>(&request)) {
    given_start_ = start->pose;
  } else if (std::holds_alternative<ResetTracker>(request)) {
    reset_track();
    person_.reset();  // the next hand may be another person's
  } else if (const auto* other = std::get_if<UseProfile>(&request)) {
    reset_track();
    person_.use(other->profile);
  } else if (const auto* mismatch = std::get_if<NoteSizeMismatch>(&request)) {
    person_.note_size_mismatch(mismatch->size);
  } else if (const auto* near = std::get_if<CoupleWith>(&request)) {
    context_.couple_with(near->objects, estimates_.hand_id());
  } else if (const auto* changed = std::get_if<UseParams>(&request)) {
    // Do first what may throw, so that an exception leaves everything unchanged.
    std::shared_ptr<Observer> observer = context_.observer_for(changed->params);
    person_.change(changed->params, observer);

    context_.params = changed->params;
    context_.observer = std::move(observer);
    follower_.change();
    estimates_.change();
    track_.change(context_.params);
  }
}

void HandTracker::reset_track() {
  track_.forget();
  estimates_.reset();
  given_start_.reset();
}

TrackView HandTracker::view() const {
  const TrackerParams& params = context_.params;
  const HandPose* const last = track_.motion.has_pose() ? &track_.motion.pose() : nullptr;
  return {.status = track_.state.status(),
          .tentative = track_.tentative(),
          .size_mismatch = person_.size_in_view() != 1,
          .start_is_given = given_start_.has_value(),
          .expected_pose = given_start_ ? &*given_start_ : last,
          .profile = person_.shared_profile(),
          .skin = person_.shared_skin(),
          .effort = track_.effort(params.full_search_every),
          .full_attempts = track_.attempts(Effort::full, params.search_attempts)};
}

}  // namespace barehand
