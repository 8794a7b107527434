#include "drivers/synthetic/people/staged_sequence.h"

#include <utility>

namespace barehand::synthetic {

// Plays a scene with a moving camera, objects that stand still, moving bodies and, optionally, one hand.

namespace {

SmoothTrack make_track(const std::vector<CameraKey>& keys) {
  std::vector<double> times;
  std::vector<std::vector<double>> values;
  for (const CameraKey& key : keys) {
    times.push_back(key.time);
    values.push_back({key.shift.x(), key.shift.y(), key.shift.z(), key.turn.x(), key.turn.y(), key.turn.z()});
  }
  return {std::move(times), std::move(values)};
}

}  // namespace

StagedSequence::StagedSequence(Setting setting) : setting_(std::move(setting)), camera_(make_track(setting_.camera)) {
  for (const PlacedObject& placed : setting_.objects) objects_.push_back(placed.object);
  for (const Body& body : setting_.bodies)
    for (SceneObject& part : body.objects()) objects_.push_back(std::move(part));
  if (!setting_.hand.empty()) hand_.emplace(setting_.R_world_hand, setting_.hand);
}

SE3 StagedSequence::world_in_camera(double time) const {
  const std::vector<double> v = camera_.at(time);
  const SE3 T_world_camera = setting_.T_camera_world.inverse();
  return SE3{exp_so3({v[3], v[4], v[5]}) * T_world_camera.R, T_world_camera.t + Eigen::Vector3d(v[0], v[1], v[2])}
      .inverse();
}

SceneState StagedSequence::at(double time) const {
  // Place the objects that stand still.
  const SE3 T_camera = world_in_camera(time);
  SceneState state;
  for (const PlacedObject& placed : setting_.objects) state.T_camera_object.push_back(T_camera * placed.T_world_object);

  // Pose the hand, and find the elbow of its arm.
  std::optional<Eigen::Vector3d> wrist;
  if (hand_) {
    HandState hand{with_tremor(hand_->at(time), time, setting_.seed), {}};
    wrist = hand.skeleton.T_camera_palm.t;  // still in the world frame
    hand.elbow = T_camera * setting_.bodies.front().right_elbow(time, *wrist);
    hand.skeleton.T_camera_palm = T_camera * hand.skeleton.T_camera_palm;
    state.hands.push_back(hand);
  }

  // Pose the bodies; the hand belongs to the first one.
  for (const Body& body : setting_.bodies) {
    for (const SE3& T_world_object : body.poses(time, wrist))
      state.T_camera_object.push_back(T_camera * T_world_object);
    wrist.reset();
  }
  return state;
}

}  // namespace barehand::synthetic
