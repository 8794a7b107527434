#pragma once

#include "drivers/synthetic/hand/skinning.h"
#include "drivers/synthetic/rendering/signed_distance.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

/// Closes a hand around an object until the skin touches it. All joints close at the same time. A phalanx
/// that touches stops its own joint and all joints before it, while the joints after it continue to close.
class GraspPlanner {
 public:
  explicit GraspPlanner(const HandRig& rig);

  /// Moves the object along `direction` (palm frame, unit vector away from the palm), starting at `T_palm_object`,
  /// until it just touches a hand with these angles. Returns its pose in the palm frame.
  SE3 place_at_palm(const SE3& T_palm_object, const Eigen::Vector3d& direction, const SignedDistance& object_distance,
                    const HandAngles& angles) const;

  /// The angles between `open` and `closed` at which the skin touches the object.
  HandAngles close(const HandAngles& open, const HandAngles& closed, const SE3& T_palm_object,
                   const SignedDistance& object_distance) const;

  /// Smallest distance between the skin of each segment and the object [m]; negative inside the object.
  std::array<double, kSegmentCount> clearance(const HandAngles& angles, const SE3& T_palm_object,
                                              const SignedDistance& object_distance) const;

 private:
  const HandRig& rig_;
  Skinner skinner_;
};

}  // namespace barehand::synthetic
