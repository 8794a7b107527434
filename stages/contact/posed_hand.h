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

/// The skin and the capsules of one tracked hand, posed. The skin is the scanned one, or tapered cylinders, which take
/// no time to make.
class PosedHand {
 public:
  /// Takes over the pose of a tracked hand. The skin is made again if the profile has changed by more than fractions of
  /// a millimetre.
  void pose(const HandEstimate& estimate);

  const PosedSkin& skin(int segment) const { return skin_[segment]; }
  const HandCapsules& capsules() const { return *capsules_; }
  const HandPose& segments() const { return pose_; }

  /// Whether a place is on or in the skin, or behind the wrist (camera frame [m]).
  bool contains(const Eigen::Vector3f& p) const;
  /// Whether a point of a surface is the hand's own skin: near to it, and facing the same way. A touching object faces
  /// the skin.
  bool owns(const SurfacePoint& point) const;

 private:
  std::shared_ptr<const HandProfile> profile_;  // profile from which the skin was made
  HandSurface surface_;                         // skin in the frames of the segments
  std::optional<HandCapsules> capsules_;
  std::array<PosedSkin, kSegmentCount> skin_;
  HandPose pose_;
};

}  // namespace barehand
