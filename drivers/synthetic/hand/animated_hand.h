#pragma once

#include <string>

#include "drivers/synthetic/hand/hand_shape.h"
#include "drivers/synthetic/hand/skinning.h"
#include "drivers/synthetic/sequences/sequence.h"

namespace barehand::synthetic {

/// A simulated hand: its mesh and the profile measured on it. Sequences move it as a right hand; a left hand is the
/// mirror image in the plane x = 0.
class AnimatedHand {
 public:
  /// Index of the sleeve's surface, which follows those of the segments.
  static constexpr std::uint8_t kSleeve = kSegmentCount;
  static constexpr std::uint8_t kSurfaceCount = kSegmentCount + 1;  ///< one for each segment, and the sleeve

  /// Loads the mesh of this side. Errors: the hand mesh was not fetched or is unusable. `mesh_folder`: see
  /// hand_mesh_folder().
  static Result<AnimatedHand> load(Handedness side, const HandShape& shape, const std::string& mesh_folder);

  Handedness side() const { return profile_.handedness; }
  /// The profile as measured on the mesh at rest.
  const HandProfile& profile() const { return profile_; }
  /// The hand as a right hand, for which sequences are made.
  const HandRig& rig() const { return rig_; }
  /// Segment of every triangle of the skin.
  const std::vector<std::uint8_t>& triangle_segments() const { return skinner_.triangle_segments(); }

  /// Segment of every vertex of the skin.
  const std::vector<std::uint8_t>& vertex_segments() const { return skinner_.vertex_segments(); }

  /// T_camera_segment; a left hand's poses are mirrored.
  HandPose pose(const SkeletonPose& skeleton) const;
  /// Triangles in the camera frame: first the skin, in the order of triangle_segments(), then the forearm (`sleeve` is
  /// "blue", "skin" or "none", see SimulatorParams). The indices of surfaces start at `first_surface`.
  SceneGeometry geometry(const HandState& state, const std::string& sleeve, std::uint8_t first_surface) const;

 private:
  AnimatedHand(const HandMesh& right, HandProfile profile, double scale);

  HandRig rig_;
  Skinner skinner_;
  HandProfile profile_;
  double scale_;
};

}  // namespace barehand::synthetic
