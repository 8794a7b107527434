#pragma once

#include "drivers/synthetic/hand/skinning.h"
#include "drivers/synthetic/rendering/signed_distance.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

/// Closes the hand around a thing until the skin touches it, finger by finger and joint by joint. A phalanx that
/// touches stops its own joint and all joints before it, while the joints after it go on.
class GraspPlanner {
 public:
  explicit GraspPlanner(const HandRig& rig);

  /// Moves the thing along `direction` (palm frame, unit vector away from the palm), starting at `T_palm_thing`, until
  /// it touches the palm of a hand with these angles.
  SE3 place_at_palm(const SE3& T_palm_thing, const Eigen::Vector3d& direction, const SignedDistance& thing,
                    const HandAngles& angles) const;

  /// The angles between `open` and `closed` at which the skin touches the thing.
  HandAngles close(const HandAngles& open, const HandAngles& closed, const SE3& T_palm_thing,
                   const SignedDistance& thing) const;

  /// Smallest distance between the skin of each segment and the thing [m]; negative inside it.
  std::array<double, kSegmentCount> clearance(const HandAngles& angles, const SE3& T_palm_thing,
                                              const SignedDistance& thing) const;

 private:
  const HandRig& rig_;
  Skinner skinner_;
};

}  // namespace barehand::synthetic
