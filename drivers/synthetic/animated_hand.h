#pragma once

#include <string>

#include "drivers/synthetic/hand_shape.h"
#include "drivers/synthetic/sequence.h"
#include "drivers/synthetic/skinning.h"

namespace barehand::synthetic {

/// A simulated hand. Sequences move it as a right hand; a left one shows what a mirror in the plane x = 0 shows.
class AnimatedHand {
 public:
  static constexpr std::uint8_t kSleeve = kSegmentCount;            ///< surface after those of the segments
  static constexpr std::uint8_t kSurfaceCount = kSegmentCount + 1;  ///< surfaces of one hand

  /// Errors: hand mesh not fetched or unfit. `mesh_folder`: see hand_mesh_folder().
  static Result<AnimatedHand> load(Handedness side, const HandShape& shape, const std::string& mesh_folder);

  Handedness side() const { return profile_.handedness; }
  /// As measured on the hand itself at rest.
  const HandProfile& profile() const { return profile_; }
  /// What sequences are made for: the hand as a right one.
  const HandRig& rig() const { return rig_; }
  /// Segment of every triangle of the skin.
  const std::vector<std::uint8_t>& triangle_segments() const { return skinner_.triangle_segments(); }

  /// T_camera_segment.
  HandPose pose(const SkeletonPose& skeleton) const;
  /// Triangles in the camera frame: the skin first, in the order of triangle_segments(), then what the forearm wears
  /// ("blue", "skin" or "none", see SimulatorParams). Surfaces count from `first_surface`.
  SceneGeometry geometry(const HandState& state, const std::string& sleeve, std::uint8_t first_surface) const;

 private:
  AnimatedHand(const HandMesh& right, HandProfile profile, double scale);

  HandRig rig_;
  Skinner skinner_;
  HandProfile profile_;
  double scale_;
};

}  // namespace barehand::synthetic
