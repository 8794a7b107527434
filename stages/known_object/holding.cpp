#include "stages/known_object/holding.h"

#include <limits>

namespace barehand {
namespace {

// A palm holds the object once it has moved by kCarried while the object stayed within kFirm of its place in the palm,
// until the object is farther than kLeft from this place [m].
constexpr double kCarried = 0.02, kFirm = 0.012, kLeft = 0.03;

}  // namespace

void Holding::update(std::int64_t utime, const HandEstimates& estimates, ObjectEstimate& state) {
  // Find the nearest palm.
  const HandEstimate* nearest = nullptr;
  const auto distance = [&](const HandEstimate& hand) {
    return (hand.segments[kPalm].T_camera_segment.t - state.T_camera_object.t).norm();
  };
  for (const HandEstimatePtr& estimate : estimates)
    if (estimate->status == TrackStatus::tracking && (!nearest || distance(*estimate) < distance(*nearest)))
      nearest = estimate.get();

  bool held = false;
  if (nearest) {
    // Start the comparison again with another palm, or if the object has left its place in the palm.
    const SE3& T_camera_palm = nearest->segments[kPalm].T_camera_segment;
    const Eigen::Vector3d in_palm = T_camera_palm.inverse() * state.T_camera_object.t;
    const double left =
        compared_hand_ == nearest->hand_id ? (in_palm - in_palm_).norm() : std::numeric_limits<double>::infinity();
    if (left > kLeft) {
      compared_hand_ = nearest->hand_id;
      in_palm_ = in_palm;
      palm_ = T_camera_palm.t;
    }

    // An object is held once it was carried, until it leaves the palm.
    held = (held_ && left < kLeft) || (left < kFirm && (T_camera_palm.t - palm_).norm() > kCarried);
  } else {
    compared_hand_ = -1;
  }

  // Fill in the state.
  if (held != held_ || since_ == 0) since_ = utime;
  held_ = held;
  state.held = held;
  state.hand_id = held ? compared_hand_ : -1;
  state.since = since_;
}

}  // namespace barehand
