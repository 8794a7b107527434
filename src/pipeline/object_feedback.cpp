#include "pipeline/object_feedback.h"

#include <algorithm>
#include <cmath>

#include "hand/grasps/holding.h"

namespace barehand {
namespace {

constexpr double kUncertain = 0.005;  // deviation of a place that is known too badly [m]
// An object that moves by so much less in a palm than in the camera frame, from frame to frame, is held [m].
constexpr double kCarried = 0.001;
constexpr double kSmooth = 0.5;  // weight of the newest motion

/// Standard deviation of the middle of an object, over all directions.
double deviation(const PosedObject& posed) {
  const auto J = point_jacobian(posed.T_camera_object.R * posed.object->centre);
  return std::sqrt((J * posed.covariance * J.transpose()).trace());
}

}  // namespace

const FrameVector<NearbyObject>& ObjectFeedback::wait() {
  while (taken_ + kLag <= tracked_) objects_ = results_.take(taken_++);
  return objects_;
}

void ObjectPlaces::Motion::add(std::int32_t hand, const Eigen::Vector3d& now_in_camera,
                               const Eigen::Vector3d& now_in_palm) {
  const bool same_hand = hand_id == hand;
  by_camera = same_hand ? by_camera + kSmooth * ((now_in_camera - in_camera).norm() - by_camera) : 0;
  by_palm = same_hand ? by_palm + kSmooth * ((now_in_palm - in_palm).norm() - by_palm) : 0;
  hand_id = hand;
  in_camera = now_in_camera;
  in_palm = now_in_palm;
}

FrameVector<NearbyObject> ObjectPlaces::place(std::span<const PosedObject> objects, const HandEstimates& estimates) {
  std::erase_if(motions_, [&](const auto& motion) {
    return std::ranges::none_of(objects, [&](const PosedObject& posed) { return posed.object->id == motion.first; });
  });

  FrameVector<NearbyObject> nearby;
  for (const PosedObject& posed : objects) {
    const double uncertain = deviation(posed);
    if (!(uncertain < kUncertain)) continue;
    NearbyObject& placed = nearby.emplace_back();
    placed = {posed.object, posed.T_camera_object, -1, posed.hand_id, uncertain};

    // Compare how far the object moved in the camera frame and in the nearest palm.
    const Eigen::Vector3d middle = posed.T_camera_object * posed.object->centre;
    const HandEstimate* const hand = nearest_palm(middle, estimates);
    if (!hand) continue;
    const SE3 T_palm_camera = hand->segments[kPalm].T_camera_segment.inverse();
    Motion& motion = motions_[posed.object->id];
    motion.add(hand->hand_id, middle, T_palm_camera * middle);

    // Place it in the palm if it moves with that.
    if (motion.by_palm >= motion.by_camera) continue;
    placed.hand_id = hand->hand_id;
    if (placed.holder_id >= 0 || motion.by_camera > motion.by_palm + kCarried) placed.holder_id = hand->hand_id;
    placed.T_base_object = T_palm_camera * posed.T_camera_object;
  }
  return nearby;
}

}  // namespace barehand
