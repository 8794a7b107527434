#pragma once

#include <vector>

#include "drivers/synthetic/people/body.h"
#include "drivers/synthetic/sequences/keyframes.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

// A simulated scene of objects, people and, optionally, one hand.

/// An object that stands still. World frame: z up, y away from the camera, x to the right; the camera looks at the
/// origin, or near it.
struct PlacedObject {
  SceneObject object;
  SE3 T_world_object;
};

/// A keyframe of the camera: its displacement [m] and rotation vector relative to its initial pose. World frame.
struct CameraKey {
  double time = 0;  ///< time of the keyframe [s]
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
};

/// A scene in front of a camera that may move: objects that stand still, bodies that move and, optionally, the right
/// hand of the first body.
class StagedSequence : public Sequence {
 public:
  struct Setting {
    double duration = 0;
    std::uint64_t seed = 0;
    SE3 T_camera_world;
    std::vector<CameraKey> camera = {{}};
    std::vector<PlacedObject> objects;
    std::vector<Body> bodies;
    std::vector<HandKey> hand;                                   ///< keyframes in the world frame; empty: no hand
    Eigen::Matrix3d R_world_hand = Eigen::Matrix3d::Identity();  ///< base orientation of these keyframes
  };
  explicit StagedSequence(Setting setting);
  double duration() const override { return setting_.duration; }
  const std::vector<SceneObject>& objects() const override { return objects_; }
  SceneState at(double time) const override;

 private:
  SE3 world_in_camera(double time) const;

  Setting setting_;
  std::vector<SceneObject> objects_;
  SmoothTrack camera_;
  std::optional<HandTrack> hand_;
};

}  // namespace barehand::synthetic
