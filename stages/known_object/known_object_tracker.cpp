#include "stages/known_object/known_object_tracker.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "math/angles.h"

namespace barehand {
namespace {

using Eigen::Vector3f;

constexpr std::size_t kPoints = 2000;  // number of depth points on which a pose is refined
constexpr std::size_t kFew = 200;      // number of depth points with which predictions are compared
constexpr int kIterations = 15;
constexpr double kReach = 0.02;       // distance from the prediction of points that may be the object's [m]
constexpr double kModel = 0.001;      // deviation of the mesh from the object [m]
constexpr double kCompared = 0.006;   // errors larger than this count as outliers in the comparison of predictions [m]
constexpr double kOutlier = 4.0 / 6;  // of a point that a pose does not explain: negative logarithm of its likelihood
constexpr int kTrial = 30;            // frames in which several hypotheses are compared
constexpr double kClear = 10;         // difference of logarithms of likelihoods that decides between hypotheses
constexpr std::int64_t kForgotten = 500'000;  // time after which an object that is not seen is searched anywhere [us]
constexpr std::int64_t kFirstLook = 500'000;  // time from when an object was found to the next search [us]
// Least time from one search to the next, at first and once they have been in vain for kVain [us].
constexpr std::int64_t kSearchEvery = 60'000, kSearchRarely = 120'000, kVain = 2'000'000;
constexpr double kLongestStep = 0.2;  // frames farther apart than this have nothing to do with each other [s]
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
  view.points_near(*object_, best->T, kReach, kPoints, points_);
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
    const Visibility visibility = view.visibility(*object_, hypothesis.T, kPoints);
    hypothesis.misfit +=
        kOutlier * (share * misfit(*object_, hypothesis.T, points_, scale) + visibility.through + visibility.blocked);
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

/// Searches for the object around one place: in turn between the fingers and around the hands. Returns whether it was
/// found.
bool KnownObjectTracker::find(std::int64_t utime, const ObservedDepth& view, const HandEstimates& estimates,
                              std::span<const Vector3f> points) {
  if (points.empty()) return false;
  if (searches_ == 0) first_search_ = utime;
  const std::int64_t pause = std::abs(utime - first_search_) > kVain ? kSearchRarely : kSearchEvery;
  if (searches_ > 0 && std::abs(utime - last_search_) < pause) return false;
  last_search_ = utime;

  // Search in turn between the fingers of a hand, and at one of the given points, which are about evenly spread.
  Vector3f seed = points[(static_cast<std::size_t>(searches_) * 7919) % points.size()];
  const HandEstimate& hand = *estimates[static_cast<std::size_t>(searches_ / 2) % estimates.size()];
  if (searches_ % 2 == 0 && hand.status == TrackStatus::tracking) {
    seed.setZero();
    for (int finger = 0; finger < kFingerCount; ++finger)
      seed += hand.segments[segment_of(finger, 2)].T_camera_segment.t.cast<float>() / kFingerCount;
  }

  // Search around the seed; a found object starts at rest.
  ++searches_;
  const auto found = search_.search(*object_, view, points, seed);
  if (found.empty()) return false;
  hypotheses_.clear();
  searches_ = 0;
  found_ = utime;
  look_ = kFirstLook;
  follow_also(found);
  return true;
}

/// Searches where the object is followed.
void KnownObjectTracker::look_again(std::int64_t utime, const ObservedDepth& view, std::span<const Vector3f> points) {
  if (std::abs(utime - found_) < look_) return;
  look_ *= 2;
  const Vector3f middle = (hypotheses_.front().T * object_->centre).cast<float>();
  follow_also(search_.search(*object_, view, points, middle));
}

/// Follows the poses that differ from those that are followed, with the velocity of the first one. If there are any,
/// all are compared from now on.
void KnownObjectTracker::follow_also(std::span<const FoundPose> found) {
  const std::size_t before = hypotheses_.size();
  for (const FoundPose& pose : found) {
    const auto same = [&](const Hypothesis& other) {
      return changes_little(*object_, other.T.inverse() * pose.T_camera_object);
    };
    if (std::ranges::any_of(hypotheses_, same)) continue;
    Hypothesis hypothesis{.T = pose.T_camera_object, .covariance = diagonal(kFreeShift, kFreeTurn)};
    if (!hypotheses_.empty()) hypothesis.velocity = hypotheses_.front().velocity;
    hypotheses_.push_back(hypothesis);
  }
  if (hypotheses_.size() == before) return;
  compared_ = 0;
  for (Hypothesis& hypothesis : hypotheses_) hypothesis.misfit = 0;
}

void KnownObjectTracker::store_palms(std::int64_t utime, const HandEstimates& estimates) {
  utime_ = utime;
  palms_.clear();
  for (const HandEstimatePtr& estimate : estimates)
    if (estimate->status == TrackStatus::tracking)
      palms_[estimate->hand_id] = estimate->segments[kPalm].T_camera_segment;
}

std::optional<ObjectEstimate> KnownObjectTracker::process(std::int64_t utime, const ObservedDepth& view,
                                                          const HandEstimates& estimates,
                                                          std::span<const Vector3f> points) {
  // Follow the object, or search for it.
  const double dt = static_cast<double>(utime - utime_) * 1e-6;
  if (std::abs(dt) > kLongestStep || std::abs(utime - seen_) > kForgotten) {
    hypotheses_.clear();
    holding_ = {};
  }
  bool seen = !hypotheses_.empty() && follow(std::abs(dt), view, estimates, points);
  const bool found = !seen && find(utime, view, estimates, points);
  if (found) seen = follow(0, view, {}, points);
  if (seen) look_again(utime, view, points);
  store_palms(utime, estimates);
  if (!seen) return std::nullopt;
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
