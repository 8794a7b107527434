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
constexpr double kReach = 0.02;      // points within this distance of the prediction may belong to the object [m]
constexpr double kModel = 0.001;     // deviation of the mesh from the object [m]
constexpr double kCompared = 0.006;  // errors larger than this count as outliers in the comparison of predictions [m]
constexpr std::int64_t kForgotten = 500'000;  // time after which an object that is not seen is searched anywhere [us]
constexpr int kSearchEvery = 2;               // frames from one search to the next
constexpr double kLongestStep = 0.2;          // longest time between two frames over which the object is followed [s]
// A pose is given up if a smaller fraction of the object is seen, or if a larger one contradicts the pose.
constexpr double kLeastShown = 0.2, kMostContradicted = 0.2;
constexpr double kSmooth = 0.5;  // weight of the newest velocity
// How far an object may be from the prediction of its velocity and of a palm, after 1/30 s.
constexpr double kFreeShift = 0.01, kFreeTurn = 15 * kDegree, kPalmShift = 0.003, kPalmTurn = 4 * kDegree;

Matrix6d diagonal(double shift, double turn) {
  Vector6d variance;
  variance << Eigen::Vector3d::Constant(shift * shift), Eigen::Vector3d::Constant(turn * turn);
  return variance.asDiagonal();
}

/// How badly a pose fits points: between 0 and 1.
double misfit(const KnownObject& object, const SE3& T, std::span<const Vector3f> points) {
  const SE3 T_object_camera = T.inverse();
  double sum = 0;
  for (const Vector3f& p : points) {
    const double d = object.grid.distance((T_object_camera * p.cast<double>()).cast<float>());
    sum += d * d / (kCompared * kCompared + d * d);
  }
  return sum / std::max(1.0, static_cast<double>(points.size()));
}

}  // namespace

/// Poses that follow from the velocity, from standing still, and from moving with each hand.
std::vector<KnownObjectTracker::Prediction> KnownObjectTracker::predictions(double dt,
                                                                            const HandEstimates& estimates) const {
  const double frames = std::max(1.0, 30 * dt);
  std::vector<Prediction> all{{*T_, kFreeShift * frames, kFreeTurn * frames},
                              {boxplus(*T_, velocity_ * dt), kFreeShift * frames, kFreeTurn * frames}};
  for (const HandEstimatePtr& estimate : estimates) {
    const auto before = palms_.find(estimate->hand_id);
    if (estimate->status != TrackStatus::tracking || before == palms_.end()) continue;
    all.push_back({estimate->segments[kPalm].T_camera_segment * before->second.inverse() * *T_, kPalmShift, kPalmTurn});
  }
  return all;
}

/// Refines the best prediction. Returns whether the object is there.
bool KnownObjectTracker::follow(double dt, const ObservedDepth& view, const HandEstimates& estimates,
                                std::span<const Vector3f> points) {
  // Compare the predictions on the points near to any of them.
  const auto all = predictions(dt, estimates);
  points_.clear();
  for (const Prediction& prediction : all) view.points_near(*object_, prediction.T, kReach, kFew, points_);

  // Choose the prediction with the least misfit.
  const Prediction* best = nullptr;
  double least = 0;
  for (const Prediction& prediction : all) {
    const double cost = misfit(*object_, prediction.T, points_);
    if (best && cost >= least) continue;
    best = &prediction;
    least = cost;
  }

  // Refine it.
  points_.clear();
  view.points_near(*object_, best->T, kReach, kPoints, points_);
  const PosePrior prior{best->T, (covariance_ + diagonal(best->shift, best->turn)).inverse()};
  const double sigma = std::hypot(view.noise(), kModel);
  const FittedPose fitted = fit_pose(*object_, points_, sigma, best->T, prior, kIterations);

  // Keep the prediction where the object is not seen.
  const PoseQuality quality = quality_of(*object_, view, fitted.T_camera_object, points);
  if (quality.visibility.shown() < kLeastShown || quality.visibility.contradicted() > kMostContradicted) {
    T_ = best->T;
    velocity_.setZero();
    covariance_ += diagonal(best->shift, best->turn);
    return false;
  }

  // Accept the refined pose and smooth the velocity.
  const Vector6d moved = boxminus(fitted.T_camera_object, *T_);
  if (dt > 0) velocity_ += kSmooth * (moved / dt - velocity_);
  T_ = fitted.T_camera_object;
  covariance_ = fitted.covariance;
  return true;
}

/// Searches for the object around one place: in turn between the fingers and around the hands. Returns whether it was
/// found.
bool KnownObjectTracker::find(const ObservedDepth& view, const HandEstimates& estimates,
                              std::span<const Vector3f> points) {
  if (--wait_ > 0 || points.empty()) return false;
  wait_ = kSearchEvery;

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
  if (!found) return false;
  T_ = found->T_camera_object;
  velocity_.setZero();
  covariance_ = diagonal(kFreeShift, kFreeTurn);
  return true;
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
  if (T_ && (std::abs(dt) > kLongestStep || std::abs(utime - seen_) > kForgotten)) T_.reset();
  bool seen = T_ && follow(std::abs(dt), view, estimates, points);
  const bool found = !seen && find(view, estimates, points);
  if (found) seen = follow(0, view, {}, points);
  store_palms(utime, estimates);
  if (!seen) return std::nullopt;
  seen_ = utime;

  // Fill in the estimate. A velocity needs two frames.
  ObjectEstimate state;
  state.id = object_->id;
  state.T_camera_object = *T_;
  if (!found) state.velocity = velocity_;
  state.covariance = covariance_;
  state.extent = object_->extent;
  holding_.update(utime, estimates, state);
  return state;
}

}  // namespace barehand
