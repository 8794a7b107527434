#pragma once

#include <array>
#include <optional>
#include <vector>

#include "drivers/synthetic/people/arm.h"
#include "drivers/synthetic/sequences/keyframes.h"
#include "drivers/synthetic/sequences/sequence.h"
#include "math/random.h"

namespace barehand::synthetic {

/// The measures of a clothed body [m].
struct BodySize {
  double shoulder = 0.19;  ///< from the middle of the body to a shoulder joint
  double depth = 0.12;     ///< half of the chest's thickness
  double torso = 0.55;     ///< from the shoulders to the hips
  double head = 1;         ///< factor on the head's size
  ArmSize arm;
};
/// The measures of some adult.
BodySize random_body(KeyedRandom& random);

inline constexpr std::size_t kHeadParts = 6;
/// A head that looks to -y, about its centre, z up: skull, jaw, nose, ears and hair. All parts share one frame.
std::array<SceneObject, kHeadParts> make_head(double size);

/// The posture of a body at one time. The right arm is the first one.
struct BodyKey {
  double time = 0;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), turn = Eigen::Vector3d::Zero();  ///< of the body where it stands
  Eigen::Vector3d head_turn = Eigen::Vector3d::Zero();
  std::array<Eigen::Vector3d, 2> wrists{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};  ///< body frame [m]
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
    bool right_forearm = true;  ///< false: a simulated hand comes with its own
  };
  explicit Body(Setting setting);

  /// The parts of the body, each in its own frame.
  std::vector<SceneObject> objects() const;
  /// T_world_object of each of them at this time. `right_wrist`: that of a simulated hand, in the world frame.
  std::vector<SE3> poses(double time, const std::optional<Eigen::Vector3d>& right_wrist = {}) const;
  /// Where the right elbow is when the right wrist is there. World frame.
  Eigen::Vector3d right_elbow(double time, const Eigen::Vector3d& right_wrist) const;

 private:
  BodyKey at(double time) const;
  SE3 frame(const BodyKey& key) const;

  Setting setting_;
  SmoothTrack track_;
};

}  // namespace barehand::synthetic
