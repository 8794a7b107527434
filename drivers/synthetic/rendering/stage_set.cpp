#include "drivers/synthetic/rendering/stage_set.h"

#include <cmath>
#include <numbers>

#include "drivers/synthetic/rendering/shapes.h"

namespace barehand::synthetic {

// Parts that several simulated scenes use: the camera above a table, the table, and a hand that moves in the air.

SE3 camera_above_table(double tilt, double distance, double height) {
  SE3 T;
  T.R.col(0) = Eigen::Vector3d::UnitX();
  T.R.col(1) = Eigen::Vector3d(0, -std::sin(tilt), std::cos(tilt));
  T.R.col(2) = Eigen::Vector3d(0, -std::cos(tilt), -std::sin(tilt));
  T.t = Eigen::Vector3d(0, 0, distance) - height * T.R.col(2);
  return T;
}

SceneObject make_table() { return {"table", make_plate({-2.0, -1.0, 0}, {4.0, 0, 0}, {0, 3.5, 0}), {{124, 136, 148}}}; }

Eigen::Matrix3d palm_to_camera() {
  Eigen::Matrix3d R;
  R.col(0) = -Eigen::Vector3d::UnitX();
  R.col(1) = Eigen::Vector3d::UnitZ();
  R.col(2) = Eigen::Vector3d::UnitY();
  return R;
}

FreeSequence::FreeSequence(Setting setting) : setting_(std::move(setting)), track_(setting_.base, setting_.keys) {
  const double straight_down = std::numbers::pi / 2;
  setting_.objects.insert(setting_.objects.begin(), make_table());
  setting_.T_camera_object.insert(setting_.T_camera_object.begin(), camera_above_table(straight_down, 0.95));
}

SceneState FreeSequence::at(double time) const {
  const SkeletonPose skeleton = with_tremor(track_.at(time), time, setting_.seed);
  // Move the elbow 0.9 times as far as the wrist.
  const Eigen::Vector3d start = setting_.keys.front().position;
  const Eigen::Vector3d elbow = start + setting_.wrist_to_elbow + 0.9 * (skeleton.T_camera_palm.t - start);
  return {{{skeleton, elbow}}, setting_.T_camera_object};
}

}  // namespace barehand::synthetic
