#include "stages/contact/object_track.h"

#include <limits>

namespace barehand {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

// A palm holds the object once it has moved by kCarried while the object stayed within kFirm of its place in the palm,
// until the object is farther than kLeft from this place [m].
constexpr double kCarried = 0.02, kFirm = 0.012, kLeft = 0.03;
constexpr int kGrip = 3;                // segments that touch an object which probably moves with the hand
constexpr double kPreference = 0.0005;  // advantage in misfit with which the less probable motion is preferred [m]
constexpr double kDoubtful = 0.25;      // contradiction of a pose from which on nothing is added to the model
constexpr double kPlace = 0.005, kTurn = 1.0;  // deviations of an object without a model [m, rad]

}  // namespace

void ObjectTrack::predict(const HandEstimates& estimates, const ObservedSpace& space,
                          std::span<const SurfacePoint* const> all) {
  points.clear();
  placed = false;
  predicted = state.T_camera_object;
  if (!modelled()) return;
  for (const HandEstimatePtr& estimate : estimates) {
    if (estimate->status != TrackStatus::tracking || estimate->hand_id != hand_) continue;
    const SE3 carried = estimate->segments[kPalm].T_camera_segment * T_palm_object_;
    const double gain = model.misfit(state.T_camera_object, all, space) - model.misfit(carried, all, space);
    if (gain > (state.held || touches >= kGrip ? -kPreference : kPreference)) predicted = carried;
  }
}

void ObjectTrack::update(std::int64_t utime, double elapsed, const HandEstimates& estimates,
                         const ObservedSpace& space) {
  state.velocity = unknown_velocity();
  if (points.empty())
    state.T_camera_object = predicted;
  else
    place(elapsed, space);
  hold(utime, estimates);
}

/// Updates the pose from the points of this frame, and the model.
void ObjectTrack::place(double elapsed, const ObservedSpace& space) {
  centre.setZero();
  for (const SurfacePoint* point : points) centre += point->p.cast<double>() / static_cast<double>(points.size());

  // Align the model with the points, and judge whether the pose is credible.
  const SE3 before = state.T_camera_object;
  bool credible = true;
  if (placed) {
    state.T_camera_object = model.align(predicted, points, state.covariance);
    credible = model.contradiction(state.T_camera_object, points, space) < kDoubtful;
    if (!credible) {
      // The object may have moved faster than predicted, so try the place of the points.
      Matrix6d covariance;
      const SE3 there = model.align(model.centred(predicted, points, space), points, covariance);
      if (model.misfit(there, points, space) < model.misfit(state.T_camera_object, points, space)) {
        state.T_camera_object = there;
        state.covariance = covariance;
        credible = model.contradiction(there, points, space) < kDoubtful;
      }
    }
    if (elapsed != 0) state.velocity = boxminus(state.T_camera_object, before) / elapsed;
  } else {
    // Start a new model at the middle of the points.
    state.T_camera_object = {Eigen::Matrix3d::Identity(), centre};
    state.covariance = Matrix6d::Zero();
    state.covariance.topLeftCorner<3, 3>().diagonal().setConstant(kPlace * kPlace);
    state.covariance.bottomRightCorner<3, 3>().diagonal().setConstant(kTurn * kTurn);
    model = ObjectModel();
  }

  // Add the points to the model. An object that continues out of view has the size of its visible points.
  Vector3f lower = points[0]->p, upper = lower;
  for (const SurfacePoint* point : points) lower = lower.cwiseMin(point->p), upper = upper.cwiseMax(point->p);
  if (!open) {
    model.fuse(state.T_camera_object, points, space, credible);
    lower = model.bounds()[0], upper = model.bounds()[1];
  }
  state.extent = (upper - lower).cast<double>();
}

/// States whether the nearest palm holds it.
void ObjectTrack::hold(std::int64_t utime, const HandEstimates& estimates) {
  // Find the tracked hand whose palm is nearest.
  const HandEstimate* nearest = nullptr;
  for (const HandEstimatePtr& estimate : estimates) {
    if (estimate->status != TrackStatus::tracking) continue;
    const auto distance = [&](const HandEstimate& hand) {
      return (hand.segments[kPalm].T_camera_segment.t - state.T_camera_object.t).norm();
    };
    if (!nearest || distance(*estimate) < distance(*nearest)) nearest = estimate.get();
  }

  // Compare the object's place in the palm with its place before.
  bool held = false;
  hand_ = -1;
  if (nearest && !open) {
    const SE3& T_camera_palm = nearest->segments[kPalm].T_camera_segment;
    hand_ = nearest->hand_id;
    T_palm_object_ = T_camera_palm.inverse() * state.T_camera_object;

    // Start the comparison again with another palm, or if the object has left its place in the palm.
    const double left =
        compared_hand_ == hand_ ? (T_palm_object_.t - in_palm_).norm() : std::numeric_limits<double>::infinity();
    if (left > (state.held ? kLeft : kFirm)) {
      compared_hand_ = hand_;
      in_palm_ = T_palm_object_.t;
      palm_ = T_camera_palm.t;
    }

    // An object is held once it was carried, until it leaves the palm.
    held = state.held ? left < kLeft : left < kFirm && (T_camera_palm.t - palm_).norm() > kCarried;
  } else {
    compared_hand_ = -1;
  }

  if (held != state.held) state.since = utime;
  state.held = held;
  state.hand_id = held ? compared_hand_ : -1;
}

}  // namespace barehand
