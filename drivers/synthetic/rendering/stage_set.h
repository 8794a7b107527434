#pragma once

#include "drivers/synthetic/sequences/keyframes.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

/// T_camera_world of a scene on a table. World frame: origin on the table, z up, y away from the camera, x to the
/// right. The camera looks at the point `height` above the origin from the distance `distance` [m], `tilt` below the
/// horizon [rad]; pi / 2 is straight down.
SE3 camera_above_table(double tilt, double distance, double height = 0);

/// A large table top around the world's origin.
SceneObject make_table();

/// Orientation of a right hand that shows its palm to the camera, with the fingers up.
Eigen::Matrix3d palm_to_camera();

/// A sequence of a hand that moves in the air on a track, in the camera frame, while objects stand still.
class FreeSequence : public Sequence {
 public:
  struct Setting {
    double duration = 0;
    std::vector<HandKey> keys;
    Eigen::Matrix3d base = palm_to_camera();
    Eigen::Vector3d wrist_to_elbow = Eigen::Vector3d(0.05, 0.25, 0.05);  ///< at the first key [m]
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

/// One hand in the air; see sequence_list() for what each of these sequences shows.
std::unique_ptr<Sequence> make_fist(std::uint64_t seed);
std::unique_ptr<Sequence> make_open(std::uint64_t seed);
std::unique_ptr<Sequence> make_scan(std::uint64_t seed);
std::unique_ptr<Sequence> make_wave(std::uint64_t seed);
std::unique_ptr<Sequence> make_returns(std::uint64_t seed);
/// A right and a left hand that do not touch.
std::unique_ptr<Sequence> make_two_hands(std::uint64_t seed);
/// `degree` 0 to 6: the occluder hides degree / 6 of the fingers.
std::unique_ptr<Sequence> make_occlusion(const HandRig& rig, int degree, std::uint64_t seed);
/// What a grasp sequence grasps.
enum class GraspedThing { mug, ball, pliers };
/// A hand that grasps, lifts, turns and releases a thing on a table.
std::unique_ptr<Sequence> make_grasp(const HandRig& rig, GraspedThing thing, std::uint64_t seed);

}  // namespace barehand::synthetic
