#include "hand/grasps/holding.h"

namespace barehand {
namespace {

// A palm that moved by kCarried while the object stayed within kFirm of its place in it holds the object; one that the
// object has left by more than kLeft does not [m].
constexpr double kCarried = 0.02, kFirm = 0.012, kLeft = 0.03;

}  // namespace

const HandEstimate* nearest_palm(const Eigen::Vector3d& place, const HandEstimates& estimates) {
  const HandEstimate* nearest = nullptr;
  const auto distance = [&](const HandEstimate& hand) {
    return (hand.segments[kPalm].T_camera_segment.t - place).norm();
  };
  for (const HandEstimatePtr& estimate : estimates)
    if (estimate->status == TrackStatus::tracking && (!nearest || distance(*estimate) < distance(*nearest)))
      nearest = estimate.get();
  return nearest;
}

void Holding::update(std::int64_t utime, const HandEstimates& estimates, const Eigen::Vector3d& centre,
                     ObjectEstimate& state) {
  // Find the nearest palm.
  const HandEstimate* const nearest = nearest_palm(state.T_camera_object * centre, estimates);

  bool held = false;
  const bool same = nearest && hand_ == nearest->hand_id;
  hand_ = nearest ? nearest->hand_id : -1;
  if (nearest) {
    const SE3& T_camera_palm = nearest->segments[kPalm].T_camera_segment;
    T_palm_object_ = T_camera_palm.inverse() * state.T_camera_object;

    // Begin anew with another palm, or if the object has left its place in the palm.
    const Eigen::Vector3d in_palm = T_palm_object_ * centre;
    if (!same || (in_palm - in_palm_).norm() > (held_ ? kLeft : kFirm)) {
      in_palm_ = in_palm;
      palm_ = T_camera_palm.t;
    } else {
      // It is held once it was carried, until it leaves.
      held = held_ || (T_camera_palm.t - palm_).norm() > kCarried;
    }
  }

  // State it.
  if (held != held_ || since_ == 0) since_ = utime;
  held_ = held;
  state.held = held;
  state.hand_id = held ? hand_ : -1;
  state.since = since_;
}

std::optional<SE3> Holding::carried(const HandEstimates& estimates) const {
  for (const HandEstimatePtr& estimate : estimates)
    if (estimate->status == TrackStatus::tracking && estimate->hand_id == hand_)
      return estimate->segments[kPalm].T_camera_segment * T_palm_object_;
  return std::nullopt;
}

}  // namespace barehand
