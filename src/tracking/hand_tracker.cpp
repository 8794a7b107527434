#include "tracking/hand_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stages/pose_prior/crossed_fingers.h"
#include "stages/pose_prior/hidden_fingers.h"
#include "stages/search/inverse_kinematics.h"
#include "stages/segment_tracker/make_observer.h"
#include "tracking/clearly_better.h"
#include "tracking/found_poses.h"
#include "tracking/relaxed_pose.h"

namespace barehand {
namespace {

constexpr double kMicro = 1e-6;
constexpr std::uint64_t kAttemptSeed = 1000003;  // between the random numbers of two attempts of one frame
constexpr int kQuickFirst = 2;                   // quick searches after a hand was followed, before a full one
constexpr double kElsewhereAdvantage = 0.3;      // of a pose that is not alike, to replace the one followed until now
constexpr double kUnlike = 2;                    // times the usual score
constexpr double kUnsure = 1.25;                 // times the usual score: found again if the next frame confirms it
constexpr double kDistinct = 0.001;              // start poses closer than this are the same [m]

}  // namespace

HandTracker::HandTracker(const TrackerParams& params, std::shared_ptr<const HandProfile> profile, std::uint64_t seed,
                         Workers& workers, std::shared_ptr<spdlog::logger> log, HandIds ids)
    : params_(params),
      seed_(seed),
      workers_(workers),
      log_(std::move(log)),
      given_(std::move(profile)),
      observer_(make_observer(params_.segment_tracker, workers_, log_)),
      budget_(params_.segment_tracker),
      model_(std::make_unique<HandModel>(params_, given_, workers_, observer_)),
      motion_(params_.prediction, params_.icp),
      loss_(params_.loss),
      uncertainty_(params_.uncertainty, params_.refinement.energy),
      ids_(ids) {
  if (params_.shape_fit.enabled) meet_person();
}

void HandTracker::reset() {
  loss_.reset();
  motion_.forget();
  unconfirmed_ = false;
  last_good_.reset();
  requested_start_.reset();
  last_tracked_.reset();
  search_frames_ = 0;
  usual_score_.reset();
  if (params_.shape_fit.enabled) forget_person();  // whoever comes next may be somebody else
}

void HandTracker::forget_person() {
  if (model_->profile != given_) model_ = std::make_unique<HandModel>(params_, given_, workers_, observer_);
  meet_person();
}

void HandTracker::change(const TrackerParams& params) {
  std::shared_ptr<Observer> observer = make_observer(params.segment_tracker, workers_, log_);
  auto model = std::make_unique<HandModel>(params, model_->profile, workers_, observer);  // until here it may throw
  params_ = params;
  observer_ = std::move(observer);
  budget_ = SampleBudget(params_.segment_tracker);
  model_ = std::move(model);
  if (person_) person_->expect_new_skin();
  if (size_check_) size_check_.emplace(params.refinement, model_->profile, model_->skin);
  MotionModel motion(params.prediction, params.icp);
  if (motion_.has_pose()) motion.restart(motion_.pose(), motion_.utime());
  motion_ = std::move(motion);
  const bool followed = loss_.status() == TrackStatus::tracking || loss_.status() == TrackStatus::holding;
  loss_ = LossDetector(params.loss);
  uncertainty_ = PoseUncertainty(params.uncertainty, params.refinement.energy);
  if (followed) loss_.start_tracking();
}

HandEstimatePtr HandTracker::process(const HandObservation& observation) {
  const TrackEvidence seen = evidence(observation);
  const bool enough = seen.hand_pixels >= params_.loss.min_hand_pixels;
  if (const auto start = std::exchange(requested_start_, std::nullopt)) {
    if (enough)
      begin_at(*start, observation.frame->utime);
    else
      log_->warn("the given pose is not used: its frame shows no hand, which is searched for now");
  }
  std::optional<Fit> fit;
  if (enough) fit = explain(observation, loss_.bad_threshold(seen));
  return judge(observation, fit, seen);
}

void HandTracker::begin_at(const HandPose& pose, std::int64_t utime) {
  motion_.restart(pose, utime);
  loss_.start_tracking();
  greet_new_hand();
  unconfirmed_ = false;
}

HandEstimatePtr HandTracker::process(const HandObservation& observation, std::optional<Fit> found) {
  TrackEvidence seen = evidence(observation);
  if (!found) seen.hand_pixels = 0;
  return judge(observation, found, seen);
}

Effort HandTracker::effort() const {
  // A hand that was followed until now is most likely near: a full search would only hold up its next frames.
  const int first_full = was_followed() ? std::min(kQuickFirst, params_.full_search_every - 1) : 0;
  return search_frames_ % params_.full_search_every == first_full ? Effort::full : Effort::quick;
}

TrackEvidence HandTracker::evidence(const HandObservation& observation) {
  const std::int64_t utime = observation.frame->utime;
  TrackEvidence evidence;
  // A recording played backwards has falling stamps: what counts is the time between frames.
  evidence.dt = last_utime_ ? std::abs(utime - last_utime_) * kMicro : 0.0;
  evidence.hand_pixels = observation.hand_present ? static_cast<int>(observation.hand_pixels.size()) : 0;
  evidence.noise = observation.noise;
  evidence.hand_length = model_->profile->hand_length();
  last_utime_ = utime;
  return evidence;
}

HandEstimatePtr HandTracker::judge(const HandObservation& observation, const std::optional<Fit>& fit,
                                   TrackEvidence evidence) {
  ++frame_;
  if (std::exchange(searched_, false)) ++search_frames_;
  const double score = fit ? judged_score(observation, fit->refined) : INFINITY;
  const bool unconfirmed = fit && needs_confirmation(*fit, score);
  if (fit && !unconfirmed && !unlike_before(score)) evidence.score = score;
  const TrackStatus status = loss_.update(evidence);
  unconfirmed_ = unconfirmed && status == TrackStatus::lost;
  const bool tracked = status == TrackStatus::tracking && fit;
  const bool good = tracked && fit->refined.score < loss_.good_threshold(evidence);
  if (tracked) {
    remember(observation, *fit);
    if (good) last_good_ = fit->refined.pose;
  } else if (unconfirmed_) {
    motion_.restart(fit->refined.pose, observation.frame->utime);
  } else if (status == TrackStatus::searching) {
    motion_.forget();
    usual_score_.reset();
    last_good_.reset();
  }
  HandEstimatePtr result = estimate(observation, fit);
  // What is learnt counts from the next frame on: this one was explained with the hand as it was.
  if (tracked && size_check_) check_size(observation, fit->refined);
  if (good) learn_person(observation, fit->refined.pose);
  use_scan();
  return result;
}

std::optional<HandTracker::Fit> HandTracker::explain(const HandObservation& observation, double bad_score) {
  std::optional<Fit> fit, found;
  if (motion_.has_pose()) fit = follow(observation);
  const double score = fit ? judged_score(observation, fit->refined) : INFINITY;
  if (fit && score < bad_score && !unlike_before(score)) {
    search_frames_ = 0;
    uncross(observation, *fit);
    const bool doubt = doubtful(fit->refined.score);  // asked always: it learns what is usual
    if (unconfirmed_)                                 // thoroughly: a quick search may be wrong once more
      found = search_once(observation, Effort::full, 0);
    else if (doubt)
      found = search_doubtful(observation, fit->refined.pose);
  } else {  // nothing to follow, or following fails: the hand may be anywhere
    found = look(observation, effort(), attempts(effort()));
  }
  if (!fit || !found) return fit ? fit : found;
  const bool elsewhere =
      !unconfirmed_ && pose_distance(*model_->profile, fit->refined.pose, found->refined.pose) > kAlike;
  const double advantage = elsewhere ? kElsewhereAdvantage : params_.search_advantage;
  return clearly_better(found->refined.score, fit->refined.score, advantage) ? found : fit;
}

void HandTracker::uncross(const HandObservation& observation, Fit& fit) {
  constexpr double kMeasure = 0.05;  // fingers side by side may explain a frame so much worse and are still more likely
  if (!params_.refinement.enabled) return;
  const auto other = uncrossed(*model_->profile, fit.refined.pose, params_.initialiser.widening);
  if (!other) return;
  const auto apart = best_of(observation, {{"uncrossed", *other}}, params_.doubt_iterations);
  if (apart->refined.score < fit.refined.score * (1 + kMeasure)) fit = *apart;
}

std::optional<HandTracker::Fit> HandTracker::search_doubtful(const HandObservation& observation,
                                                             const HandPose& followed) {
  ++doubtful_frames_;
  if (observation.detected) return propose_detected(observation);
  const int first = (params_.doubt_every + 1) / 2;
  // A hand that is taken for something else looks wrong from its start on; later doubts are mostly about fingers.
  if (doubtful_frames_ == first) return search_once(observation, Effort::full, 1);
  if (doubtful_frames_ % params_.doubt_every == first % params_.doubt_every)
    return search_once(observation, Effort::quick, 0);
  if (doubtful_frames_ % params_.doubt_near_every == 0) return search_near(observation, followed);
  return std::nullopt;
}

bool HandTracker::worse_than_usual(double score, double factor) const {
  return score >= std::max(params_.search_convincing, factor * usual_score_.level());
}

// A hand that was lost a moment ago is known: what is explained so much worse is half of it, or something else.
bool HandTracker::unlike_before(double score) const {
  return loss_.status() == TrackStatus::lost && worse_than_usual(score, kUnlike);
}

// Found again, and explained somewhat worse than usual, even if convincing: half of a hand fits many poses a little.
bool HandTracker::needs_confirmation(const Fit& found, double score) const {
  const bool confirms = unconfirmed_ && found.prediction;
  return loss_.status() == TrackStatus::lost && !confirms && score > kUnsure * usual_score_.level() &&
         !unlike_before(score);
}

// Explained, but not as well as this hand usually is: some fingers may be where their neighbours are.
bool HandTracker::doubtful(double score) {
  usual_score_.update(score);
  return worse_than_usual(score, 1 + params_.doubt);
}

void HandTracker::remember(const HandObservation& observation, const Fit& fit) {
  if (!fit.prediction) {
    if (!motion_.has_pose()) greet_new_hand();
    if (fit.size != 1) doubt_size(fit.size);
    motion_.restart(fit.refined.pose, observation.frame->utime);
    return;
  }
  std::array<bool, kSegmentCount> seen;
  for (int s = 0; s < kSegmentCount; ++s) seen[s] = fit.refined.matched[s] >= params_.seen_fraction;
  HandPose pose = fit.refined.pose;
  if (params_.hidden_follow)
    pose = with_hidden_following(*model_->profile, motion_.pose(), pose, fit.prediction->dt, seen, fit.refined.matched,
                                 params_.initialiser.widening);
  motion_.update(pose, seen, *fit.prediction);
}

void HandTracker::greet_new_hand() {
  hand_id_ = hand_id_ ? hand_id_ + ids_.step : ids_.first;
  doubtful_frames_ = 0;
  if (scan_) scan_->restart();
  const bool doubted = std::exchange(size_in_view_, 1) != 1;  // it may be somebody else's now
  if (doubted || (person_ && model_->profile->scanned_skin))
    size_check_.emplace(params_.refinement, model_->profile, model_->skin);
}

void HandTracker::check_size(const HandObservation& observation, const RefinedPose& refined) {
  if (doubts_size()) return;
  const auto size = size_check_->look(observation, refined.pose, refined.score);
  if (!size) return;
  if (!person_) return doubt_size(*size);
  log_->info("a hand of {:.2f} times the size of the last one is fitted anew", *size);
  forget_person();
}

void HandTracker::doubt_size(double size) {
  size_in_view_ = size;
  if (!std::exchange(said_size_, true)) log_->warn("{}", other_size(size, *model_->profile));
}

void HandTracker::meet_person() {
  person_.reset();
  size_check_.reset();
  size_in_view_ = 1;
  said_size_ = false;
  if (!given_->scanned_skin)
    scan_ = std::make_unique<PersonScan>(PersonScanParams{params_.refinement, params_.shape_fit, params_.skin_cell},
                                         given_, workers_);
  if (given_->origin == ProfileOrigin::mean)
    person_.emplace(params_.shape_fit, given_);
  else
    size_check_.emplace(params_.refinement, model_->profile, model_->skin);
}

void HandTracker::use_scan() {
  if (!scan_) return;
  try {
    const auto hand = scan_->take();
    if (!hand) return;
    model_ = std::make_unique<HandModel>(params_, hand, hand->scanned_skin, model_->initialiser, workers_, observer_);
    log_->info("hand scanned while tracked: {:.0f} mm long", 1e3 * hand->hand_length());
    if (person_ && scan_->of_hand_before()) size_check_.emplace(params_.refinement, model_->profile, model_->skin);
  } catch (const std::exception& e) {  // most likely memory: the hand as it is does, too
    log_->warn("the hand could not be scanned: {}", e.what());
  }
}

void HandTracker::learn_person(const HandObservation& observation, const HandPose& pose) {
  if (scan_) scan_->add(observation, pose);
  if (!person_ || model_->profile->scanned_skin) return;
  const PersonFit::Change change = person_->look(observation, pose, model_->refinement, model_->skin);
  if (change == PersonFit::Change::large) {
    model_ = std::make_unique<HandModel>(params_, person_->profile(), workers_, observer_);
    log_->info("hand fitted to the person after {} looks: {:.0f} mm long, the mean hand {:.0f} mm",
               person_->fit().looks(), 1e3 * person_->profile()->hand_length(), 1e3 * given_->hand_length());
  } else if (change == PersonFit::Change::small) {
    model_ = std::make_unique<HandModel>(params_, person_->profile(), person_->skin(), model_->initialiser, workers_,
                                         observer_);
  }
}

double HandTracker::interval_factor(double dt) const { return std::clamp(dt * params_.nominal_rate, 0.5, 4.0); }

FusedPose HandTracker::sample(const HandObservation& observation, const Prediction& prediction) {
  const PreparedObservation& prepared = model_->segment_tracker.prepare(observation, prediction.primary());
  if (budget_.to_be_measured(observer_->on_device())) measure_budget(prepared, prediction.primary());
  const double factor = interval_factor(prediction.dt);
  const Proposals* proposals = &model_->fusion.first_proposals(prediction.primary(), factor);
  const int levels = params_.fusion.levels;
  for (int level = 0;; ++level) {
    const int count = budget_.samples(observer_->on_device());
    const SegmentSamples& samples =
        model_->segment_tracker.sample(prepared, *proposals, {seed_, frame_, level, levels}, count);
    const HandBelief& belief = model_->fusion.fuse(samples, level);
    if (level + 1 == levels) return model_->fusion.read_out(samples, belief, factor);
    proposals = &model_->fusion.next_proposals(samples, belief, level, factor);
  }
}

/// By the first level of a frame, whose results are not used.
void HandTracker::measure_budget(const PreparedObservation& prepared, const HandPose& predicted) {
  budget_.measure([&](int count) {
    const Proposals& proposals = model_->fusion.first_proposals(predicted);
    const SampleKey key{seed_, frame_, 0, params_.fusion.levels};
    const SegmentSamples& samples = model_->segment_tracker.sample(prepared, proposals, key, count);
    const HandBelief& belief = model_->fusion.fuse(samples, 0);
    model_->fusion.next_proposals(samples, belief, 0);
  });
  log_->info("{}", budget_.to_text());
}

RefinedPose HandTracker::refine_best_start(const HandObservation& observation, const Prediction& prediction) {
  starts_.assign(1, prediction.primary());
  for (std::size_t i = 1; i < prediction.candidates.size(); ++i) {
    const HandPose& pose = prediction.candidates[i].pose;
    if (pose_distance(*model_->profile, pose, prediction.primary()) >= kDistinct) starts_.push_back(pose);
  }
  return model_->refinement.refine_best(observation, starts_, prediction.primary(), params_.refinement.iterations);
}

std::optional<HandTracker::Fit> HandTracker::follow(const HandObservation& observation) {
  Fit fit;
  fit.prediction = motion_.predict(observation, *model_->surface);
  const bool refine = params_.refinement.enabled;
  FusedPose fused;
  // Neither needs the other. The sampler comes first: it spreads over idle cores itself, which a thread that waits for
  // it inside its own work could not help.
  workers_.for_each_index(2, [&](int i) {
    if (i == 0 && (params_.sampling || !refine)) fused = sample(observation, *fit.prediction);
    if (i == 1 && refine) fit.refined = refine_best_start(observation, *fit.prediction);
  });
  if (refine && !params_.sampling) {
    fit.joint_gap = raw_gap(fit.refined.pose);
    return fit;
  }
  fit.joint_gap = raw_gap(fused.pose);
  if (!refine) {
    fit.refined = model_->refinement.evaluate(observation, fused.pose);
    fit.belief = fused.covariance;
    return fit;
  }
  if (!lies_elsewhere(fit.refined, fused.pose)) return fit;
  // A good local fit must not be spoilt by a sampled one that only looks as good.
  const RefinedPose sampled =
      model_->refinement.refine(observation, fused.pose, fit.prediction->primary(), params_.refinement.iterations);
  if (clearly_better(sampled.score, fit.refined.score, params_.sampling_advantage)) fit.refined = sampled;
  return fit;
}

/// Whether anything seen is in another place: else both poses would be refined to the same one.
bool HandTracker::lies_elsewhere(const RefinedPose& refined, const HandPose& sampled) const {
  const HandProfile& profile = *model_->profile;
  for (int s = 0; s < kSegmentCount; ++s) {
    if (refined.visible[s] < params_.seen_fraction) continue;
    if ((refined.pose[s].t - sampled[s].t).norm() > params_.sampling_distinct) return true;
    const double tips_apart = (distal_end(profile, refined.pose, s) - distal_end(profile, sampled, s)).norm();
    if (tips_apart > params_.sampling_distinct) return true;
  }
  return false;
}

std::optional<HandTracker::Fit> HandTracker::look(const HandObservation& observation, Effort effort, int attempts) {
  searched_ = true;
  if (static_cast<int>(observation.hand_pixels.size()) < params_.loss.min_hand_pixels) return std::nullopt;
  std::optional<Fit> best = propose_detected(observation);
  if (best && judged_score(observation, best->refined) < params_.loss.recovered_score) return best;
  FoundPoses poses(*model_->profile, params_.search_settled, params_.loss.recovered_score);
  for (int attempt = 0; attempt < attempts && !poses.settled(); ++attempt) {
    auto found = search_once(observation, effort, attempt);
    if (!found) continue;
    const bool better = poses.add(found->refined.pose, found->refined.score);
    if (better && (!best || found->refined.score < best->refined.score)) best = std::move(found);
  }
  return best;
}

/// The detected hand as a start: inverse kinematics of its joints, then the ordinary refinement.
std::optional<HandTracker::Fit> HandTracker::propose_detected(const HandObservation& observation) const {
  if (!observation.detected) return std::nullopt;
  const auto detected = fit_to_joints(*model_->profile, observation.detected->joints);
  if (!detected) return std::nullopt;
  auto fit = best_of(observation, {{"detected", detected->pose}}, params_.search_iterations);
  fit->refined = relaxed_pose(observation, fit->refined, *model_->profile, model_->refinement, params_);
  return fit;
}

std::optional<HandTracker::Fit> HandTracker::search_once(const HandObservation& observation, Effort effort,
                                                         int attempt) {
  const Hiding hiding = attempt == 0 ? Hiding::costs : Hiding::free;
  const std::uint64_t seed = seed_ + frame_ + attempt * kAttemptSeed;
  std::optional<Fit> best = best_of(
      observation,
      model_->initialiser->propose(observation, effort, seed, workers_, hiding, last_good_ ? &*last_good_ : nullptr),
      params_.search_iterations);
  if (best) best->refined = relaxed_pose(observation, best->refined, *model_->profile, model_->refinement, params_);
  return best;
}

// Refinement and detection err in different ways: where they agree, the frame may be explained half as well, as with a
// sensor or a hand that the skin model knows badly.
double HandTracker::judged_score(const HandObservation& observation, const RefinedPose& refined) const {
  constexpr double kAgreement = 0.02;  // m, mean over the joints; the detection is 13 mm off on its own test images
  constexpr double kConfirmed = 0.5;
  const bool confirmed =
      observation.detected && mean_distance(*model_->profile, refined.pose, observation.detected->joints) < kAgreement;
  return confirmed ? kConfirmed * refined.score : refined.score;
}

std::optional<HandTracker::Fit> HandTracker::search_near(const HandObservation& observation, const HandPose& followed) {
  return best_of(observation, model_->initialiser->propose_near(observation, followed, seed_ + frame_, workers_),
                 params_.doubt_iterations);
}

std::optional<HandTracker::Fit> HandTracker::best_of(const HandObservation& observation,
                                                     const std::vector<StartCandidate>& starts, int iterations) const {
  std::vector<Fit> fits(std::min<std::size_t>(params_.search_refined, starts.size()));
  workers_.for_each_index(static_cast<int>(fits.size()), [&](int i) {
    fits[i].refined = model_->refinement.refine(observation, starts[i].pose, starts[i].pose, iterations);
  });
  std::optional<Fit> best;
  for (Fit& fit : fits) {
    fit.joint_gap = raw_gap(fit.refined.pose);
    if (!best || fit.refined.score < best->refined.score) best = fit;
  }
  return best;
}

double HandTracker::raw_gap(const HandPose& pose) const {
  double sum = 0;
  for (int s = 1; s < kSegmentCount; ++s) sum += (joint_in_parent(*model_->profile, pose, s) - pose[s].t).norm();
  return sum / (kSegmentCount - 1);
}

}  // namespace barehand
