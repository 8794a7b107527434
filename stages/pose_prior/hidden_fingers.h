#pragma once

#include <array>
#include <limits>
#include <optional>

#include "hand/grasps/finger_hold.h"
#include "hand/joint_angles.h"

namespace barehand {

// A prior for fingers that no data shows: they mostly bend with their neighbours, since a grasp closes all fingers and
// since their tendons are coupled (enslaving: Zatsiorsky, Li and Latash, Exp. Brain Res. 131, 2000).

/// Sets the hidden joints of a pose that a search found to neutral angles: a hidden finger is bent at its root like the
/// nearest fingers that are seen, and each further hidden joint like the joint before it, but the last joint by only
/// kDistalShare of the angle of the one before it.
HandPose with_hidden_neutral(const HandProfile& profile, const HandPose& pose,
                             const std::array<bool, kSegmentCount>& seen);

/// Infers the hidden fingers of one hand from frame to frame, and remembers what is needed for that.
class HiddenFingers {
 public:
  /// Returns `now` with the hidden parts of the fingers moved, within the profile's limits widened by `widening`
  /// [rad]. A joint counts as hidden if it is hidden together with all joints after it. The thumb and everything seen
  /// stay unchanged.
  ///
  /// A finger that is held closes on the object, or stays where it rests. A joint of any other finger bends by as much
  /// as the same joints of the nearest seen fingers have bent since `before`, `dt` [s] ago; any other difference from
  /// these joints decays within seconds, or at once after a release. If only the thumb is seen, all fingers bend with
  /// it, since a grasp closes all digits at once. The abduction returns to what was seen last.
  /// `shown`: the fraction of each segment's skin that matches data.
  HandPose follow(const HandProfile& profile, const HandPose& before, const HandPose& now, double dt,
                  const std::array<bool, kSegmentCount>& seen, const std::array<double, kSegmentCount>& shown,
                  const std::array<FingerHold, kFingerCount>& holds, double widening);
  /// Forgets the hand.
  void forget() { fingers_ = {}; }

 private:
  struct Finger {
    std::optional<double> abduction;                              // of its root, as it was seen [rad]; none: never seen
    double since_held = std::numeric_limits<double>::infinity();  // [s]
  };
  void remember(const HandProfile& profile, const HandPose& now, double dt,
                const std::array<double, kSegmentCount>& shown, const std::array<FingerHold, kFingerCount>& holds);

  std::array<Finger, kFingerCount> fingers_;
};

}  // namespace barehand
