#include "stages/known_object/known_object_tracker.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "math/angles.h"

namespace barehand {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kPoints = 800;  // number of depth points on which poses are refined; hypotheses share them
constexpr std::size_t kComparedSamples = 400;  // number of samples of the surface with which hypotheses are compared
constexpr std::size_t kFew = 200;              // number of depth points with which predictions are compared
constexpr int kIterations = 15;
constexpr double kReach = 0.02;      // distance from the prediction of points that may be the object's [m]
constexpr double kModel = 0.001;     // deviation of the mesh from the object [m]
constexpr double kCompared = 0.006;  // errors larger than this count as outliers in the comparison of predictions [m]
// Negative logarithm of the likelihood of a point that a pose does not explain.
constexpr double kOutlier = 4 / kTogether;
constexpr double kAtEdges = 0.03;  // fraction of the samples that contradict any pose, for edges are measured badly
constexpr int kTrial = 30;         // frames in which several hypotheses are compared
constexpr double kClear = 10;      // difference of logarithms of likelihoods that decides between hypotheses
constexpr std::int64_t kForgotten = 500'000;  // time after which an object that is not seen is searched anywhere [us]
constexpr std::int64_t kFirstLook = 500'000;  // time from when an object was found to the next search [us]
// Time over which the work of the longest search is spread: at first, and once searches have been in vain for kVain or
// the object is followed [s].
constexpr double kSearch = 0.1, kRareSearch = 0.4;
constexpr std::int64_t kVain = 2'000'000;  // [us]
constexpr double kLongestStep = 0.2;       // frames farther apart than this have nothing to do with each other [s]
// A pose is given up if less of the object shows, if more of what should be seen is seen through, or if more of the
// outline is none.
constexpr double kLeastShown = 0.2, kMostContradicted = 0.15, kMostContinued = 0.35;
constexpr double kSmooth = 0.5;  // weight of the newest velocity
// How far an object may be from the prediction of its velocity and of a palm, after 1/30 s.
constexpr double kFreeShift = 0.01, kFreeTurn = 15 * kDegree, kPalmShift = 0.003, kPalmTurn = 4 * kDegree;

Matrix6d diagonal(double shift, double turn) {
  Vector6d variance;
  variance << Eigen::Vector3d::Constant(shift * shift), Eigen::Vector3d::Constant(turn * turn);
  return variance.asDiagonal();
}

/// How many points a pose does not explain. Errors much larger than `scale` count as 1, smaller ones less.
double misfit(const KnownObject& object, const SE3& T, std::span<const Vector3f> points, double scale) {
  const SE3 T_object_camera = T.inverse();
  double sum = 0;
  for (const Vector3f& p : points) {
    const double d = object.grid.distance((T_object_camera * p.cast<double>()).cast<float>());
    sum += d * d / (scale * scale + d * d);
  }
  return sum;
}

}  // namespace

/// Predicts poses from the velocity, from standing still, and from moving with each hand.
void KnownObjectTracker::predict(const Hypothesis& hypothesis, double dt, const HandEstimates& estimates) {
  const double frames = std::max(1.0, 30 * dt);
  predictions_.clear();
  predictions_.push_back({hypothesis.T, kFreeShift * frames, kFreeTurn * frames});
  predictions_.push_back({boxplus(hypothesis.T, hypothesis.velocity * dt), kFreeShift * frames, kFreeTurn * frames});
  for (const HandEstimatePtr& estimate : estimates) {
    const auto before = palms_.find(estimate->hand_id);
    if (estimate->status != TrackStatus::tracking || before == palms_.end()) continue;
    predictions_.push_back(
        {estimate->segments[kPalm].T_camera_segment * before->second.inverse() * hypothesis.T, kPalmShift, kPalmTurn});
  }
}

/// Refines the best of the predictions of a hypothesis.
void KnownObjectTracker::refine(Hypothesis& hypothesis, double dt, const ObservedDepth& view,
                                std::span<const Vector3f> points) {
  // Compare the predictions on the points near to any of them.
  points_.clear();
  for (const Prediction& prediction : predictions_) view.points_near(*object_, prediction.T, kReach, kFew, points_);

  // Choose the prediction with the least misfit.
  const Prediction* best = nullptr;
  double least = 0;
  for (const Prediction& prediction : predictions_) {
    const double cost = misfit(*object_, prediction.T, points_, kCompared);
    if (best && cost >= least) continue;
    best = &prediction;
    least = cost;
  }

  // Refine it.
  points_.clear();
  view.points_near(*object_, best->T, kReach, kPoints / hypotheses_.size(), points_);
  const PosePrior prior{best->T, (hypothesis.covariance + diagonal(best->shift, best->turn)).inverse()};
  const double sigma = std::hypot(view.noise(), kModel);
  const FittedPose fitted = fit_pose(*object_, points_, sigma, best->T, prior, kIterations, 1);

  // Keep the prediction where the object is not seen.
  const PoseQuality quality = quality_of(*object_, view, fitted.T_camera_object, points);
  hypothesis.seen = quality.visibility.shown() >= kLeastShown &&
                    quality.visibility.contradicted() <= kMostContradicted &&
                    view.continued(*object_, fitted.T_camera_object) <= kMostContinued;
  if (!hypothesis.seen) {
    hypothesis.T = best->T;
    hypothesis.velocity.setZero();
    hypothesis.covariance += diagonal(best->shift, best->turn);
    return;
  }

  // Accept the refined pose and smooth the velocity.
  const Vector6d moved = boxminus(fitted.T_camera_object, hypothesis.T);
  if (dt > 0) hypothesis.velocity += kSmooth * (moved / dt - hypothesis.velocity);
  hypothesis.T = fitted.T_camera_object;
  hypothesis.covariance = fitted.covariance;
}

/// Adds up how badly each hypothesis fits the frames, on the same points, and drops those that are clearly worse.
void KnownObjectTracker::compare(const ObservedDepth& view) {
  // Measure how badly they fit this frame.
  points_.clear();
  for (const Hypothesis& hypothesis : hypotheses_) view.points_near(*object_, hypothesis.T, kReach, kPoints, points_);
  const double scale = 2 * std::hypot(view.noise(), kModel), share = 1.0 / static_cast<double>(hypotheses_.size());
  for (Hypothesis& hypothesis : hypotheses_) {
    const Visibility visibility = view.visibility(*object_, hypothesis.T, kComparedSamples);
    const int against = visibility.through + visibility.blocked;
    const double clearly = std::max(0.0, against - kAtEdges * (against + visibility.seen));
    hypothesis.misfit += kOutlier * (share * misfit(*object_, hypothesis.T, points_, scale) + clearly);
  }

  // A better one takes the lead if it is clearly better, so that a symmetric object does not jump.
  const auto best = std::ranges::min_element(hypotheses_, {}, &Hypothesis::misfit);
  if (best->misfit < hypotheses_.front().misfit - kClear) std::iter_swap(best, hypotheses_.begin());
  const double most = hypotheses_.front().misfit + kClear;
  std::erase_if(hypotheses_, [&](const Hypothesis& other) { return other.misfit > most; });
  if (++compared_ == kTrial) hypotheses_.resize(1);
}

/// Follows all hypotheses. Returns whether the object is there.
bool KnownObjectTracker::follow(double dt, const ObservedDepth& view, const HandEstimates& estimates,
                                std::span<const Vector3f> points) {
  for (Hypothesis& hypothesis : hypotheses_) {
    predict(hypothesis, dt, estimates);
    refine(hypothesis, dt, view, points);
  }

  // Drop those that are not seen; if none is, only the prediction of the first one is kept.
  if (std::ranges::none_of(hypotheses_, &Hypothesis::seen)) {
    hypotheses_.resize(1);
    return false;
  }
  std::erase_if(hypotheses_, [](const Hypothesis& hypothesis) { return !hypothesis.seen; });
  if (hypotheses_.size() > 1) compare(view);
  return true;
}

/// Goes on with the search that is under way, or begins one: in turn between the fingers and around the hands. Returns
/// whether the object was found.
bool KnownObjectTracker::find(std::int64_t utime, double dt, const ObservedDepth& view, const HandEstimates& estimates,
                              std::span<const Vector3f> points) {
  if (searches_ == 0) first_search_ = utime;
  if (!search_.under_way()) {
    if (points.empty()) return false;

    // Search in turn between the fingers of a hand, and at one of the given points, which are about evenly spread.
    Vector3f seed = points[(static_cast<std::size_t>(searches_) * 7919) % points.size()];
    const HandEstimate& hand = *estimates[static_cast<std::size_t>(searches_ / 2) % estimates.size()];
    if (searches_ % 2 == 0 && hand.status == TrackStatus::tracking) {
      seed.setZero();
      for (int finger = 0; finger < kFingerCount; ++finger)
        seed += hand.segments[segment_of(finger, 2)].T_camera_segment.t.cast<float>() / kFingerCount;
    }
    ++searches_;
    begin_search(utime, view, estimates, points, seed);
  }

  // Do a part of the search.
  const double duration = std::abs(utime - first_search_) > kVain ? kRareSearch : kSearch;
  if (!search_.advance(dt / duration) || search_.found().empty()) return false;

  // Follow what was found, at rest or with a palm, from the frame in which the search began.
  hypotheses_.clear();
  searches_ = 0;
  found_ = utime;
  look_ = kFirstLook;
  follow_also({});
  palms_ = palms_then_;
  return follow(static_cast<double>(std::abs(utime - search_began_)) * 1e-6, view, estimates, points);
}

/// Searches where the object is followed.
void KnownObjectTracker::look_again(std::int64_t utime, double dt, const ObservedDepth& view,
                                    const HandEstimates& estimates, std::span<const Vector3f> points) {
  if (!search_.under_way()) {
    if (std::abs(utime - found_) < look_) return;
    look_ *= 2;
    begin_search(utime, view, estimates, points, (hypotheses_.front().T * object_->centre).cast<float>());
  }

  // What is found has moved since as what is followed has.
  const Hypothesis& first = hypotheses_.front();
  if (search_.advance(dt / kRareSearch)) follow_also(first.T * first.T_then.inverse());
}

void KnownObjectTracker::begin_search(std::int64_t utime, const ObservedDepth& view, const HandEstimates& estimates,
                                      std::span<const Vector3f> points, const Vector3f& seed) {
  search_.begin(view, points, seed);
  search_began_ = utime;
  palms_then_ = palms_of(estimates);
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.T_then = hypothesis.T;
}

/// Follows the poses that were found and have moved since, if they differ from those that are followed, with the
/// velocity of the first one. If there are any, all are compared from now on.
void KnownObjectTracker::follow_also(const SE3& moved) {
  const std::size_t before = hypotheses_.size();
  for (const FoundPose& pose : search_.found()) {
    const SE3 T = moved * pose.T_camera_object;
    const auto same = [&](const Hypothesis& other) { return changes_little(*object_, other.T.inverse() * T); };
    if (std::ranges::any_of(hypotheses_, same)) continue;
    Hypothesis hypothesis{.T = T, .T_then = T, .covariance = diagonal(kFreeShift, kFreeTurn)};
    if (!hypotheses_.empty()) hypothesis.velocity = hypotheses_.front().velocity;
    hypotheses_.push_back(hypothesis);
  }
  if (hypotheses_.size() == before) return;
  compared_ = 0;
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.misfit = 0;
}

KnownObjectTracker::Palms KnownObjectTracker::palms_of(const HandEstimates& estimates) {
  Palms palms;
  for (const HandEstimatePtr& estimate : estimates)
    if (estimate->status == TrackStatus::tracking)
      palms[estimate->hand_id] = estimate->segments[kPalm].T_camera_segment;
  return palms;
}

std::optional<ObjectEstimate> KnownObjectTracker::process(std::int64_t utime, const ObservedDepth& view,
                                                          const HandEstimates& estimates,
                                                          std::span<const Vector3f> points) {
  // Frames that are far apart have nothing to do with each other.
  const double dt = static_cast<double>(std::abs(utime - utime_)) * 1e-6;
  if (dt > kLongestStep) search_.stop();
  if (dt > kLongestStep || std::abs(utime - seen_) > kForgotten) {
    hypotheses_.clear();
    holding_ = {};
  }

  // Follow the object, or search for it.
  const bool followed = !hypotheses_.empty() && follow(dt, view, estimates, points);
  const bool found = !followed && find(utime, dt, view, estimates, points);
  if (followed) look_again(utime, dt, view, estimates, points);
  utime_ = utime;
  palms_ = palms_of(estimates);
  if (!followed && !found) return std::nullopt;
  seen_ = utime;

  // Fill in the estimate. A velocity needs two frames.
  ObjectEstimate state;
  state.id = object_->id;
  state.T_camera_object = hypotheses_.front().T;
  if (!found) state.velocity = hypotheses_.front().velocity;
  state.covariance = hypotheses_.front().covariance;
  state.extent = object_->extent;
  holding_.update(utime, estimates, object_->centre, state);
  return state;
}

}  // namespace barehand
