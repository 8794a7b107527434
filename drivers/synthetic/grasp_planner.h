#pragma once

#include "drivers/synthetic/sequence.h"
#include "drivers/synthetic/signed_distance.h"
#include "drivers/synthetic/skinning.h"

namespace barehand::synthetic {

/// Closes the hand around a thing until the skin touches it, finger by finger and joint by joint: a phalanx that
/// touches stops its own joint and those before it; the joints after it go on.
class GraspPlanner {
 public:
  explicit GraspPlanner(const HandRig& rig);

  /// Moves the thing along `direction` (palm frame, unit, away from the palm) from `T_palm_thing` to where it touches
  /// the palm of a hand with these angles.
  SE3 place_at_palm(const SE3& T_palm_thing, const Eigen::Vector3d& direction, const SignedDistance& thing,
                    const HandAngles& angles) const;

  /// Angles between `open` and `closed` at which the skin comes within contact of the thing.
  HandAngles close(const HandAngles& open, const HandAngles& closed, const SE3& T_palm_thing,
                   const SignedDistance& thing) const;

  /// Smallest distance between the skin of each segment and the thing; negative = inside it.
  std::array<double, kSegmentCount> clearance(const HandAngles& angles, const SE3& T_palm_thing,
                                              const SignedDistance& thing) const;

 private:
  const HandRig& rig_;
  Skinner skinner_;
};

}  // namespace barehand::synthetic
