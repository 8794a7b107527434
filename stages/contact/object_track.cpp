#include "stages/contact/object_track.h"

namespace barehand {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

constexpr int kGrip = 3;                // segments that touch an object which probably moves with the hand
constexpr double kPreference = 0.0005;  // advantage in misfit with which the less probable motion is preferred [m]
constexpr double kDoubtful = 0.25;      // contradiction of a pose from which on nothing is added to the model
constexpr int kShapeEvery = 5;          // frames from one fit of a shape to the model to the next
constexpr double kPlace = 0.005, kTurn = 1.0;  // deviations of an object without a model [m, rad]

}  // namespace

void ObjectTrack::predict(const HandEstimates& estimates, const ObservedSpace& space,
                          std::span<const SurfacePoint* const> all) {
  points.clear();
  placed = false;
  predicted = state.T_camera_object;
  if (!modelled()) return;
  const auto carried = holding_.carried(estimates);
  if (!carried) return;
  const double gain = model.misfit(state.T_camera_object, all, space) - model.misfit(*carried, all, space);
  if (gain > (state.held || touches >= kGrip ? -kPreference : kPreference)) predicted = *carried;
}

void ObjectTrack::update(std::int64_t utime, double elapsed, const HandEstimates& estimates,
                         const ObservedSpace& space) {
  state.velocity = unknown_velocity();
  if (points.empty())
    state.T_camera_object = predicted;
  else
    place(elapsed, space);
  if (!open) holding_.update(utime, estimates, Vector3d::Zero(), state);
  points.clear();  // they live no longer than the frame
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
    shape_age_ = 0;
  }

  // Add the points to the model. An object that continues out of view has the size of its visible points.
  Vector3f lower = points[0]->p, upper = lower;
  for (const SurfacePoint* point : points) lower = lower.cwiseMin(point->p), upper = upper.cwiseMax(point->p);
  if (!open) {
    model.fuse(state.T_camera_object, points, space, credible);
    lower = model.bounds()[0], upper = model.bounds()[1];
  }
  state.extent = (upper - lower).cast<double>();
  find_shape();
}

void ObjectTrack::rename(std::int32_t id) {
  state.id = id;
  round.reset();
  round_object = nullptr;
  shape_age_ = 0;
}

/// Fits a round shape: every few frames to the model, or in each frame to the visible points of an open object, whose
/// frame moves with them.
void ObjectTrack::find_shape() {
  if (open) {
    const SE3 T_object_camera = state.T_camera_object.inverse();
    surface_.clear();
    for (const SurfacePoint* point : points)
      surface_.push_back({(T_object_camera * point->p.cast<double>()).cast<float>(),
                          (T_object_camera.R * point->n.cast<double>()).cast<float>()});
  } else {
    if (shape_age_++ % kShapeEvery != 0) return;
    surface_ = model.surface();
  }
  round = fit_round_shape(surface_);
  round_object = round ? make_round_object(*round, state.id) : nullptr;
}

}  // namespace barehand
