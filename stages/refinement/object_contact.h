#pragma once

#include <array>
#include <optional>
#include <span>

#include "hand/gaussian_tree.h"
#include "hand/grasps/finger_hold.h"
#include "hand/hand_pose.h"
#include "hand/joint_angles.h"
#include "hand/surface.h"
#include "object/known_object.h"

namespace barehand {

/// Weights of the terms that couple a hand with the objects whose shape is known or guessed.
struct ObjectContactParams {
  bool enabled = true;
  double sigma_inside = 0.002;
  double sigma_touch = 0.004;
  double touch_scale = 0.015;
  bool operator==(const ObjectContactParams&) const = default;
};

template <class V>
void visit(V& v, ObjectContactParams& p) {
  v("enabled", p.enabled,
    "keep fingers out of known and of round objects, and close hidden ones on what the hand grips");
  v("sigma_inside", p.sigma_inside, 1e-5, 1.0, "m, standard deviation of the depth of a segment within an object");
  v("sigma_touch", p.sigma_touch, 1e-5, 1.0,
    "m, standard deviation of the distance of a hidden fingertip from the object that its hand holds");
  v("touch_scale", p.touch_scale, 1e-4, 1.0, "m, Geman-McClure scale of that distance");
}

/// Couples a hand with the objects near it whose shape is known or guessed: its fingers do not enter them, and hidden
/// tips of a hand that grips an object are drawn to its surface. Immutable once made.
class ObjectContact {
 public:
  /// `surface`: the skin of the hand.
  ObjectContact(const ObjectContactParams& params, HandSurface surface);

  /// What add_terms() added.
  struct Terms {
    double energy = 0;
    std::array<double, kFingerCount> rests{};  ///< how firmly each hidden fingertip rests on an object, from 0 to 1
  };
  /// Adds the distances of the fingers from the objects as least-squares residuals to `tree`; returns the energy. The
  /// distance of a segment is that of the point of its skin that is nearest to the object, or deepest within it.
  /// Objects move neither with the fingers nor, though a held one is fixed to it, with the palm: the tree's blocks of
  /// the palm stay as they are. `hidden`: how hidden each segment is, from 0 to 1.
  Terms add_terms(const HandPose& pose, std::span<const NearbyObject> objects,
                  const std::array<double, kSegmentCount>& hidden, GaussianTree& tree) const;

  /// How far each hidden finger of a hand that grips an object is bent once it is closed on that: its hidden joints
  /// bend together from straight, and each stops when its segment or one after it touches. None for the thumb, for a
  /// finger that is seen to its tip, and for one whose pad does not come to touch the object, or that touches it
  /// straight. `limits` of the joints [rad].
  std::array<std::optional<FingerFlexion>, kFingerCount> closed(const HandProfile& profile,
                                                                const std::array<JointLimits, kSegmentCount>& limits,
                                                                const HandPose& pose,
                                                                std::span<const NearbyObject> objects,
                                                                const std::array<double, kSegmentCount>& hidden) const;

 private:
  /// The place of a segment's skin that is nearest to an object.
  struct Nearest {
    double distance = DistanceGrid::kMargin;      // signed [m]
    Eigen::Vector3d point, gradient = {0, 0, 0};  // camera frame; the gradient is that of the distance
  };
  std::array<Nearest, kSegmentCount> nearest_of_all(const HandPose& pose, const DistanceGrid& grid,
                                                    const SE3& T_camera_object) const;
  double grip(const std::array<Nearest, kSegmentCount>& near, const std::array<double, kSegmentCount>& hidden,
              bool held) const;
  Nearest nearest(const SE3& T_camera_segment, int segment, const DistanceGrid& grid, const SE3& T_camera_object) const;
  std::optional<FingerFlexion> close(int finger, int first, const HandProfile& profile,
                                     const std::array<JointLimits, kSegmentCount>& limits, const HandPose& pose,
                                     const DistanceGrid& grid, const SE3& T_camera_object) const;

  ObjectContactParams params_;
  HandSurface surface_;
  struct Sphere {
    Eigen::Vector3f centre = {0, 0, 0};
    float radius = 0;
  };
  std::array<Sphere, kSegmentCount> spheres_;  // around the skin of each segment, in its frame
};

}  // namespace barehand
