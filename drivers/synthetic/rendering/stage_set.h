#pragma once

#include "drivers/synthetic/sequences/keyframes.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

// Parts that several simulated scenes use: camera, table, and a hand that moves in the air.

/// T_camera_world of a scene on a table. World frame: origin on the table, z up, y away from the camera, x to the
/// right. The camera looks at the point `height` [m] above the origin from the distance `distance` [m]; it looks `tilt`
/// [rad] below the horizon (pi / 2: straight down).
SE3 camera_above_table(double tilt, double distance, double height = 0);

/// A large table top around the world's origin.
SceneObject make_table();

/// Orientation, in the camera frame, of a right hand that shows its palm to the camera, with the fingers up.
Eigen::Matrix3d palm_to_camera();

/// A sequence of a hand that moves freely in the air, in the camera frame, while objects stand still.
class FreeSequence : public Sequence {
 public:
  struct Setting {
    double duration = 0;
    std::vector<HandKey> keys;
    Eigen::Matrix3d base = palm_to_camera();
    Eigen::Vector3d wrist_to_elbow = Eigen::Vector3d(0.05, 0.25, 0.05);  ///< vector at the first keyframe [m]
    std::vector<SceneObject> objects;
    std::vector<SE3> T_camera_object;
    std::uint64_t seed = 0;
  };
  explicit FreeSequence(Setting setting);
  double duration() const override { return setting_.duration; }
  const std::vector<SceneObject>& objects() const override { return setting_.objects; }
  SceneState at(double time) const override;

 private:
  Setting setting_;
  HandTrack track_;
};

/// Sequences of one hand in the air; sequence_list() describes what each of them shows.
std::unique_ptr<Sequence> make_fist(std::uint64_t seed);
std::unique_ptr<Sequence> make_open(std::uint64_t seed);
std::unique_ptr<Sequence> make_scan(std::uint64_t seed);
std::unique_ptr<Sequence> make_wave(std::uint64_t seed);
std::unique_ptr<Sequence> make_returns(std::uint64_t seed);
/// A right and a left hand that do not touch.
std::unique_ptr<Sequence> make_two_hands(std::uint64_t seed);
/// A hand behind a plate that hides `degree` / 6 of the fingers; `degree` is 0 to 6.
std::unique_ptr<Sequence> make_occlusion(const HandRig& rig, int degree, std::uint64_t seed);
/// The object of a grasp sequence.
enum class GraspedShape { mug, ball, pliers };
/// A hand that grasps, lifts, turns and releases an object on a table.
std::unique_ptr<Sequence> make_grasp(const HandRig& rig, GraspedShape shape, std::uint64_t seed);

}  // namespace barehand::synthetic
