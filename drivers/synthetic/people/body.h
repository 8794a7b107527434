#pragma once

#include <array>
#include <optional>
#include <vector>

#include "drivers/synthetic/people/arm.h"
#include "drivers/synthetic/sequences/keyframes.h"
#include "drivers/synthetic/sequences/sequence.h"
#include "math/random.h"

namespace barehand::synthetic {

// The body of a simulated person.

/// The dimensions of a clothed body [m].
struct BodySize {
  double shoulder = 0.19;  ///< distance from the middle of the body to a shoulder joint
  double depth = 0.12;     ///< half of the chest's thickness
  double torso = 0.55;     ///< distance from the shoulders to the hips
  double head = 1;         ///< scale of the head, without unit; 1 = standard size
  ArmSize arm;
};
/// The dimensions of a random adult.
BodySize random_body(KeyedRandom& random);

inline constexpr std::size_t kHeadParts = 6;
/// A head: skull, jaw, nose, ears and hair. All parts share one frame: origin at the centre of the head, z up, the face
/// towards -y.
std::array<SceneObject, kHeadParts> make_head(double size);

/// A keyframe of a body: its posture at one time. The right arm is the first one.
struct BodyKey {
  double time = 0;  ///< time of the keyframe [s]
  /// Displacement [m] and rotation vector of the body relative to its place in the scene.
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();
  Eigen::Vector3d head_turn = Eigen::Vector3d::Zero();  ///< rotation vector of the head relative to the body
  /// Positions of the wrists in the body frame [m].
  std::array<Eigen::Vector3d, 2> wrists{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

/// A person without hands: torso, head and arms that end in sleeves. Body frame: origin midway between the shoulders,
/// z up, y to the back, x to the body's left.
class Body {
 public:
  struct Setting {
    BodySize size;
    SE3 T_world_body;
    std::vector<BodyKey> keys;
    bool head = true;
    bool right_forearm = true;  ///< whether it has a right forearm; false: a simulated hand brings its own
  };
  explicit Body(Setting setting);

  /// The parts of the body, each in its own frame.
  std::vector<SceneObject> objects() const;
  /// T_world_object of each of these parts at this time. `right_wrist`: position of a simulated hand's wrist in the
  /// world frame, to which the right arm leads; none: the keyframes give its position.
  std::vector<SE3> poses(double time, const std::optional<Eigen::Vector3d>& right_wrist = {}) const;
  /// Position of the right elbow if the right wrist is at this position. World frame.
  Eigen::Vector3d right_elbow(double time, const Eigen::Vector3d& right_wrist) const;

 private:
  BodyKey at(double time) const;
  SE3 frame(const BodyKey& key) const;

  Setting setting_;
  SmoothTrack track_;
};

}  // namespace barehand::synthetic
