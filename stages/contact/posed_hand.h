#pragma once

#include <array>
#include <memory>
#include <optional>

#include "hand/hand_pose.h"
#include "hand/surface.h"
#include "stages/contact/hand_capsules.h"
#include "stages/contact/surface_cells.h"
#include "stages/contact/surface_distance.h"

namespace barehand {

/// The skin and the capsules of one tracked hand at its estimated pose. The skin is the scanned one if the profile has
/// one, otherwise tapered cylinders, which are fast to build.
class PosedHand {
 public:
  /// Sets the pose of a tracked hand. The skin is rebuilt if the profile has changed by more than fractions of a
  /// millimetre.
  void pose(const HandEstimate& estimate);

  const PosedSkin& skin(int segment) const { return skin_[segment]; }
  const HandCapsules& capsules() const { return *capsules_; }
  const HandPose& segments() const { return pose_; }

  /// Whether a point is on or in the skin, or behind the wrist (camera frame [m]).
  bool contains(const Eigen::Vector3f& p) const;
  /// Whether a point of a surface is on the hand's own skin: near to it, with a similar normal. The surface of an
  /// object that the hand touches faces the opposite way.
  bool owns(const SurfacePoint& point) const;

 private:
  std::shared_ptr<const HandProfile> profile_;  // profile from which the skin was built
  HandSurface surface_;                         // skin in the frames of the segments
  std::optional<HandCapsules> capsules_;
  std::array<PosedSkin, kSegmentCount> skin_;
  HandPose pose_;
};

}  // namespace barehand
